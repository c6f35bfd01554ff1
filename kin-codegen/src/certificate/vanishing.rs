//! Configurations in which what a plan divides by vanishes, and the vectors that tell its angles:
//! there a step may degenerate where the arm does not.

use crate::closed_form::ClosedForm;
use crate::expr::Expr;
use crate::model::Model;
use kin_runtime::Pose;

/// Steps of Newton's method.
const STEPS: usize = 40;
/// Of these, so many may reduce a quantity by less than a half.
const SLOW: usize = 5;
/// A quantity that changes less than by this share is that of a unit vector, or a constant.
const CONSTANT: f64 = 1e-9;
/// Below this share of its usual value a quantity has vanished.
const VANISHED: f64 = 1e-9;
/// Below this it need not be driven any further: the square of what is nothing to rounding.
const NOTHING: f64 = 1e-26;
/// Differences of joints at most and at least, radians or metres.
const DIFFERENCE: [f64; 2] = [1e-7, 1e-13];
/// As differences, this share of the step before.
const SHARE: f64 = 1e-2;
/// Where a step leaves so much, the root is double, as that of a square is: twice the step is
/// Newton's.
const QUARTER: std::ops::Range<f64> = 0.2..0.3;
/// The farthest that a joint goes in a step, radians or metres.
const FARTHEST: f64 = 0.5;
/// What has moved no farther, radians or metres, is where it was.
const MOVED: f64 = 1e-6;
/// What keeps the normal equations regular, relative to their trace: of a sine and a cosine one
/// may be zero throughout.
const DAMPING: f64 = 1e-9;

/// A divisor, or a sine and a cosine of some length.
pub(super) type Quantity = (Expr, Option<Expr>);

/// A configuration in which a quantity vanishes.
pub(super) struct Driven {
    pub q: Vec<f64>,
    /// By joint: the others do not matter for it.
    pub is_moved: Vec<bool>,
}

/// The expressions of a plan, on the branch of a configuration.
pub(super) struct OnBranch<'a, F> {
    pub form: &'a ClosedForm,
    /// The arm that targets are solved for.
    pub model: &'a Model,
    /// The target of a configuration, and what comes with it.
    pub asked: F,
}

impl<F: Fn(&[f64]) -> (Pose, Vec<f64>)> OnBranch<'_, F> {
    /// Configurations to which Newton's method goes from some, where one of these quantities vanishes.
    pub fn vanishing(&self, quantities: &[Quantity], starts: &[Vec<f64>]) -> Vec<Driven> {
        let mut all = Vec::new();
        for &of in quantities {
            let length_at = |q: &Vec<f64>| Some(length(self.at(of, q, self.branch(q)?)));
            let lengths: Vec<f64> = starts.iter().filter_map(length_at).collect();
            let usual = lengths.iter().copied().fold(0.0, f64::max);
            let least = lengths.iter().copied().fold(usual, f64::min);
            if usual - least > CONSTANT * usual {
                let driven = |from: &Vec<f64>| {
                    let q = self.driven(of, from.clone(), usual)?;
                    let is_moved = from.iter().zip(&q).map(|(a, b)| (a - b).abs() > MOVED);
                    Some(Driven {
                        is_moved: is_moved.collect(),
                        q,
                    })
                };
                all.extend(starts.iter().filter_map(driven));
            }
        }
        all
    }

    /// The branch that a configuration is on.
    fn branch(&self, q: &[f64]) -> Option<u32> {
        let (target, parameters) = (self.asked)(q);
        let joints = |q: &[f64]| self.form.given.joints_at(q).into_owned();
        let own = joints(q);
        let apart = |other: &[f64]| -> f64 {
            let other = joints(other);
            let each = 0..own.len();
            each.map(|i| self.model.joint_distance(i, own[i], other[i]))
                .sum()
        };
        let branches = self.form.branches_at(&target, &parameters);
        let own = branches
            .iter()
            .min_by(|a, b| apart(&a.q).total_cmp(&apart(&b.q)));
        own.map(|own| own.branch)
    }

    /// The value of a quantity on a branch for the target of a configuration.
    fn at(&self, (a, b): Quantity, q: &[f64], branch: u32) -> [f64; 2] {
        let (target, parameters) = (self.asked)(q);
        let count = b.map_or(a, |b| a.max(b)).index() + 1;
        let values = self.form.first_values(count, &target, &parameters, branch);
        [values[a.index()], b.map_or(0.0, |b| values[b.index()])]
    }

    /// Moves the joints by the least that makes a quantity vanish; none if that is not found.
    fn driven(&self, of: Quantity, mut q: Vec<f64>, usual: f64) -> Option<Vec<f64>> {
        let (mut slow, mut before, mut difference) = (0, f64::INFINITY, DIFFERENCE[0]);
        let mut multiplicity = 1.0;
        let mut nearest = (f64::INFINITY, q.clone());
        for _ in 0..STEPS {
            let Some(branch) = self.branch(&q) else {
                break;
            };
            let here = self.at(of, &q, branch);
            let left = length(here);
            if left < nearest.0 {
                nearest = (left, q.clone());
            }
            if left <= NOTHING * usual {
                return Some(q);
            }
            let ratio = left / before;
            if QUARTER.contains(&ratio) {
                multiplicity = 2.0;
            } else if ratio > 0.5 {
                multiplicity = 1.0;
                slow += 1;
            }
            before = left;
            if slow > SLOW {
                break;
            }
            let slope = |joint: usize| {
                let mut beside = q.clone();
                beside[joint] += difference;
                let there = self.at(of, &beside, branch);
                [0, 1].map(|i| (there[i] - here[i]) / difference)
            };
            let slopes: Vec<[f64; 2]> = (0..q.len()).map(slope).collect();
            let Some([u, v]) = least_norm(&slopes, here) else {
                break;
            };
            let mut farthest: f64 = 0.0;
            for (x, slope) in q.iter_mut().zip(&slopes) {
                let step = multiplicity * (slope[0] * u + slope[1] * v);
                let step = step.clamp(-FARTHEST, FARTHEST);
                *x -= step;
                farthest = farthest.max(step.abs());
            }
            let [most, least] = DIFFERENCE;
            difference = (SHARE * farthest).clamp(least, most);
        }
        let (left, q) = nearest;
        (left <= VANISHED * usual).then_some(q)
    }
}

fn length([a, b]: [f64; 2]) -> f64 {
    a.hypot(b)
}

/// The weights of two rows, given by columns, in their shortest combination that is a vector,
/// damped; none if there is none.
fn least_norm(columns: &[[f64; 2]], [a, b]: [f64; 2]) -> Option<[f64; 2]> {
    let entry = |i: usize, j: usize| columns.iter().map(|x| x[i] * x[j]).sum::<f64>();
    let trace = entry(0, 0) + entry(1, 1);
    let [uu, uv, vv] = [
        entry(0, 0) + DAMPING * trace,
        entry(0, 1),
        entry(1, 1) + DAMPING * trace,
    ];
    let determinant = uu * vv - uv * uv;
    let is_regular = determinant.is_finite() && determinant > 0.0;
    is_regular.then(|| {
        [
            (vv * a - uv * b) / determinant,
            (uu * b - uv * a) / determinant,
        ]
    })
}
