//! What it took to read exact relations into the axes of a file.

use kin_codegen::closed_form::{ClosedForm, Refinement};
use serde::Serialize;

/// The file's axes are off exact relations: the closed form runs on an arm
/// that has them, and every branch is refined onto the file's own.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Idealization {
    /// Directions that differ by less were taken for equal, and lengths by the
    /// same number times the arm's size.
    pub tolerance: f64,
    /// The axes that moved.
    pub moved: Vec<Moved>,
    /// How far the tips of the two arms are apart.
    pub tip_shift: f64,
    /// How branches become solutions of the file's arm, in a sentence.
    pub refinement: String,
}

/// One axis that moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Moved {
    /// The joint's number.
    pub joint: usize,
    /// The joint's name.
    pub name: String,
    /// How far its direction turned.
    pub angle: f64,
    /// How far its line shifted.
    pub distance: f64,
}

impl Idealization {
    /// None if the file is exact up to its rounding.
    pub(super) fn of(form: &ClosedForm) -> Option<Self> {
        let moved = |moved: &kin_codegen::geometry::Moved| Moved {
            joint: moved.joint + 1,
            name: form.idealized.model.joints[moved.joint].name.clone(),
            angle: moved.angle,
            distance: moved.distance,
        };
        (!form.is_exact()).then(|| Self {
            tolerance: form.idealized.tolerance,
            moved: form.idealized.moved.iter().map(moved).collect(),
            tip_shift: form.tip_shift,
            refinement: refinement(form),
        })
    }
}

fn refinement(form: &ClosedForm) -> String {
    match &form.refinement {
        Refinement::Correction => {
            "Levenberg's method takes every branch onto the file's arm.".to_owned()
        }
        Refinement::Univariate(arm) => {
            let degree = arm.kept[0].elimination.degree;
            format!(
                "Newton's method refines every branch onto the file's arm; near singular ones the \
                 roots of a polynomial of degree {degree} in {} tell the others.",
                arm.kept_beside(&form.given),
            )
        }
    }
}
