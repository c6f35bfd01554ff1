//! The manipulator Jacobian.

/// A 6×N Jacobian: `rows[0..3]` are the linear part v, `rows[3..6]` the angular
/// part ω, one column per joint (MLS section 3.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian<const N: usize> {
    /// Rows (v, ω); columns follow the joints.
    pub rows: [[f64; N]; 6],
}
