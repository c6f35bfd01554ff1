//! Where something changes between two values.

/// The first value behind a change, by halving: at the lower end `is_before`, at the upper one not.
pub(super) fn change(
    [mut low, mut high]: [f64; 2],
    halvings: usize,
    is_before: impl Fn(f64) -> bool,
) -> f64 {
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        match is_before(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    high
}
