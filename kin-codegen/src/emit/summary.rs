//! A few words for the robot's documentation.

use crate::arm::CompiledArm;
use crate::geometry::structure;
use crate::plan::Target;

/// What the documentation of the robot says of its kinematics, in Markdown
/// lines.
pub fn summary(compiled: &CompiledArm) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        format!("Axes: {}.", structure(&compiled.model)),
    ];
    let Some(solver) = &compiled.inverse else {
        lines.push(String::new());
        lines.push("Generated without inverse kinematics (`ik = none`).".into());
        return lines;
    };
    let seen = &solver.certificate;
    lines.push(String::new());
    lines.push(format!(
        "Inverse kinematics by {}: {} branches. Verified on {} configurations: all recovered, {} \
         answers, the worst {:.1e} m from its target.",
        solver.plan,
        solver.plan.branches(),
        seen.configurations,
        seen.answers,
        seen.worst_residual,
    ));
    if seen.unanswered > 0 {
        lines.push(format!(
            "Of {} singular configurations, {} got no representative.",
            seen.singular, seen.unanswered
        ));
    }
    if solver.plan.target != Target::Pose {
        lines.push(format!(
            "Targets are {}: the rest of a pose is not read.",
            solver.plan.target.phrase()
        ));
    }
    if solver.polish > 0 {
        lines.push(String::new());
        lines.push(format!(
            "The file's axes are off exact relations by up to {:.1e} rad: the closed form runs on \
             an arm whose tip is within {:.1e} m, and every branch is polished onto the file's own.",
            solver.snap.moved.iter().map(|moved| moved.angle).fold(0.0, f64::max),
            solver.tip_shift,
        ));
    }
    lines
}
