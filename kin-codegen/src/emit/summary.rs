//! A few words for the robot's documentation.

use crate::arm::CompiledArm;
use crate::geometry::structure;
use crate::plan::Target;
use crate::solver::Certified;

/// What the documentation of the robot says of its kinematics, in Markdown
/// lines.
pub fn summary(compiled: &CompiledArm) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        format!("Axes: {}.", structure(&compiled.model)),
    ];
    let Some(Certified {
        form, certificate, ..
    }) = &compiled.inverse
    else {
        lines.push(String::new());
        lines.push("Generated without inverse kinematics (`ik = none`).".into());
        return lines;
    };
    lines.push(String::new());
    lines.push(format!(
        "Inverse kinematics by {}: {} branches. Verified on {} configurations: all recovered, {} \
         answers, the worst {:.1e} m from its target.",
        form.plan,
        form.plan.branches(),
        certificate.configurations,
        certificate.solutions,
        certificate.worst_residual,
    ));
    if certificate.unanswered > 0 {
        lines.push(format!(
            "Of {} singular configurations, {} got no representative.",
            certificate.singular, certificate.unanswered
        ));
    }
    if form.plan.target != Target::Pose {
        lines.push(format!(
            "Targets are {}: the rest of a pose is not read.",
            form.plan.target.phrase()
        ));
    }
    if !form.is_exact() {
        lines.push(String::new());
        lines.push(format!(
            "The file's axes are off exact relations by up to {:.1e} rad: the closed form runs on \
             an arm whose tip is within {:.1e} m, and every branch is polished onto the file's own.",
            form.idealized.moved.iter().map(|moved| moved.angle).fold(0.0, f64::max),
            form.tip_shift,
        ));
    }
    lines
}
