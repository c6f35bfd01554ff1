//! Two parallel joints on a first one that is square to them, and a wrist.
//!
//! The first subproblems of inverse kinematics for such an arm ask whether the
//! wrist's centre can be where the target wants it: its height and its distance
//! from the first axis must lie in one of two annuli, which are images of each
//! other in that axis. All that the wrist adds is a sphere about the tip: the
//! centres that are wanted for the orientations of the tip. The tip is in
//! reach if the sphere meets the annuli, and in dextrous reach if the sphere
//! lies in them. Both are decided on the boundary circles.

use core::f64::consts::{PI, TAU};

use super::{EXACT, Line};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::scalar::golden_section::GoldenSection;
use crate::{Chain, math};

/// Points of a circle between which an extremum is looked for.
const POINTS: usize = 360;
/// Steps that find it to rounding.
const STEPS: usize = 60;
/// Rounding, relative to the arm's size.
const ROUNDING: f64 = 1e-12;

/// What carries the wrist, and the wrist.
#[derive(Clone, Debug)]
pub(super) struct Shoulder {
    first: Line,
    /// From the first axis to the plane in which the centre moves.
    offset: f64,
    /// The second axis in that plane: along it, and up the first axis.
    second: [f64; 2],
    /// Least and largest distance of the centre from the second axis.
    span: [f64; 2],
    /// Whether there is a wrist, and how far the tip is from its centre.
    tool: Option<f64>,
    size: f64,
}

/// A place on the half-plane at one side of the first axis: distance from the
/// axis and height.
type Place = [f64; 2];

impl Shoulder {
    pub(super) fn of(chain: &Chain) -> Option<Shoulder> {
        let lines: alloc::vec::Vec<Line> =
            chain.twists().iter().map(Line::of).collect::<Option<_>>()?;
        let (arm, wrist) = lines.split_at_checked(3)?;
        let [first, second, third] = *arm else {
            return None;
        };
        let tip = chain.home().translation;
        let square = |a: &Line, b: &Line| dot(a.direction, b.direction).abs() < EXACT;
        if !second.is_parallel(third.direction) || !square(&first, &second) {
            return None;
        }
        let size = norm(second.offset(third.point)) + norm(third.offset(tip));
        let (centre, tool) = match wrist {
            [] => (tip, None),
            [a, b, c] if square(a, b) && square(b, c) => {
                let centre = meeting(a, b)?;
                let meets = norm(c.offset(centre)) < EXACT * size;
                let tool = norm(sub(tip, centre));
                // A rounding error is no tool.
                let tool = if tool < ROUNDING * size { 0.0 } else { tool };
                meets.then_some((centre, Some(tool)))?
            }
            _ => return None,
        };
        let across = cross(second.direction, first.direction);
        let from_first = |point| sub(point, first.point);
        let links = [norm(second.offset(third.point)), norm(third.offset(centre))];
        Some(Shoulder {
            first,
            offset: dot(from_first(centre), second.direction).abs(),
            second: [
                dot(from_first(second.point), across),
                dot(from_first(second.point), first.direction),
            ],
            span: [(links[0] - links[1]).abs(), links[0] + links[1]],
            tool,
            size,
        })
    }

    fn place(&self, point: [f64; 3]) -> Place {
        let up = dot(sub(point, self.first.point), self.first.direction);
        [norm(self.first.offset(point)), up]
    }

    /// How far inside the reach of the centre a place is, by the posture that
    /// has it farthest inside; negative outside.
    fn margin(&self, place: Place) -> f64 {
        let [front, back] = [1.0, -1.0].map(|side| self.margin_of(side, place));
        front.max(back)
    }

    /// The arm in front of the first axis, or reaching over behind it.
    fn margin_of(&self, side: f64, [r, z]: Place) -> f64 {
        let along = side * math::sqrt((r * r - self.offset * self.offset).max(0.0));
        let [a, h] = self.second;
        let distance = libm::hypot(along - a, z - h);
        // Nearer to the first axis than the offset lets it there is nothing, and at the offset
        // rounding does not tell.
        let room = (r - self.offset).min(0.0);
        let inside = (distance - self.span[0]).min(self.span[1] - distance);
        match room < 0.0 {
            true => inside.min(room),
            false => inside,
        }
    }

