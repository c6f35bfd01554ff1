//! What was found and decided, in the field's words.

use crate::compiler::Compiled;
use crate::geometry::{Line, axes, concurrency, cross, norm, size};
use crate::model::{JointKind, Model};
use crate::plan::Target;

/// What the documentation of the robot says of its kinematics, in Markdown
/// lines.
pub fn summary(compiled: &Compiled) -> Vec<String> {
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
    if solver.plan.target == Target::Position {
        lines.push("Targets are positions: the arm cannot choose its orientation.".into());
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

/// How the axes lie to each other, to within what is snapped by default.
pub fn structure(model: &Model) -> String {
    let tolerance = 1e-3;
    let axes = axes(model);
    let size = size(model);
    let mut found = Vec::new();
    for range in rows(model, |lines| parallel(lines, tolerance)) {
        found.push(format!("{} parallel", list(range)));
    }
    for range in rows(model, |lines| {
        concurrency(lines, 0.01, tolerance * size).is_some()
    }) {
        found.push(format!("{} intersect in a point", list(range)));
    }
    for (i, joint) in model.joints.iter().enumerate() {
        if joint.kind == JointKind::Prismatic {
            found.push(format!("{} prismatic", i + 1));
        }
    }
    if found.is_empty() {
        found.push(format!(
            "{} axes, no neighbours parallel or intersecting",
            axes.len()
        ));
    }
    found.join("; ")
}

fn parallel(lines: &[Line], tolerance: f64) -> bool {
    let first = lines[0].direction;
    lines
        .iter()
        .all(|line| norm(cross(first, line.direction)) < tolerance)
}

/// Maximal rows of at least two consecutive revolute joints with a property.
fn rows(model: &Model, holds: impl Fn(&[Line]) -> bool) -> Vec<std::ops::Range<usize>> {
    let axes = axes(model);
    let n = axes.len();
    let turns = |i: usize| model.joints[i].kind == JointKind::Revolute;
    let mut found: Vec<std::ops::Range<usize>> = Vec::new();
    for start in 0..n {
        let longest = (start + 2..=n)
            .filter(|&end| (start..end).all(turns) && holds(&axes[start..end]))
            .max();
        if let Some(end) = longest
            && found.last().is_none_or(|last| last.end < end)
        {
            found.push(start..end);
        }
    }
    found
}

fn list(range: std::ops::Range<usize>) -> String {
    let numbers: Vec<String> = range.map(|i| (i + 1).to_string()).collect();
    numbers.join(", ")
}
