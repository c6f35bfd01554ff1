//! The solutions of one target.

use super::elimination::{Elimination, Equations, Loop};
use super::polish::{Polished, polished};
use super::polynomial::{NOISY, polynomial};
use super::recover::Recovery;
use super::roots::{CLUSTER, Roots, roots};
use super::sharing::SHARING;
use super::{LANES, Told, Univariate};
use crate::{Pose, Solution, Solutions, math};
use core::f64::consts::TAU;

/// Cosines and sines that are off by more are those of an extraneous root.
const EXTRANEOUS: f64 = 0.05;

/// Where they are off by less, a null vector is of one solution, and no mixture.
const PURE: f64 = 1e-3;

/// Solutions reach the target to this, in units of the arm's size.
const REACHED: f64 = 1e-13;

/// The rotation of a target may be off an orthonormal one by this.
const ORTHONORMAL: f64 = 1e-9;

/// Steps of Newton's method at most; twice as many where it converges slowly.
const STEPS: usize = 6;

/// Below this a pivot of the Jacobian, relative to the largest, is that of a
/// singular configuration.
const SINGULAR: f64 = 1e-5;

/// Singular solutions that are nearer to each other, radians, are one, or members of a
/// family.
const FAMILY: f64 = 1e-4;

/// Below this another solution may be so near that roots of the polynomial do not
/// tell the two apart.
const MEETING: f64 = 3e-3;

/// How far it is looked for, radians: Newton's method halves the distance at every
/// step until it is there.
const DISTANCES: [f64; LANES] = [-1e-5, 1e-5, -1e-4, 1e-4, -1e-3, 1e-3, -1e-2, 1e-2];

/// The solutions so far.
pub(super) struct Search<'a> {
    arm: &'a Univariate<'a>,
    /// Orthonormal; lengths in units of half the arm's size.
    target: Pose,
    /// How far the target's rotation is from that.
    gap: f64,
    regular: Solutions<6>,
    /// Of each regular solution, the least pivot of the Jacobian by the largest.
    independence: [f64; Solutions::<6>::CAPACITY],
    /// Where the Jacobian loses rank: these may be members of families, and must not
    /// take the place of others.
    singular: Solutions<6>,
    /// Bit i is set where the elimination that was asked last knows regular solution i.
    own: u32,
}

impl<'a> Search<'a> {
    pub fn new(arm: &'a Univariate<'a>, target: &Pose) -> Self {
        let (rotation, gap) = orthonormal(&target.rotation);
        let target = Pose {
            rotation,
            translation: target.translation.map(|x| x * (2.0 / arm.size)),
        };
        let (regular, singular) = (Solutions::new(), Solutions::new());
        Self {
            arm,
            target,
            gap,
            regular,
            independence: [0.0; Solutions::<6>::CAPACITY],
            singular,
            own: 0,
        }
    }

    /// Asks the eliminations in turn until one is sure of its answer.
    pub fn run(&mut self) {
        if self.gap > ORTHONORMAL || self.gap.is_nan() {
            return;
        }
        for elimination in self.arm.eliminations {
            if self.ask(elimination).certain {
                return;
            }
        }
        let known = self.regular;
        known.iter().for_each(|solution| self.around(&solution.q));
    }

    /// Takes a configuration in if it is singular, and nearly a solution.
    pub fn keep(&mut self, seed: &[f64; 6]) {
        let found = self.polished(&seed.map(|q| [q; LANES]), STEPS);
        if found.independence[0] < SINGULAR {
            self.insert(&found, 0);
        }
    }

    /// Adds what one elimination finds.
    pub fn ask(&mut self, elimination: &Elimination) -> Told {
        let round = Loop::new(elimination, &self.arm.frames, &self.target);
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
        told.certain = !roots.incomplete && f.noise < NOISY;
        self.own = 0;
        for (i, chunk) in roots.angles[..roots.count].chunks(LANES).enumerate() {
            let kept = core::array::from_fn(|k| chunk[k.min(chunk.len() - 1)]);
            let starts = recovery.joints(&kept);
            let found = self.polished(&starts.q, STEPS);
            for k in 0..chunk.len() {
                let before = self.own;
                let reached = self.insert(&found, k);
                let off = starts.inconsistency[k];
                let candidate = LANES * i + k;
                let one = !roots.is_double(candidate) && !roots.is_several(candidate);
                if !reached && off > EXTRANEOUS && one {
                    continue;
                }
                if self.own == before || off > PURE || !one {
                    self.share(&recovery, chunk[k]);
                    self.around(&starts.q.map(|q| q[k]));
                    told.certain &= self.resolves(elimination, &roots, candidate);
                }
            }
        }
        told.certain &= self.own == (1 << self.regular.len()) - 1;
        told
    }

