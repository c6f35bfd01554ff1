//! Six revolute joints without a closed form: one unknown left.

mod bernstein;
mod determinant;
mod elimination;
mod harmonics;
mod line;
mod polish;
mod recover;
mod roots;
mod turn;

pub use elimination::Elimination;
pub use line::{ENTRIES, Lines, Z_AXIS, moved, turned_back};

use crate::{Pose, Solution, Solutions, math};
use determinant::{eliminate, product, reflect};
use elimination::{Equations, Loop};
use harmonics::{HALF_ANGLES, Harmonics, samples};
use polish::{Polished, polished};
use recover::Recovery;
use roots::roots;

/// Configurations that are worked on at once.
const LANES: usize = 8;

/// Above this noise the samples are taken again without a pivot that is small.
const NOISY: f64 = 3e-13;

/// Cosines and sines that are off by more are those of an extraneous root.
const EXTRANEOUS: f64 = 0.05;

/// Solutions reach the target to this, in units of the arm's size.
const REACHED: f64 = 1e-13;

/// Steps of Newton's method at most; twice as many where it converges slowly.
const STEPS: usize = 6;

/// Below this a pivot of the Jacobian, relative to the largest, is that of a
/// singular configuration.
const SINGULAR: f64 = 1e-5;

/// Below this another solution may be so near that roots of the polynomial do not
/// tell the two apart.
const MEETING: f64 = 3e-3;

/// How far it is looked for, radians: Newton's method halves the distance at every
/// step until it is there.
const DISTANCES: [f64; LANES] = [-1e-5, 1e-5, -1e-4, 1e-4, -1e-3, 1e-3, -1e-2, 1e-2];

/// To targets close by, of which no solutions share a joint's value for reasons of
/// symmetry: by 0.02 and 0.003 rad, and about as many units of half the arm's size.
const NUDGES: [Pose; 2] = [
    Pose {
        rotation: [
            [0.999819247190496, 0.014445447078606033, 0.01236131085804095],
            [
                -0.014368484982933282,
                0.9998769687622505,
                -0.006292374600158338,
            ],
            [
                -0.01245068619495124,
                0.006113623926337757,
                0.999903797380409,
            ],
        ],
        translation: [0.0143, -0.0084, 0.0186],
    },
    Pose {
        rotation: [
            [
                0.999997809190536,
                -0.0017852833210022776,
                0.001092875835578923,
            ],
            [
                0.0017829305642721462,
                0.9999960992904666,
                0.0021500145241778283,
            ],
            [
                -0.0010967099576576554,
                -0.0021480612921754554,
                0.9999970915257473,
            ],
        ],
        translation: [-0.0019, -0.0027, 0.0012],
    },
];

/// An arm of six revolute joints, and how it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Univariate<'a> {
    /// A₀ … A₆ of the arm A₀ Rz(q₁) A₁ … Rz(q₆) A₆; lengths in units of half
    /// the arm's size.
    pub frames: [Pose; 7],
    /// The arm's size, metres.
    pub size: f64,
    /// The eliminations, the best first.
    pub eliminations: &'a [Elimination],
}

/// What one elimination said of one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Told {
    /// Real roots.
    pub roots: usize,
    /// Of the polynomial, relative to its largest coefficient.
    pub noise: f64,
    /// Whether all solutions are sure to be among those found.
    pub certain: bool,
}

impl Univariate<'_> {
    /// All configurations that put the tip at the target, in the order of the joint
    /// that is kept first.
    ///
    /// One elimination is asked. Where it is not sure of its answer, so are the
    /// others; then the neighbours of solutions that have nearly met are looked for;
    /// and last, where solutions share the values of all joints that are kept, the
    /// solutions of a target close by are brought here.
    pub fn solutions(&self, target: &Pose) -> Solutions<6> {
        let mut search = Search::new(self, target);
        search.run();
        search.in_order()
    }

    /// What one elimination says of a target.
    pub fn told(&self, elimination: &Elimination, target: &Pose) -> Told {
        let mut search = Search::new(self, target);
        let target = search.target;
        search.ask(elimination, &target)
    }
}

/// The solutions of one target so far.
struct Search<'a> {
    arm: &'a Univariate<'a>,
    /// Lengths in units of half the arm's size.
    target: Pose,
    regular: Solutions<6>,
    /// Where the Jacobian loses rank: these may be members of families, and must not
    /// take the place of others.
    singular: Solutions<6>,
}

impl<'a> Search<'a> {
    fn new(arm: &'a Univariate<'a>, target: &Pose) -> Self {
        let target = Pose {
            translation: target.translation.map(|x| x * (2.0 / arm.size)),
            ..*target
        };
        let (regular, singular) = (Solutions::new(), Solutions::new());
        Self {
            arm,
            target,
            regular,
            singular,
        }
    }

    fn run(&mut self) {
        let target = self.target;
        for at in [target, target * NUDGES[0], target * NUDGES[1]] {
            for elimination in self.arm.eliminations {
                if self.ask(elimination, &at).certain {
                    return;
                }
            }
            self.neighbours();
        }
    }

