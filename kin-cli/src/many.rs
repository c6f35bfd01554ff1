//! `kin fk` and `kin ik`.

use crate::arguments::{Fk, InverseOfMany, Many, RobotOptions, read};
use crate::bar::Bar;
use crate::batch::{Forward, Inverse, Job, Kept, Pair, RADIANS, Report, Tally, Task, Written};
use crate::batch::{forget_all, pairs};
use crate::table::{Fault, Format, Place, Reader};
use crate::{Done, Exit};
use kin_codegen::spec::one_line;
use kin_codegen::{Ik, Options, Target};
use kinematics::Robot;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

pub fn forward(arguments: &Fk) -> Done {
    let options = arguments.options.options();
    let has_given = arguments.given || !options.free.is_empty();
    let options = Options {
        ik: if has_given { options.ik } else { Ik::None },
        ..options
    };
    let (robot, identity) = match load(&arguments.file, &options) {
        Ok(loaded) => loaded,
        Err(done) => return done,
    };
    let written = match arguments.matrix {
        true => Written::Matrix,
        false => Written::Quaternion,
    };
    let all = All {
        identity: format!("fk {written:?} {identity}"),
        answers: "poses",
        keeps_empty: false,
        help: "",
        robot: &arguments.file,
        input: &arguments.input,
        options: &arguments.options,
        many: &arguments.many,
    };
    all.run(|input, reader| {
        let task = Forward::new(input, &robot, written)?;
        let columns = task.find(input, reader.header())?;
        Ok((Box::new(task), columns))
    })
}

pub fn inverse(arguments: &InverseOfMany) -> Done {
    let options = arguments.options.options();
    if options.ik == Ik::None {
        let reason = "solutions are of inverse kinematics: leave out `--no-ik` (`--ik none`)";
        return Done::failing(Exit::Usage, reason);
    }
    let (robot, identity) = match load(&arguments.file, &options) {
        Ok(loaded) => loaded,
        Err(done) => return done,
    };
    let (at, needed) = (&arguments.at, robot.parameter_names());
    if !at.is_empty() && at.len() != needed.len() {
        let reason = match needed.len() {
            0 => "nothing is given beside a pose of this robot: leave out `--at`".into(),
            _ => format!(
                "`--at` has {} values, for {}\nhelp: give one for each, radians and metres, with \
                 commas between",
                at.len(),
                needed.join(", ")
            ),
        };
        return Done::failing(Exit::Usage, reason);
    }
    if at.iter().any(|x| !x.is_finite()) {
        let reason = "the values of `--at` have to be finite";
        return Done::failing(Exit::Usage, reason);
    }
    let kept = Kept {
        within_limits: arguments.within_limits,
        empty: arguments.keep_empty,
    };
    let help = unsolved(&robot);
    let all = All {
        identity: format!("ik {at:?} {kept:?} {identity}"),
        answers: "solutions",
        keeps_empty: kept.empty,
        help: &help,
        robot: &arguments.file,
        input: &arguments.input,
        options: &arguments.options,
        many: &arguments.many,
    };
    all.run(|input, reader| {
        let (task, columns) = Inverse::new(&robot, at, kept, input, reader.header())?;
        Ok((Box::new(task), columns))
    })
}

/// What to do where no pose has a solution.
fn unsolved(robot: &Robot) -> String {
    let usual = "poses are in metres, and those of the tip in the base that `kin explain` names";
    let joints = robot.joints();
    match (robot.target(), joints) {
        (Target::Pose, ..6) => format!(
            "a robot of {joints} joints reaches few whole poses: say what of them counts, for \
             example `--target {}`; {usual}",
            if joints == 5 {
                "position_axis"
            } else {
                "position"
            }
        ),
        _ => usual.into(),
    }
}

/// The robot of a file, and what else than its name makes it this one.
fn load(file: &str, options: &Options) -> Result<(Robot, String), Done> {
    if Format::of(Path::new(file)).is_ok() {
        let reason = format!(
            "{} is a table\nhelp: the robot file comes first, and the table behind it",
            one_line(file)
        );
        return Err(Done::failing(Exit::Usage, reason));
    }
    let source = read(file).map_err(|error| Done::failing(Exit::Broken, error))?;
    let robot =
        Robot::load(&source, options).map_err(|error| Done::failing(Exit::from(&error), error))?;
    let text = source.text.as_bytes();
    let identity = format!("{} {:08x} {options:?}", text.len(), crc32fast::hash(text));
    Ok((robot, identity))
}