    /// Whether the solutions near a candidate are known to be all: two that share a value
    /// of the kept joint, and are regular.
    fn resolves(&self, elimination: &Elimination, roots: &Roots, candidate: usize) -> bool {
        let kept = roots.angles[candidate];
        let sign = if elimination.backwards { -1.0 } else { 1.0 };
        let joint = usize::from(elimination.joints[0] % 6);
        let near = |q: f64| math::wrap(q - kept).abs() < CLUSTER;
        let solutions = self.regular.iter().zip(&self.independence);
        let (mut count, mut least) = (0, f64::INFINITY);
        for (_, independence) in solutions.filter(|(found, _)| near(sign * found.q[joint])) {
            count += 1;
            least = least.min(*independence);
        }
        let alone = (0..roots.count).filter(|&i| near(roots.angles[i])).count() == 1;
        roots.is_double(candidate) && alone && count == 2 && least > MEETING
    }

    /// Configurations that nearly close the loop, if any do, at values of the kept joint
    /// all round.
    pub fn all_round(&self, elimination: &Elimination) -> [[f64; LANES]; 6] {
        let round = Loop::new(elimination, &self.arm.frames, &self.target);
        let far_side = round.far_side();
        let recovery = Recovery {
            elimination,
            round: &round,
            far_side: &far_side,
            equations: &Equations::new(elimination, &far_side),
        };
        let kept = core::array::from_fn(|k| TAU / LANES as f64 * k as f64);
        recovery.joints(&kept).q
    }

    fn polished(&self, start: &[[f64; LANES]; 6], steps: usize) -> Polished {
        polished(&self.arm.frames, &self.target, start, steps)
    }

    /// Adds the solution in a lane, if it is one.
    fn insert(&mut self, found: &Polished, lane: usize) -> bool {
        let residual = found.residual[lane];
        if residual > REACHED || residual.is_nan() {
            return false;
        }
        let q = found.q.map(|q| math::wrap(q[lane]));
        let singular = found.independence[lane] < SINGULAR;
        let residual = self.arm.size * math::sqrt(residual * residual + self.gap * self.gap);
        let solution = Solution {
            q,
            residual,
            branch: 0,
            singular,
        };
        if !singular {
            let place = self.regular.insert_distinct(solution);
            if let Some(place) = place {
                self.own |= 1 << place;
                self.independence[place] = found.independence[lane];
            }
        } else if self
            .singular
            .iter()
            .all(|known| apart(&known.q, &q) > FAMILY)
        {
            self.singular.push_if(true, solution);
        }
        true
    }

    /// Adds the solutions that share a value of the kept joint.
    fn share(&mut self, recovery: &Recovery, kept: f64) {
        let found = self.polished(&recovery.sharing(kept).q, STEPS);
        for lane in 0..SHARING {
            self.insert(&found, lane);
        }
    }

    /// Adds solutions near a nearly singular configuration: they are along the motion
    /// that moves the tip least, at some distance.
    fn around(&mut self, q: &[f64; 6]) {
        let here = self.polished(&q.map(|q| [q; LANES]), 0);
        if here.independence[0] > MEETING {
            return;
        }
        let along = |j: usize, k: usize| here.q[j][k] + DISTANCES[k] * here.weak[j][k];
        let start = core::array::from_fn(|j| core::array::from_fn(|k| along(j, k)));
        let found = self.polished(&start, 2 * STEPS);
        for lane in 0..LANES {
            self.insert(&found, lane);
        }
    }

    /// The regular solutions, then the singular ones as far as there is room, each in
    /// the order of the joint that is kept first.
    pub fn in_order(&self) -> Solutions<6> {
        let first = self.arm.eliminations.first();
        let joint = first.map_or(0, |first| usize::from(first.joints[0] % 6));
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

/// The largest difference of two angles.
fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let turns = a.iter().zip(b).map(|(a, b)| math::wrap(a - b).abs());
    turns.fold(0.0, math::max)
}

/// The rotation next to a matrix that is one but for rounding, and how far off it is:
/// a step of Newton's method for the polar decomposition (N. J. Higham, SIAM J. Sci.
/// Stat. Comput. 7, 1986).
fn orthonormal(r: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let product = |i: usize, j: usize| (0..3).map(|k| r[k][i] * r[k][j]).sum::<f64>();
    let mut out = *r;
    let mut square = 0.0;
    for i in 0..3 {
        for j in 0..3 {
            let along: f64 = (0..3).map(|k| r[i][k] * product(k, j)).sum();
            let step = 0.5 * (r[i][j] - along);
            out[i][j] += step;
            square += 0.5 * step * step;
        }
    }
    (out, math::sqrt(square))
}
