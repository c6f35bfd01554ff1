//! Following a path by the answers of inverse kinematics.

use crate::path::STEPS;
use kinematics::{JointLimit, Kinematics, Pose, Solution};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// At a branch's singularity its least singular value passes through zero; one
/// that is nearer than a step is seen to be at most so many steps from it.
const BESIDE: f64 = 5.0;
/// Rounding.
const SINGULAR: f64 = 1e-12;

/// Where the path was met.
pub struct Sample {
    pub s: f64,
    pub answer: Solution<6>,
    /// The least singular value of the Jacobian, metres and radians.
    pub conditioning: f64,
}

/// How the next answer is chosen.
#[derive(Clone, Copy, PartialEq)]
pub enum By {
    /// The nearest to the last one.
    Nearness,
    /// The one of the same branch, the nearest where it is not there.
    Branch,
}

/// Follows the path from s = −half to half, beginning with the answer nearest
/// to `seed`. None where there is no answer. The samples are at the multiples
/// of the step plus a `shift`, in steps.
pub fn follow<K: Kinematics<6>>(
    arm: &K,
    seed: [f64; 6],
    path: &impl Fn(f64) -> Pose,
    [step, half, shift]: [f64; 3],
    by: By,
) -> Vec<Option<Sample>> {
    let mut last: Option<Solution<6>> = None;
    let count = (half / step).round() as i32;
    let sample = |k: i32| {
        let s = (f64::from(k) + shift) * step;
        let seed = last.map_or(seed, |answer| answer.q);
        let answers = arm.ik_seeded(&path(s), &seed);
        let kept = |answer: &&Solution<6>| Some(answer.branch) == last.map(|last| last.branch);
        let same = answers.iter().find(kept).filter(|_| by == By::Branch);
        let nearest = || answers.nearest(&seed, &[JointLimit::Continuous; 6]);
        last = Some(same.copied().or_else(nearest)?);
        last.map(|answer| Sample {
            s,
            answer,
            conditioning: conditioning(arm, &answer.q),
        })
    };
    (-count..count).map(sample).collect()
}

/// On the singular pose and beside it.
const SHIFTS: [f64; 3] = [0.0, 0.5, 0.13];

/// Two neighbours on a path.
pub struct Pair<'a>(pub &'a Sample, pub &'a Sample);

impl Pair<'_> {
    /// The largest change of an angle.
    pub fn jump(&self) -> f64 {
        let Pair(Sample { answer: a, .. }, Sample { answer: b, .. }) = self;
        apart(&a.q, &b.q)
    }

    fn conditioning(&self) -> f64 {
        self.0.conditioning.min(self.1.conditioning)
    }

    /// Whether the Jacobian accounts for the change in a step along the path.
    pub fn is_explained(&self, step: f64) -> bool {
        self.jump() < step / self.conditioning()
    }

    pub fn changes_branch(&self) -> bool {
        self.0.answer.branch != self.1.answer.branch
    }

    fn is_flagged(&self) -> bool {
        self.0.answer.singular || self.1.answer.singular
    }
}

/// Follows a path that passes through a singularity of the arm at s = 0, in
/// all steps. The nearest answer moves by no more than `rate` radians per
/// metre, and as the Jacobian explains. It changes its branch at
/// singularities. Who keeps to a branch instead jumps there alone, and sees
/// the flag if a sample is at the singularity.
pub fn passes<K: Kinematics<6>>(arm: &K, seed: [f64; 6], path: impl Fn(f64) -> Pose, rate: f64) {
    for (step, half) in STEPS {
        for shift in SHIFTS {
            let samples = all(follow(arm, seed, &path, [step, half, shift], By::Nearness));
            for pair in pairs(&samples) {
                let (jump, s) = (pair.jump(), pair.0.s);
                assert!(jump < rate * step, "{jump:e} at {s:e} in steps of {step:e}");
                assert!(pair.is_explained(step), "{jump:e} at {s:e}");
                let beside = pair.conditioning() < BESIDE * step;
                assert!(beside || !pair.changes_branch(), "at {s:e}");
            }
            let samples = all(follow(arm, seed, &path, [step, half, shift], By::Branch));
            for pair in pairs(&samples) {
                let (jump, s) = (pair.jump(), pair.0.s);
                let beside = pair.conditioning() < BESIDE * step;
                assert!(beside || jump < rate * step, "{jump:e} at {s:e}");
                assert!(beside || !pair.changes_branch(), "at {s:e}");
                let jumps = jump > rate * step || pair.changes_branch();
                let singular = pair.conditioning() < SINGULAR;
                assert!(!(jumps && singular) || pair.is_flagged(), "at {s:e}");
            }
            let met = samples.iter().any(|sample| sample.conditioning < SINGULAR);
            assert_eq!(met, shift == 0.0, "the path misses the singularity");
        }
    }
}

fn all(samples: Vec<Option<Sample>>) -> Vec<Sample> {
    let count = samples.len();
    let found: Vec<Sample> = samples.into_iter().flatten().collect();
    assert_eq!(found.len(), count, "there are places without an answer");
    found
}

pub fn pairs(samples: &[Sample]) -> impl Iterator<Item = Pair<'_>> {
    samples.windows(2).map(|pair| Pair(&pair[0], &pair[1]))
}

fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let on_circle = |(a, b): (&f64, &f64)| {
        let d = (a - b).abs() % TAU;
        d.min(TAU - d)
    };
    a.iter().zip(b).map(on_circle).fold(0.0, f64::max)
}

fn conditioning<K: Kinematics<6>>(arm: &K, q: &[f64; 6]) -> f64 {
    let rows = arm.geometric_jacobian(q).rows;
    singular_values::of(DMatrix::from_fn(6, 6, |i, j| rows[i][j]))[5]
}

/// The configuration that differs from `q` in one joint, by less than `reach`
/// to one side, and where the determinant of the Jacobian changes its sign.
pub fn singular_near<K: Kinematics<6>>(arm: &K, q: [f64; 6], joint: usize, reach: f64) -> [f64; 6] {
    let at = |value: f64| {
        let mut q = q;
        q[joint] = value;
        q
    };
    let sign = |value: f64| {
        let rows = arm.geometric_jacobian(&at(value)).rows;
        DMatrix::from_fn(6, 6, |i, j| rows[i][j]).determinant() > 0.0
    };
    let (mut a, mut b) = (q[joint], q[joint] + reach);
    assert_ne!(sign(a), sign(b), "no singularity between {a} and {b}");
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if sign(middle) == sign(a) {
            a = middle;
        } else {
            b = middle;
        }
    }
    at(a)
}
