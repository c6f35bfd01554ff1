//! `kin explain`.

use super::explain;
use crate::arguments::{Explain, read};
use crate::{Done, Exit, json};
use kin_codegen::Error;

pub fn run(arguments: &Explain) -> Done {
    let options = arguments.options.options();
    let explanation = read(&arguments.file)
        .map_err(Error::from)
        .and_then(|source| explain(&source, &options));
    match explanation {
        Err(error) => Done::failing(Exit::from(&error), error),
        Ok(explanation) if arguments.json => match json::pretty(&explanation) {
            Ok(json) => Done::printing(json),
            Err(error) => Done::failing(Exit::Broken, error),
        },
        Ok(explanation) => Done::printing(explanation.to_string()),
    }
}
