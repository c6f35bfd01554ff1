//! Solutions that differ by full turns of joints.

use super::super::scalar::Real;
use super::super::{JointLimit, Solution, Solutions};

impl<const N: usize> Solutions<N> {
    /// Every solution inside the limits with all full turns of its joints:
    /// all q + 2πk. A joint that may turn without end in either direction takes
    /// part with one value, the nearest to zero turns.
    ///
    /// ```
    /// use kin_runtime::{JointLimit, Solution, Solutions};
    /// let mut solutions = Solutions::new();
    /// solutions.push(Solution { q: [1.0, 0.0], residual: 0.0, branch: 0, singular: false });
    /// let limit = JointLimit::Revolute { lower: -6.3, upper: 6.3 };
    /// // 1 and 1 − 2π, times −2π, 0 and 2π.
    /// assert_eq!(solutions.with_full_turns(&[limit; 2]).count(), 6);
    /// ```
    pub fn with_full_turns<'a>(&'a self, limits: &'a [JointLimit; N]) -> FullTurns<'a, N> {
        FullTurns {
            solutions: self.iter(),
            limits,
            odometer: None,
        }
    }
}

/// Iterator over solutions with full turns of their joints; see [`Solutions::with_full_turns`].
#[derive(Clone, Debug)]
pub struct FullTurns<'a, const N: usize> {
    solutions: core::slice::Iter<'a, Solution<N>>,
    limits: &'a [JointLimit; N],
    odometer: Option<Odometer<'a, N>>,
}

impl<const N: usize> Iterator for FullTurns<'_, N> {
    type Item = Solution<N>;

    fn next(&mut self) -> Option<Solution<N>> {
        loop {
            if let Some(winding) = self.odometer.as_mut().and_then(Odometer::next) {
                return Some(winding);
            }
            self.odometer = Some(Odometer::new(self.solutions.next()?, self.limits));
        }
    }
}

/// Counts through the turns of all joints of one solution.
#[derive(Clone, Debug)]
struct Odometer<'a, const N: usize> {
    solution: &'a Solution<N>,
    limits: &'a [JointLimit; N],
    /// First and last number of turns of every joint.
    range: [(Real, Real); N],
    turns: [Real; N],
    done: bool,
}

impl<'a, const N: usize> Odometer<'a, N> {
    fn new(solution: &'a Solution<N>, limits: &'a [JointLimit; N]) -> Self {
        let range = core::array::from_fn(|i| {
            let (first, last) = limits[i].turns(solution.q[i]);
            if first.is_finite() && last.is_finite() {
                return (first, last);
            }
            let fewest = Real::max(0.0, first).min(last);
            (fewest, fewest)
        });
        let done = range.iter().any(|(first, last)| first > last);
        Odometer {
            solution,
            limits,
            range,
            turns: range.map(|(first, _)| first),
            done,
        }
    }

    fn next(&mut self) -> Option<Solution<N>> {
        if self.done {
            return None;
        }
        let q = core::array::from_fn(|i| self.limits[i].turned(self.solution.q[i], self.turns[i]));
        self.advance();
        Some(Solution {
            q,
            ..*self.solution
        })
    }

    fn advance(&mut self) {
        for i in (0..N).rev() {
            if self.turns[i] < self.range[i].1 {
                self.turns[i] += 1.0;
                return;
            }
            self.turns[i] = self.range[i].0;
        }
        self.done = true;
    }
}
