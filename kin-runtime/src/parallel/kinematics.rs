//! What every generated mechanism can do.

use super::newton::{Task, close};
use super::posture::Posture;
use super::postures::Postures;
use crate::{Jacobian, JointLimit, Pose, Solution, Solutions, Twist};

/// The kinematics of a parallel mechanism: K chains from one base to one
/// platform, with N joints together, M of them actuated (MLS section 3.5).
///
/// Generated mechanisms are zero-sized types that implement this trait and
/// offer the same methods inherently. A configuration q lists the joints of the
/// first chain, then those of the second, and so on; radians and metres.
/// Velocities are spatial twists (v, ω) of the platform.
///
/// ```
/// use kin_runtime::{JointLimit, ParallelKinematics, Pose, Twist};
///
/// /// A parallelogram: two cranks of 1 m, 2 m apart, and a coupler that does
/// /// not turn. The first crank is driven.
/// struct Parallelogram;
///
/// impl ParallelKinematics<4, 1, 2> for Parallelogram {
///     const JOINT_NAMES: [&'static str; 4] = ["crank", "pin", "rocker", "other_pin"];
///     const LIMITS: [JointLimit; 4] = [JointLimit::Continuous; 4];
///     const CHAINS: [[usize; 2]; 2] = [[0, 2], [2, 4]];
///     const ACTUATED: [usize; 1] = [0];
///     const BASE: &'static str = "frame";
///     const PLATFORM: &'static str = "coupler";
///     const LENGTH: f64 = 2.0;
///     const MOBILITY: usize = 1;
///     const BRANCHES: [usize; 2] = [0, 0];
///     const ASSEMBLY_MODES: usize = 0;
///
///     fn chains(&self, q: &[f64; 4]) -> ([Pose; 2], [Twist; 4]) {
///         let arm = |x: f64, a: f64, b: f64| {
///             let z = [0.0, 0.0, 1.0];
///             let crank = Twist::revolute(z, [x, 0.0, 0.0]);
///             let turned = Pose::exp(&crank, a);
///             let pin = Twist::revolute(z, [x, 1.0, 0.0]);
///             let home = Pose::from_translation([1.0, 1.0, 0.0]);
///             (turned * Pose::exp(&pin, b) * home, [crank, turned.adjoint(&pin)])
///         };
///         let (left, [a, b]) = arm(0.0, q[0], q[1]);
///         let (right, [c, d]) = arm(2.0, q[2], q[3]);
///         ([left, right], [a, b, c, d])
///     }
/// }
///
/// let turned = Parallelogram.fk_near(&[0.3], &[0.0; 4]).unwrap();
/// assert!(turned.residual < 1e-12 && (turned.q[2] - 0.3).abs() < 1e-12);
/// // The coupler moves at right angles to the crank.
/// let forward = Parallelogram.forward_jacobian(&[0.0; 4]).unwrap();
/// assert!((forward.rows[0][0] + 1.0).abs() < 1e-15);
/// // Stretched flat, it may turn into an antiparallelogram: the structure
/// // equation's Jacobian loses rank.
/// let flat = core::f64::consts::FRAC_PI_2;
/// assert!(Parallelogram.kinematic_singularity(&[flat, -flat, flat, -flat]) < 1e-15);
/// ```
pub trait ParallelKinematics<const N: usize, const M: usize, const K: usize> {
    /// The joints' names, chain after chain, from base to platform.
    const JOINT_NAMES: [&'static str; N];
    /// The joints' kinds and travel.
    const LIMITS: [JointLimit; N];
    /// The first joint of every chain, and one past its last.
    const CHAINS: [[usize; 2]; K];
    /// Which joints are actuated, by number.
    const ACTUATED: [usize; M];
    /// The frame that poses are given in.
    const BASE: &'static str;
    /// The frame that poses are of.
    const PLATFORM: &'static str;
    /// What an angle of one radian is worth beside lengths, metres.
    const LENGTH: f64;
    /// How many independent motions the mechanism has where it is regular.
    const MOBILITY: usize;
    /// How many branches each chain's inverse kinematics looks at; 0 if it was
    /// not generated.
    const BRANCHES: [usize; K];
    /// How many assembly modes closed-form forward kinematics looks at; 0 if there
    /// is none, and [`ParallelKinematics::fk_near`] has to do.
    const ASSEMBLY_MODES: usize;

    /// Where each chain puts the platform, and the spatial twist of each joint,
    /// displaced by those before it in its chain: J₁, J₂, … side by side.
    fn chains(&self, q: &[f64; N]) -> ([Pose; K], [Twist; N]);

    /// All configurations that hold the platform at `target`; none if one of
    /// the chains cannot reach it. Limits are not applied, see
    /// [`Postures::nearest`].
    fn ik(&self, target: &Pose) -> Postures<N, K> {
        self.ik_near(target, &[0.0; N])
    }

    /// As [`ParallelKinematics::ik`]; an angle that a singular target leaves
    /// free keeps its value in `seed`.
    fn ik_near(&self, target: &Pose, seed: &[f64; N]) -> Postures<N, K> {
        const {
            assert!(
                K == 0 || Self::BRANCHES[0] == 0,
                "a mechanism with branches has to implement `ik_near`"
            );
            assert!(
                K > 0 && Self::BRANCHES[0] > 0,
                "this mechanism was generated without inverse kinematics (`ik = none`)"
            );
        }
        let _ = (target, seed);
        Postures::new(Self::CHAINS)
    }

    /// All assembly modes with the given values of the actuated joints, radians and
    /// metres, by closed form. Of the ways to hold one platform pose with the
    /// same actuated joints, the nearest to q = 0 stands for all.
    fn fk(&self, actuated: &[f64; M]) -> Solutions<N> {
        const {
            assert!(
                Self::ASSEMBLY_MODES == 0,
                "a mechanism with assembly modes has to implement `fk`"
            );
            assert!(
                Self::ASSEMBLY_MODES > 0,
                "this mechanism has no closed form of its forward kinematics: use `fk_near`"
            );
        }
        let _ = actuated;
        Solutions::new()
    }

    /// The assembly with the given values of the actuated joints that Newton's
    /// method finds from `seed`, whose own actuated values are not read. At
    /// most 60 steps; none if the loops do not close to 1e-12 of the
    /// mechanism's length by then.
    fn fk_near(&self, actuated: &[f64; M], seed: &[f64; N]) -> Option<Solution<N>> {
        let mut q = *seed;
        for (joint, value) in Self::ACTUATED.iter().zip(actuated) {
            q[*joint] = *value;
        }
        let task = Task {
            chains: &Self::CHAINS,
            actuated: &Self::ACTUATED,
            length: Self::LENGTH,
        };
        let evaluate = |q: &[f64], poses: &mut [Pose], twists: &mut [Twist]| {
            let (p, t) = self.chains(&core::array::from_fn(|i| q[i]));
            poses.copy_from_slice(&p);
            twists.copy_from_slice(&t);
        };
        let (mut poses, mut twists) = ([Pose::IDENTITY; K], [Twist::default(); N]);
        let mut best = [0.0; N];
        let gap = close(task, evaluate, &mut q, &mut best, &mut poses, &mut twists);
        (gap <= 1e-12 * Self::LENGTH).then(|| Solution {
            q,
            residual: gap,
            branch: 0,
            singular: self.actuator_singularity(&q) < 1e-6,
        })
    }

    /// The platform's pose by the first chain; by all of them where the loops
    /// are closed.
    fn platform(&self, q: &[f64; N]) -> Pose {
        self.chains(q).0[0]
    }

    /// The values of the actuated joints.
    fn actuated(&self, q: &[f64; N]) -> [f64; M] {
        Self::ACTUATED.map(|joint| q[joint])
    }

    /// The structure equation: the spatial twist that takes each chain's end to
    /// that of the first. All zero where the loops are closed.
    fn structure_equation(&self, q: &[f64; N]) -> [Twist; K] {
        let poses = self.chains(q).0;
        poses.map(|pose| (poses[0] * pose.inverse()).log())
    }

    /// How far the ends of the chains are apart, the larger of the translation
    /// and the angle times [`ParallelKinematics::LENGTH`]; metres.
    fn gap(&self, q: &[f64; N]) -> f64 {
        posture::<Self, _, _, _, _>(self, q, |posture| posture.gap())
    }

    /// The Jacobian of the structure equation: the columns of chain k are Jₖ,
    /// and J₁ θ̇₁ = J₂ θ̇₂ = … is the platform's spatial velocity.
    fn structure_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        Jacobian::from_columns(self.chains(q).1)
    }

