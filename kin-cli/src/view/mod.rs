//! `kin view`: a page that shows a robot.

mod skeleton;

pub use skeleton::Skeleton;

use crate::arguments::{self, read};
use crate::{Done, Exit};
use kin_codegen::geometry::size;
use kin_codegen::spec::one_line;
use kin_codegen::{
    Compiled, Diagnostics, Error, GeneratedJs, Ik, Options, Scalar, Source, compile,
};
use serde_json::json;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they use each other.
const SCRIPTS: [&str; 9] = [
    include_str!("poses.js"),
    include_str!("camera.js"),
    include_str!("scene.js"),
    include_str!("gizmo.js"),
    include_str!("panel.js"),
    include_str!("parameter.js"),
    include_str!("arm.js"),
    include_str!("mechanism.js"),
    include_str!("page.js"),
];

pub(crate) fn run(arguments: &arguments::View) -> Done {
    let ending = arguments.output.extension();
    if !ending.is_some_and(|ending| {
        ["html", "htm"]
            .iter()
            .any(|own| ending.eq_ignore_ascii_case(own))
    }) {
        let shown = one_line(&arguments.output.to_string_lossy());
        return Done::failing(Exit::Usage, format!("{shown}: pages are written as .html"));
    }
    // A page computes in the numbers that JavaScript has.
    let options = Options {
        scalar: Scalar::F64,
        ..arguments.options.options()
    };
    let source = match read(&arguments.file) {
        Ok(source) => source,
        Err(diagnostics) => return Done::failing(Exit::Broken, diagnostics),
    };
    let (page, warnings) = match page(&source, &options) {
        Ok(found) => found,
        Err(error) => return Done::failing(Exit::from(&error), error),
    };
    let mut done = Done::writing(&arguments.file, &arguments.output, page);
    if let Some(warnings) = warnings {
        done.stderr.insert_str(0, &format!("{warnings}\n"));
    }
    done
}

/// The page of a robot, and what of the file is odd. Of a robot without a closed form it has all
/// but branches, and says why.
///
/// # Errors
///
/// What is wrong with the file or the options.
pub fn page(source: &Source, options: &Options) -> Result<(String, Option<Diagnostics>), Error> {
    let (robot, why) = match compile(source, options) {
        Err(Error::Refused(refusal)) => {
            let forward = Options {
                ik: Ik::None,
                free: Vec::new(),
                ..options.clone()
            };
            (
                compile(source, &forward)?,
                Some(lines(&refusal.to_string())),
            )
        }
        robot => (robot?, None),
    };
    let generated = GeneratedJs::of(robot, source, options);
    let warnings = Diagnostics::of(&source.path, generated.robot.warnings().to_vec());
    let script = [
        generated.source.as_str(),
        &shown(&generated.robot, why),
        &SCRIPTS.join("\n"),
    ];
    let page = PAGE.replace("{{style}}", STYLE.trim_end());
    // Last, and alone: it has names of the file in it.
    let (before, after) = page.split_once("{{script}}").unwrap_or((&page, ""));
    Ok((format!("{before}{}{after}", script.join("\n")), warnings))
}

/// A text for people, whose lines have no control characters in them.
fn lines(text: &str) -> String {
    let lines: Vec<String> = text.lines().map(one_line).collect();
    lines.join("\n")
}

/// What is drawn, as a definition in JavaScript.
fn shown(robot: &Compiled, why: Option<String>) -> String {
    let (models, length, coordinates) = match robot {
        Compiled::Arm(arm) => {
            let coordinates = arm.target().coordinates();
            (vec![&arm.model], size(&arm.model), Some(coordinates))
        }
        Compiled::Mechanism(compiled) => (
            compiled.legs.iter().map(|leg| &leg.model).collect(),
            compiled.mechanism.generic().length(),
            None,
        ),
    };
    let chains: Vec<Skeleton> = models.iter().map(|model| Skeleton::new(model)).collect();
    let view = json!({
        "size": length,
        "chains": chains,
        "why": why,
        // How many of a target count, where it is of an arm.
        "coordinates": coordinates,
    });
    format!("const view = {};\n", escaped(&view.to_string()))
}

/// JSON that is a script, also where it stands in a page.
fn escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            ' '..='~' if c != '<' => out.push(c),
            _ => (c.encode_utf16(&mut [0; 2]).iter())
                .for_each(|unit| out += &format!("\\u{unit:04x}")),
        }
    }
    out
}
