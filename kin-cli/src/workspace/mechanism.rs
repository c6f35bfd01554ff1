//! Parallel mechanisms on the map.

use super::arm::{is_within, reach};
use super::map::{Robot, Sampling, slices};
use crate::arguments;
use kin_codegen::mechanism::{Aim, CompiledMechanism};
use kin_runtime::__private::math;
use kin_runtime::Pose;
use std::f64::consts::{PI, SQRT_2};

/// How far a platform that can turn is turned away from home, at most.
const TILT: f64 = PI / 6.0;
/// π (3 − √5), by which neighbours on the spiral are apart.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Points along a side when the size of the map is looked for.
const COARSE: usize = 25;

/// A mechanism with its closed forms.
struct Platform<'a> {
    compiled: &'a CompiledMechanism,
    generic: kin_runtime::Mechanism,
    turning: Turning,
    limited: bool,
}

/// How a platform can turn while its position is chosen.
enum Turning {
    /// Not of its own choice.
    None,
    /// About axes of one direction.
    About([f64; 3]),
    /// In every way.
    Free,
}

/// Through the platform's home; none if its position cannot be chosen freely
/// at a given orientation.
pub fn sampling<'a>(
    compiled: &'a CompiledMechanism,
    arguments: &arguments::Workspace,
) -> Option<Sampling<'a>> {
    let generic = compiled.mechanism.generic();
    let turning = turning(compiled, &generic)?;
    let home = compiled.mechanism.home();
    let centre = home.translation;
    let legs = compiled.mechanism.legs.iter();
    let farthest = legs
        .map(|leg| reach(&leg.model, centre))
        .fold(f64::INFINITY, f64::min);
    let mut sampling = Sampling {
        orientations: turning.orientations(&home, arguments.samples),
        robot: Box::new(Platform {
            compiled,
            generic,
            turning,
            limited: arguments.limits,
        }),
        slices: slices(centre),
        cells: COARSE,
        step: 2.0 * farthest / COARSE as f64,
        limited: arguments.limits,
    };
    // What one chain alone can reach is much; what all of them can is found.
    let found = sampling.map(&|_| ());
    let half = sampling.look_at(&found).min(farthest);
    sampling.cells = arguments.cells;
    sampling.step = 2.0 * half / arguments.cells as f64;
    Some(sampling)
}

impl Robot for Platform<'_> {
    /// The posture measured is that of the solutions nearest home, chain by
    /// chain.
    fn try_pose(&self, target: &Pose, _: &mut Vec<f64>) -> Option<f64> {
        let placed = self.compiled.solutions(target);
        let postures = placed.iter().filter_map(|placed| {
            let chains = placed.solutions.iter().enumerate();
            let nearest = chains.map(|(k, solutions)| self.nearest(k, solutions));
            nearest.collect::<Option<Vec<_>>>()
        });
        postures
            .map(|chains| self.generic.actuator_singularity(&chains.concat()))
            .reduce(f64::max)
    }

    fn measure(&self) -> [&'static str; 2] {
        [
            "actuator_singularity",
            "distance from actuator singularities of the posture nearest home",
        ]
    }

    fn choice(&self) -> String {
        let degrees = TILT.to_degrees();
        match self.turning {
            Turning::None => "the one that the platform has".into(),
            Turning::About([x, y, z]) => {
                format!("turned by up to {degrees:.0}° from home about [{x:.3}, {y:.3}, {z:.3}]")
            }
            Turning::Free => format!("turned by up to {degrees:.0}° from home, evenly"),
        }
    }
}

impl Platform<'_> {
    /// The solution of a chain nearest home, by the Euclidean norm, radians and metres, of those that
    /// count.
    fn nearest(&self, chain: usize, solutions: &[Vec<f64>]) -> Option<Vec<f64>> {
        let model = &self.compiled.mechanism.legs[chain].model;
        let limits = model.limits();
        let from_home = |q: &Vec<f64>| -> f64 {
            let joints = q.iter().enumerate();
            let moved = joints.map(|(j, value)| match model.turns(j) {
                true => math::wrap(*value),
                false => *value,
            });
            moved.map(|x| x * x).sum()
        };
        (solutions.iter())
            .filter(|q| !self.limited || is_within(&limits, q))
            .min_by(|a, b| from_home(a).total_cmp(&from_home(b)))
            .cloned()
    }
}

/// By the closed configurations that the compiler knows.
fn turning(compiled: &CompiledMechanism, generic: &kin_runtime::Mechanism) -> Option<Turning> {
    let freedom = &compiled.freedom;
    let aim = compiled.inverse.as_ref()?.aim;
    if aim != Aim::Pose {
        return (freedom.platform > 1).then_some(Turning::None);
    }
    if freedom.platform == 6 {
        return Some(Turning::Free);
    }
    let home = compiled.mechanism.home();
    let turns = freedom.samples.iter().map(|q| {
        let turn = generic.poses(q)[0] * home.inverse();
        turn.log().angular
    });
    let turns: Vec<[f64; 3]> = turns.collect();
    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { (0..3).map(|i| a[i] * b[i]).sum() };
    let longest = (turns.iter().copied()).max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
    let axis = longest.map(|x| x / dot(longest, longest).sqrt());
    let along = |w: &[f64; 3]| {
        let part = dot(*w, axis);
        (0..3).all(|i| (w[i] - part * axis[i]).abs() < 1e-6)
    };
    // One turn and two or three translations.
    (freedom.platform >= 3 && turns.iter().all(along)).then_some(Turning::About(axis))
}

impl Turning {
    /// Orientations of the platform, always the same: that at home among them,
    /// unless an even number share one axis.
    fn orientations(&self, home: &Pose, count: usize) -> Vec<Pose> {
        let home = Pose {
            translation: [0.0; 3],
            ..*home
        };
        let turned = |axis, angle| Pose::from_axis_angle(axis, angle, [0.0; 3]) * home;
        match *self {
            Turning::None => vec![home],
            Turning::About(axis) => (0..count)
                .map(|k| turned(axis, TILT * ((2 * k + 1) as f64 / count as f64 - 1.0)))
                .collect(),
            // Rotation vectors that fill a ball: axes on a spiral over the
            // sphere, and angles by the cube root of fractions that step by √2.
            Turning::Free => (0..count)
                .map(|k| {
                    let (sine, cosine) = (GOLDEN_ANGLE * k as f64).sin_cos();
                    let z = 1.0 - (2 * k + 1) as f64 / count as f64;
                    let radius = (1.0 - z * z).sqrt();
                    let part = (SQRT_2 * k as f64).fract();
                    turned([radius * cosine, radius * sine, z], TILT * part.cbrt())
                })
                .collect(),
        }
    }
}
