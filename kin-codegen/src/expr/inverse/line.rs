//! Points that turn and slide onto others: left = J₁ J₂ J₃ right, with prismatic
//! joints among the unknowns.

use super::Writer;
use super::transport::Transported;
use crate::expr::Expr;
use crate::expr::linear::Vector;
use crate::plan::{Atom, Relation};

/// What keeps unit vectors that depend on each other apart, of 1.
const DAMPING: f64 = 1e-8;

/// A point c cos θ + s sin θ + m.
type Circle = [Vector; 3];

impl Writer<'_> {
    /// left = right + Σ dᵢ vᵢ, linear in two or three travels.
    pub(super) fn slides(&mut self, relation: &Relation, unknowns: &[Atom]) {
        let from = &relation.from;
        let (start, end) = self.extent(unknowns[0]);
        let left = self.bring_before(from, from.joints.end, start);
        let right = self.bring_behind(from, from.joints.start, end);
        let (left, right) = (self.point(&left), self.point(&right));
        let gap = self.g.minus(left, right);
        let along: Vec<Vector> = (unknowns.iter())
            .map(|&unknown| self.slide_behind(unknown, end))
            .collect();
        self.slide_along(unknowns, &along, gap);
    }

    /// t of Σ tᵢ vᵢ = gap, of unit vectors: by Cramer's rule, of two in their plane. Of those that
    /// depend on each other many will do, and the ones nearest to the seed's stand for all.
    fn slide_along(&mut self, unknowns: &[Atom], along: &[Vector], gap: Vector) {
        let mut columns = along.to_vec();
        if let &[first, second] = along {
            columns.push(self.g.cross(first, second));
        }
        let [a, b, c] = columns[..] else {
            return;
        };
        let whole = self.volume(a, b, c);
        let one = self.g.one();
        let inverse = self.g.div(one, whole);
        let volumes = [(gap, b, c), (a, gap, c), (a, b, gap)];
        let mut travels: Vec<Expr> = Vec::new();
        for (a, b, c) in volumes.into_iter().take(along.len()) {
            let volume = self.volume(a, b, c);
            travels.push(self.g.mul(volume, inverse));
        }
        if self.g.value(whole).is_none() {
            let square = match along.len() {
                2 => whole,
                _ => self.g.square(whole),
            };
            let nothing = self.flag_free(unknowns, square, one);
            let near = self.nearest_to_seed(unknowns, along, gap);
            for (travel, near) in travels.iter_mut().zip(near) {
                *travel = self.g.select_less(square, nothing, near, *travel);
                self.refuse_beyond_digits(*travel);
            }
        }
        for (&unknown, travel) in unknowns.iter().zip(travels) {
            self.set_slide(unknown, travel);
        }
    }

    /// The t nearest to the seed's of those that make Σ tᵢ vᵢ = gap, where the vᵢ depend on each
    /// other: (VᵀV + μ)⁻¹ Vᵀ of what the seed leaves of the gap, and of what that leaves (J. D. Riley,
    /// "Solving systems of linear equations with a positive definite, symmetric, but possibly
    /// ill-conditioned matrix", Math. Tables Aids Comput. 9, 1955).
    fn nearest_to_seed(&mut self, unknowns: &[Atom], along: &[Vector], gap: Vector) -> Vec<Expr> {
        let zero = self.g.zero();
        let mut travels: Vec<Expr> = Vec::new();
        for &unknown in unknowns {
            let (joint, _) = self.extent(unknown);
            travels.push(self.seeded_joint(joint).unwrap_or(zero));
        }
        let damping = self.g.constant(DAMPING);
        let mut gram = [[zero; 3]; 3];
        for (i, row) in gram.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if let (Some(&a), Some(&b)) = (along.get(i), along.get(j)) {
                    *entry = self.g.dot(a, b);
                }
            }
            row[i] = self.g.add(row[i], damping);
        }
        let [a, b, c] = gram;
        let whole = self.volume(a, b, c);
        for _ in 0..2 {
            let mut left = gap;
            for (&v, &travel) in along.iter().zip(&travels) {
                let part = self.g.scale(travel, v);
                left = self.g.minus(left, part);
            }
            let mut side = [zero; 3];
            for (side, &v) in side.iter_mut().zip(along) {
                *side = self.g.dot(v, left);
            }
            let volumes = [(side, b, c), (a, side, c), (a, b, side)];
            for (travel, (a, b, c)) in travels.iter_mut().zip(volumes) {
                let volume = self.volume(a, b, c);
                let step = self.g.div(volume, whole);
                *travel = self.g.add(*travel, step);
            }
        }
        travels
    }

    fn volume(&mut self, a: Vector, b: Vector, c: Vector) -> Expr {
        let normal = self.g.cross(b, c);
        self.g.dot(a, normal)
    }

    /// left − d₁ v₁ = J (right + d₃ v₃): the lines along v₁ and J v₃ meet where
    /// (v₁ × J v₃) · (left − J right) = 0, which is linear in J.
    pub(super) fn lines(&mut self, relation: &Relation, first: Atom, turn: Atom, last: Atom) {
        let from = &relation.from;
        let (start, end) = self.extent(turn);
        let left = self.bring_before(from, from.joints.end, start);
        let right = self.bring_behind(from, from.joints.start, end);
        let (left, right) = (self.point(&left), self.point(&right));
        let (v, w) = (
            self.slide_before(first, start),
            self.slide_behind(last, end),
        );
        let zero = self.g.zero();
        let moment = self.g.cross(left, v);
        let (a, b, d) = self.cosine_sine(moment, w, zero);
        let back = self.g.cross(right, w);
        let (a2, b2, d2) = self.cosine_sine(v, back, zero);
        let [a, b, d] = [(a, a2), (b, b2), (d, d2)].map(|(x, y)| self.g.add(x, y));
        let trig = self.angle_with(turn, a, b, d, None, self.linkage.size);
        self.set(turn, trig);
        let [right, w] = [right, w].map(|x| self.g.turn(trig, x));
        let gap = self.g.minus(left, right);
        self.slide_along(&[first, last], &[v, w], gap);
    }

    /// The line p + t v, turned about the middle axis, and the point, turned
    /// about the axis that is not next to the line: in the frame of the middle
    /// axis, whose height the turn keeps, the line is at the height z of the
    /// point where t = (z − p₃)/v₃, and the two are as far from the axis.
    pub(super) fn hyperboloid(&mut self, relation: &Relation, first: Atom, turn: Atom, last: Atom) {
        let from = &relation.from;
        let (start, end) = self.extent(turn);
        let is_behind = self.is_prismatic(last);
        let (circle, line, along, far, slide) = if is_behind {
            let line = self.bring_behind(from, from.joints.start, end);
            let along = self.slide_behind(last, end);
            let circle = self.circle_before(relation, first, start);
            (circle, line, along, first, last)
        } else {
            let line = self.bring_before(from, from.joints.end, start);
            let along = self.slide_before(first, start);
            let circle = self.circle_behind(relation, last, end);
            (circle, line, along, last, first)
        };
        let line = self.point(&line);
        // v₃ (x, y) of the point, and v₃ (x, y) of the line at its height.
        let level = line[2];
        let [of_point, of_line] = [0, 1].map(|which| {
            [0, 1, 2].map(|k| {
                let [x, y, z] = circle[k];
                let z = if k == 2 { self.g.sub(z, level) } else { z };
                [(0, x), (1, y)].map(|(i, x)| {
                    if which == 0 {
                        return self.g.mul(along[2], x);
                    }
                    let rise = self.g.mul(along[i], z);
                    let foot = self.g.mul(along[2], line[i]);
                    if k == 2 { self.g.add(foot, rise) } else { rise }
                })
            })
        });
        let [a, b] = [of_point, of_line].map(|columns| self.square(columns));
        let coefficients = [0, 1, 2, 3, 4].map(|i| self.g.sub(a[i], b[i]));
        let trig = self.quartic_roots(coefficients, None, None, None);
        self.set(far, trig);
        let [c, s, m] = circle;
        let (c, s) = (self.g.scale(trig.cos, c), self.g.scale(trig.sin, s));
        let turning = self.g.plus(c, s);
        let point = self.g.plus(turning, m);
        let rise = self.g.sub(point[2], level);
        let travel = self.g.div(rise, along[2]);
        let way = self.g.scale(travel, along);
        let foot = self.g.plus(line, way);
        let (left, right) = if is_behind {
            (point, foot)
        } else {
            (foot, point)
        };
        let trig = self.across(left, right);
        let lengths = [left, right].map(|v| self.length_squared(v));
        let product = self.g.mul(lengths[0], lengths[1]);
        let factor = self.g.sqrt(product);
        let scale = self.g.constant(self.linkage.size.powi(2));
        let trig = self.normalized(turn, trig, factor, scale);
        self.set(turn, trig);
        // left − d v = J₂ J₃ right, where the slide stands in front.
        let travel = match is_behind {
            true => travel,
            false => self.g.neg(travel),
        };
        self.set_slide(slide, travel);
    }

    fn is_prismatic(&self, unknown: Atom) -> bool {
        !self.linkage.is_revolute(self.extent(unknown).0)
    }

    /// J₁⁻¹ left before joint `start`.
    fn circle_before(&mut self, relation: &Relation, far: Atom, start: usize) -> Circle {
        let from = &relation.from;
        let (far_start, far_end) = self.extent(far);
        let left = self.bring_before(from, from.joints.end, far_start);
        let [x, y, z] = self.point(&left);
        let minus = self.g.neg(x);
        self.parts([x, y], [y, minus], z).map(|part| {
            let there = self.onwards(part, far_end, start);
            let there = self.arrive_before(there, start);
            self.vector_of(&there)
        })
    }

    /// J₃ right behind joint `end`.
    fn circle_behind(&mut self, relation: &Relation, far: Atom, end: usize) -> Circle {
        let from = &relation.from;
        let (far_start, far_end) = self.extent(far);
        let right = self.bring_behind(from, from.joints.start, far_end);
        let [x, y, z] = self.point(&right);
        let minus = self.g.neg(y);
        self.parts([x, y], [minus, x], z).map(|part| {
            let there = self.leave_before(part, far_start);
            let there = self.backwards(there, far_start, end);
            self.vector_of(&there)
        })
    }

    /// What turns with the cosine, with the sine, and what stays.
    fn parts(&mut self, cos: [Expr; 2], sin: [Expr; 2], z: Expr) -> [Transported; 3] {
        let zero = self.g.zero();
        let direction = |v: [Expr; 2]| Transported {
            point: None,
            direction: Some([v[0], v[1], zero]),
        };
        let stays = Transported {
            point: Some([zero, zero, z]),
            direction: None,
        };
        [direction(cos), direction(sin), stays]
    }

    fn vector_of(&mut self, x: &Transported) -> Vector {
        match x.direction {
            Some(direction) => direction,
            None => self.point(x),
        }
    }

    /// The direction in which a joint slides, before joint `start`.
    fn slide_before(&mut self, unknown: Atom, start: usize) -> Vector {
        let (slide, end) = self.extent(unknown);
        let there = self.slide_direction(slide);
        let there = self.onwards(there, end, start);
        let there = self.arrive_before(there, start);
        self.direction(&there)
    }

    /// The direction in which a joint slides, behind joint `end − 1`.
    fn slide_behind(&mut self, unknown: Atom, end: usize) -> Vector {
        let (slide, behind) = self.extent(unknown);
        let there = self.slide_direction(slide);
        let there = self.backwards(there, behind, end);
        self.direction(&there)
    }

    fn slide_direction(&mut self, joint: usize) -> Transported {
        let direction = self.g.vector(self.linkage.links[joint].direction);
        Transported {
            point: None,
            direction: Some(direction),
        }
    }

    fn set_slide(&mut self, unknown: Atom, travel: Expr) {
        let (joint, _) = self.extent(unknown);
        let name = format!("d{}", joint + 1);
        self.solved.slide[joint] = Some(self.g.named(travel, name));
    }
}
