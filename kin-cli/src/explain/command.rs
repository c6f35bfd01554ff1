//! `kin explain`.

use super::{explain, mechanism};
use crate::arguments::{Explain, read};
use crate::{Done, Exit};
use kin_codegen::Diagnostics;
use kin_codegen::spec::MechanismSpec;
use serde::Serialize;
use std::fmt::Display;

pub fn run(arguments: &Explain) -> Done {
    let options = arguments.options.options();
    match read(&arguments.file) {
        Err(diagnostics) => Done::failing(Exit::Broken, diagnostics),
        Ok(source) if MechanismSpec::is_meant(&source) => {
            show(arguments, mechanism::explain(&source, &options))
        }
        Ok(source) => show(arguments, explain(&source, &options)),
    }
}

fn show<E: Serialize + Display>(arguments: &Explain, told: Result<E, Diagnostics>) -> Done {
    match told {
        Err(diagnostics) => Done::failing(Exit::Broken, diagnostics),
        Ok(explanation) if arguments.json => match serde_json::to_string_pretty(&explanation) {
            Ok(json) => Done::printing(json + "\n"),
            Err(error) => Done::failing(Exit::Broken, error),
        },
        Ok(explanation) => Done::printing(explanation.to_string()),
    }
}
