//! `kin workspace`.

mod map;
mod npy;
mod picture;

use crate::arguments::{self, read};
use crate::bar::Bar;
use crate::{Done, Exit};
use kin_codegen::{Compiled, Ik, compile};
use map::{Map, Sampling};
use serde_json::json;
use std::fs;
use std::io;
use std::path::PathBuf;

pub fn run(arguments: &arguments::Workspace) -> Done {
    let options = arguments.options.options();
    if options.ik == Ik::None {
        let reason = "a map is made by inverse kinematics: leave out `--ik none`";
        return Done::failing(Exit::Usage, reason);
    }
    let compiled = match read(&arguments.file).and_then(|source| compile(&source, &options)) {
        Ok(compiled) => compiled,
        Err(diagnostics) => return Done::failing(refused(arguments), diagnostics),
    };
    let Some(sampling) = Sampling::new(&compiled, arguments) else {
        let reason = format!(
            "{}: targets are {}, which have no place in a workspace",
            arguments.file,
            compiled.target().phrase()
        );
        return Done::failing(Exit::Usage, reason);
    };
    let bar = Bar::new(&arguments.file, sampling.points(), "points");
    let map = sampling.map(&|points| bar.advance(points));
    drop(bar);
    match write(arguments, &compiled, &sampling, &map) {
        Ok(files) => Done::printing(report(&sampling, &map, &files)),
        Err((path, error)) => Done::failing(
            Exit::Broken,
            format!("cannot write {}: {error}", path.display()),
        ),
    }
}

/// Whether the file is broken or its arm has no closed form.
fn refused(arguments: &arguments::Workspace) -> Exit {
    let options = kin_codegen::Options {
        ik: Ik::None,
        ..arguments.options.options()
    };
    match read(&arguments.file).and_then(|source| compile(&source, &options)) {
        Ok(_) => Exit::Refused,
        Err(_) => Exit::Broken,
    }
}

/// Writes all files and tells which.
fn write(
    arguments: &arguments::Workspace,
    compiled: &Compiled,
    sampling: &Sampling,
    map: &Map,
) -> Result<Vec<PathBuf>, (PathBuf, io::Error)> {
    let folder = &arguments.out;
    fs::create_dir_all(folder).map_err(|error| (folder.clone(), error))?;
    let mut files = Vec::new();
    let mut file = |name: &str, content: io::Result<Vec<u8>>| {
        let path = folder.join(format!("{}_{name}", compiled.model.name));
        let written = content.and_then(|content| fs::write(&path, content));
        match written {
            Ok(()) => files.push(path),
            Err(error) => return Err((path, error)),
        }
        Ok(())
    };
    let shape = [3, map.cells, map.cells];
    for (i, slice) in sampling.slices.iter().enumerate() {
        file(&format!("{}.png", slice.name), picture::slice(map, i))?;
    }
    file("workspace.png", picture::all(map))?;
    file("reachability.npy", Ok(npy::encode(&shape, &map.share)))?;
    file(
        "manipulability.npy",
        Ok(npy::encode(&shape, &map.manipulability)),
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
    let description = json!({
        "schema": 1,
        "slices": slices,
        "cells": map.cells,
        "cell_size": sampling.step,
        "orientations": sampling.orientations.len(),
        "limits_applied": sampling.limits.is_some(),
        "reachability": "share of orientations reached; index [slice][row][column]",
        "manipulability": "|det J| of the best branch, the mean over the orientations reached",
    });
    format!("{description:#}\n")
}

fn report(sampling: &Sampling, map: &Map, files: &[PathBuf]) -> String {
    let mut text = format!(
        "{} points, {} orientations at each, {} limits\n",
        sampling.points(),
        sampling.orientations.len(),
        match sampling.limits {
            Some(_) => "within",
            None => "regardless of",
        }
    );
    for (i, slice) in sampling.slices.iter().enumerate() {
        let share = map.slice(&map.share, i);
        let area = |count: usize| count as f64 * sampling.step.powi(2);
        let reached = share.iter().filter(|share| **share > 0.0).count();
        let everywhere = share.iter().filter(|share| **share == 1.0).count();
        text += &format!(
            "{}: {:.3} m² in reach, {:.3} m² with every orientation tried\n",
            slice.name,
            area(reached),
            area(everywhere)
        );
    }
    for file in files {
        text += &format!("{}\n", file.display());
    }
    text
}