    /// From actuated rates to the platform's spatial velocity; none if the
    /// platform can move while the actuated joints are locked.
    fn forward_jacobian(&self, q: &[f64; N]) -> Option<Jacobian<M>> {
        posture::<Self, _, _, _, _>(self, q, |posture| {
            posture.forward_jacobian().map(Jacobian::from_columns)
        })
    }

    /// From the platform's spatial velocity to actuated rates: row a times
    /// (v, ω) is the rate of the a-th actuated joint, for all velocities that
    /// the mechanism allows. None if a chain is singular, so that some of these
    /// velocities need infinite rates.
    fn inverse_jacobian(&self, q: &[f64; N]) -> Option<[[f64; 6]; M]> {
        posture::<Self, _, _, _, _>(self, q, |posture| {
            let mut rows = [[0.0; 6]; M];
            for (a, row) in rows.iter_mut().enumerate() {
                *row = posture.inverse_row(a)?;
            }
            Some(rows)
        })
    }

    /// The rates of all joints while the actuated ones move at the given rates,
    /// rad/s and m/s; none where there is no forward Jacobian.
    fn joint_rates(&self, q: &[f64; N], actuated: &[f64; M]) -> Option<[f64; N]> {
        let velocity = self.forward_jacobian(q)?.velocity(actuated);
        let mut rates = [0.0; N];
        posture::<Self, _, _, _, _>(self, q, |posture| {
            posture.joint_rates(&velocity, &mut rates);
        });
        Some(rates)
    }

