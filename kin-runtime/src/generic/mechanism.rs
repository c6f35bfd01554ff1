//! A parallel mechanism whose chains are known only at run time.

use alloc::{vec, vec::Vec};

use super::characteristic_length::characteristic_length;

use crate::linear::span::Span;
use crate::linear::vector::norm;
use crate::parallel::newton::{Limb, Task, close};
use crate::parallel::posture::{self, Posture, Vector6};
use crate::{Chain, Pose, Twist};

/// Several chains from one base to one platform (MLS section 3.5). The
/// configuration q lists the joints of all chains, one chain after the other;
/// radians and metres. With q = 0 the mechanism is at home.
///
/// The plain counterpart of generated mechanisms, to check them.
///
/// ```
/// use kin_runtime::{Chain, Mechanism, Pose, Twist};
/// // A four-bar linkage, its coupler the platform, its crank driven.
/// let turn = |x: f64, y: f64| Twist::revolute([0.0, 0.0, 1.0], [x, y, 0.0]);
/// let coupler = Pose::from_translation([1.0, 1.0, 0.0]);
/// let linkage = Mechanism::new(
///     vec![
///         Chain::new(vec![turn(0.0, 0.0), turn(0.0, 1.0)], coupler),
///         Chain::new(vec![turn(3.0, 0.0), turn(2.0, 2.0)], coupler),
///     ],
///     vec![0],
/// );
/// // In space its planar loop counts as overdetermined, and moves all the same.
/// assert_eq!((linkage.gruebler(3), linkage.gruebler(6), linkage.mobility()), (1, -2, 1));
/// assert_eq!(linkage.motion_dimension(), 3);
/// let q = linkage.fk_near(&[0.4], &[0.0; 4]).unwrap();
/// assert!(linkage.gap(&q) < 1e-12);
/// assert_eq!(linkage.assembly_modes(&[0.4]).len(), 2);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    chains: Vec<Chain>,
    ranges: Vec<[usize; 2]>,
    actuated: Vec<usize>,
    length: f64,
}

impl Mechanism {
    /// From chains that are at home together, and the numbers of the actuated
    /// joints, in ascending order.
    ///
    /// # Panics
    /// If there are no chains, or no such joints.
    pub fn new(chains: Vec<Chain>, actuated: Vec<usize>) -> Mechanism {
        let mut ranges = Vec::new();
        let mut first = 0;
        for chain in &chains {
            let end = first + chain.twists().len();
            ranges.push([first, end]);
            first = end;
        }
        assert!(actuated.iter().all(|&joint| joint < first), "no such joint");
        let twists: Vec<Twist> = chains.iter().flat_map(Chain::twists).copied().collect();
        let length = characteristic_length(&twists, chains[0].home());
        Mechanism {
            chains,
            ranges,
            actuated,
            length,
        }
    }

    /// The chains.
    pub fn chains(&self) -> &[Chain] {
        &self.chains
    }

    /// The numbers of the actuated joints.
    pub fn actuated(&self) -> &[usize] {
        &self.actuated
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.ranges.last().map_or(0, |range| range[1])
    }

    /// The characteristic length, which an angle of one radian is worth: the distance of
    /// the platform from the farthest axis at home, metres.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Where each chain puts the platform.
    ///
    /// # Panics
    /// If `q` has not one value for each joint; so do all the functions below.
    pub fn poses(&self, q: &[f64]) -> Vec<Pose> {
        let parts = self.chains.iter().zip(&self.ranges);
        parts
            .map(|(chain, &[first, end])| chain.fk(&q[first..end]))
            .collect()
    }

    /// The spatial twist of each joint, displaced by those before it in its
    /// chain: J₁, J₂, … side by side.
    pub fn twists(&self, q: &[f64]) -> Vec<Twist> {
        let parts = self.chains.iter().zip(&self.ranges);
        parts
            .flat_map(|(chain, &[first, end])| chain.spatial_jacobian(&q[first..end]))
            .collect()
    }

