//! `kin explain`.

use crate::arguments::{Explain, read};
use crate::{Done, Exit};
use kin_codegen::explain::explain;

pub fn run(arguments: &Explain) -> Done {
    let explained =
        read(&arguments.file).and_then(|source| explain(&source, &arguments.options.options()));
    match explained {
        Err(diagnostics) => Done::failing(Exit::Broken, diagnostics),
        Ok(explanation) if arguments.json => match serde_json::to_string_pretty(&explanation) {
            Ok(json) => Done::printing(json + "\n"),
            Err(error) => Done::failing(Exit::Broken, error),
        },
        Ok(explanation) => Done::printing(explanation.to_string()),
    }
}
