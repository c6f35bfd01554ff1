//! `kin check`.

use super::report::{self, Checked};
use super::verdict::{Check, Verdict, check};
use crate::arguments::{self, read};
use crate::bar::Bar;
use crate::sweep::{Draw, Replay, Settings, Tally, sweep};
use crate::{Done, Exit};
use kin_codegen::spec::one_line;
use kin_codegen::{Compiled, Diagnostics, Options};

pub fn run(arguments: &arguments::Check) -> Done {
    let options = arguments.options.options();
    let mut done = Done::printing("");
    let mut all = Vec::new();
    for file in &arguments.files {
        let mut checked = Checked {
            check: one(file, &options),
            sweep: None,
            replay: None,
        };
        // Among several files the others are tried all the same.
        if let Err(diagnostic) = checked.try_more(arguments) {
            if arguments.files.len() == 1 {
                return Done::failing(Exit::Broken, diagnostic);
            }
            done.stderr += &format!("{diagnostic}\n\n");
            done.exit = worse(done.exit, Exit::Broken);
        }
        // The line names the first diagnostic; here are all, with their places.
        match &checked.check.verdict {
            Verdict::Refused(diagnostics)
            | Verdict::Broken(diagnostics)
            | Verdict::Ambiguous(diagnostics) => {
                done.stderr += &format!("{diagnostics}\n\n");
            }
            Verdict::Solved { robot, .. } => {
                let warnings = robot.warnings().to_vec();
                if let Some(warnings) = Diagnostics::of(file, warnings) {
                    done.stderr += &format!("{warnings}\n\n");
                }
            }
        }
        done.exit = worse(done.exit, checked.exit());
        all.push(checked);
    }
    done.stdout = if arguments.json {
        match report::json(&all) {
            Ok(json) => json,
            Err(error) => return Done::failing(Exit::Broken, error),
        }
    } else {
        all.iter().map(report::text).collect()
    };
    done
}

fn one(file: &str, options: &Options) -> Check {
    match read(file) {
        Ok(source) => check(&source, options),
        Err(diagnostics) => Check {
            path: file.into(),
            verdict: Verdict::Broken(diagnostics),
        },
    }
}

impl Checked {
    /// Sweeps or replays, if that was asked for and there is a closed form.
    ///
    /// # Errors
    ///
    /// The configuration to be replayed is not one of the arm, or there is no
    /// arm.
    fn try_more(&mut self, arguments: &arguments::Check) -> Result<(), String> {
        let Verdict::Solved { robot, .. } = &self.check.verdict else {
            return Ok(());
        };
        let arm = match &**robot {
            Compiled::Arm(arm) => arm,
            Compiled::Mechanism(_) if arguments.targets > 0 || arguments.at.is_some() => {
                return Err(format!(
                    "{}: --targets and --at try an arm, and this is a mechanism\n\
                     help: leave them out; its closed form is verified all the same",
                    one_line(&self.check.path)
                ));
            }
            Compiled::Mechanism(_) => return Ok(()),
        };
        let (model, Some(form)) = (&arm.model, arm.form()) else {
            return match arguments.targets > 0 || arguments.at.is_some() {
                true => Err(format!(
                    "{}: --targets and --at try inverse kinematics, and --no-ik (--ik none) \
                     leaves it out\nhelp: leave out --no-ik (--ik none)",
                    one_line(&self.check.path)
                )),
                false => Ok(()),
            };
        };
        if arguments.targets > 0 {
            let settings = Settings {
                targets: arguments.targets,
                oracle: arguments.oracle,
                seed: arguments.seed,
                draw: match arguments.aligned {
                    true => Draw::Aligned,
                    false => Draw::Anywhere,
                },
            };
            let bar = Bar::new(&self.check.path, settings.targets, "targets");
            self.sweep = Some(sweep(model, form, &settings, &|done| bar.advance(done)));
        }
        if let Some(q) = &arguments.at {
            let replay = Replay::new(model, form, q).ok_or_else(|| {
                let path = one_line(&self.check.path);
                let names: Vec<String> = (model.variables.iter())
                    .map(|it| one_line(&it.name))
                    .collect();
                let reason = match q.len() == names.len() {
                    true => "the values of --at have to be finite".to_owned(),
                    false => format!(
                        "--at has {} values, and the arm {} joints",
                        q.len(),
                        names.len()
                    ),
                };
                format!(
                    "{path}: {reason}\nhelp: give a number for each of {}, radians and metres",
                    names.join(", ")
                )
            })?;
            self.replay = Some(replay);
        }
        Ok(())
    }

    fn exit(&self) -> Exit {
        let replayed = self.replay.as_ref().map(|replay| &replay.tally);
        let is_clean = self.sweep.iter().chain(replayed).all(Tally::is_clean);
        match &self.check.verdict {
            Verdict::Solved { .. } if is_clean => Exit::Success,
            Verdict::Solved { .. } => Exit::Incomplete,
            Verdict::Refused(_) => Exit::Refused,
            Verdict::Ambiguous(_) => Exit::Ambiguous,
            Verdict::Broken(_) => Exit::Broken,
        }
    }
}

/// Of several files, what needs attention most decides.
fn worse(a: Exit, b: Exit) -> Exit {
    let order = [
        Exit::Incomplete,
        Exit::Broken,
        Exit::Ambiguous,
        Exit::Refused,
    ];
    order
        .into_iter()
        .find(|exit| [a, b].contains(exit))
        .unwrap_or(Exit::Success)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Split;

    /// A clean robot, after a sweep that saw `tally`.
    fn exit_after(tally: Tally) -> Exit {
        let checked = Checked {
            check: one("../robots/planar_2r.yaml", &Options::default()),
            sweep: Some(tally),
            replay: None,
        };
        checked.exit()
    }

    #[test]
    fn what_a_sweep_saw_decides() {
        let one = Split {
            regular: 1,
            near_singular: 0,
        };
        let near_one = Split {
            regular: 0,
            near_singular: 1,
        };
        let clean = Tally::default;
        assert_eq!(exit_after(clean()), Exit::Success);
        let faulty = [
            Tally {
                unsound: 1,
                ..clean()
            },
            Tally {
                lost: one,
                ..clean()
            },
            Tally {
                doubled: one,
                ..clean()
            },
        ];
        for tally in faulty {
            assert_eq!(exit_after(tally), Exit::Incomplete);
        }
        let near = Tally {
            lost: near_one,
            ..clean()
        };
        assert_eq!(exit_after(near), Exit::Success);
    }
}
