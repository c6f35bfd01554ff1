//! `kin generate`.

use crate::arguments::{Generate, Language, read};
use crate::{Done, Exit};
use kin_codegen::spec::{Diagnostic, one_line};
use kin_codegen::{Diagnostics, Error, Options, Source, generate, generate_c, generate_js};
use std::fs;
use std::path::{Path, PathBuf};

/// What is generated.
struct Output {
    /// Texts, and where they go; none for standard output.
    files: Vec<(Option<PathBuf>, String)>,
    warnings: Vec<Diagnostic>,
}

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
    if let (Language::C, Some(folder)) = (&arguments.lang, &arguments.output)
        && folder.extension().is_some_and(|it| it == "c" || it == "h")
    {
        let shown = one_line(&folder.to_string_lossy());
        let reason = format!("C is two files in one folder, and `{shown}` is named as a file");
        let remedy = "give the folder, such as `-o src`: the files are named after the robot";
        return Done::failing(Exit::Usage, format!("{reason}\nhelp: {remedy}"));
    }
    let generated = match arguments.lang {
        Language::Rust => rust(&source, &options, arguments.output.as_ref()),
        Language::Js => js(&source, &options, arguments.output.as_ref()),
        Language::C => c(&source, &options, arguments.output.as_ref()),
    };
    let Output { files, warnings } = match generated {
        Ok(output) => output,
        Err(error) => return Done::failing(Exit::from(&error), error),
    };
    if let (Language::C, Some(folder), false) =
        (&arguments.lang, &arguments.output, arguments.check)
        && let Err(error) = fs::create_dir_all(folder)
    {
        return Done::unwritten(folder, &error);
    }
    let mut done = Done::printing("");
    for (file, code) in files {
        done = match file {
            None => Done::printing(code),
            Some(file) if arguments.check => check(&file, &code),
            Some(file) => Done::writing(&arguments.file, &file, &code),
        };
        if done.exit != Exit::Success {
            break;
        }
    }
    if let Some(warnings) = Diagnostics::of(&source.path, warnings) {
        done.stderr.insert_str(0, &format!("{warnings}\n"));
    }
    done
}

fn rust(source: &Source, options: &Options, file: Option<&PathBuf>) -> Result<Output, Error> {
    let generated = generate(source, options)?;
    Ok(Output {
        files: vec![(file.cloned(), generated.code())],
        warnings: generated.robot.warnings().to_vec(),
    })
}

fn js(source: &Source, options: &Options, file: Option<&PathBuf>) -> Result<Output, Error> {
    let generated = generate_js(source, options)?;
    Ok(Output {
        files: vec![(file.cloned(), generated.source)],
        warnings: generated.warnings,
    })
}

fn c(source: &Source, options: &Options, folder: Option<&PathBuf>) -> Result<Output, Error> {
    let generated = generate_c(source, options)?;
    let place = |ending: &str| Some(folder?.join(format!("{}.{ending}", generated.name)));
    Ok(Output {
        files: vec![
            (place("h"), generated.header.clone()),
            (place("c"), generated.source.clone()),
        ],
        warnings: generated.warnings.clone(),
    })
}

fn check(output: &Path, code: &str) -> Done {
    let shown = one_line(&output.to_string_lossy());
    match fs::read_to_string(output) {
        // Checked out with the line ends of another system it is the same code.
        Ok(found) if found.replace("\r\n", "\n") == code => Done::printing(""),
        Ok(_) => Done::failing(
            Exit::Stale,
            format!("{shown} is stale\nhelp: run the same command without --check"),
        ),
        Err(error) => Done::failing(
            Exit::Broken,
            format!("cannot read {shown}: {error}\nhelp: run the same command without --check"),
        ),
    }
}
