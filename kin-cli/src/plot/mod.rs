//! `kin plot`, and pictures as people publish them: axes with units, titles, and the same as
//! vectors and as pixels.

pub mod canvas;
mod path;
mod trajectory;

use crate::arguments::{self, read};
use crate::{Done, Exit};
use kin_codegen::Ik;
use kin_codegen::spec::one_line;
use kinematics::Robot;
use path::Path;
use std::fs;
use trajectory::Trajectory;

pub fn run(arguments: &arguments::Plot) -> Done {
    let options = arguments.options.options();
    if options.ik == Ik::None {
        let reason = "a path is followed by inverse kinematics: leave out `--ik none`";
        return Done::failing(Exit::Usage, reason);
    }
    let source = match read(&arguments.file) {
        Ok(source) => source,
        Err(diagnostics) => return Done::failing(Exit::Broken, diagnostics),
    };
    let robot = match Robot::load(&source, &options) {
        Ok(robot) => robot,
        Err(error) => return Done::failing(Exit::from(&error), error),
    };
    let joints = robot.joints();
    for (option, q) in [("from", &arguments.from), ("to", &arguments.to)] {
        if q.len() != joints || !q.iter().all(|x| x.is_finite()) {
            let names: Vec<String> = robot.joint_names().iter().map(|it| one_line(it)).collect();
            let reason = format!(
                "`--{option}` takes {joints} finite numbers, for {}",
                names.join(", ")
            );
            return Done::failing(Exit::Usage, reason);
        }
    }
    let path = Path::new(&robot, &arguments.from, &arguments.to, arguments.steps);
    let trajectory = Trajectory {
        robot: &robot,
        path: &path,
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
            return Done::failing(Exit::Usage, reason);
        }
    };
    let written = picture.and_then(|picture| fs::write(&arguments.output, picture));
    match written {
        Ok(()) => Done::printing(report(&path)),
        Err(error) => Done::failing(Exit::Broken, format!("cannot write {shown}: {error}")),
    }
}

/// How the arm got along.
fn report(path: &Path) -> String {
    let points = path.taken.len();
    let taken = path.taken.iter().flatten().count();
    let least = path.least.iter().flatten().copied();
    let least = least.fold(f64::INFINITY, f64::min);
    let mut text = format!("{taken} of {points} points within limits");
    match path.jumps().len() {
        0 => {}
        1 => text += ", 1 jump",
        jumps => text += &format!(", {jumps} jumps"),
    }
    if least.is_finite() {
        text += &format!("; least singular value {least:.4}");
    }
    text + "\n"
}
