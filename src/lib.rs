//! A kinematics compiler.
#![no_std]
pub use kin_runtime::*;
