//! Solutions of a robot whose number of joints is known when the program runs.

use kin_runtime::{Solution, Solutions};

/// All solutions to a target, in the order of their branches; see
/// [`Solutions`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    joints: usize,
    /// Of all solutions, one behind the other.
    q: Vec<f64>,
    rest: Vec<Rest>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Rest {
    residual: f64,
    branch: u32,
    singular: bool,
}

/// One solution; see [`Solution`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Answer<'a> {
    /// Joint values, radians and metres.
    pub q: &'a [f64],
    /// The distance of its pose from the target, metres.
    pub residual: f64,
    /// Which combination of roots it is.
    pub branch: u32,
    /// Whether it stands for a family of solutions, or for two that have met.
    pub singular: bool,
}

impl Answers {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.rest.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// One of them, by its place.
    pub fn get(&self, place: usize) -> Option<Answer<'_>> {
        self.rest.get(place).map(|rest| self.answer(place, rest))
    }

    /// One after the other.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Answer<'_>> {
        let rest = self.rest.iter().enumerate();
        rest.map(|(place, rest)| self.answer(place, rest))
    }

    fn answer(&self, place: usize, rest: &Rest) -> Answer<'_> {
        Answer {
            q: &self.q[place * self.joints..(place + 1) * self.joints],
            residual: rest.residual,
            branch: rest.branch,
            singular: rest.singular,
        }
    }
}

/// As a sequence of [`Answer`], which has the form of a [`Solution`].
#[cfg(feature = "serde")]
impl serde::Serialize for Answers {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl Answers {
    /// The first joints of solutions.
    pub(super) fn of<const N: usize>(joints: usize, solutions: &Solutions<N>) -> Self {
        let rest = |solution: &Solution<N>| Rest {
            residual: solution.residual,
            branch: solution.branch,
            singular: solution.singular,
        };
        let mut q = Vec::with_capacity(joints * solutions.len());
        for solution in solutions {
            q.extend(&solution.q[..joints]);
        }
        Answers {
            joints,
            q,
            rest: solutions.iter().map(rest).collect(),
        }
    }
}

impl<const N: usize> From<&Solutions<N>> for Answers {
    fn from(solutions: &Solutions<N>) -> Self {
        Answers::of(N, solutions)
    }
}
