//! The branches of a target: loops over lanes.

use super::{Curly, counted, indented};
use crate::closed_form::ClosedForm;
use crate::emit::headings;
use crate::emit::lanes::{
    Lanes, Output, Stage, TARGET, is_minus, lanes, target_names, told_of_angles,
};
use crate::emit::language::Language;
use crate::emit::straight::sign_name;
use crate::expr::inverse::InverseGraph;

/// The statements that fill a struct of all lanes.
pub struct Body {
    /// Of `target`, `seed`, `given` and `free_below`.
    pub statements: String,
    /// How many lanes there are.
    pub width: usize,
    /// Those of its inputs that it does not read.
    pub unread: Vec<&'static str>,
    /// Of how many joints it tells that may be free.
    pub free_joints: usize,
}

/// Writes all lanes of a closed form.
pub fn body<L: Curly>(solver: &ClosedForm, inverse: &InverseGraph) -> Body {
    let places = |name: &str, count: usize| -> Vec<String> {
        (0..count).map(|i| format!("{name}[{i}]")).collect()
    };
    let (solved, given) = (solver.given.variables(), solver.given.parameters());
    let own = [places("seed", solved), places("given", given)].concat();
    let inputs = own.into_iter().chain(["free_below".to_owned()]);
    let found = lanes::<L>(solver, inverse, inputs, None);
    let width = found.width;
    let mut statements = String::new();
    let trig = L::bound(&found.trig);
    if !trig.is_empty() {
        statements += &<L as Curly>::comment(told_of_angles(solver));
    }
    statements += &trig;
    statements += &found.given.concat();
    for (i, (entry, used)) in target_names().iter().zip(&found.inputs).enumerate() {
        // Rows of four: three of the rotation, and the translation behind them.
        let place = if i < 9 {
            4 * (i / 3) + i % 3
        } else {
            4 * (i - 9) + 3
        };
        if *used {
            statements += &L::definition(entry, format!("target[{place}]"));
        }
    }
    for (number, stage) in found.stages.iter().enumerate() {
        statements += &match number {
            0 => stage.body.concat(),
            _ => lane_loop(stage, width),
        };
    }
    statements += &counted::<L>(0, width, &results(&found));
    let parameters = [
        ("seed", TARGET..TARGET + solved),
        ("given", TARGET + solved..TARGET + solved + given),
        (
            "free_below",
            TARGET + solved + given..TARGET + solved + given + 1,
        ),
        ("target", 0..TARGET),
    ];
    let unread = parameters
        .into_iter()
        .filter(|(_, inputs)| !found.inputs[inputs.clone()].contains(&true));
    Body {
        statements,
        width,
        unread: unread.map(|(name, _)| name).collect(),
        free_joints: found.free_joints.len(),
    }
}

/// The statements that put the results of lane k where they are read.
fn results<L: Curly>(found: &Lanes<L>) -> String {
    let mut results: Vec<(String, &Output<String>)> = Vec::new();
    results.extend((0..).map(|i| format!("q[{i}]")).zip(&found.q));
    results.push(("residual".into(), &found.residual));
    results.push(("invalid".into(), &found.invalid));
    results.push(("singular".into(), &found.singular));
    for (i, [level, no_root]) in found.free_joints.iter().enumerate() {
        results.push((format!("level[{i}]"), level));
        results.push((format!("no_root[{i}]"), no_root));
    }
    let written = |(field, output): &(String, &Output<String>)| {
        let value = match output {
            Output::OfTarget(value) | Output::ValueOfTarget(value) | Output::Value(value) => {
                value.clone()
            }
            Output::Earlier(value) | Output::Last(value) => L::kept(value, true),
        };
        format!("    lanes{}{field}[k] = {value};\n", L::FIELD)
    };
    results.iter().map(written).collect()
}

/// A loop over branches, in front of it what older lanes are where there are more of them.
fn lane_loop<L: Curly>(stage: &Stage<L>, all: usize) -> String {
    let mut out = String::new();
    let width = 1_usize << stage.signs;
    let (names, from) = &stage.widened;
    if !names.is_empty() {
        let copies = names
            .iter()
            .map(|name| format!("    {name}_[k] = {name}_[k - {from}];\n"));
        out += &<L as Curly>::comment(&headings::widened(*from, width));
        out += &counted::<L>(*from, width, &copies.collect::<String>());
    }
    out += &<L as Curly>::comment(&stage.heading);
    for &choice in &stage.reads {
        let signs = (0..width as u32).map(|lane| match is_minus(choice, lane) {
            false => "1.0",
            true => "-1.0",
        });
        let stated = format!("{}_of_{width}", sign_name(choice));
        out += &L::table(&stated, &signs.collect::<Vec<_>>());
    }
    for name in &stage.kept {
        out += &L::room(&format!("{name}_"), all);
    }
    let mut body = String::new();
    for &choice in &stage.reads {
        let name = sign_name(choice);
        body += &L::definition(&name, format!("{name}_of_{width}[k]"));
    }
    body += &stage.body.concat();
    for name in &stage.kept {
        body += &format!("{name}_[k] = {name};\n");
    }
    out + &counted::<L>(0, width, &indented(&body))
}
