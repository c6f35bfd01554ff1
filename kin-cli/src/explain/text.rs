//! An explanation as text for a terminal.

use super::singular::{COUPLED, DEFICIENT, NOT_SQUARE};
use super::{
    ArmExplanation, Chain, FixedFrame, Idealization, Inverse, Joint, JointMotion, KeptJoint, Step,
    Weighed, write_refusal, write_warnings,
};
use kin_codegen::redundancy::costs_as_much;
use kin_codegen::spec::one_line;
use std::fmt::{self, Display, Formatter};

/// Deviations below this are rounding, and not worth a word; radians, metres.
const ROUNDING: f64 = 1e-9;

impl Display for ArmExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Chain {
            base, tip, joints, ..
        } = &self.chain;
        let (base, tip) = (one_line(base), one_line(tip));
        writeln!(
            f,
            "{}, from {}: {base} to {tip}, {} joints, {:.3} m long\n",
            one_line(&self.robot),
            one_line(&self.file),
            joints.len(),
            self.chain.size
        )?;
        write_warnings(&self.warnings, f)?;
        writeln!(
            f,
            "Chain at home, in metres and {base}'s axes\n{}",
            self.chain
        )?;
        fixed_frames(&self.chain.frames, f)?;
        writeln!(f, "Axes\n{}", self.axes)?;
        writeln!(f, "Forward kinematics\n  {}", self.fk)?;
        writeln!(f, "  with the spatial Jacobian: {}\n", self.fk_jacobian)?;
        writeln!(f, "Singularities")?;
        match &self.singularities {
            Some(singularities) => writeln!(f, "{singularities}")?,
            None if self.chain.joints.iter().any(|joint| joint.mimic.is_some()) => {
                writeln!(f, "{COUPLED}\n")?;
            }
            None if joints.len() == 6 => writeln!(f, "{DEFICIENT}\n")?,
            None => writeln!(f, "{NOT_SQUARE}\n")?,
        }
        writeln!(f, "Inverse kinematics")?;
        match (&self.inverse, &self.refusal) {
            (Some(inverse), _) => write!(f, "{inverse}"),
            (None, refusal) => write_refusal(refusal, &self.remedy, f),
        }
    }
}

fn fixed_frames(frames: &[FixedFrame], f: &mut Formatter<'_>) -> fmt::Result {
    if frames.is_empty() {
        return Ok(());
    }
    writeln!(f, "Fixed frames, each in that of its link")?;
    let name = |frame: &FixedFrame| one_line(&frame.name).chars().count();
    let width = frames.iter().map(name).max().unwrap_or(0);
    for frame in frames {
        let [name, link] = [&frame.name, &frame.link].map(|name| one_line(name));
        let at = vector(frame.translation);
        writeln!(f, "  {name:width$}  at {at}  on {link}")?;
    }
    writeln!(f)
}

impl Display for Chain {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = |joint: &Joint| one_line(&joint.name).chars().count();
        let width = self.joints.iter().map(name).max().unwrap_or(0);
        for (i, joint) in self.joints.iter().enumerate() {
            writeln!(
                f,
                "  {:>2}  {:width$}  {:10}  axis {}  through {}  {}",
                i + 1,
                one_line(&joint.name),
                joint.motion,
                vector(joint.axis),
                vector(joint.point),
                travel(joint),
            )?;
        }
        let tip = vector(self.home_translation);
        let (name, what) = (one_line(&self.tip), self.tool.map_or("tip", |_| "its tool"));
        writeln!(f, "      {name:width$}  {what:10}  at {tip}")
    }
}

impl Display for JointMotion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            JointMotion::Revolute => "revolute",
            JointMotion::Continuous => "continuous",
            JointMotion::Prismatic => "prismatic",
        })
    }
}

fn vector(v: [f64; 3]) -> String {
    let [x, y, z] = v.map(|x| {
        let shown = format!("{x:.4}");
        // Neither trailing zeros nor a negative zero say anything.
        let shown = shown.trim_end_matches('0').trim_end_matches('.');
        if shown == "-0" {
            "0".to_owned()
        } else {
            shown.to_owned()
        }
    });
    format!("({x:>7} {y:>7} {z:>7})")
}

fn travel(joint: &Joint) -> String {
    let range = match joint.limits {
        None => "no limits".into(),
        Some([lower, upper]) if joint.motion == JointMotion::Prismatic => {
            format!("{lower:.3} to {upper:.3} m")
        }
        Some([lower, upper]) => format!("{:.1}° to {:.1}°", lower.to_degrees(), upper.to_degrees()),
    };
    let Some(mimic) = joint.mimic else {
        return range;
    };
    let times = match mimic.multiplier {
        1.0 => String::new(),
        -1.0 => "−".into(),
        other => format!("{other} "),
    };
    let offset = match mimic.offset {
        0.0 => String::new(),
        offset if offset < 0.0 => format!(" − {}", -offset),
        offset => format!(" + {offset}"),
    };
    format!("{range}, moves by {times}q{}{offset}", joint.coordinate)
}

