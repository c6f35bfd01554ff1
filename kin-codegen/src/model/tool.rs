//! The frame of a tool in that of the tip, as the options give it.

use super::Model;
use crate::spec::{ArmSpec, Diagnostic, Diagnostics, FULL_TURN};
use crate::vector::norm;
use kin_runtime::Pose;

/// A longer tool, in metres, was written in millimetres.
const LONGEST: f64 = 10.0;

impl Model {
    /// The same arm with a tool at its tip, whose poses are meant: x, y and z in metres, then roll,
    /// pitch and yaw in radians, in the frame of the tip.
    ///
    /// # Errors
    ///
    /// A number is not finite, or of another unit.
    pub(crate) fn with_tool(
        self,
        spec: &ArmSpec,
        tool: Option<[f64; 6]>,
    ) -> Result<Self, Diagnostics> {
        let Some(tool) = tool else { return Ok(self) };
        let [x, y, z, roll, pitch, yaw] = tool;
        let [xyz, rpy] = [[x, y, z], [roll, pitch, yaw]];
        let fault = if !tool.iter().all(|x| x.is_finite()) {
            Some(("has a number that is not finite", "give six finite numbers"))
        } else if norm(xyz) > LONGEST {
            Some((
                "is longer than 10 m: this looks like millimetres",
                "give x, y and z in metres",
            ))
        } else if rpy.iter().any(|angle| angle.abs() > FULL_TURN) {
            let turns = "turns by more than a full turn: this looks like degrees";
            Some((turns, "give roll, pitch and yaw in radians"))
        } else {
            None
        };
        if let Some((what, remedy)) = fault {
            let diagnostic = Diagnostic::whole(format!("the tool {tool:?} {what}"), remedy);
            return Err(Diagnostics::one(&spec.source.path, diagnostic));
        }
        Ok(Self {
            home: self.home * Pose::from_rpy(rpy, xyz),
            tool: Some(tool),
            ..self
        })
    }

    /// What stands behind the name of the tip where it carries a tool.
    pub(crate) fn tool_text(&self) -> String {
        let text = |tool: [f64; 6]| format!(" with a tool at {tool:?}");
        self.tool.map_or_else(String::new, text)
    }
}
