//! Where the swivel angle puts the elbow.
//!
//! Shoulder, elbow and wrist are a triangle whose sides are known once the elbow is bent:
//! the elbow is on a circle about the line from shoulder to wrist, and the swivel angle tells
//! where.

use super::Writer;
use super::transport::Transported;
use crate::expr::linear::Vector;
use crate::geometry::{Swivel, dot};
use crate::plan::{Invariant, Kind};

impl Writer<'_> {
    /// The elbow in the frame before the first joint. Where the line from shoulder to wrist is
    /// along the first axis there is no side to begin from, and the frame's x axis is one.
    pub(super) fn elbow(&mut self) -> Transported {
        let nothing = Transported {
            point: None,
            direction: None,
        };
        let Some((swivel, angle)) = self.linkage.swivel.zip(self.swivel) else {
            return nothing;
        };
        let point = |point, joints: std::ops::Range<usize>| Invariant {
            kind: Kind::Point,
            joints,
            point,
            direction: [0.0; 3],
        };
        let shoulder = point(swivel.shoulder, Swivel::SHOULDER);
        let elbow = point(swivel.elbow, Swivel::ELBOW..Swivel::ELBOW + 1);
        let wrist = point(swivel.wrist, Swivel::WRIST);

        // The triangle, as the link of the elbow sees it.
        let link = Swivel::ELBOW + 1;
        let here = self.seen_from(&shoulder, link);
        let [centre, elbow] = [here, self.seen_from(&elbow, link)].map(|x| self.point(&x));
        let bent = self.bring_behind(&wrist, Swivel::WRIST.start, link);
        let bent = self.point(&bent);
        let (upper, whole) = (self.g.minus(elbow, centre), self.g.minus(bent, centre));
        let along = self.g.dot(upper, whole);
        let across = self.g.cross(upper, whole);
        let across = self.g.dot(across, across);
        let across = self.g.sqrt(across);

        // The same triangle where the target has shoulder and wrist.
        let shoulder = self.seen_from(&shoulder, 0);
        let wrist = self.bring_before(&wrist, Swivel::WRIST.end, 0);
        let [shoulder, wrist] = [shoulder, wrist].map(|x| self.point(&x));
        let way = self.g.minus(wrist, shoulder);
        let square = self.g.dot(way, way);
        let length = self.g.sqrt(square);
        let [side, beside] = self.sides_of(way, length, swivel.reference);
        let [cos, sin] = [angle.cos, angle.sin].map(|x| self.g.mul(across, x));
        let [side, beside] = [self.g.scale(cos, side), self.g.scale(sin, beside)];
        let aside = self.g.plus(side, beside);
        let [along, across] = [self.g.scale(along, way), self.g.scale(length, aside)];
        let both = self.g.plus(along, across);
        let one = self.g.one();
        let inverse = self.g.div(one, square);
        let offset = self.g.scale(inverse, both);
        Transported {
            point: Some(self.g.plus(shoulder, offset)),
            direction: None,
        }
    }

    /// Two unit vectors across the way from shoulder to wrist: to the side to which the first
    /// axis points, and to its left.
    fn sides_of(
        &mut self,
        way: Vector,
        length: crate::expr::Expr,
        reference: [f64; 3],
    ) -> [Vector; 2] {
        let across = self.length_squared(way);
        let size = self.linkage.size;
        let nothing = self.g.constant(self.tolerances.free_below * size * size);
        let square = self.g.constant(size * size);
        if !self.doubt(across, square, nothing) {
            self.watch(across, nothing);
        }
        let radius = self.g.sqrt(across);
        let [zero, one] = [self.g.zero(), self.g.one()];
        let azimuth = [way[0], way[1]].map(|x| self.g.div(x, radius));
        let cos = self.g.select_less(across, nothing, one, azimuth[0]);
        let sin = self.g.select_less(across, nothing, zero, azimuth[1]);
        let minus_z = self.g.neg(way[2]);
        let up = [self.g.mul(minus_z, cos), self.g.mul(minus_z, sin), radius];
        let inverse = self.g.div(one, length);
        let up = self.g.scale(inverse, up);
        let left = [sin, self.g.neg(cos), zero];
        // The frame's z axis is the first axis, or looks the other way.
        let z = self.linkage.links[0].before_home.rotate([0.0, 0.0, 1.0]);
        match dot(z, reference) > 0.0 {
            true => [up, left],
            false => [up, left].map(|v| v.map(|x| self.g.neg(x))),
        }
    }
}
