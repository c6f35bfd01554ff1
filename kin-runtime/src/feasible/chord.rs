//! Points of an arc between two that it has.
//!
//! Next to a fold, and where joints turn while the parameter hardly moves, they are no steady
//! functions of the parameter. Along the chord from one point to the next they are.

use super::arcs::Arc;
use super::false_position::false_position;
use super::task::{Place, Point, Task};
use crate::RedundantKinematics;
use crate::continuation::{Cut, along};
use crate::linear::vector::{dot, norm};

/// The curve is nearer to what tangents tell of it than these shares of how far its slopes at the
/// ends are from the chord, and of the chord.
const OF_BEND: f64 = 0.1;
const OF_LENGTH: f64 = 1e-3;
/// Slopes that are farther from the chord, as a share of it, tell nothing of what is in between.
const BENT: f64 = 0.5;
/// Halvings of the chord until they do.
const HALVINGS: usize = 24;
/// Chords shorter than this are rounding.
const SHORT: f64 = 1e-9;

/// The straight way from one point of an arc to the next.
#[derive(Clone, Copy)]
pub(super) struct Chord {
    from: Point,
    pub way: Point,
    pub length: f64,
    /// The derivatives of points by the share of the chord at its ends.
    pub slopes: [Point; 2],
    /// How far they are from the chord.
    bend: f64,
}

impl Chord {
    /// From a point, with the tangents at both ends, however long and to either side.
    pub fn new(from: Point, way: Point, tangents: [Point; 2]) -> Self {
        let length = norm(way);
        let slopes = tangents.map(|tangent| match length < SHORT {
            true => way,
            false => {
                let scale = length * length / dot(tangent, way);
                tangent.map(|t| t * scale)
            }
        });
        let off = slopes.map(|slope| norm(along(&slope, &way, -1.0)));
        Chord {
            from,
            way,
            length,
            slopes,
            bend: off[0] + off[1],
        }
    }

    /// Whether its ends tell nothing of what is in between.
    pub fn is_bent(&self) -> bool {
        // Infinite, or no number, where a tangent is across the chord.
        !self.bend.is_finite() || self.bend > BENT * self.length
    }

    /// The point at a share of the chord, to the fourth order in its length: the cubic of Hermite,
    /// where the ends tell it.
    fn expected(&self, share: f64) -> Point {
        if self.is_bent() {
            return along(&self.from, &self.way, share);
        }
        let (s, rest) = (share, 1.0 - share);
        let [first, last] = self.slopes;
        core::array::from_fn(|i| {
            let way = self.way[i];
            let bend = rest * (first[i] - way) - s * (last[i] - way);
            self.from[i] + s * way + s * rest * bend
        })
    }
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    pub fn chord(&self, from: &Place, to: &Place) -> Chord {
        let way = self.way(&from.x, &to.x);
        Chord::new(from.x, way, [from.tangent, to.tangent])
    }

    /// The point that is across from a share of the chord between two; as an error where the ends
    /// tell it to be, if Newton's method does not get there.
    fn between(&self, ends: [&Place; 2], share: f64) -> Result<Point, Point> {
        if share >= 1.0 {
            return Ok(ends[1].x);
        }
        let whole = self.chord(ends[0], ends[1]);
        if share <= 0.0 || whole.length < SHORT {
            return Ok(ends[0].x);
        }
        let meet = |share: f64, expected: Point| {
            let cut = Cut {
                normal: whole.way.map(|x| x / whole.length),
                point: along(&whole.from, &whole.way, share),
            };
            self.meet(&cut, expected)
        };
        let (mut chord, mut ends, mut shares) = (whole, ends.map(|&place| place), [0.0, 1.0]);
        for _ in 0..HALVINGS {
            let part = (share - shares[0]) / (shares[1] - shares[0]);
            let expected = chord.expected(part);
            if !chord.is_bent() {
                let near = OF_BEND * chord.bend + OF_LENGTH * chord.length;
                let is_near = |x: &Point| norm(self.way(&expected, x)) <= near;
                if let Some(found) = meet(share, expected).filter(is_near) {
                    return Ok(found);
                }
            }
            let middle = 0.5 * (shares[0] + shares[1]);
            let found = meet(middle, along(&ends[0].x, &chord.way, 0.5));
            let Some(place) = found.and_then(|x| self.place(x)) else {
                return Err(expected);
            };
            let half = usize::from(share < middle);
            (ends[half], shares[half]) = (place, middle);
            chord = self.chord(&ends[0], &ends[1]);
        }
        Err(chord.expected(0.5))
    }

