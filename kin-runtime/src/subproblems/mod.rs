//! The canonical subproblems that closed-form inverse kinematics is made of.
//!
//! | function | find | such that | isolated solutions |
//! |---|---|---|---|
//! | [`subproblem1`] | t | R(k, t) p₁ = p₂ | 1 |
//! | [`subproblem2`] | t₁, t₂ | R(k₁, t₁) p₁ = R(k₂, t₂) p₂ | 0 to 2 |
//! | [`subproblem3`] | t | ‖R(k, t) p₁ − p₂‖ = d | 0 to 2 |
//! | [`subproblem4`] | t | h · R(k, t) p = d | 0 to 2 |
//! | [`translation1`] | t | ‖p + t v − q‖ = d | 0 to 2 |
//! | [`translation2`] | t | h · (p + t v) = d | 1 |
//!
//! R(k, t) is the rotation by t radians about the unit vector k. The forms with
//! twists and points, as in the book, are [`paden_kahan1`], [`paden_kahan2`]
//! and [`paden_kahan3`].
//!
//! Sources: B. Paden, "Kinematics and Control of Robot Manipulators", 1986, and
//! MLS section 3.2 for 1 to 3; A. J. Elias and J. T. Wen, "Canonical
//! Subproblems for Robot Inverse Kinematics", arXiv 2211.05737, for 4 and for
//! the least-squares answers.
//!
//! # Tolerances
//!
//! An equation counts as solved when it is off by less than 1e-10 of the size
//! of its terms. Two roots so close that the equation cannot tell them apart in
//! double precision, 1e-13 of that size, are one double root.

mod answer;
mod rotation;
mod screw;
mod translation;

pub use answer::{Answer, Roots};
pub use rotation::{subproblem1, subproblem2, subproblem3, subproblem4};
pub use screw::{paden_kahan1, paden_kahan2, paden_kahan3};
pub use translation::{translation1, translation2};

/// Relative error up to which an equation counts as solved.
const SOLVED: f64 = 1e-10;

/// Relative depth of a double root: a parabola shallower than this between its
/// roots is lost in rounding.
const DOUBLE: f64 = 1e-13;

/// Sine of the angle, or relative distance, below which a vector lies on an
/// axis.
const ON_AXIS: f64 = 1e-12;
