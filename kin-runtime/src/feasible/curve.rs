//! The configurations of a branch over an interval of the parameter.

use super::arcs::Arc;
use super::lanes::MIDDLES;
use super::task::{Point, Task};
use crate::{FeasibleInterval, RedundantKinematics, math};
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

/// Arguments of roots below this are zero: the branches of both signs are one.
const ZERO_ARGUMENT: f64 = 1e-11;

/// A branch over an interval of the parameter.
pub(super) struct Curve {
    pub from: f64,
    pub to: f64,
    pub is_closed: bool,
    /// Whether joint values along it may be anything, because an angle is free throughout.
    pub is_free: bool,
    pub by: By,
}

/// How its configurations are found.
pub(super) enum By {
    /// Among all solutions by its branch of the plan; of an interval without length it is the
    /// point.
    Plan { branch: usize, point: Point },
    /// From points of the curve by Newton's method.
    Points(Arc),
}

/// A part of a curve, by its variable.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub from: f64,
    pub to: f64,
    pub is_closed: bool,
}

impl Curve {
    /// Of an arc.
    pub fn of_arc(parameter: usize, arc: Arc) -> Curve {
        let [from, to] = arc.ends(parameter);
        Curve {
            from,
            to,
            is_closed: arc.is_closed,
            is_free: false,
            by: By::Points(arc),
        }
    }

    /// All of it. The variable is the place along an arc. Of a branch of the plan it is the
    /// parameter where the curve is closed, and otherwise θ from 0 to π, of which the parameter
    /// is m − h cos θ: at an end joints go with the root of the parameter's distance from it, and
    /// so with θ.
    pub fn whole(&self) -> Part {
        let [from, to] = match &self.by {
            By::Points(arc) => [0.0, arc.chords() as f64],
            By::Plan { .. } if self.is_closed => [self.from, self.to],
            By::Plan { .. } => [0.0, PI],
        };
        Part {
            from,
            to,
            is_closed: self.is_closed,
        }
    }
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The curve of a branch of the plan.
    pub fn curve(&self, branch: usize, interval: &FeasibleInterval<N>, is_free: bool) -> Curve {
        let middle = 0.5 * (interval.from + interval.to);
        Curve {
            from: interval.from,
            to: interval.to,
            is_closed: interval.is_closed,
            is_free,
            by: By::Plan {
                branch,
                point: self.point(&interval.middle, middle),
            },
        }
    }

    /// The point of a curve at a value of the variable.
    pub fn on(&self, curve: &Curve, variable: f64) -> Option<Point> {
        match &curve.by {
            By::Plan { .. } => self.at_parameter(curve, self.parameter_on(curve, variable)),
            By::Points(arc) => self.on_arc(arc, variable).ok(),
        }
    }

    /// The parameter at a value of the variable.
    pub fn parameter_on(&self, curve: &Curve, variable: f64) -> f64 {
        let (middle, half) = (0.5 * (curve.from + curve.to), 0.5 * (curve.to - curve.from));
        match &curve.by {
            By::Plan { .. } if curve.is_closed => variable,
            By::Plan { .. } => middle - half * math::sin_cos(variable).1,
            By::Points(arc) => {
                let (Ok(x) | Err(x)) = self.on_arc(arc, variable);
                x[self.parameter]
            }
        }
    }

    /// Values of the variable on a part, ascending, both ends and points of an arc among them: so
    /// many to each radian or metre of the parameter, and so many in all, at least.
    pub fn spread_over(&self, curve: &Curve, part: &Part, density: f64, fewest: f64) -> Vec<f64> {
        let mut values = alloc::vec![part.from];
        let mut from = part.from;
        while from < part.to {
            let to = match curve.by {
                By::Plan { .. } => part.to,
                By::Points(_) => math::min(libm::floor(from) + 1.0, part.to),
            };
            let [first, last] = [from, to].map(|variable| self.parameter_on(curve, variable));
            let share = fewest * (to - from) / (part.to - part.from);
            let count = libm::ceil(math::max(density * (last - first), share)) as usize;
            values.extend((1..=count).map(|i| from + (to - from) * i as f64 / count as f64));
            from = to;
        }
        values
    }

    /// The point of a curve at a value of the parameter.
    fn at_parameter(&self, curve: &Curve, value: f64) -> Option<Point> {
        match &curve.by {
            By::Plan { point, .. } if curve.from == curve.to => Some(*point),
            By::Plan { branch, .. } => self.of_branch(*branch, value),
            By::Points(arc) => self.on_arc_at(arc, value),
        }
    }

    /// What a part of a curve is to a caller; none if nothing of it is left.
    pub fn interval(&self, curve: &Curve, part: &Part) -> Option<FeasibleInterval<N>> {
        let [from, to] = [part.from, part.to].map(|variable| self.parameter_on(curve, variable));
        let middles = MIDDLES.map(|share| from + share * (to - from));
        let middle = middles
            .into_iter()
            .find_map(|value| self.at_parameter(curve, value))?;
        Some(self.wound(FeasibleInterval {
            from,
            to,
            is_angle: self.turns(self.parameter),
            is_closed: part.is_closed,
            middle: self.q_wrapped(&middle),
        }))
    }

    /// The solution of a branch, or of one that differs from it by signs of zero.
    fn of_branch(&self, branch: usize, value: f64) -> Option<Point> {
        let solutions = self.solutions(value);
        let own = solutions.iter().find(|it| it.branch as usize == branch);
        let found = own.or_else(|| {
            let arguments = self.robot.root_arguments(self.target, value);
            let met = (0..self.roots).filter(|&root| arguments[root][branch].abs() < ZERO_ARGUMENT);
            let signs = met.fold(0, |signs, root| signs | 1 << root);
            let is_same = |other: usize| (other ^ branch) & !signs == 0;
            solutions.iter().find(|it| is_same(it.branch as usize))
        })?;
        Some(self.point(&found.q, value))
    }

    /// An interval with its lower end in (−π, π], if the parameter is an angle.
    pub fn wound(&self, interval: FeasibleInterval<N>) -> FeasibleInterval<N> {
        let turns = match self.turns(self.parameter) {
            true => TAU * libm::ceil((interval.from - PI) / TAU),
            false => 0.0,
        };
        FeasibleInterval {
            from: interval.from - turns,
            to: interval.to - turns,
            ..interval
        }
    }

    /// Joint values with angles in (−π, π].
    fn q_wrapped(&self, x: &Point) -> [f64; N] {
        let q = self.q(x);
        core::array::from_fn(|i| match self.limits[i].is_revolute() {
            true => math::wrap(q[i]),
            false => q[i],
        })
    }
}
