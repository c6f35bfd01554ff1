//! Conversions to and from the types of other crates, each behind a feature of
//! that crate's name.

#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serde;
#[cfg(feature = "serde")]
pub(crate) use serde::{array, rows};
