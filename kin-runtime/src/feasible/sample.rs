//! All solutions at one value of the parameter, and how those at two belong together.

use super::task::{Place, Task, WIDTH};
use crate::RedundantKinematics;
use crate::continuation::along;
use crate::linear::vector::norm;
use alloc::vec::Vec;
use core::cell::OnceCell;

/// How far solutions of neighbouring samples may be apart, radians and metres.
const FAR: f64 = 0.6;
/// How far the way between them may differ from what their tangents tell, relative to its
/// length.
const TRUST: f64 = 0.15;
/// Ways shorter than this are not judged.
const SHORT: f64 = 1e-9;

/// Equations count as dependent below this share of the longest: solutions that have met are known
/// to the root of what numbers are, and nothing tells how they go on.
const DEPENDENT: f64 = 1e-6;

/// All solutions at one value of the parameter.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub parameter: f64,
    pub places: Vec<Place>,
    /// By place, the folds to where the parameter falls and to where it grows, once looked for.
    folds: Vec<[OnceCell<Option<Place>>; 2]>,
}

impl Sample {
    pub fn new(parameter: f64, places: Vec<Place>) -> Self {
        let folds = places.iter().map(|_| Default::default()).collect();
        Self {
            parameter,
            places,
            folds,
        }
    }
}

/// Which places of two samples are on one arc, and which of either are not carried over.
pub(super) struct Matched {
    pub pairs: Vec<[usize; 2]>,
    pub ending: Vec<usize>,
    pub beginning: Vec<usize>,
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The solutions at a value of the parameter that go on in one way.
    pub fn sample(&self, parameter: f64) -> Sample {
        let solutions = self.robot.ik_at(self.target, parameter);
        let points = solutions
            .iter()
            .map(|found| self.point(&found.q, parameter));
        let places = points.filter_map(|x| self.place_where(x, DEPENDENT));
        Sample::new(parameter, places.collect())
    }

    /// The fold that a place comes to where the parameter grows (`sense` 1) or falls (−1), which
    /// every neighbour of the sample asks for.
    pub fn fold(&self, sample: &Sample, place: usize, sense: f64) -> Option<Place> {
        let [falling, growing] = &sample.folds[place];
        let known = if sense > 0.0 { growing } else { falling };
        *known.get_or_init(|| self.extremum(self.parameter, &sample.places[place], sense))
    }

    /// Pairs places whose tangents lead from one to the other and to no third.
    pub fn matched(&self, from: &Sample, to: &Sample) -> Matched {
        let leads = |i: usize, j: usize| self.leads(&from.places[i], &to.places[j]);
        let (n, m) = (from.places.len(), to.places.len());
        let only = |mut all: Vec<usize>| if all.len() == 1 { all.pop() } else { None };
        let next = |i: usize| only((0..m).filter(|&j| leads(i, j)).collect());
        let before = |j: usize| only((0..n).filter(|&i| leads(i, j)).collect());
        let pair = |i: usize| next(i).filter(|&j| before(j) == Some(i)).map(|j| [i, j]);
        let pairs: Vec<[usize; 2]> = (0..n).filter_map(pair).collect();
        let paired = |side: usize, k: usize| pairs.iter().any(|pair| pair[side] == k);
        Matched {
            ending: (0..n).filter(|&i| !paired(0, i)).collect(),
            beginning: (0..m).filter(|&j| !paired(1, j)).collect(),
            pairs,
        }
    }

    /// Pairs what is left of places of two samples, the nearest first.
    pub fn match_near(&self, from: &Sample, to: &Sample, matched: &mut Matched) {
        let far = |i: usize, j: usize| norm(self.way(&from.places[i].x, &to.places[j].x));
        let all = matched.ending.iter();
        let all = all.flat_map(|&i| matched.beginning.iter().map(move |&j| (far(i, j), [i, j])));
        let mut near: Vec<(f64, [usize; 2])> = all.filter(|(way, _)| *way <= FAR).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, [i, j]) in near {
            let (ending, beginning) = (&mut matched.ending, &mut matched.beginning);
            if ending.contains(&i) && beginning.contains(&j) {
                ending.retain(|&other| other != i);
                beginning.retain(|&other| other != j);
                matched.pairs.push([i, j]);
            }
        }
    }

    fn leads(&self, from: &Place, to: &Place) -> bool {
        let way = self.way(&from.x, &to.x);
        let length = norm(way);
        let across = way[self.parameter];
        // By the trapezoidal rule over the parameter.
        let share = |place: &Place| 0.5 * across / place.tangent[self.parameter];
        let expected = along(&[0.0; WIDTH], &from.tangent, share(from));
        let expected = along(&expected, &to.tangent, share(to));
        let off = norm(along(&way, &expected, -1.0));
        length <= FAR && (off <= TRUST * length || length <= SHORT)
    }
}