    /// How far the chains' ends are apart, metres.
    pub fn gap(&self, q: &[f64]) -> f64 {
        self.look(q, |posture| posture.gap())
    }

    /// The rows of J₁ θ̇₁ − Jₖ θ̇ₖ = 0 for every chain k after the first, at the
    /// platform's origin, angular ones times [`Mechanism::length`].
    pub fn constraint_jacobian(&self, q: &[f64]) -> Vec<Vec<f64>> {
        self.look(q, |posture| {
            let row = |i: usize| {
                let mut row = vec![0.0; self.joints()];
                posture.constraint(i, &mut row);
                row
            };
            (0..posture.constraints()).map(row).collect()
        })
    }

    /// The mobility formula of Grübler for motions in a group of the given
    /// dimension (6 in space, 3 in the plane or about a point): the joints'
    /// freedoms less what closing the loops takes.
    pub fn gruebler(&self, dimension: usize) -> isize {
        let loops = self.chains.len() - 1;
        self.joints() as isize - (dimension * loops) as isize
    }

    /// The dimension of the smallest group of motions that holds those of all
    /// joints: that of the Lie algebra which their twists generate.
    pub fn motion_dimension(&self) -> usize {
        self.at_home(|posture| {
            let mut basis: Vec<Twist> = Vec::new();
            let mut waiting = posture.twists.to_vec();
            while let Some(twist) = waiting.pop() {
                let known: Vec<Vector6> = basis.iter().map(|b| posture.scaled(b)).collect();
                let vector = posture.scaled(&twist);
                let span = Span::of(known.len(), |j| known[j], posture::DEPENDENT);
                let rest = norm(span.reject(vector));
                // Brackets of unit twists below this are rounding.
                if rest > 1e-7 * self.length {
                    let unit = twist * (self.length / norm(vector));
                    waiting.extend(basis.iter().map(|other| other.bracket(&unit)));
                    basis.push(unit);
                }
            }
            basis.len()
        })
    }

    /// How many independent motions there are where the mechanism is regular:
    /// the least n − rank of the structure equation's Jacobian over home and
    /// configurations near it.
    pub fn mobility(&self) -> usize {
        let home = vec![0.0; self.joints()];
        let near = self.neighbours();
        let all = core::iter::once(&home).chain(&near);
        all.map(|q| self.mobility_at(q)).min().unwrap_or(0)
    }

    /// Whether the mechanism can leave home at all: a rank may be lost at home
    /// without a motion to follow.
    pub fn is_mobile(&self) -> bool {
        !self.neighbours().is_empty()
    }

    /// How many independent motions the structure equation's Jacobian allows at
    /// one configuration.
    pub fn mobility_at(&self, q: &[f64]) -> usize {
        Posture::mobility(&self.structure(q))
    }

    /// How many independent motions the platform has at one configuration: those
    /// of the mechanism less the idle ones, such as a leg that spins about
    /// itself.
    pub fn platform_freedom(&self, q: &[f64]) -> usize {
        // With nothing actuated, what the chains bear is what they forbid.
        let held = self.look_with(q, &[], |posture| posture.held());
        held.iter().filter(|x| **x <= posture::FREE).count()
    }

    /// The singular values of the structure equation's Jacobian, one for each
    /// joint, largest first.
    pub fn structure(&self, q: &[f64]) -> Vec<f64> {
        let n = self.joints();
        let (mut square, mut row, mut values) = (vec![0.0; n * n], vec![0.0; n], vec![0.0; n]);
        self.look(q, |posture| {
            posture.structure(&mut square, &mut row, &mut values);
        });
        values
    }

    /// How far from a kinematic singularity; see
    /// [`ParallelKinematics::kinematic_singularity`](crate::ParallelKinematics::kinematic_singularity).
    /// `mobility` is that of the regular mechanism.
    pub fn kinematic_singularity(&self, q: &[f64], mobility: usize) -> f64 {
        let values = self.structure(q);
        match values.get(self.joints().wrapping_sub(mobility + 1)) {
            Some(least) if values[0] > 0.0 => least / values[0],
            _ => 0.0,
        }
    }

