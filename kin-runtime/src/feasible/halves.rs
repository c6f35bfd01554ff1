//! Halves of a rectangle, by de Casteljau's algorithm.

use super::patch::{POINTS, Patch};

impl Patch {
    /// The halves along the side along which it changes more, or along the other one if that is
    /// short; none if both are.
    pub fn halves(&self, shortest: [f64; 2]) -> Option<[Patch; 2]> {
        let [mut along_s, mut along_t]: [f64; 2] = [0.0; 2];
        for (i, row) in self.rows.iter().enumerate() {
            for k in 1..self.count {
                along_t = along_t.max((row[k] - row[k - 1]).abs());
                along_s = along_s.max((row[k] - self.rows[i.max(1) - 1][k]).abs());
            }
        }
        let long = |[from, to]: [f64; 2], shortest| to - from > shortest;
        match [long(self.s, shortest[0]), long(self.t, shortest[1])] {
            [false, false] => None,
            [true, true] if along_t * self.count as f64 > along_s * POINTS as f64 => {
                Some(self.halves_along_t())
            }
            [true, _] => Some(self.halves_along_s()),
            [false, true] => Some(self.halves_along_t()),
        }
    }

    fn halves_along_s(&self) -> [Patch; 2] {
        let (mut low, mut high) = (*self, *self);
        let middle = 0.5 * (self.s[0] + self.s[1]);
        (low.s[1], high.s[0]) = (middle, middle);
        (low.shares[0], high.shares[0]) = (0.5 * self.shares[0], 0.5 * self.shares[0]);
        for i in 0..POINTS {
            low.rows[i] = high.rows[0];
            for j in 0..POINTS - 1 - i {
                let (front, back) = high.rows.split_at_mut(j + 1);
                for (a, b) in front[j][..self.count].iter_mut().zip(&back[0]) {
                    *a = 0.5 * (*a + b);
                }
            }
        }
        [low, high]
    }

    fn halves_along_t(&self) -> [Patch; 2] {
        let (mut low, mut high) = (*self, *self);
        let middle = 0.5 * (self.t[0] + self.t[1]);
        (low.t[1], high.t[0]) = (middle, middle);
        (low.shares[1], high.shares[1]) = (0.5 * self.shares[1], 0.5 * self.shares[1]);
        for (low, high) in low.rows.iter_mut().zip(&mut high.rows) {
            for i in 0..self.count {
                low[i] = high[0];
                for j in 0..self.count - 1 - i {
                    high[j] = 0.5 * (high[j] + high[j + 1]);
                }
            }
        }
        [low, high]
    }
}
