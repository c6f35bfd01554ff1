//! The branches of a target as C: loops over lanes, which a compiler turns into vector
//! instructions.

use super::language::{C, bound, indented};
use crate::closed_form::ClosedForm;
use crate::emit::headings;
use crate::emit::lanes::{Output, Stage, TARGET, is_minus, lanes, target_names, told_of_angles};
use crate::emit::language::Language;
use crate::emit::straight::sign_name;
use crate::expr::inverse::InverseGraph;

/// The struct of all lanes, and the function that computes them.
pub fn function(solver: &ClosedForm, inverse: &InverseGraph) -> String {
    let places = |name: &str, count: usize| -> Vec<String> {
        (0..count).map(|i| format!("{name}[{i}]")).collect()
    };
    let (solved, given) = (solver.given.variables(), solver.given.parameters());
    let own = [places("seed", solved), places("given", given)].concat();
    let inputs = own.into_iter().chain(["free_below".to_owned()]);
    let found = lanes::<C>(solver, inverse, inputs);
    let width = found.width;
    let mut body = String::new();
    let trig = bound(found.trig);
    if !trig.is_empty() {
        body += &C::comment(told_of_angles(solver));
    }
    body += &trig;
    body += &found.given.concat();
    for (i, (entry, used)) in target_names().iter().zip(&found.inputs).enumerate() {
        // Rows of four: three of the rotation, and the translation behind them.
        let place = if i < 9 {
            4 * (i / 3) + i % 3
        } else {
            4 * (i - 9) + 3
        };
        if *used {
            body += &C::definition(entry, format!("target[{place}]"));
        }
    }
    for (number, stage) in found.stages.iter().enumerate() {
        body += &match number {
            0 => stage.body.concat(),
            _ => lane_loop(stage, width),
        };
    }
    let mut results: Vec<(String, &Output<String>)> = Vec::new();
    results.extend((0..).map(|i| format!("q[{i}]")).zip(&found.q));
    results.push(("residual".into(), &found.residual));
    results.push(("invalid".into(), &found.invalid));
    results.push(("singular".into(), &found.singular));
    if let Some([level, no_root]) = &found.free_angle {
        results.push(("level".into(), level));
        results.push(("no_root".into(), no_root));
    }
    let results = results.iter().map(|(field, output)| {
        let value = written(output);
        format!("    lanes->{field}[k] = {value};\n")
    });
    body += &format!(
        "for (int k = 0; k < {width}; ++k) {{\n{}}}\n",
        results.collect::<String>()
    );
    let parameters = [
        ("seed", TARGET..TARGET + solved),
        ("given", TARGET + solved..TARGET + solved + given),
        (
            "free_below",
            TARGET + solved + given..TARGET + solved + given + 1,
        ),
        ("target", 0..TARGET),
    ];
    for (name, inputs) in parameters {
        if !found.inputs[inputs].contains(&true) {
            body = format!("(void){name};\n{body}");
        }
    }
    let free_angle = match &found.free_angle {
        Some(_) => format!(
            "    /* What the root behind an angle that may be free says: its level, and positive \
             where it\n     * is none. */\n    double level[{width}];\n    double no_root[{width}];\n"
        ),
        None => String::new(),
    };
    format!(
        "/* All branches of the plan: lane k is the branch whose i-th choice is + where bit i of \
         k is\n * clear. */\ntypedef struct kin_lanes {{\n    double q[KIN_SOLVED][{width}];\n    \
         double residual[{width}];\n    /* Positive where the branch does not exist or repeats \
         another. */\n    double invalid[{width}];\n    /* Positive where a root is double or an \
         angle is free. */\n    double singular[{width}];\n{free_angle}}} kin_lanes;\n\n\
         KIN_INLINE void kin_lanes_of(\n    const double target[12], const double seed[KIN_SOLVED], \
         const double *given, double free_below,\n    kin_lanes *lanes)\n{{\n{}}}\n",
        indented(&body)
    )
}

/// A result in lane k.
fn written(output: &Output<String>) -> String {
    match output {
        Output::OfTarget(value) | Output::ValueOfTarget(value) | Output::Value(value) => {
            value.clone()
        }
        Output::Earlier(value) | Output::Last(value) => C::kept(value, true),
    }
}

/// A loop over branches, in front of it what older lanes are where there are more of them.
fn lane_loop(stage: &Stage<C>, all: usize) -> String {
    let mut out = String::new();
    let width = 1_usize << stage.signs;
    let (names, from) = &stage.widened;
    if !names.is_empty() {
        let copies = names
            .iter()
            .map(|name| format!("    {name}_[k] = {name}_[k - {from}];\n"));
        out += &C::comment(&headings::widened(*from, width));
        out += &format!(
            "for (int k = {from}; k < {width}; ++k) {{\n{}}}\n",
            copies.collect::<String>()
        );
    }
    out += &C::comment(&stage.heading);
    for &choice in &stage.reads {
        let name = sign_name(choice);
        let signs = (0..width as u32).map(|lane| match is_minus(choice, lane) {
            false => "1.0",
            true => "-1.0",
        });
        let signs = signs.collect::<Vec<_>>().join(", ");
        let stated = format!("{name}_of_{width}");
        out += &format!("static const double {stated}[{width}] = {{{signs}}};\n");
    }
    for name in &stage.kept {
        out += &format!("double {name}_[{all}];\n");
    }
    let mut body = String::new();
    for &choice in &stage.reads {
        let name = sign_name(choice);
        body += &C::definition(&name, format!("{name}_of_{width}[k]"));
    }
    body += &stage.body.concat();
    for name in &stage.kept {
        body += &format!("{name}_[k] = {name};\n");
    }
    out + &format!(
        "for (int k = 0; k < {width}; ++k) {{\n{}}}\n",
        indented(&body)
    )
}
