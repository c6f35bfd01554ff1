//! `kin check`.

use crate::arguments::{self, read};
use crate::{Done, Exit};
use kin_codegen::Options;
use kin_codegen::explain::{Check, Verdict, check};

pub fn run(arguments: &arguments::Check) -> Done {
    let options = arguments.options.options();
    let mut done = Done::printing("");
    for file in &arguments.files {
        let check = one(file, &options, arguments.deep);
        done.stdout += &format!("{check}\n");
        // The line names the first complaint; here are all, with their places.
        if let Verdict::Broken(diagnostics) = &check.verdict {
            done.stderr += &format!("{diagnostics}\n\n");
        }
        done.exit = worse(done.exit, exit(&check.verdict));
    }
    done
}

fn one(file: &str, options: &Options, deep: usize) -> Check {
    match read(file) {
        Ok(source) => check(&source, options, deep),
        Err(diagnostics) => Check {
            path: file.into(),
            verdict: Verdict::Broken(diagnostics),
        },
    }
}

fn exit(verdict: &Verdict) -> Exit {
    match verdict {
        Verdict::Solved {
            completeness: Some(completeness),
            ..
        } if !completeness.lost.is_empty() => Exit::Incomplete,
        Verdict::Solved { .. } => Exit::Success,
        Verdict::Refused(_) => Exit::Refused,
        Verdict::Broken(_) => Exit::Broken,
    }
}

/// Of several files, what needs attention most decides.
fn worse(a: Exit, b: Exit) -> Exit {
    let order = [Exit::Incomplete, Exit::Broken, Exit::Refused];
    order
        .into_iter()
        .find(|exit| [a, b].contains(exit))
        .unwrap_or(Exit::Success)
}