/// All tables of a command.
struct All<'a> {
    /// What the answers depend on beside a table.
    identity: String,
    answers: &'static str,
    /// Whether a row without any has an empty one.
    keeps_empty: bool,
    /// What to do where no row has any.
    help: &'a str,
    robot: &'a str,
    input: &'a Path,
    options: &'a RobotOptions,
    many: &'a Many,
}

impl All<'_> {
    /// Runs a task for each of them, which is made for a table with its columns.
    fn run<'t>(
        &self,
        task: impl Fn(&Path, &dyn Reader) -> Result<(Box<dyn Task + 't>, Vec<usize>), Fault>,
    ) -> Done {
        let many = self.many;
        let pairs = match pairs(self.input, &many.output, many.format, many.share) {
            Ok(pairs) => pairs,
            Err(fault) => return Done::failing(Exit::Broken, fault),
        };
        if let Some(refused) = pairs
            .iter()
            .find_map(|pair| Done::over_robot(self.robot, &pair.output))
        {
            return refused;
        }
        let clock = Instant::now();
        let mut done = Done::printing("");
        let (mut total, mut answers) = (Tally::default(), 0);
        for pair in &pairs {
            let report = self.one(pair, &task);
            match report {
                Ok(report) => {
                    done.stderr += &warnings(pair, &report);
                    total.add(&report.tally);
                    answers += report.answers;
                }
                Err(fault) => {
                    done.stderr += &format!("{fault}\n");
                    done.exit = Exit::Broken;
                }
            }
        }
        if self.keeps_empty {
            answers -= total.unsolved + total.faulty;
        }
        if done.exit == Exit::Success {
            forget_all(pairs.iter().map(|pair| &*pair.output));
            let seconds = clock.elapsed().as_secs_f64();
            done.stdout = self.summary(&total, answers, pairs.len(), seconds);
            if answers == 0 && total.unsolved > 0 {
                done.stderr += &format!("no row has a solution\nhelp: {}\n", self.help);
            }
        }
        done
    }

    fn one<'t>(
        &self,
        pair: &Pair,
        task: impl Fn(&Path, &dyn Reader) -> Result<(Box<dyn Task + 't>, Vec<usize>), Fault>,
    ) -> Result<Report, Fault> {
        let mut reader = Format::of(&pair.input)?.open(&pair.input)?;
        let (task, columns) = task(&pair.input, &*reader)?;
        reader.select(&columns)?;
        let (extent, unit) = reader.extent();
        let bar = Bar::new(
            &one_line(&pair.input.to_string_lossy()),
            extent as usize,
            unit,
        );
        let job = Job {
            input: &pair.input,
            reader,
            task: &*task,
            encoder: pair.format.encoder(task.columns()),
            output: pair.output.clone(),
            batch: self.many.batch as usize,
            is_strict: self.options.strict,
            robot: format!("{:?} {}", pair.format, self.identity),
        };
        job.run(&mut |extent| {
            bar.advance(extent as usize);
            ControlFlow::Continue(())
        })
    }

    fn summary(&self, total: &Tally, answers: u64, files: usize, seconds: f64) -> String {
        let output = one_line(&self.many.output.to_string_lossy());
        let mut line = format!(
            "{output}: {answers} {} of {} rows",
            self.answers, total.rows
        );
        if self.input.is_dir() {
            let _ = write!(line, " in {files} tables");
        }
        if total.unsolved > 0 {
            let _ = write!(line, ", {} of them without any", total.unsolved);
        }
        let _ = writeln!(line, "; {seconds:.1} s");
        line
    }
}

/// What a person should know of a table that was taken.
fn warnings(pair: &Pair, report: &Report) -> String {
    let mut lines = String::new();
    let input = one_line(&pair.input.to_string_lossy());
    if report.before > 0 {
        let _ = writeln!(lines, "{input}: {} rows were done before", report.before);
    }
    if let Some((row, reason)) = &report.tally.first_fault {
        let such = match report.tally.faulty {
            1 => "it has no answer".into(),
            faulty => format!("it and {} others have no answer", faulty - 1),
        };
        let first = Fault::at(
            &pair.input,
            Place {
                row: Some(*row),
                column: None,
            },
            format!("{reason}; {such}"),
            "mend such rows; with `--strict` they are errors",
        );
        let _ = writeln!(lines, "{first}");
    }
    if let Some((row, reason)) = &report.tally.first_beyond {
        let at = Place {
            row: Some(*row),
            column: None,
        };
        let first = Fault::at(&pair.input, at, reason, RADIANS);
        let _ = writeln!(lines, "{first}");
    }
    lines
}
