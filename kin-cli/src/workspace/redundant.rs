//! Redundant arms on the map: what is given beside a target is tried at several values.

use super::arm::is_within;
use super::map;
use kin_runtime::{JointLimit, Pose};
use kinematics::{Parameter, Robot};
use std::f64::consts::PI;

/// Values that are tried at every target of one number, and of several at once.
const TRIED: usize = 12;
const TRIED_AT_ONCE: usize = 48;

/// An arm, and the numbers that are given beside its targets.
pub struct Redundant {
    robot: Robot,
    parameters: Vec<Vec<f64>>,
    limited: bool,
}

impl Redundant {
    /// Of an arm of this size.
    pub fn new(robot: Robot, size: f64, limited: bool) -> Self {
        let range = |place| match robot.parameter(place) {
            Some(Parameter::Joint(joint)) => tried(&robot.limits()[joint], size),
            _ => [-PI, PI],
        };
        let ranges: Vec<[f64; 2]> = (0..robot.parameters()).map(range).collect();
        let count = match ranges.len() {
            1 => TRIED,
            _ => TRIED_AT_ONCE,
        };
        let value = |part: f64, [lower, upper]: &[f64; 2]| lower + part * (upper - lower);
        let set = |k: usize| {
            let parts = scattered(ranges.len(), k, count);
            parts
                .zip(&ranges)
                .map(|(part, range)| value(part, range))
                .collect()
        };
        Self {
            parameters: (0..count).map(set).collect(),
            robot,
            limited,
        }
    }
}

/// The values of a joint that are tried, from the first to the last.
fn tried(limit: &JointLimit, size: f64) -> [f64; 2] {
    let all = match limit.is_revolute() {
        true => PI,
        false => 0.5 * size,
    };
    match [limit.lower(), limit.upper()] {
        [lower, upper] if upper - lower < 2.0 * all => [lower, upper],
        _ if limit.is_revolute() => [-PI, PI],
        [lower, upper] if lower.is_finite() && upper.is_finite() => [lower, upper],
        _ => [-all, all],
    }
}

/// The k-th of so many points that fill a cube evenly (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018), along an edge the middles of as many parts.
fn scattered(dimensions: usize, k: usize, count: usize) -> impl Iterator<Item = f64> {
    // The root of x^(d + 1) = x + 1.
    let root = (0..32).fold(2.0_f64, |x, _| {
        (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0))
    });
    (1..=dimensions as i32).map(move |i| match dimensions {
        1 => (k as f64 + 0.5) / count as f64,
        _ => (0.5 + (k as f64 + 1.0) * root.powi(-i)).fract(),
    })
}

impl map::Robot for Redundant {
    fn try_pose(&self, target: &Pose, _: &mut Vec<f64>) -> Option<f64> {
        let mut best: Option<f64> = None;
        for parameters in &self.parameters {
            for answer in self.robot.ik_at(target, parameters).iter() {
                if !self.limited || is_within(self.robot.limits(), answer.q) {
                    let volume = self.robot.manipulability(answer.q).volume;
                    best = Some(best.map_or(volume, |best| best.max(volume)));
                }
            }
        }
        best
    }

    fn measure(&self) -> [&'static str; 2] {
        ["manipulability", "√det(J Jᵀ) of the best solution"]
    }

    fn choice(&self) -> String {
        format!(
            "all that the target tells apart, evenly; {} values of {} at each",
            self.parameters.len(),
            self.robot.parameter_names().join(" and ")
        )
    }
}
