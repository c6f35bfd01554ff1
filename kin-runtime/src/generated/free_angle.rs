//! An angle that a singular target leaves free.
//!
//! Any value closes the step that asks for it, but not every value leaves the
//! steps behind it a real root: a UR with its wrist stretched can turn its
//! elbow out of reach of the shoulder. The branches have the seed's value.
//! Where that leaves the next root none, the freedom is spent on it: its
//! equation a cos θ + b sin θ = d has the more room the nearer d is to zero,
//! and as a function of the free angle d is d₀ + d₁ cos φ + d₂ sin φ, which its
//! values at three angles tell. They take three more runs of the plan, which
//! regular targets do not pay.

use super::super::math;
use super::super::scalar::Real;
use super::super::scalar::consts::{FRAC_PI_2, PI};
pub use super::super::scalar::tolerance::{FREE_BELOW, NEARLY_FREE};
use super::branches::Branches;

/// What the next root says of a free angle, as array lanes.
#[derive(Clone, Copy, Debug)]
pub struct FreeAngle<const L: usize> {
    /// d of the root's equation a cos θ + b sin θ = d.
    pub level: [Real; L],
    /// Positive where the angle is free and its value leaves no real root.
    pub no_root: [Real; L],
}

impl<const L: usize> FreeAngle<L> {
    /// Whether the angle's value costs some branch its root.
    #[inline(always)]
    pub fn leaves_no_root(&self) -> bool {
        let mut leaves = false;
        for k in 0..L {
            leaves |= self.no_root[k] > 0.0;
        }
        leaves
    }
}

/// The turns of the seed's angle, radians, at which [`roomiest_turn`] wants the
/// level.
pub const SAMPLES: [Real; 3] = [0.0, FRAC_PI_2, PI];

/// The turn of a free angle, radians, that leaves the next root the most room.
/// `levels` are its d at [`SAMPLES`].
///
/// ```
/// use kin_runtime::__private::free_angle::{SAMPLES, roomiest_turn};
/// let level = |turn: f64| 0.3 - 0.5 * turn.cos() + 0.4 * turn.sin();
/// assert!(level(roomiest_turn(SAMPLES.map(level))).abs() < 1e-15);
/// ```
pub fn roomiest_turn([here, quarter, half]: [Real; 3]) -> Real {
    let mean = 0.5 * (here + half);
    let [x, y] = [0.5 * (here - half), quarter - mean];
    // mean + x cos φ + y sin φ = 0 by the tangent of half of φ less the phase, or what comes
    // nearest to it.
    let amplitude = math::sqrt(x * x + y * y);
    let [near, far] = [amplitude + mean, amplitude - mean].map(|end| math::sqrt(end.max(0.0)));
    math::wrap(math::atan2(y, x) - 2.0 * math::atan2(near, far))
}

impl<const N: usize, const L: usize> Branches<N, L> {
    /// The branches with a free angle turned where its own value leaves the next
    /// root none. `run` gives those for a seed and the threshold below which the
    /// angle is free and follows coordinate `joint` of the seed.
    #[cold]
    #[inline(never)]
    pub fn with_free_angle(
        mut self,
        free: &FreeAngle<L>,
        seed: &[Real; N],
        joint: usize,
        run: impl Fn(&[Real; N], Real) -> (Self, FreeAngle<L>),
    ) -> Self {
        let turned = |turn: Real| {
            let mut seed = *seed;
            seed[joint] += turn;
            run(&seed, NEARLY_FREE)
        };
        let samples = SAMPLES.map(|turn| turned(turn).1.level);
        for k in (0..L).filter(|&k| free.no_root[k] > 0.0) {
            let levels = samples.map(|level| level[k]);
            self.set_lane(k, &turned(roomiest_turn(levels)).0);
        }
        self
    }

    fn set_lane(&mut self, k: usize, other: &Self) {
        for (q, other) in self.q.iter_mut().zip(&other.q) {
            q[k] = other[k];
        }
        self.residual[k] = other.residual[k];
        self.invalid[k] = other.invalid[k];
        self.singular[k] = other.singular[k];
    }
}
