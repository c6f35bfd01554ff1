//! The zero of a function between two places at which it has unlike signs.

/// A place and the value there.
pub(super) type Sample = (f64, f64);

/// Zeros are told to this.
const EXACT: f64 = 1e-15;
/// Steps towards a zero.
const STEPS: usize = 60;

/// By the method of false position in the version of Illinois (M. Dowell and P. Jarratt, "A modified
/// regula falsi method", BIT 11, 1971).
pub(super) fn false_position(f: impl Fn(f64) -> f64, from: Sample, to: Sample) -> f64 {
    let ((mut a, mut u), (mut b, mut v)) = (from, to);
    for _ in 0..STEPS {
        let c = (a * v - b * u) / (v - u);
        let moved = (c - b).abs();
        let w = f(c);
        // The end behind which the zero is moves up; the other one counts half if it has
        // stayed.
        match (w < 0.0) == (v < 0.0) {
            true => u *= 0.5,
            false => (a, u) = (b, v),
        }
        (b, v) = (c, w);
        if w == 0.0 || moved < EXACT || (b - a).abs() < EXACT {
            break;
        }
    }
    b
}
