//! A mechanism of few digits, read as the one of exact relations that it stands for.
//!
//! Rounding takes a planar loop its motion, and turns a platform that is meant to translate. An arm is
//! solved with exact relations and refined onto what the file says; a mechanism as written does not
//! close, so that the exact one is what the file means. One that moves as it is written, and is further
//! from exact relations than five digits are, is measured, and stays as it is.

use super::Freedom;
use super::model::Mechanism;
use crate::geometry::{Idealized, idealizations};
use crate::model::{Joint, Model};
use crate::spec::{Diagnostic, MechanismSpec, Source};

/// A mechanism that is no longer rounded, and how it moves.
pub(super) struct Reading {
    pub mechanism: Mechanism,
    pub freedom: Freedom,
    /// What was wrong and by how much axes moved, radians and metres.
    moved: Option<(String, [f64; 2])>,
}

/// Digits beyond this are rounding of the file's own, radians and as a share of the size.
const TOLD: f64 = 1e-10;
/// What of a mechanism moves further is not rounded but measured, and moves as it is written if it does:
/// five digits.
const MEASURED: f64 = 1e-4;

impl Reading {
    /// The mechanism as it is given; or where it does not move as it should, or as what is rounded does,
    /// with the relations that its axes satisfy to the strictest tolerance that mends it, if there is one.
    pub fn of(given: Mechanism, spec: &MechanismSpec) -> Self {
        let freedom = Freedom::of(&given);
        let moves = freedom.check(&given, spec).is_ok();
        let wrong = match freedom.barely_turns {
            Some(turned) if moves => format!(
                "as it is written the platform turns, by {turned:.0e} rad, as where rounding turns one \
                 that is not meant to"
            ),
            _ => "the loops do not close as they are written".to_owned(),
        };
        let size = given.generic().length();
        let exact = |idealized: Idealized| {
            let mechanism = with_axes(&given, &idealized.model.joints);
            let freedom = Freedom::of(&mechanism);
            let mended = freedom.is_sound(&mechanism, spec);
            let angles = idealized.moved.iter().map(|moved| moved.angle);
            let distances = idealized.moved.iter().map(|moved| moved.distance);
            let moved = [angles.fold(0.0, f64::max), distances.fold(0.0, f64::max)];
            let is_rounded = moved[0].max(moved[1] / size) < MEASURED;
            (mended && (is_rounded || !moves)).then(|| Reading {
                mechanism,
                freedom,
                moved: Some((wrong.clone(), moved)),
            })
        };
        if !freedom.is_sound(&given, spec) {
            let all = side_by_side(&given);
            if let Some(mended) = idealizations(&all).find_map(exact) {
                return mended;
            }
        }
        Reading {
            mechanism: given,
            freedom,
            moved: None,
        }
    }

    /// What is told of axes that moved, and of a platform that turns where it is not meant to.
    pub fn warning(&self, source: &Source) -> Option<Diagnostic> {
        let Some((wrong, [angle, distance])) = &self.moved else {
            return self.freedom.warning(&self.mechanism, source);
        };
        let size = self.mechanism.generic().length();
        if angle.max(distance / size) < TOLD {
            return None;
        }
        let reason = format!(
            "{wrong}: axes that are nearly parallel, square or meeting are read as exactly so, turned \
             by up to {angle:.0e} rad and shifted by up to {distance:.0e} m"
        );
        let remedy = "give axes and points with all digits, twelve behind the point, where they are \
                      rounded";
        let at = self.mechanism.at;
        Some(Diagnostic::at(at, source, reason, remedy).warning())
    }
}

/// The joints of all chains, for relations from one to another.
fn side_by_side(mechanism: &Mechanism) -> Model {
    let joints = mechanism.legs.iter().flat_map(|leg| &leg.model.joints);
    Model {
        joints: joints.cloned().collect(),
        ..mechanism.legs[0].model.clone()
    }
}

/// The mechanism with other axes, given side by side.
fn with_axes(given: &Mechanism, axes: &[Joint]) -> Mechanism {
    let mut mechanism = given.clone();
    let legs = mechanism.legs.iter_mut();
    let joints = legs.flat_map(|leg| &mut leg.model.joints);
    for (joint, exact) in joints.zip(axes) {
        joint.axis = exact.axis;
        joint.point = exact.point;
    }
    mechanism
}
