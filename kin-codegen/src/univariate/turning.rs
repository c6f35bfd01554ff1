//! Which entries of a line turn with a joint about z.

/// Whether an entry of l, p, m or n is across the axis.
pub fn turns(i: usize) -> bool {
    i < 12 && i % 3 < 2
}
