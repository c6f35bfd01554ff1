//! Where the roots of a plan are real, one after the other.
//!
//! The first root's argument is an analytic function of the parameter. Where it is positive,
//! between two zeros, there are two roots ±√, and what they lead to is no analytic function of
//! the parameter, for they meet steeply at the ends. Of the angle t in p = m − h cos t it is: the
//! one half of its turn has the root +√, the other −√, and √ goes through zero there as sin t
//! does. On that circle the argument of the next root is analytic, and so on: every root unfolds
//! the curves on which all roots before it are real.

use super::interpolant::Cosines;
use super::task::Task;
use super::zeros::{Zeros, zeros};
use crate::RedundantKinematics;
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

/// The most roots that sixteen branches have.
const ROOTS: usize = 4;
/// Pieces of a turn, or of a travel, to begin with.
const PIECES: usize = 4;
/// Where a circle is cut, and what share of a part stands for it: nowhere special.
const CUT: f64 = 0.381_966;
/// Arguments that are negative by less than this are zero: roots that have met everywhere.
const ZERO: f64 = 1e-12;

/// How the variable of a curve leads to that of the curve before it, and to the sign of the
/// root between them: − where it is negative.
#[derive(Clone, Copy)]
enum Fold {
    /// Both signs at the same place: the root has no zeros.
    Apart { minus: bool },
    /// m − h cos t, of the sign of sin t.
    Round { middle: f64, half: f64 },
    /// From a zero on, to a stop: end + t² · way, of the sign of t.
    Stopped { end: f64, way: f64 },
}

impl Fold {
    fn at(self, t: f64) -> (f64, bool) {
        match self {
            Fold::Apart { minus } => (t, minus),
            Fold::Round { middle, half } => {
                let (sine, cosine) = crate::math::sin_cos(t);
                (middle - half * cosine, sine < 0.0)
            }
            Fold::Stopped { end, way } => (end + t * t * way, t < 0.0),
        }
    }
}

/// A curve on which the first roots are real.
#[derive(Clone, Copy)]
struct Curve {
    folds: [Fold; ROOTS],
    /// How many roots are real on it.
    roots: usize,
    from: f64,
    to: f64,
    /// Whether its end is its beginning.
    is_closed: bool,
}

impl Curve {
    /// The parameter, and the signs of the roots as the bits of a branch.
    fn at(&self, mut t: f64) -> (f64, usize) {
        let mut signs = 0;
        for root in (0..self.roots).rev() {
            let (before, minus) = self.folds[root].at(t);
            signs |= usize::from(minus) << root;
            t = before;
        }
        (t, signs)
    }

    fn folded(mut self, fold: Fold, from: f64, to: f64, is_closed: bool) -> Curve {
        self.folds[self.roots] = fold;
        Curve {
            folds: self.folds,
            roots: self.roots + 1,
            from,
            to,
            is_closed,
        }
    }

    /// The curves on which one more root is real, if its argument has zeros and is positive
    /// where it is.
    fn unfolded(self, zeros: &[f64], exists: impl Fn(f64) -> bool) -> Vec<Curve> {
        let mut found = Vec::new();
        if zeros.is_empty() {
            if exists(self.from + CUT * (self.to - self.from)) {
                let apart = |minus| Fold::Apart { minus };
                let both = [false, true].map(apart);
                found
                    .extend(both.map(|fold| self.folded(fold, self.from, self.to, self.is_closed)));
            }
            return found;
        }
        let mut between = |from: f64, to: f64| {
            if exists(from + CUT * (to - from)) {
                let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
                found.push(self.folded(Fold::Round { middle, half }, CUT, CUT + TAU, true));
            }
        };
        for pair in zeros.windows(2) {
            between(pair[0], pair[1]);
        }
        let (first, last) = (zeros[0], zeros[zeros.len() - 1]);
        if self.is_closed {
            between(last, first + self.to - self.from);
            return found;
        }
        for (end, stop) in [(first, self.from), (last, self.to)] {
            if exists(end + CUT * (stop - end)) {
                let way = stop - end;
                found.push(self.folded(Fold::Stopped { end, way }, -1.0, 1.0, false));
            }
        }
        found
    }
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// Where branches begin, end or meet; the parameter is anything modulo a turn, if it turns.
    pub fn meetings(&self) -> Zeros {
        let turns = self.turns(self.parameter);
        let [from, to] = match turns {
            true => [CUT - PI, CUT + PI],
            false => self.range(),
        };
        let whole = Curve {
            folds: [Fold::Apart { minus: false }; ROOTS],
            roots: 0,
            from,
            to,
            is_closed: turns,
        };
        let mut all = Zeros::default();
        self.explore(whole, &Cosines::new(), &mut all);
        all
    }

    fn explore(&self, curve: Curve, cosines: &Cosines, all: &mut Zeros) {
        let root = curve.roots;
        if root == self.roots {
            return;
        }
        let argument = |t: f64| {
            let (value, signs) = curve.at(t);
            self.robot.root_arguments(self.target, value)[root][signs]
        };
        // A root that is always real has none.
        let middle = argument(0.5 * (curve.from + curve.to));
        let zeros = match middle == f64::INFINITY {
            true => Zeros::default(),
            false => zeros(cosines, &argument, curve.from, curve.to, PIECES),
        };
        let values = |of: &[f64]| of.iter().map(|&t| curve.at(t).0).collect::<Vec<_>>();
        all.crossing.extend(values(&zeros.crossing));
        all.touching.extend(values(&zeros.touching));
        if root + 1 == self.roots {
            return;
        }
        let unfolded = curve.unfolded(&zeros.crossing, |t| argument(t) >= -ZERO);
        for next in unfolded {
            self.explore(next, cosines, all);
        }
    }
}
