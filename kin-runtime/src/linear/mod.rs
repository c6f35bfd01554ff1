//! Linear algebra in small dense matrices, without allocation.

#[cfg(feature = "alloc")]
pub(crate) mod cholesky;
pub(crate) mod givens;
pub(crate) mod row_space;
pub(crate) mod singular_values;
pub(crate) mod span;
pub(crate) mod vector;