    /// How far from an actuator singularity; see
    /// [`ParallelKinematics::actuator_singularity`](crate::ParallelKinematics::actuator_singularity).
    pub fn actuator_singularity(&self, q: &[f64]) -> f64 {
        self.look(q, |posture| posture.held()[5])
    }

    /// The spatial twist that unit rate of each actuated joint gives the
    /// platform; none if it can move while they are locked, where their rates cannot be chosen
    /// freely, or if more than six joints are actuated.
    pub fn forward_jacobian(&self, q: &[f64]) -> Option<Vec<Twist>> {
        let count = self.actuated.len();
        let unit = |posture: &Posture| posture.forward_jacobian::<6>();
        if count > 6 {
            return None;
        }
        // Joints beyond the last stand in for those that are missing.
        let mut six = self.actuated.clone();
        six.resize(6, usize::MAX);
        let found = self.look_with(q, &six, unit)?;
        Some(found[..count].to_vec())
    }

    /// The row r of each actuated joint for which r · (v, ω) is its rate while
    /// the platform has that spatial velocity; none if an actuated joint's motion is one that the
    /// others of its chain can do without it.
    pub fn inverse_jacobian(&self, q: &[f64]) -> Option<Vec<[f64; 6]>> {
        let count = self.actuated.len();
        self.look(q, |posture| {
            (0..count).map(|a| posture.inverse_row(a)).collect()
        })
    }

    /// The configuration with the given values of the actuated joints that
    /// Newton's method finds from `seed` in at most 60 steps; none if the loops
    /// do not close to 1e-12 of [`Mechanism::length`] by then.
    ///
    /// # Panics
    /// If there is not one value for each actuated joint.
    pub fn fk_near(&self, actuated: &[f64], seed: &[f64]) -> Option<Vec<f64>> {
        assert_eq!(actuated.len(), self.actuated.len());
        let mut q = seed.to_vec();
        for (joint, value) in self.actuated.iter().zip(actuated) {
            q[*joint] = *value;
        }
        let gap = self.close_with(&self.actuated, &mut q);
        (gap <= 1e-12 * self.length).then_some(q)
    }

    /// Closes the loops with the joints of these numbers as they are: how far they are from closed.
    pub(super) fn close_with(&self, held: &[usize], q: &mut [f64]) -> f64 {
        let task = Task {
            chains: &self.ranges,
            actuated: held,
            length: self.length,
        };
        let evaluate = |q: &[f64], poses: &mut [Pose], twists: &mut [Twist]| {
            poses.copy_from_slice(&self.poses(q));
            twists.copy_from_slice(&self.twists(q));
        };
        let mut best = q.to_vec();
        let mut poses = vec![Pose::IDENTITY; self.chains.len()];
        let mut twists = vec![Twist::default(); self.joints()];
        let mut limbs: Vec<Limb> = self.chains.iter().map(|_| Limb::NONE).collect();
        let (poses, twists) = (&mut poses, &mut twists);
        close(task, evaluate, q, &mut best, poses, twists, &mut limbs)
    }

    pub(super) fn is_prismatic(&self, joint: usize) -> bool {
        let mut twists = self.chains.iter().flat_map(Chain::twists);
        twists.nth(joint).is_some_and(super::chain::is_prismatic)
    }

    fn at_home<R>(&self, look: impl FnOnce(&Posture) -> R) -> R {
        self.look(&vec![0.0; self.joints()], look)
    }

    fn look<R>(&self, q: &[f64], look: impl FnOnce(&Posture) -> R) -> R {
        self.look_with(q, &self.actuated, look)
    }

    fn look_with<R>(&self, q: &[f64], actuated: &[usize], look: impl FnOnce(&Posture) -> R) -> R {
        let (poses, twists) = (self.poses(q), self.twists(q));
        look(&Posture {
            poses: &poses,
            twists: &twists,
            chains: &self.ranges,
            actuated,
            length: self.length,
        })
    }
}
