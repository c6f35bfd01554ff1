//! `kin generate`.

use crate::arguments::{Generate, read};
use crate::{Done, Exit};
use kin_codegen::spec::one_line;
use kin_codegen::{Diagnostics, Options, generate};
use std::fs;
use std::path::Path;

pub fn run(arguments: &Generate) -> Done {
    let options = Options {
        name: arguments.name.clone(),
        krate: arguments.krate.clone(),
        ..arguments.options.options()
    };
    let source = match read(&arguments.file) {
        Ok(source) => source,
        Err(diagnostics) => return Done::failing(Exit::Broken, diagnostics),
    };
    let generated = match generate(&source, &options) {
        Ok(generated) => generated,
        Err(error) => return Done::failing(Exit::from(&error), error),
    };
    let code = generated.code();
    let mut done = match &arguments.output {
        None => Done::printing(code),
        Some(output) if arguments.check => check(output, &code),
        Some(output) => write(output, &code),
    };
    let warnings = generated.robot.warnings().to_vec();
    if let Some(warnings) = Diagnostics::of(&source.path, warnings) {
        done.stderr.insert_str(0, &format!("{warnings}\n"));
    }
    done
}

fn check(output: &Path, code: &str) -> Done {
    let shown = one_line(&output.to_string_lossy());
    match fs::read_to_string(output) {
        Ok(found) if found == code => Done::printing(""),
        Ok(_) => Done::failing(
            Exit::Stale,
            format!("{shown} is stale\nhelp: run the same command without --check"),
        ),
        Err(error) => Done::failing(Exit::Broken, format!("cannot read {shown}: {error}")),
    }
}

fn write(output: &Path, code: &str) -> Done {
    match fs::write(output, code) {
        Ok(()) => Done::printing(""),
        Err(error) => Done::failing(
            Exit::Broken,
            format!(
                "cannot write {}: {error}",
                one_line(&output.to_string_lossy())
            ),
        ),
    }
}
