//! The short verdict on robot files: [`check()`], and the command that asks for
//! it.

mod command;
mod report;
mod verdict;

pub(crate) use command::run;
pub use verdict::{Check, Verdict, check};
