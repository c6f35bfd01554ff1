//! Where numerical searches start.

use alloc::vec::Vec;

/// Starts that fill a box evenly, always the same: the additive recurrence whose steps are the
/// powers of 1/φ with φⁿ⁺¹ = φ + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018).
pub(super) struct Starts {
    steps: Vec<f64>,
    /// Half the width of the box in every direction.
    ranges: Vec<f64>,
    /// In units of the width, in [0, 1).
    place: Vec<f64>,
    start: Vec<f64>,
}

impl Starts {
    /// In a box about zero, half as wide as `ranges`.
    pub fn new(ranges: Vec<f64>) -> Self {
        let n = ranges.len();
        let phi = (0..64).fold(2.0, |phi: f64, _| {
            libm::pow(1.0 + phi, 1.0 / (n + 1) as f64)
        });
        let powers = core::iter::successors(Some(1.0 / phi), |power| Some(power / phi));
        Self {
            steps: powers.take(n).collect(),
            ranges,
            place: alloc::vec![0.5; n],
            start: alloc::vec![0.0; n],
        }
    }

    /// One more.
    pub fn next(&mut self) -> &[f64] {
        for i in 0..self.start.len() {
            self.place[i] += self.steps[i];
            self.place[i] -= libm::floor(self.place[i]);
            self.start[i] = self.ranges[i] * (2.0 * self.place[i] - 1.0);
        }
        &self.start
    }
}

/// How many starts a search takes.
pub(super) struct Effort {
    /// Those of the first batch.
    pub first: usize,
    /// How often in a row a doubling of their number must find nothing new.
    pub stable_doublings: u32,
    /// The search ends after this many in any case.
    pub most: usize,
}

impl Effort {
    /// Takes starts until doubling their number finds nothing new. `start` takes one, and tells how
    /// many have been found, or none to end the search.
    pub fn search(&self, mut start: impl FnMut() -> Option<usize>) {
        let (mut tried, mut batch) = (0, self.first);
        let (mut quiet, mut known) = (0, 0);
        while quiet < self.stable_doublings && tried < self.most {
            let mut found = known;
            for _ in 0..batch.min(self.most - tried) {
                let Some(count) = start() else {
                    return;
                };
                found = count;
            }
            tried += batch;
            batch = tried;
            quiet = if found > known { 0 } else { quiet + 1 };
            known = found;
        }
    }
}
