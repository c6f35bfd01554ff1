//! `kin plot`, and pictures as people publish them: axes with units, titles, and the same as
//! vectors and as pixels.

mod arm;
pub mod canvas;
pub mod figure;
mod line;
mod mechanism;
mod path;
mod table;
mod trajectory;

use crate::arguments::{self, read};
use crate::batch::{RADIANS, beyond};
use crate::{Done, Exit};
use kin_codegen::spec::{Spec, one_line};
use kin_codegen::{Ik, Options, Source, compile};
use kinematics::Robot;
use path::{Path, Subject};
use table::Table;
use trajectory::Trajectory;

pub fn run(arguments: &arguments::Plot) -> Done {
    match plot(arguments) {
        Ok(report) => Done::printing(report),
        Err(done) => done,
    }
}

fn plot(arguments: &arguments::Plot) -> Result<String, Done> {
    let options = arguments.options.options();
    if options.ik == Ik::None {
        let reason = "a path is followed by inverse kinematics: leave out `--no-ik` (`--ik none`)";
        return Err(Done::failing(Exit::Usage, reason));
    }
    if arguments.table.is_none() && arguments.from.is_empty() {
        let reason = "there is no path\nhelp: name a table behind the robot file, or give `--from` and `--to`";
        return Err(Done::failing(Exit::Usage, reason));
    }
    let source = read(&arguments.file).map_err(|error| Done::failing(Exit::Broken, error))?;
    let spec = Spec::parse(&source).map_err(|error| Done::failing(Exit::Broken, error))?;
    match spec {
        Spec::Arm(spec) => {
            let robot = Robot::load(&source, &options)
                .map_err(|error| Done::failing(Exit::from(&error), error))?;
            let model = options
                .model(&spec)
                .map_err(|error| Done::failing(Exit::Broken, error))?;
            let subject = arm::subject(&robot);
            let path = match &arguments.table {
                Some(table) => Table::open(table)
                    .and_then(|table| arm::of_table(&robot, table))
                    .map_err(|fault| Done::failing(Exit::Broken, fault))?,
                None => {
                    check(arguments, &robot.joint_names())?;
                    let (from, to) = (&arguments.from, &arguments.to);
                    arm::along_line(&robot, from, to, arguments.steps)
                }
            };
            let (figures, tip) = arm::figures(&model, &robot, &path);
            write(arguments, &subject, &path, figures, tip)
        }
        Spec::Mechanism(_) => mechanism(arguments, &source, &options),
    }
}

fn mechanism(
    arguments: &arguments::Plot,
    source: &Source,
    options: &Options,
) -> Result<String, Done> {
    let compiled = compile(source, options);
    let compiled = compiled.map_err(|error| Done::failing(Exit::from(&error), error))?;
    let Some(compiled) = compiled.mechanism() else {
        unreachable!("the specification of a mechanism compiles to one")
    };
    let platform = mechanism::Platform::new(compiled);
    let path = match &arguments.table {
        Some(table) => Table::open(table)
            .and_then(|table| platform.of_table(table))
            .map_err(|fault| Done::failing(Exit::Broken, fault))?,
        None => {
            let actuated = platform.actuated();
            check(
                arguments,
                &actuated.iter().map(String::as_str).collect::<Vec<_>>(),
            )?;
            let (from, to) = (&arguments.from, &arguments.to);
            let driven = platform.driven(from, to, arguments.steps);
            driven.ok_or_else(|| {
                let reason = "`--from` is no place that the actuated joints bring the mechanism \
                              to from home, evenly: its loops do not close on the way";
                Done::failing(Exit::Usage, reason)
            })?
        }
    };
    let (figures, tip) = platform.figures(&path);
    write(arguments, &platform.subject, &path, figures, tip)
}

/// That the ends of a path are configurations.
fn check(arguments: &arguments::Plot, joints: &[&str]) -> Result<(), Done> {
    for (option, q) in [("from", &arguments.from), ("to", &arguments.to)] {
        if q.len() != joints.len() || !q.iter().copied().all(path::is_place) {
            let names: Vec<String> = joints.iter().map(|it| one_line(it)).collect();
            let reason = format!(
                "`--{option}` takes {} finite numbers below 1e12, for {}",
                joints.len(),
                names.join(", ")
            );
            return Err(Done::failing(Exit::Usage, reason));
        }
    }
    Ok(())
}

fn write(
    arguments: &arguments::Plot,
    subject: &Subject,
    path: &Path,
    figures: Vec<figure::Figure>,
    tip: Vec<[f64; 3]>,
) -> Result<String, Done> {
    let trajectory = Trajectory {
        subject,
        path,
        figures,
        tip,
    };
    let is = |ending: &str| {
        let own = arguments.output.extension();
        own.is_some_and(|own| own.eq_ignore_ascii_case(ending))
    };
    let shown = one_line(&arguments.output.to_string_lossy());
    let picture = match () {
        () if is("svg") => canvas::svg(&trajectory),
        () if is("png") => canvas::png(&trajectory),
        () => {
            let reason = format!("{shown}: pictures are written as .svg or .png");
            return Err(Done::failing(Exit::Usage, reason));
        }
    };
    let picture = picture.map_err(|error| Done::unwritten(&arguments.output, &error))?;
    let done = Done::writing(&arguments.file, &arguments.output, picture);
    match done.exit {
        Exit::Success => Ok(report(arguments, subject, path)),
        _ => Err(done),
    }
}

/// How the robot got along.
fn report(arguments: &arguments::Plot, subject: &Subject, path: &Path) -> String {
    let points = path.taken.len();
    let taken = path.taken.iter().flatten();
    let within = taken.filter(|q| subject.is_within(q)).count();
    let least = path.measure.iter().flatten().copied();
    let least = least.fold(f64::INFINITY, f64::min);
    let mut text = format!("{within} of {points} points within limits");
    match path.jumps().len() {
        0 => {}
        1 => text += ", 1 jump",
        jumps => text += &format!(", {jumps} jumps"),
    }
    if least.is_finite() {
        let measure = subject.measure[0];
        let measure = measure.strip_suffix(" of the Jacobian").unwrap_or(measure);
        text += &format!("; {measure} {least:.4} at least");
    }
    let joints = |q: &Vec<f64>| {
        let joints = subject.joints.iter();
        beyond(joints.map(|it| (it.name.as_str(), it.limit)), q)
    };
    // Ends as they were given: of solutions full turns are taken.
    let ends = [&arguments.from, &arguments.to].into_iter();
    let ends = ends.filter(|q| q.len() == subject.joints.len());
    if let Some(reason) = ends.chain(path.taken.iter().flatten()).find_map(joints) {
        text += &format!("\n{reason}: {RADIANS}");
    }
    text + "\n"
}
