//! What the file's numbers measure.

use super::fields::Reader;
use super::node::Node;
use crate::spec::JointType;
use crate::spec::orientation::FULL_TURN;
use std::f64::consts::FRAC_PI_4;

/// The units of a file.
pub(super) struct Units {
    degrees: bool,
    millimetres: bool,
}

/// Reads `{angle: ..., length: ...}`.
pub(super) fn read(node: &Node, reader: &mut Reader) -> Option<Units> {
    let fields = reader.fields(node, "choice of units", &["angle", "length"])?;
    let angle = fields
        .required("angle", reader)
        .and_then(|node| reader.word(node, &["rad", "deg"]));
    let length = fields
        .required("length", reader)
        .and_then(|node| reader.word(node, &["m", "mm"]));
    Some(Units {
        degrees: angle? == "deg",
        millimetres: length? == "mm",
    })
}

/// What part of pi a number is a multiple of in radians, a half or a quarter, but for rounding: to
/// three digits whatever was written, to two where no more were.
fn part_of_pi(angle: f64) -> Option<u8> {
    let quarters = (angle / FRAC_PI_4).round();
    let exact = quarters * FRAC_PI_4;
    let is_rounded = |by: f64| (angle * by - (exact * by).round()).abs() < 1e-6;
    match quarters.abs() as u8 {
        1..=8 if quarters % 2.0 == 0.0 => {
            ((angle - exact).abs() < 5e-4 || is_rounded(1e2)).then_some(2)
        }
        1..=8 => (is_rounded(1e3) || is_rounded(1e4)).then_some(4),
        _ => None,
    }
}

impl Units {
    /// A length in metres.
    pub(super) fn length(&self, node: &Node, reader: &mut Reader) -> Option<f64> {
        let (length, _) = reader.number(node)?;
        Some(if self.millimetres {
            length / 1000.0
        } else {
            length
        })
    }

    /// An angle in radians.
    pub(super) fn angle(&self, node: &Node, reader: &mut Reader) -> Option<f64> {
        let (angle, pi) = reader.number(node)?;
        if self.degrees && pi {
            reader.at(
                node.at,
                "this angle is in degrees and contains pi, which would be 3.14 degrees",
                "write degrees, or state `angle: rad`",
            );
            return None;
        }
        Some(if self.degrees {
            angle.to_radians()
        } else {
            angle
        })
    }

    /// An angle that places a frame, in radians: at most once around.
    pub(super) fn placing_angle(&self, node: &Node, reader: &mut Reader) -> Option<f64> {
        let angle = self.angle(node, reader)?;
        if angle.abs() > FULL_TURN {
            let degrees = if self.degrees {
                ""
            } else {
                ": this looks like degrees"
            };
            let reason = format!("this angle turns more than once around{degrees}");
            reader.at(
                node.at,
                reason,
                "write an angle within one turn, in the unit that `units` states",
            );
            return None;
        }
        let part = part_of_pi(angle.to_degrees()).filter(|_| self.degrees);
        if let Some(part) = part {
            let reason = format!(
                "this angle is in degrees, and a multiple of pi/{part}: this looks like radians"
            );
            reader.at(
                node.at,
                reason,
                "write degrees (a right angle is 90), or state `angle: rad`; an angle that is meant \
                 so can be written in radians alone",
            );
            return None;
        }
        Some(angle)
    }

    /// A joint value in radians or metres.
    pub(super) fn joint_value(
        &self,
        kind: JointType,
        node: &Node,
        reader: &mut Reader,
    ) -> Option<f64> {
        match kind {
            JointType::Prismatic => self.length(node, reader),
            _ => self.angle(node, reader),
        }
    }

    /// What one unit of a joint's value is in radians or metres.
    pub(super) fn of_joint(&self, kind: JointType) -> f64 {
        match kind {
            JointType::Prismatic if self.millimetres => 1e-3,
            JointType::Revolute if self.degrees => 1_f64.to_radians(),
            _ => 1.0,
        }
    }
}
