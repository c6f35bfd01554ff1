//! Where a joint comes to a value along an arc.
//!
//! Between two points of the arc the joint is nearly the cubic that its tangents tell, and that is
//! between its coefficients in Bernstein's basis
//! (G. Farin, *Curves and Surfaces for CAGD*, 2002, chapter 5): where these leave the value on
//! one side, or pass it once, no point in between is looked at.

use super::arcs::Arc;
use super::chord::Chord;
use super::false_position::false_position;
use super::memo::Memo;
use super::task::{Place, Point, Task};
use crate::{RedundantKinematics, math};
use alloc::vec::Vec;

/// What the joint may differ from the cubic, as a share of how far the cubic does from the chord,
/// and of the chord.
const OF_BEND: f64 = 0.25;
const OF_CHORD: f64 = 1e-3;
/// A curve goes no farther than so many of its chords.
const FAR: f64 = 2.0;
/// Halvings of a chord at most.
const HALVINGS: u32 = 12;
/// And of all chords of an arc.
const HALVED: usize = 1024;

/// A value of one of the coordinates.
#[derive(Clone, Copy)]
pub(super) struct Bound {
    pub coordinate: usize,
    pub value: f64,
}

/// A point of the arc: how many others are before it, and the share of the chord to the next one.
type Station = (f64, Place);

/// How often a coordinate has a value between two points.
enum Crosses {
    Never,
    Once,
    Unknown,
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// Where along an arc coordinates have these values.
    pub fn crossings(&self, arc: &Arc, bounds: &[Bound]) -> Vec<f64> {
        let mut search = Search {
            task: self,
            arc,
            known: Memo::new(),
            halved: 0,
            found: Vec::new(),
        };
        let station = |i: usize| (i as f64, arc.points[i]);
        for i in 0..arc.chords() {
            for bound in bounds {
                search.between([&station(i), &station(i + 1)], bound, HALVINGS);
            }
        }
        search.found
    }

    /// How far a coordinate is from a value, by the shorter way round.
    fn off(&self, x: &Point, bound: &Bound) -> f64 {
        let off = x[bound.coordinate] - bound.value;
        match self.turns(bound.coordinate) {
            true => math::wrap(off),
            false => off,
        }
    }
}

struct Search<'a, K: ?Sized, const N: usize> {
    task: &'a Task<'a, K, N>,
    arc: &'a Arc,
    /// Points in the middle of chords, which every bound asks for.
    known: Memo<Option<Place>>,
    halved: usize,
    found: Vec<f64>,
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Search<'_, K, N> {
    fn between(&mut self, [from, to]: [&Station; 2], bound: &Bound, halvings: u32) {
        let (task, arc) = (self.task, self.arc);
        let off = [from, to].map(|(_, place)| task.off(&place.x, bound));
        let chord = task.chord(&from.1, &to.1);
        let crosses = crosses(&chord, bound.coordinate, off);
        if matches!(crosses, Crosses::Never) {
            return;
        }
        if matches!(crosses, Crosses::Unknown) && halvings > 0 && self.halved < HALVED {
            self.halved += 1;
            let middle = 0.5 * (from.0 + to.0);
            let place = || task.on_arc(arc, middle).ok().and_then(|x| task.place(x));
            if let Some(place) = self.known.at(middle, place) {
                let middle = (middle, place);
                self.between([from, &middle], bound, halvings - 1);
                self.between([&middle, to], bound, halvings - 1);
                return;
            }
        }
        if (off[0] < 0.0) != (off[1] < 0.0) {
            let off_along = |way: f64| {
                let (Ok(x) | Err(x)) = task.on_arc(arc, from.0 + way);
                task.off(&x, bound)
            };
            let ends = [(0.0, off[0]), (to.0 - from.0, off[1])];
            let way = false_position(off_along, ends[0], ends[1]);
            self.found.push(from.0 + way);
        }
    }
}

