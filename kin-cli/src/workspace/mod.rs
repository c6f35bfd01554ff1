//! `kin workspace`.

mod arm;
mod map;
mod mechanism;
mod npy;
mod picture;
mod redundant;

use crate::arguments::{self, read};
use crate::bar::Bar;
use crate::plot::canvas;
use crate::plot::figure::Figure;
use crate::{Done, Exit};
use kin_codegen::arm::CompiledArm;
use kin_codegen::geometry::size;
use kin_codegen::spec::one_line;
use kin_codegen::{Compiled, Ik, Options, Source, Target, compile};
use kinematics::{LoadError, Robot};
use map::{Map, Sampling};
use redundant::Redundant;
use serde_json::json;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub fn run(arguments: &arguments::Workspace) -> Done {
    let options = arguments.options.options();
    if options.ik == Ik::None {
        let reason = "a map is made by inverse kinematics: leave out `--no-ik` (`--ik none`)";
        return Done::failing(Exit::Usage, reason);
    }
    let source = match read(&arguments.file) {
        Ok(source) => source,
        Err(diagnostics) => return Done::failing(Exit::Broken, diagnostics),
    };
    let robot = match compile(&source, &options) {
        Ok(robot) => robot,
        Err(error) => return Done::failing(Exit::from(&error), error),
    };
    let sampling = match &robot {
        Compiled::Arm(arm) => match redundant(arm, &source, &options, arguments.limits) {
            Ok(redundant) => arm::sampling(arm, redundant, arguments),
            Err(error) => return Done::failing(Exit::from(&error), error),
        },
        Compiled::Mechanism(compiled) => mechanism::sampling(compiled, arguments),
    };
    match sampling {
        Some(sampling) => {
            let (name, figure) = drawn(&robot);
            let shown = picture::Robot {
                name: one_line(name),
                figure,
            };
            draw(arguments, name, &shown, &sampling)
        }
        None => Done::failing(
            Exit::Usage,
            format!("{}: {}", one_line(&arguments.file), placeless(&robot)),
        ),
    }
}

/// An arm, if it is redundant.
fn redundant(
    arm: &CompiledArm,
    source: &Source,
    options: &Options,
    limited: bool,
) -> Result<Option<Box<dyn map::Robot>>, LoadError> {
    if arm.redundancy.is_none() {
        return Ok(None);
    }
    let robot = Robot::load(source, options)?;
    let redundant = Redundant::new(robot, size(&arm.model), limited);
    Ok(Some(Box::new(redundant)))
}

/// The robot as it is drawn, and its name.
fn drawn(robot: &Compiled) -> (&str, Figure) {
    match robot {
        Compiled::Arm(arm) => {
            let home = vec![0.0; arm.model.variables.len()];
            (&arm.model.name, Figure::arm(&arm.model, &home))
        }
        Compiled::Mechanism(compiled) => {
            let mechanism = &compiled.mechanism;
            let home = vec![0.0; mechanism.joints()];
            (&mechanism.name, Figure::mechanism(mechanism, &home))
        }
    }
}

/// Why a robot's targets make no map.
fn placeless(robot: &Compiled) -> String {
    match robot {
        Compiled::Arm(arm) if arm.target() == Target::Pose => format!(
            "of whole poses {} joints reach few, and none of those that a map tries\n\
             help: choose {}",
            arm.model.variables.len(),
            arm.fitting().map_or_else(
                || "a link in front of the last joints as the tip (`--tip`)".into(),
                |target| format!("`--target {}`", target.word())
            )
        ),
        Compiled::Arm(arm) => format!(
            "targets are {}, which have no place in a workspace\n\
             help: choose `--target pose` or `--target position`",
            arm.target().phrase()
        ),
        Compiled::Mechanism(_) => {
            "the platform's position cannot be chosen freely at a given orientation\n\
             help: `kin plot` draws what it does while the actuated joints move"
                .into()
        }
    }
}

fn draw(
    arguments: &arguments::Workspace,
    name: &str,
    robot: &picture::Robot,
    sampling: &Sampling,
) -> Done {
    let bar = Bar::new(&arguments.file, sampling.points(), "points");
    let map = sampling.map(&|points| bar.advance(points));
    drop(bar);
    match write(arguments, name, robot, sampling, &map) {
        Ok(files) => Done::printing(report(sampling, &map, &files)),
        Err((path, error)) => Done::unwritten(&path, &error),
    }
}