    /// How far from a kinematic singularity, where the structure equation's
    /// Jacobian loses rank and the loops allow more motions than
    /// [`ParallelKinematics::MOBILITY`]: the least singular value that has to
    /// stay above zero, relative to the largest.
    fn kinematic_singularity(&self, q: &[f64; N]) -> f64 {
        let (mut square, mut row, mut values) = ([[0.0; N]; N], [0.0; N], [0.0; N]);
        posture::<Self, _, _, _, _>(self, q, |posture| {
            posture.structure(square.as_flattened_mut(), &mut row, &mut values);
        });
        match values.get(N.wrapping_sub(Self::MOBILITY + 1)) {
            Some(least) if values[0] > 0.0 => least / values[0],
            _ => 0.0,
        }
    }

    /// How far from an actuator singularity, where the platform can move while
    /// the actuated joints are locked: the least singular value of the wrenches
    /// of length 1 that the chains can bear, 0 at the singularity.
    fn actuator_singularity(&self, q: &[f64; N]) -> f64 {
        posture::<Self, _, _, _, _>(self, q, |posture| posture.held()[5])
    }
}

/// Looks at one configuration.
fn posture<P, R, const N: usize, const M: usize, const K: usize>(
    mechanism: &P,
    q: &[f64; N],
    look: impl FnOnce(&Posture) -> R,
) -> R
where
    P: ParallelKinematics<N, M, K> + ?Sized,
{
    let (poses, twists) = mechanism.chains(q);
    look(&Posture {
        poses: &poses,
        twists: &twists,
        chains: &P::CHAINS,
        actuated: &P::ACTUATED,
        length: P::LENGTH,
    })
}