/// By how far the coordinate is from the value at both ends.
fn crosses(chord: &Chord, coordinate: usize, [first, last]: [f64; 2]) -> Crosses {
    let way = chord.way[coordinate];
    if (first + way - last).abs() > 1.0 {
        // Half a turn away.
        return Crosses::Never;
    }
    if chord.is_bent() {
        let is_far = math::min(first.abs(), last.abs()) > FAR * chord.length;
        return match is_far {
            true => Crosses::Never,
            false => Crosses::Unknown,
        };
    }
    let [rise, fall] = chord.slopes.map(|slope| slope[coordinate] / 3.0);
    let third = way / 3.0;
    let bend = math::max((rise - third).abs(), (fall - third).abs());
    let noise = OF_BEND * bend + OF_CHORD * chord.length;
    let coefficients = [first, first + rise, last - fall, last];
    let (least, most) = coefficients
        .iter()
        .fold((first, first), |(least, most), &x| {
            (math::min(least, x), math::max(most, x))
        });
    if least > noise || most < -noise {
        return Crosses::Never;
    }
    // It goes one way.
    let steps = [rise, last - first - rise - fall, fall];
    let goes = |sign: f64| steps.iter().all(|step| sign * step > noise);
    match goes(1.0) || goes(-1.0) {
        true => Crosses::Once,
        false => Crosses::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::super::task::WIDTH;
    use super::*;

    /// The chord of a function, which gives its derivative too, from 0 to `far`.
    fn chord(f: &dyn Fn(f64) -> [f64; 2], far: f64) -> (Chord, [f64; 2]) {
        let vector = |x, y| {
            let mut vector = [0.0; WIDTH];
            (vector[0], vector[1]) = (x, y);
            vector
        };
        let [[first, rise], [last, fall]] = [0.0, far].map(f);
        let tangents = [vector(rise, 1.0), vector(fall, 1.0)];
        let chord = Chord::new(vector(first, 0.0), vector(last - first, far), tangents);
        (chord, [first, last])
    }

    #[test]
    fn what_passes_between_points_is_seen() {
        for far in [1e-3, 0.1, 0.4] {
            // Its ends are below zero by a share of what it rises.
            let hill = |share: f64| {
                let below = 0.25 * share * far * far;
                let (chord, ends) = chord(&|t| [t * (far - t) - below, far - 2.0 * t], far);
                crosses(&chord, 0, ends)
            };
            for share in [0.1, 0.9, 0.99] {
                assert!(matches!(hill(share), Crosses::Unknown), "{far} {share}");
            }
            assert!(matches!(hill(40.0), Crosses::Never), "{far}");
        }
        // More bent in the middle than the tangents at the ends say.
        let far = 0.2;
        let steep = |t: f64| {
            let (rise, slope) = (t * (far - t), far - 2.0 * t);
            let square = far * far;
            [
                rise + 2.0 * rise * rise / square - 0.36 * square,
                slope * (1.0 + 4.0 * rise / square),
            ]
        };
        let (bent, ends) = chord(&steep, far);
        assert!(steep(0.5 * far)[0] > 0.0 && ends[0] < 0.0);
        assert!(matches!(crosses(&bent, 0, ends), Crosses::Unknown));
        // The same squared, of whose rise the tangents at the ends say nothing.
        let far = 0.3;
        let flat = |t: f64| {
            let rise = t * (far - t);
            [rise * rise - 2e-4, 2.0 * rise * (far - 2.0 * t)]
        };
        let (chord, ends) = chord(&flat, far);
        assert!(flat(0.5 * far)[0] > 0.0 && ends[0] < 0.0);
        assert!(matches!(crosses(&chord, 0, ends), Crosses::Unknown));
    }

    #[test]
    fn what_goes_one_way_crosses_once() {
        let (steady, ends) = chord(&|t| [t.sin() - 0.1, t.cos()], 0.3);
        assert!(matches!(crosses(&steady, 0, ends), Crosses::Once));
        let (wave, ends) = chord(&|t| [0.1 * (20.0 * t).sin(), 2.0 * (20.0 * t).cos()], 0.3);
        assert!(matches!(crosses(&wave, 0, ends), Crosses::Unknown));
        // Half a turn away from the value.
        let (steady, _) = chord(&|t| [t, 1.0], 0.3);
        let ends = [3.1, 3.4 - core::f64::consts::TAU];
        assert!(matches!(crosses(&steady, 0, ends), Crosses::Never));
    }
}
