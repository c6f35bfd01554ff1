//! Transporting points and directions around the loop.
//!
//! Behind every joint is a link with its frame, behind the last one the tip,
//! and the target closes the loop to the base. An object that is constant in
//! one link is transported through known joints into the frame of another. An
//! unknown joint on the way is one that the relation does not depend on; it
//! is crossed as if it stood at zero.

use super::Writer;
use crate::expr::linear::{Trig, Vector, transpose};
use crate::model::JointKind;
use crate::plan::{Invariant, Kind};
use kin_runtime::Pose;

/// A point and a direction in the frame of some link; a point object leaves
/// its direction zero, a direction its point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transported {
    pub point: Option<Vector>,
    pub direction: Option<Vector>,
}

impl Writer<'_> {
    /// An invariant in the frame of link `body`, where it is constant.
    pub(super) fn seen_from(&mut self, invariant: &Invariant, body: usize) -> Transported {
        let home = self.home_of(body).inverse();
        let tidy =
            |v: [f64; 3], scale: f64| v.map(|x| if x.abs() < 1e-13 * scale { 0.0 } else { x });
        let point = tidy(home.transform_point(invariant.point), self.linkage.size);
        let direction = tidy(home.rotate(invariant.direction), 1.0);
        let point = self.g.vector(point);
        let direction = self.g.vector(direction);
        Transported {
            point: (invariant.kind != Kind::Direction).then_some(point),
            direction: (invariant.kind != Kind::Point).then_some(direction),
        }
    }

    /// The frame of link `body` at home: 0 is before the first joint, n + 1
    /// the tip.
    fn home_of(&self, body: usize) -> Pose {
        let n = self.linkage.links.len();
        match body {
            0 => self.linkage.links[0].before_home,
            b if b > n => self.tip,
            b => self.linkage.links[b - 1].after_home,
        }
    }

    /// Transports onwards (base to tip, over the target, to the base again) from
    /// the frame of link `from` to that of link `to`.
    pub(super) fn onwards(&mut self, mut x: Transported, from: usize, to: usize) -> Transported {
        let n = self.linkage.links.len();
        let mut body = from;
        while body != to {
            if body >= n {
                if body == n {
                    x = self.uncross(x, self.linkage.links[n - 1].after);
                }
                if to == n + 1 {
                    return x;
                }
                x = self.over_target(x);
                body = 0;
                continue;
            }
            x = self.arrive_before(x, body);
            if let Some((sum, end)) = self.whole_run(&x, body, to) {
                let back = self.g.reverse(sum);
                x = self.turn(x, back);
                body = end;
            } else {
                x = self.uncross_joint(x, body);
                body += 1;
            }
        }
        x
    }

    /// Transports backwards from the frame of link `from` to that of link `to`.
    pub(super) fn backwards(&mut self, mut x: Transported, from: usize, to: usize) -> Transported {
        let n = self.linkage.links.len();
        let mut body = from;
        while body != to {
            if body == 0 {
                x = self.under_target(x);
                body = n + 1;
            } else if body == n + 1 {
                x = self.cross(x, self.linkage.links[n - 1].after);
                body = n;
            } else {
                let joint = body - 1;
                let run = self.linkage.run_of(joint);
                let start = self.linkage.runs[run].joints.start;
                let ends = self.linkage.runs[run].joints.end == body;
                let whole = if ends {
                    self.whole_run(&x, start, to)
                } else {
                    None
                };
                if let Some((sum, _)) = whole {
                    x = self.turn(x, sum);
                    body = start;
                } else {
                    x = self.cross_joint(x, joint);
                    body = joint;
                }
                x = self.leave_before(x, body);
            }
        }
        x
    }

    /// From the frame of link `joint` to the frame before that joint.
    pub(super) fn arrive_before(&mut self, x: Transported, joint: usize) -> Transported {
        match joint {
            0 => x,
            j => self.uncross(x, self.linkage.links[j - 1].after),
        }
    }

    /// From the frame before joint `joint` to that of the link before it.
    pub(super) fn leave_before(&mut self, x: Transported, joint: usize) -> Transported {
        match joint {
            0 => x,
            j => self.cross(x, self.linkage.links[j - 1].after),
        }
    }

    /// If a direction is to cross a whole run of parallel joints whose sum is
    /// known: that sum, and where the run ends.
    fn whole_run(&mut self, x: &Transported, joint: usize, to: usize) -> Option<(Trig, usize)> {
        let run = self.linkage.run_of(joint);
        let range = self.linkage.runs[run].joints.clone();
        let stops_inside = range.start < to && to < range.end;
        if x.point.is_some() || range.start != joint || range.len() < 2 || stops_inside {
            return None;
        }
        self.run_sum(run).map(|sum| (sum, range.end))
    }

    fn turn(&mut self, x: Transported, t: Trig) -> Transported {
        Transported {
            point: x.point.map(|p| self.g.turn(t, p)),
            direction: x.direction.map(|d| self.g.turn(t, d)),
        }
    }

    /// J x.
    fn cross_joint(&mut self, x: Transported, joint: usize) -> Transported {
        match self.linkage.links[joint].kind {
            JointKind::Revolute => match self.solved.trig[joint] {
                Some(t) => self.turn(x, t),
                None => x,
            },
            JointKind::Prismatic => {
                let shift = self.shift(joint);
                Transported {
                    point: x.point.map(|p| self.g.plus(p, shift)),
                    ..x
                }
            }
        }
    }

    /// J⁻¹ x.
    fn uncross_joint(&mut self, x: Transported, joint: usize) -> Transported {
        match self.linkage.links[joint].kind {
            JointKind::Revolute => match self.solved.trig[joint] {
                Some(t) => {
                    let back = self.g.reverse(t);
                    self.turn(x, back)
                }
                None => x,
            },
            JointKind::Prismatic => {
                let shift = self.shift(joint);
                Transported {
                    point: x.point.map(|p| self.g.minus(p, shift)),
                    ..x
                }
            }
        }
    }

    /// The vector by which a joint slides.
    fn shift(&mut self, joint: usize) -> Vector {
        let v = self.g.vector(self.linkage.links[joint].direction);
        let slide = self.solved.slide[joint].unwrap_or_else(|| self.g.zero());
        self.g.scale(slide, v)
    }

    /// C x.
    fn cross(&mut self, x: Transported, c: Pose) -> Transported {
        let c = self.g.motion(&c);
        Transported {
            point: x.point.map(|p| {
                let p = self.g.rotate(&c.rotation, p);
                self.g.plus(c.translation, p)
            }),
            direction: x.direction.map(|d| self.g.rotate(&c.rotation, d)),
        }
    }

    /// C⁻¹ x.
    fn uncross(&mut self, x: Transported, c: Pose) -> Transported {
        let c = self.g.motion(&c);
        Transported {
            point: x.point.map(|p| {
                let p = self.g.minus(p, c.translation);
                self.g.rotate_back(&c.rotation, p)
            }),
            direction: x.direction.map(|d| self.g.rotate_back(&c.rotation, d)),
        }
    }

    /// From the tip over the target to before the first joint: C₀⁻¹ T x.
    fn over_target(&mut self, x: Transported) -> Transported {
        let pose = self.pose;
        let x = Transported {
            point: x.point.map(|p| {
                let p = self.g.rotate(&pose.rotation, p);
                self.g.plus(pose.translation, p)
            }),
            direction: x.direction.map(|d| self.g.rotate(&pose.rotation, d)),
        };
        self.uncross(x, self.linkage.base)
    }

    /// From before the first joint to the tip: T⁻¹ C₀ x.
    fn under_target(&mut self, x: Transported) -> Transported {
        let x = self.cross(x, self.linkage.base);
        let pose = self.pose;
        let back = transpose(&pose.rotation);
        Transported {
            point: x.point.map(|p| {
                let p = self.g.minus(p, pose.translation);
                self.g.rotate(&back, p)
            }),
            direction: x.direction.map(|d| self.g.rotate(&back, d)),
        }
    }
}
