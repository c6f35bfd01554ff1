//! What generated C and JavaScript say of an arm in numbers.

use crate::closed_form::{ClosedForm, Inverse};
use crate::plan::Target;
use crate::univariate::Arm;
use kin_runtime::__private::univariate::Elimination;
use kin_runtime::{Pose, Twist};

/// Parts of a turn whose cosines are tables: 24 and 32 samples, their halves and 16 arcs are on it.
pub const PARTS: usize = 192;

/// The distance at which angles count as lengths, metres: an elimination has that of the joints
/// that are solved for.
pub fn size(solver: &ClosedForm) -> f64 {
    match &solver.inverse {
        Inverse::Univariate(arm) => arm.size,
        Inverse::Expressions(_) => solver.acceptance().size,
    }
}

/// What of a target counts: its translation, its rotation, and the direction of the tool's axis.
pub fn counts(target: Target) -> [bool; 3] {
    let translation = !matches!(target, Target::Direction | Target::Orientation);
    [translation, target != Target::Position, target.fixes_axis()]
}

/// Whether all six joints are the arm's own: then what is found are its solutions.
pub fn is_whole(solver: &ClosedForm, arm: &Arm) -> bool {
    let free_turn = usize::from(arm.counts == Target::PositionAxis);
    solver.given.variables() + free_turn == 6
}

/// The functionals of an elimination, without the rows of zeros at their end.
pub fn nonzero_functionals(elimination: &Elimination) -> &[[f64; 15]] {
    let is_zero = |row: &[f64; 15]| row.iter().all(|x| *x == 0.0);
    let last = elimination
        .functionals
        .iter()
        .rposition(|row| !is_zero(row));
    &elimination.functionals[..last.map_or(0, |last| last + 1)]
}

/// The twelve numbers of a pose, by rows.
pub fn rows(pose: &Pose) -> impl Iterator<Item = f64> + use<> {
    let Pose {
        rotation,
        translation,
    } = *pose;
    (0..3).flat_map(move |i| {
        let [a, b, c] = rotation[i];
        [a, b, c, translation[i]]
    })
}

/// The six numbers of a twist, without the noise of composing frames.
pub fn twist(twist: &Twist) -> impl Iterator<Item = f64> + use<> {
    let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
    twist.linear.into_iter().chain(twist.angular).map(clean)
}
