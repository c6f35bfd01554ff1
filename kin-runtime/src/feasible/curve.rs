//! The configurations of a branch over an interval of the parameter.

use super::arcs::Arc;
use super::lanes::MIDDLES;
use super::task::{Place, Point, Task};
use crate::continuation::{Cut, along};
use crate::linear::vector::{dot, norm};
use crate::{FeasibleInterval, RedundantKinematics, math};
use core::f64::consts::{PI, TAU};

/// Arguments of roots below this are zero: the branches of both signs are one.
const ZERO_ARGUMENT: f64 = 1e-11;
/// Halvings of the way between two points of an arc.
const HALVINGS: usize = 24;
/// Which side of a fold points are on that are nearer to each other is rounding.
const SHORT: f64 = 1e-6;

/// A branch over an interval of the parameter.
pub(super) struct Curve {
    pub from: f64,
    pub to: f64,
    pub is_closed: bool,
    /// Whether joint values along it may be anything, because an angle is free throughout.
    pub is_free: bool,
    by: By,
}

/// How the configuration at a value of the parameter is found.
enum By {
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
    /// Of an arc that has points.
    pub fn of_points(parameter: usize, arc: Arc) -> Option<Curve> {
        let ends = arc.points.first().zip(arc.points.last());
        let [from, to] = ends.map(|(a, b)| [a[parameter], b[parameter]])?;
        Some(Curve {
            from,
            to,
            is_closed: arc.is_closed,
            is_free: false,
            by: By::Points(arc),
        })
    }

    /// All of it. The variable is the parameter where the curve is closed, and otherwise θ from 0
    /// to π, of which the parameter is m − h cos θ: at an end joints go with the root of the
    /// parameter's distance from it, and so with θ.
    pub fn whole(&self) -> Part {
        let [from, to] = match self.is_closed {
            true => [self.from, self.to],
            false => [0.0, PI],
        };
        Part {
            from,
            to,
            is_closed: self.is_closed,
        }
    }

    /// The parameter at a value of the variable.
    pub fn parameter(&self, variable: f64) -> f64 {
        match self.is_closed {
            true => variable,
            false => {
                let (middle, half) = (0.5 * (self.from + self.to), 0.5 * (self.to - self.from));
                middle - half * math::sin_cos(variable).1
            }
        }
    }

    /// How long a part is, by the parameter.
    pub fn length(&self, part: &Part) -> f64 {
        self.parameter(part.to) - self.parameter(part.from)
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

    /// The point of a curve at a value of the parameter.
    pub fn on(&self, curve: &Curve, value: f64) -> Option<Point> {
        match &curve.by {
            By::Plan { point, .. } if curve.from == curve.to => Some(*point),
            By::Plan { branch, .. } => self.of_branch(*branch, value),
            By::Points(arc) => {
                let round = curve.to - curve.from;
                let turns = match curve.is_closed {
                    true => libm::floor((value - curve.from) / round),
                    false => 0.0,
                };
                self.near_points(arc, value - turns * round)
            }
        }
    }

    /// What a part of a curve is to a caller; none if nothing of it is left.
    pub fn interval(&self, curve: &Curve, part: &Part) -> Option<FeasibleInterval<N>> {
        let [from, to] = [part.from, part.to].map(|variable| curve.parameter(variable));
        let middles = MIDDLES.map(|share| from + share * (to - from));
        let middle = middles
            .into_iter()
            .find_map(|value| self.on(curve, value))?;
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

    /// Between two points of an arc.
    fn near_points(&self, arc: &Arc, value: f64) -> Option<Point> {
        let parameter = self.parameter;
        let behind = arc.points.partition_point(|x| x[parameter] < value);
        let behind = behind.clamp(1, arc.points.len().max(2) - 1);
        let (from, to) = (arc.points.get(behind - 1)?, arc.points.get(behind)?);
        if value <= from[parameter] {
            return Some(*from);
        }
        if value >= to[parameter] {
            return Some(*to);
        }
        let eased = |value: f64| eased(arc, parameter, value);
        let (mut from, mut to) = (*from, *to);
        for _ in 0..HALVINGS {
            let way = self.way(&from, &to);
            let [a, b, at] = [from[parameter], to[parameter], value].map(eased);
            let guess = along(&from, &way, (at - a) / (b - a));
            let found = self.meet_at(parameter, value, guess);
            if let Some(found) = found.filter(|found| self.goes(&way, &guess, found)) {
                return Some(found);
            }
            // Across the way, which folds do not turn back from.
            let point = along(&from, &way, 0.5);
            let middle = self.meet(&Cut { normal: way, point }, point)?;
            match middle[parameter] {
                p if p > from[parameter] && p <= value => from = middle,
                p if p > value && p < to[parameter] => to = middle,
                _ => return None,
            }
        }
        None
    }

    /// Whether a point is on the way from one point of an arc to the next: next to a fold there is
    /// one that goes back, beside it.
    fn goes(&self, way: &Point, guess: &Point, found: &Point) -> bool {
        let length = norm(*way);
        let is_near = norm(self.way(guess, found)) <= 0.5 * length;
        let ahead = |place: Place| dot(place.tangent, *way) >= 0.5 * length;
        is_near && (length < SHORT || self.place(*found).is_some_and(ahead))
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

/// A value of the parameter as that of which joints are smooth functions also next to the ends of
/// an arc: there the parameter goes with the square of the way.
fn eased(arc: &Arc, parameter: usize, value: f64) -> f64 {
    let ends = arc.points.first().zip(arc.points.last());
    let [from, to] = ends.map_or([value; 2], |(from, to)| [from, to].map(|x| x[parameter]));
    match arc.is_closed {
        true => value,
        false => {
            let [before, behind] =
                [value - from, to - value].map(|x| math::sqrt(math::max(x, 0.0)));
            2.0 * math::atan2(before, behind)
        }
    }
}