impl Display for Inverse {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some(targets) = &self.targets {
            writeln!(f, "  {targets}")?;
        }
        if !self.free.is_empty() {
            self.write_free(f)?;
        }
        if let Some(idealization) = &self.idealization {
            write!(f, "{idealization}")?;
        }
        if let Some(coupling) = &self.coupling {
            writeln!(f, "  {coupling}")?;
        }
        writeln!(f, "  Plan {}", self.plan)?;
        for (i, step) in self.steps.iter().enumerate() {
            writeln!(f, "  {:>2}. {step}", i + 1)?;
        }
        let es = if self.branches == 1 { "" } else { "es" };
        writeln!(f, "  {} branch{es}.", self.branches)?;
        if let Some(cost) = &self.cost {
            if let Some(degeneracy) = degeneracy(&self.steps, self.certificate.lost) {
                writeln!(f, "  {degeneracy}")?;
            }
            match &self.others[..] {
                [] => writeln!(f, "  The search found no other plan.")?,
                others => writeln!(f, "  Other plans found: {}.", others.join("; "))?,
            }
            writeln!(f, "  One branch: {}", cost.one_branch)?;
            writeln!(f, "  All of them: {}", cost.all_branches)?;
        }
        for (i, kept) in self.kept.iter().enumerate() {
            let when = match (i, &self.cost) {
                (0, None) => "Kept is",
                (0, Some(_)) => "Where branches do not tell all solutions, kept is",
                _ => "Where that is not sure, so is",
            };
            writeln!(f, "  {when} {kept}.")?;
        }
        let seen = &self.certificate;
        writeln!(
            f,
            "  Verified on {} configurations, {} of them singular: {} solutions, the worst {:.1e} m \
             from its target, at most {} to one target; {}.",
            seen.configurations,
            seen.singular,
            seen.solutions,
            seen.worst_residual,
            seen.most_solutions,
            match (seen.unanswered, seen.lost) {
                (0, 0) => "every configuration was recovered".into(),
                (0, lost) => format!("all but {lost} were recovered"),
                (unanswered, _) =>
                    format!("{unanswered} of the singular ones got no representative"),
            }
        )?;
        let mut reservations = seen.reservations().into_iter();
        reservations.try_for_each(|reservation| writeln!(f, "  {reservation}"))
    }
}

impl Inverse {
    /// What is given beside a target, and why that.
    fn write_free(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = |(free, given): (&String, &String)| match free.as_str() {
            "turn" => "the turn of the tool about the tip's z axis".to_owned(),
            // Names may be of that form themselves.
            joint if joint != given => format!("{joint} (`{given}`)"),
            joint => joint.to_owned(),
        };
        let free: Vec<String> = self.free.iter().zip(&self.given).map(name).collect();
        write!(f, "  Given beside a target: {}", free.join(", "))?;
        let text = |weighed: &Weighed| {
            let weight = weighed.weight?;
            Some(format!("{}: {weight}", weighed.free.join(" and ")))
        };
        let weights: Vec<String> = self.weighed.iter().filter_map(text).collect();
        match (self.weighed.len(), &weights[..]) {
            (0 | 1, _) => writeln!(f, "."),
            (_, []) => writeln!(
                f,
                ". No joint leaves the others a closed form; of those at the ends of the chain \
                 it leaves the best polynomial."
            ),
            (_, weights) => {
                let is_given = |joint: &String| self.free.contains(joint);
                let first = &self.weighed[0];
                let least = self.weighed.iter().filter_map(|it| it.weight).min();
                let why = match first.free.iter().all(is_given) {
                    true if first.weight == least => "leaves the others the cheapest plan",
                    true if self.target == "position" => {
                        "leaves joints that reach far, those next to the base before cheaper ones"
                    }
                    true if first.carriers > 0 => "has what carries the arm among it",
                    true if costs_as_much(first.weight, least) => {
                        "leaves the others a plan about as cheap as any, as the last of those that do"
                    }
                    true => "stands at an end of the chain",
                    false => "leaves the others the cheapest of the plans that lose least",
                };
                writeln!(
                    f,
                    ". That {why}; operations of all branches, residuals aside: {}.",
                    weights.join("; ")
                )
            }
        }
    }
}

impl Display for KeptJoint {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: degree {}, noise {:.0e} at 95 of 100 random targets, not sure of all solutions \
             at {:.1} of 100",
            self.unknown, self.degree, self.noise, self.unsure
        )
    }
}

fn degeneracy(steps: &[Step], lost: usize) -> Option<String> {
    let can = |step: &&Step| step.can_degenerate;
    let unknowns: Vec<String> = steps
        .iter()
        .filter(can)
        .map(|step| step.unknowns.join(", "))
        .collect();
    match unknowns.is_empty() {
        // Joints that are coupled may degenerate together.
        true if lost > 0 => None,
        true => Some("No step degenerates where the arm is regular.".into()),
        false => Some(format!(
            "May degenerate where the arm is regular: {}.",
            unknowns.join("; ")
        )),
    }
}

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let unknowns = self.unknowns.join(", ");
        write!(f, "{unknowns} by {}", self.subproblem)?;
        if self.roots > 1 {
            write!(f, ", {} roots", self.roots)?;
        }
        if !self.given.is_empty() {
            write!(f, ", given {}", self.given.join(", "))?;
        }
        write!(f, ": {}.", self.text)
    }
}

impl Display for Idealization {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "  The file is off exact relations. Within {:.0e} rad, and that part of the arm's \
             length, it is read as an arm that has them:",
            self.tolerance
        )?;
        for moved in &self.moved {
            let ways = [
                ("turned", moved.angle, "rad"),
                ("shifted", moved.distance, "m"),
            ];
            let ways = ways.iter().filter(|(_, amount, _)| *amount > ROUNDING);
            let ways: Vec<String> = ways
                .map(|(way, amount, unit)| format!("{way} by {amount:.1e} {unit}"))
                .collect();
            if !ways.is_empty() {
                writeln!(f, "    axis {} {}", moved.joint, ways.join(", "))?;
            }
        }
        writeln!(
            f,
            "    whose tip is within {:.1e} m of the file's. {}",
            self.tip_shift, self.refinement
        )
    }
}
