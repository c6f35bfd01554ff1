//! The canonical subproblems that closed-form inverse kinematics is made of.
//!
//! | function | find | such that | isolated solutions |
//! |---|---|---|---|
//! | [`subproblem1`] | t | R(k, t) p₁ = p₂ | 1 |
//! | [`subproblem2`] | t₁, t₂ | R(k₁, t₁) p₁ = R(k₂, t₂) p₂ | 0 to 2 |
//! | [`subproblem2e`] | t₁, t₂ | p₀ + R(k₁, t₁) p₁ = R(k₂, t₂) p₂ | 0 to 2 |
//! | [`subproblem3`] | t | ‖R(k, t) p₁ − p₂‖ = d | 0 to 2 |
//! | [`subproblem4`] | t | h · R(k, t) p = d | 0 to 2 |
//! | [`subproblem5`] | t₁, t₂, t₃ | p₀ + R(k₁, t₁) p₁ = R(k₂, t₂) (p₂ + R(k₃, t₃) p₃) | 0 to 4 |
//! | [`subproblem6`] | t₁, t₂ | h₁ · R(k₁, t₁) p₁ + h₂ · R(k₂, t₂) p₂ = d₁ and so with h₃, h₄ | 0 to 4 |
//! | [`parallel_pair`] | t₁, t₂ | e^(ξ̂₁ t₁) e^(ξ̂₂ t₂) p = q, axes parallel | 0 to 2 |
//! | [`two_distances`] | t₁, t₂ | ‖R(k₁, t₁) R(k₂, t₂) p − qᵢ‖ = dᵢ, i = 1, 2 | 0 to 4 |
//! | [`translation1`] | t | ‖p + t v − q‖ = d | 0 to 2 |
//! | [`translation2`] | t | h · (p + t v) = d | 1 |
//!
//! R(k, t) is the rotation by t radians about the unit vector k. The forms with
//! twists and points, as in the book, are [`paden_kahan1`], [`paden_kahan2`]
//! and [`paden_kahan3`].
//!
//! Sources: B. Paden, "Kinematics and Control of Robot Manipulators", 1986, and
//! MLS section 3.3.2 for 1 to 3; A. J. Elias and J. T. Wen, "Canonical
//! Subproblems for Robot Inverse Kinematics", arXiv 2211.05737, for 2 extended,
//! 4, 5, 6 and for the least-squares answers.
//!
//! # Tolerances
//!
//! An equation counts as solved when it is off by less than 1e-10 of the size
//! of its terms. Two roots so close that the equation cannot tell them apart in
//! double precision, 1e-13 of that size, are one double root. Lengths may have
//! any unit: only their ratios matter.
//!
//! Input that is degenerate in several ways at once, but in each only to
//! within 1e-5 to 1e-12 (a vector nearly on its axis, next to an axis nearly
//! parallel, in a stretched posture), can have solutions that rounding hides.
//! Of special geometry disturbed at random by that much, subproblems 2E and 6
//! find no solution in up to 3 cases of 1000, subproblem 5 in up to 15 and two
//! distances in up to 81, and where they find some, others may be missing.

mod circles;
mod components;
mod distances;
mod parallel;
mod radial;
mod refine;
mod rotation;
mod screw;
mod solution_set;
mod three_axes;
mod torus;
mod translation;

pub use circles::subproblem2e;
pub use components::subproblem6;
pub use distances::two_distances;
pub use parallel::parallel_pair;
pub use rotation::{subproblem1, subproblem2, subproblem3, subproblem4};
pub use screw::{paden_kahan1, paden_kahan2, paden_kahan3};
pub use solution_set::{Roots, SolutionSet};
pub use three_axes::subproblem5;
pub use translation::{translation1, translation2};

/// Relative error up to which an equation counts as solved.
const SOLVED: f64 = 1e-10;

/// Relative depth of a double root: a parabola shallower than this between its
/// roots is lost in rounding.
const DOUBLE: f64 = 1e-13;

/// Sine of the angle, or relative distance, below which a vector lies on an
/// axis.
const ON_AXIS: f64 = 1e-12;
