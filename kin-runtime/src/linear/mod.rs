//! Linear algebra in small dense matrices, without allocation.

pub(crate) mod cholesky;
pub(crate) mod givens;
pub(crate) mod normal_equations;
pub(crate) mod singular_values;
pub(crate) mod span;
pub(crate) mod vector;
