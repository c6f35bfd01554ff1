//! What was checked, as text and as JSON.

use super::verdict::{Check, Verdict};
use crate::json::pretty;
use crate::sweep::{Replay, Tally};
use kin_codegen::spec::{Diagnostic, Severity};
use serde_json::{Value, json};

/// What became of a robot file, and of what was tried on it.
pub(super) struct Checked {
    pub check: Check,
    pub sweep: Option<Tally>,
    pub replay: Option<Replay>,
}

/// The version of the JSON. Grows when a field changes its meaning or goes; new
/// fields may come without.
const SCHEMA: u32 = 4;

/// One line, and below it what a sweep or a replay has to say.
pub fn text(checked: &Checked) -> String {
    let mut text = format!("{}\n", checked.check);
    if let Some(tally) = &checked.sweep {
        text += &tally.to_string();
    }
    if let Some(replay) = &checked.replay {
        text += &replay.to_string();
    }
    text
}

/// All files in one object.
pub fn json(all: &[Checked]) -> Result<String, serde_json::Error> {
    let files: Vec<Value> = all.iter().map(file).collect();
    pretty(&json!({"schema": SCHEMA, "files": files}))
}

fn file(checked: &Checked) -> Value {
    let word = match &checked.check.verdict {
        Verdict::Solved { .. } => "solved",
        Verdict::Refused(_) => "refused",
        Verdict::Ambiguous(_) => "ambiguous",
        Verdict::Broken(_) => "broken",
    };
    let (structure, plan, tip_shift) = match &checked.check.verdict {
        Verdict::Solved {
            structure, robot, ..
        } => {
            let form = robot.arm().and_then(|arm| arm.form());
            let idealized = form.filter(|form| !form.is_exact());
            (
                Some(structure),
                form.map(|form| form.plan.to_string()),
                idealized.map(|form| form.tip_shift),
            )
        }
        _ => (None, None, None),
    };
    let diagnostics: Vec<Value> = match &checked.check.verdict {
        Verdict::Refused(all) | Verdict::Ambiguous(all) | Verdict::Broken(all) => {
            all.iter().map(diagnostic).collect()
        }
        Verdict::Solved { robot, .. } => robot.warnings().iter().map(diagnostic).collect(),
    };
    json!({
        "file": checked.check.path,
        "verdict": word,
        "text": checked.check.verdict.to_string(),
        "diagnostics": diagnostics,
        "structure": structure,
        "plan": plan,
        "tip_shift": tip_shift,
        "sweep": checked.sweep,
        "replay": checked.replay,
    })
}

fn diagnostic(of: &Diagnostic) -> Value {
    json!({
        "line": of.at.map(|at| at.line),
        "column": of.at.map(|at| at.column),
        "reason": of.reason,
        "remedy": of.remedy,
        "severity": match of.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Ambiguity => "ambiguity",
        },
    })
}