/// A robot's name as the beginning of a file's: the file is data of a stranger, and
/// must not choose the folder.
fn in_file_name(robot: &str) -> String {
    let stays = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    let name = robot.chars().take(LONGEST_NAME);
    name.map(|c| if stays(c) { c } else { '_' }).collect()
}

/// File systems take names of 255 bytes, four of which a character may have.
const LONGEST_NAME: usize = 50;

fn shown(path: &Path) -> String {
    one_line(&path.to_string_lossy())
}

/// Writes all files and tells which.
fn write(
    arguments: &arguments::Workspace,
    name: &str,
    robot: &picture::Robot,
    sampling: &Sampling,
    map: &Map,
) -> Result<Vec<PathBuf>, (PathBuf, io::Error)> {
    let (folder, stem) = (&arguments.out, in_file_name(name));
    fs::create_dir_all(folder).map_err(|error| (folder.clone(), error))?;
    let mut files = Vec::new();
    let mut file = |name: &str, content: io::Result<Vec<u8>>| {
        let path = folder.join(format!("{stem}_{name}"));
        let written = content.and_then(|content| fs::write(&path, content));
        match written {
            Ok(()) => files.push(path),
            Err(error) => return Err((path, error)),
        }
        Ok(())
    };
    let shape = [3, map.cells, map.cells];
    let names = sampling.slices.iter().map(|slice| slice.name);
    let parts = names.enumerate().map(|(i, name)| (name, Some(i)));
    for (name, only) in parts.chain([("workspace", None)]) {
        let maps = picture::Maps {
            sampling,
            map,
            robot,
            only,
        };
        file(&format!("{name}.svg"), canvas::svg(&maps))?;
        file(&format!("{name}.png"), canvas::png(&maps))?;
    }
    file("reachability.npy", Ok(npy::encode(&shape, &map.share)))?;
    let [measure, _] = sampling.robot.measure();
    file(
        &format!("{measure}.npy"),
        Ok(npy::encode(&shape, &map.measure)),
    )?;
    file(
        "workspace.json",
        Ok(description(sampling, map).into_bytes()),
    )?;
    Ok(files)
}

/// What the numbers in the other files are.
fn description(sampling: &Sampling, map: &Map) -> String {
    let slices: Vec<_> = (sampling.slices.iter())
        .map(|slice| {
            json!({
                "name": slice.name,
                "columns_along": slice.across,
                "rows_along": slice.up,
                "centre": slice.centre,
            })
        })
        .collect();
    let [measure, meaning] = sampling.robot.measure();
    let description = json!({
        "schema": 1,
        "slices": slices,
        "cells": map.cells,
        "cell_size": sampling.step,
        "orientations": sampling.orientations.len(),
        "orientations_are": sampling.robot.choice(),
        "limits_applied": sampling.limited,
        "reachability": "share of orientations reached; index [slice][row][column]",
        measure: format!("{meaning}, the mean over the orientations reached"),
    });
    format!("{description:#}\n")
}

fn report(sampling: &Sampling, map: &Map, files: &[PathBuf]) -> String {
    let mut text = format!(
        "{} points, {} orientations at each ({}), {} limits\n",
        sampling.points(),
        sampling.orientations.len(),
        sampling.robot.choice(),
        match sampling.limited {
            true => "within",
            false => "regardless of",
        }
    );
    for (i, slice) in sampling.slices.iter().enumerate() {
        let share = map.slice(&map.share, i);
        let area = |count: usize| count as f64 * sampling.step.powi(2);
        let reached = share.iter().filter(|share| **share > 0.0).count();
        let everywhere = share.iter().filter(|share| **share == 1.0).count();
        let all = if reached == share.len() {
            "all of its "
        } else {
            ""
        };
        text += &format!(
            "{}: {all}{:.3} m² in reach, {:.3} m² with every orientation tried\n",
            slice.name,
            area(reached),
            area(everywhere)
        );
    }
    for file in files {
        text += &format!("{}\n", shown(file));
    }
    text
}
