//! A kinematics compiler: robot files become specialized, verified Rust while
//! your crate builds.
#![no_std]

pub use kin_macros::kinematics;
pub use kin_runtime::*;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