    /// Adds what one elimination finds at a target, moved to that which counts.
    fn ask(&mut self, elimination: &Elimination, at: &Pose) -> Told {
        let round = Loop::new(elimination, &self.arm.frames, at);
        let far_side = round.far_side();
        let equations = Equations::new(elimination, &far_side);
        let f = polynomial(elimination, &equations);
        let mut told = Told {
            roots: 0,
            noise: f.noise,
            certain: false,
        };
        if !f.noise.is_finite() {
            return told;
        }
        let roots = roots(&f);
        let recovery = Recovery {
            elimination,
            round: &round,
            far_side: &far_side,
            equations: &equations,
        };
        told.roots = roots.count;
        told.certain = !roots.uncertain && f.noise < NOISY;
        let mut own = 0_u32;
        for (i, chunk) in roots.angles[..roots.count].chunks(LANES).enumerate() {
            let kept = core::array::from_fn(|k| chunk[k.min(chunk.len() - 1)]);
            let starts = recovery.joints(&kept);
            let found = polished(&self.arm.frames, &self.target, &starts.q, STEPS);
            for k in 0..chunk.len() {
                let place = self.insert(&found, k).map_or(0, |place| 1 << place);
                if place == 0 && starts.inconsistency[k] > EXTRANEOUS {
                    continue;
                }
                told.certain &= place & !own != 0;
                own |= place;
                let double = roots.double >> (LANES * i + k) & 1 == 1;
                if place == 0 || double {
                    self.around(&starts.q.map(|q| q[k]));
                }
            }
        }
        told.certain &= own == (1 << self.regular.len()) - 1;
        told
    }

    /// Where the solution in a lane is among the regular ones; none if it is none.
    fn insert(&mut self, found: &Polished, lane: usize) -> Option<usize> {
        let residual = found.residual[lane];
        if residual > REACHED || residual.is_nan() {
            return None;
        }
        let singular = found.independence[lane] < SINGULAR;
        let solution = Solution {
            q: found.q.map(|q| math::wrap(q[lane])),
            residual: self.arm.size * residual,
            branch: 0,
            singular,
        };
        if singular {
            self.singular.insert_distinct(solution);
            return None;
        }
        self.regular.insert_distinct(solution)
    }

    /// Looks for those that have nearly met one that is known.
    fn neighbours(&mut self) {
        let known = self.regular;
        known.iter().for_each(|solution| self.around(&solution.q));
    }

    /// Solutions near a nearly singular configuration: they are along the motion that
    /// moves the tip least, at some distance.
    fn around(&mut self, q: &[f64; 6]) {
        let Univariate { frames, .. } = self.arm;
        let here = polished(frames, &self.target, &q.map(|q| [q; LANES]), 0);
        if here.independence[0] > MEETING {
            return;
        }
        let along = |j: usize, k: usize| here.q[j][k] + DISTANCES[k] * here.weak[j][k];
        let start = core::array::from_fn(|j| core::array::from_fn(|k| along(j, k)));
        let found = polished(frames, &self.target, &start, 2 * STEPS);
        for lane in 0..LANES {
            self.insert(&found, lane);
        }
    }

    /// The regular solutions, then the singular ones as far as there is room, each in
    /// the order of the joint that is kept first.
    fn in_order(&self) -> Solutions<6> {
        let joint = self
            .arm
            .eliminations
            .first()
            .map_or(0, |first| usize::from(first.joints[0] % 6));
        Solutions::build(|out| {
            for solutions in [&self.regular, &self.singular] {
                let mut taken = 0_u32;
                for _ in 0..solutions.len() {
                    let left = (0..solutions.len()).filter(|i| taken >> i & 1 == 0);
                    let value = |i: &usize| solutions[*i].q[joint];
                    let Some(next) = left.min_by(|a, b| value(a).total_cmp(&value(b))) else {
                        break;
                    };
                    taken |= 1 << next;
                    let branch = out.len() as u32;
                    out.push_if(
                        true,
                        Solution {
                            branch,
                            ..solutions[next]
                        },
                    );
                }
            }
        })
    }
}

/// The determinant as a polynomial in the kept joint.
#[inline(never)]
fn polynomial(elimination: &Elimination, equations: &Equations) -> Harmonics {
    let degree = usize::from(elimination.degree);
    let exact = |values: &mut [f64], robust: bool| {
        let step = HALF_ANGLES.len() / values.len();
        for (chunk, values) in values.chunks_mut(LANES).enumerate() {
            let angle = |k: usize| HALF_ANGLES[step * (LANES * chunk + k)];
            let cosine: [f64; LANES] = core::array::from_fn(|k| angle(k)[0]);
            let sine: [f64; LANES] = core::array::from_fn(|k| angle(k)[1]);
            let mut matrix = equations.matrix(elimination, &cosine, &sine);
            match robust {
                true => reflect(&mut matrix),
                false => eliminate(&mut matrix),
            }
            values.copy_from_slice(&product(&matrix)[..values.len()]);
        }
    };
    let mut values = [0.0; harmonics::MOST_SAMPLES];
    let values = &mut values[..samples(degree)];
    exact(values, false);
    let f = Harmonics::new(degree, values);
    if f.noise < NOISY {
        return f;
    }
    exact(values, true);
    Harmonics::new(degree, values)
}
