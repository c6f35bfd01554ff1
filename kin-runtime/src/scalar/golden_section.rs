//! The method of golden section (J. Kiefer, "Sequential minimax search for a maximum",
//! Proceedings of the AMS 4, 1953).

/// The share of a bracket that a step keeps.
const KEPT: f64 = 0.618_033_988_749_894_9;

/// A place and the value there.
type Sample = (f64, f64);

/// A bracket of the greatest value of a function, with two places inside. A step costs one value.
#[derive(Clone, Copy, Debug)]
pub struct GoldenSection {
    low: f64,
    left: Sample,
    right: Sample,
    high: f64,
}

impl GoldenSection {
    /// Between two places.
    pub fn new(low: f64, high: f64, mut f: impl FnMut(f64) -> f64) -> Self {
        let kept = KEPT * (high - low);
        let [left, right] = [high - kept, low + kept].map(|place| (place, f(place)));
        Self {
            low,
            left,
            right,
            high,
        }
    }

    /// Leaves out what is beyond the place with the lesser value.
    pub fn step(&mut self, mut f: impl FnMut(f64) -> f64) {
        let is_left = self.left.1 > self.right.1;
        if is_left {
            self.high = self.right.0;
            self.right = self.left;
        } else {
            self.low = self.left.0;
            self.left = self.right;
        }
        let kept = KEPT * (self.high - self.low);
        if is_left {
            let place = self.high - kept;
            self.left = (place, f(place));
        } else {
            let place = self.low + kept;
            self.right = (place, f(place));
        }
    }

    /// The place with the greater value.
    pub fn best(&self) -> Sample {
        match self.left.1 > self.right.1 {
            true => self.left,
            false => self.right,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::GoldenSection;

    #[test]
    fn a_peak_is_found_from_either_side_with_one_value_for_each_step() {
        for peak in [0.1, 0.4, 0.5, 0.6, 0.9] {
            let mut values = 0;
            let mut f = |x: f64| {
                values += 1;
                -(x - peak).abs()
            };
            let mut section = GoldenSection::new(0.0, 1.0, &mut f);
            (0..50).for_each(|_| section.step(&mut f));
            assert!(
                (section.best().0 - peak).abs() < 1e-9,
                "{peak}: {section:?}"
            );
            assert_eq!(values, 52);
        }
    }

    #[test]
    fn a_peak_at_an_end_is_approached() {
        let f = |x: f64| x;
        let mut section = GoldenSection::new(-2.0, 3.0, f);
        (0..60).for_each(|_| section.step(f));
        assert!(section.best().0 > 3.0 - 1e-9, "{section:?}");
    }
}