    /// A place on the circle of some radius about the second axis.
    fn on_circle(&self, radius: f64, angle: f64) -> Place {
        let (sine, cosine) = libm::sincos(angle);
        let along = self.second[0] + radius * cosine;
        [
            libm::hypot(along, self.offset),
            self.second[1] + radius * sine,
        ]
    }

    /// The greatest value where the centre is as near to the first axis as its
    /// offset lets it.
    fn greatest_on_cylinder(&self, f: impl Fn(Place) -> f64) -> f64 {
        let middle = self.second[1];
        greatest(|angle| {
            let at = [self.offset, middle + self.span[1] * (angle / PI - 1.0)];
            match self.margin(at) >= 0.0 {
                true => f(at),
                false => f64::NEG_INFINITY,
            }
        })
    }

    pub(super) fn is_reachable(&self, point: [f64; 3]) -> bool {
        let place = self.place(point);
        let rounding = ROUNDING * self.size;
        let tool = self.tool.unwrap_or(0.0);
        let inside = self.margin(place) >= -rounding;
        if tool == 0.0 {
            return inside;
        }
        // The reach of the centre is connected, so that every distance between
        // the least and the largest occurs.
        let near = |at: Place| libm::hypot(at[0] - place[0], at[1] - place[1]);
        let far = |at: Place| libm::hypot(at[0] + place[0], at[1] - place[1]);
        let least = if inside {
            0.0
        } else {
            let of = |radius: f64| -greatest(|angle| -near(self.on_circle(radius, angle)));
            let cylinder = -self.greatest_on_cylinder(|at| -near(at));
            of(self.span[0]).min(of(self.span[1])).min(cylinder)
        };
        let largest = greatest(|angle| far(self.on_circle(self.span[1], angle)));
        tool >= least - rounding && tool <= largest + rounding
    }

    pub(super) fn is_dextrous(&self, point: [f64; 3]) -> bool {
        let Some(tool) = self.tool else {
            return false;
        };
        let [r, z] = self.place(point);
        let rounding = ROUNDING * self.size;
        // One of the wanted centres, and then no boundary among them.
        if self.margin([r, z + tool]) < -rounding {
            return false;
        }
        if tool == 0.0 {
            return true;
        }
        // How far a place is inside the shadow that the sphere of wanted
        // centres casts on the half-plane.
        let shadow = |[x, y]: Place| {
            let [near, far] = [libm::hypot(x - r, y - z), libm::hypot(x + r, y - z)];
            (tool - near).min(far - tool)
        };
        // A boundary of one posture may lie inside the other.
        let covered = |side: f64, at: Place| self.margin_of(side, at) > rounding;
        let meets = |radius: f64| {
            let on_boundary = |angle: f64| {
                let at = self.on_circle(radius, angle);
                let side = (self.second[0] + radius * libm::cos(angle)).signum();
                match covered(-side, at) {
                    true => f64::NEG_INFINITY,
                    false => shadow(at),
                }
            };
            greatest(on_boundary) > 1e3 * rounding
        };
        let cylinder =
            self.offset > EXACT * self.size && self.greatest_on_cylinder(shadow) > 1e3 * rounding;
        !(meets(self.span[0]) || meets(self.span[1]) || cylinder)
    }
}

/// Where two axes meet.
fn meeting(a: &Line, b: &Line) -> Option<[f64; 3]> {
    let normal = cross(a.direction, b.direction);
    let d = sub(b.point, a.point);
    let t = dot(cross(d, b.direction), normal) / dot(normal, normal);
    let point = add(a.point, scale(t, a.direction));
    (norm(b.offset(point)) < EXACT * (1.0 + norm(point))).then_some(point)
}

/// The greatest value on a full turn, by golden section about the best points
/// of a grid.
fn greatest(f: impl Fn(f64) -> f64) -> f64 {
    let step = TAU / POINTS as f64;
    let at = |k: usize| f(k as f64 * step);
    let mut best = f64::NEG_INFINITY;
    for k in 0..POINTS {
        let here = at(k);
        best = best.max(here);
        let is_peak = here >= at((k + POINTS - 1) % POINTS) && here >= at(k + 1);
        if !is_peak || here == f64::NEG_INFINITY {
            continue;
        }
        let [low, high] = [-1.0, 1.0].map(|side| (k as f64 + side) * step);
        let mut section = GoldenSection::new(low, high, &f);
        (0..STEPS).for_each(|_| section.step(&f));
        best = best.max(section.best().1);
    }
    best
}