    /// The point of an arc at a place: how many of its points are before it, and the share of the
    /// chord to the next one; of a closed arc also rounds later. As an error where its neighbours tell
    /// it to be.
    pub fn on_arc(&self, arc: &Arc, place: f64) -> Result<Point, Point> {
        let count = arc.chords() as f64;
        let rounds = match arc.is_closed {
            true => libm::floor(place / count),
            false => 0.0,
        };
        let own = place - rounds * count;
        let before = (own as usize).min(arc.chords() - 1);
        let ends = [&arc.points[before], &arc.points[before + 1]];
        let [first, last] = arc.ends(self.parameter);
        let round = |mut x: Point| {
            x[self.parameter] += rounds * (last - first);
            x
        };
        self.between(ends, own - before as f64)
            .map(round)
            .map_err(round)
    }

    /// The point of an arc at a value of the parameter, which grows along it.
    pub fn on_arc_at(&self, arc: &Arc, value: f64) -> Option<Point> {
        let parameter = self.parameter;
        let [first, last] = arc.ends(parameter);
        let rounds = match arc.is_closed {
            true => libm::floor((value - first) / (last - first)),
            false => 0.0,
        };
        let value = value - rounds * (last - first);
        let behind = arc
            .points
            .partition_point(|place| place.x[parameter] < value);
        let behind = behind.clamp(1, arc.chords());
        let [from, to] = [&arc.points[behind - 1], &arc.points[behind]];
        let ends = [(0.0, from), (1.0, to)].map(|(at, place)| (at, place.x[parameter] - value));
        if ends[0].1 >= 0.0 {
            return Some(from.x);
        }
        if ends[1].1 <= 0.0 {
            return Some(to.x);
        }
        // Where Newton's method gets to none, there is nothing to look for.
        let off = |share| {
            let found = self.between([from, to], share);
            found.map_or(0.0, |x| x[parameter] - value)
        };
        let share = false_position(off, ends[0], ends[1]);
        self.between([from, to], share).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::super::task::WIDTH;
    use super::*;

    fn vector(x: f64, y: f64) -> Point {
        let mut vector = [0.0; WIDTH];
        (vector[0], vector[1]) = (x, y);
        vector
    }

    #[test]
    fn what_is_expected_is_a_number_whatever_the_tangents() {
        let way = vector(0.0, 0.4);
        for across in [vector(1.0, 0.0), vector(0.0, 0.0), vector(f64::NAN, 1.0)] {
            let chord = Chord::new(vector(0.3, 0.0), way, [across, vector(0.0, 1.0)]);
            assert!(chord.is_bent());
            assert_eq!(chord.expected(0.25), vector(0.3, 0.1));
        }
        // No way at all.
        let chord = Chord::new(vector(0.3, 0.0), vector(0.0, 0.0), [vector(1.0, 0.0); 2]);
        assert_eq!(chord.expected(0.25), vector(0.3, 0.0));
    }

    /// A circle about 0, by its points at ±a.
    #[test]
    fn what_is_expected_is_off_by_the_fourth_power() {
        let off = |a: f64| {
            let from = vector(a.cos(), -a.sin());
            let way = vector(0.0, 2.0 * a.sin());
            let tangents = [vector(a.sin(), a.cos()), vector(-a.sin(), a.cos())];
            let [x, y, ..] = Chord::new(from, way, tangents).expected(0.5);
            assert!(y.abs() < 1e-15);
            (x - 1.0).abs()
        };
        let ratio = off(0.2) / off(0.1);
        assert!((ratio - 16.0).abs() < 1.0, "{ratio}");
    }
}
