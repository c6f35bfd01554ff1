//! The configurations of a branch over an interval of the parameter.

use super::arcs::Arc;
use super::lanes::MIDDLES;
use super::task::{Point, Task};
use crate::continuation::along;
use crate::{FeasibleInterval, RedundantKinematics, math};
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

    fn near_points(&self, arc: &Arc, value: f64) -> Option<Point> {
        let parameter = self.parameter;
        let behind = arc.points.partition_point(|x| x[parameter] < value);
        let behind = behind.clamp(1, arc.points.len().max(2) - 1);
        let (from, to) = (arc.points.get(behind - 1)?, arc.points.get(behind)?);
        let way = self.way(from, to);
        let share = match way[parameter] > 0.0 {
            true => ((value - from[parameter]) / way[parameter]).clamp(0.0, 1.0),
            false => 0.0,
        };
        let share = eased(arc, behind, share);
        let guess = along(from, &way, share);
        match share == 0.0 || share == 1.0 {
            true => Some(guess),
            false => self.meet_at(parameter, value, guess),
        }
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

/// How far along the chord a share of the parameter's way is: next to a fold the parameter goes
/// with the square of the way.
fn eased(arc: &Arc, behind: usize, share: f64) -> f64 {
    let (first, last) = (behind == 1, behind == arc.points.len() - 1);
    match (arc.is_closed, first, last) {
        (true, ..) | (_, false, false) => share,
        (_, true, false) => math::sqrt(share),
        (_, false, true) => 1.0 - math::sqrt(1.0 - share),
        // Both ends in one cell: half a turn of a cosine.
        (_, true, true) => {
            let angle = math::atan2(2.0 * math::sqrt(share * (1.0 - share)), 1.0 - 2.0 * share);
            angle / PI
        }
    }
}
