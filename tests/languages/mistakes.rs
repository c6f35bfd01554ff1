//! What the comparison with Rust is worth: mistakes that are put into the C of a robot, one by
//! one, signs and bounds, and each of which it has to find.

use super::*;
use kin_codegen::Options;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// So many of the differences that the C of the robot's expressions computes become sums.
const SIGNS: usize = 8;

/// Of what is the same for every robot, and what stands there instead.
const BOUNDS: [[&str; 2]; 5] = [
    ["beyond <= 1e-9;", "beyond <= 1e-1;"],
    ["motion < least", "motion > least"],
    ["return value < ", "return value > "],
    ["missing[3 + i] = z[i] - ", "missing[3 + i] = z[i] + "],
    ["counts && !(", "counts && ("],
];

/// The text with one of its lines changed.
fn with_line(text: &str, number: usize, change: impl Fn(&str) -> String) -> String {
    let line = |(i, line): (usize, &str)| match i == number {
        true => change(line),
        false => line.to_owned(),
    };
    let lines: Vec<String> = text.lines().enumerate().map(line).collect();
    lines.join("\n") + "\n"
}

/// Lines with a difference in what is written of expressions: forward kinematics and Jacobians,
/// and the lanes of the branches.
fn differences(text: &str) -> Vec<usize> {
    let place = |words: &str| text.lines().position(|it| it.contains(words)).unwrap();
    let forward = place("void mistaken_fk(")..place("int mistaken_fk_frame(");
    let inverse = place("mistaken_whole(")..place("mistaken_compute_lanes(");
    let lines = text.lines().enumerate();
    let differs = |(i, line): &(usize, &str)| {
        line.contains(" - ") && (forward.contains(i) || inverse.contains(i))
    };
    let all: Vec<usize> = lines.filter(differs).map(|(i, _)| i).collect();
    let every = all.len() / SIGNS;
    all.into_iter().skip(every / 2).step_by(every).collect()
}

#[test]
fn mistakes_are_found() {
    if !Compiler::C.is_there() {
        return;
    }
    let path = "robots/kr6_r900.yaml";
    let right = generated(path, "mistaken", &Options::default());
    let rust = Robot::load(&read(path), &Options::default()).unwrap();
    let subject = Subject::new(path, &right, String::new(), rust);
    let text = &right.source;
    let differences = differences(text).into_iter();
    let signs = differences.map(|line| with_line(text, line, |it| it.replacen(" - ", " + ", 1)));
    let bounds = BOUNDS.iter().map(|[there, instead]| {
        assert!(text.contains(there), "{there}");
        text.replacen(there, instead, 1)
    });
    let all: Vec<String> = [text.clone()]
        .into_iter()
        .chain(signs)
        .chain(bounds)
        .collect();
    assert!(all.len() > SIGNS + BOUNDS.len());
    let mut program = Program::new("mistakes");
    for (number, source) in all.iter().enumerate() {
        let name = format!("wrong{number}");
        program.add(&GeneratedC {
            header: renamed(&right.header, &name),
            source: renamed(source, &name),
            name,
            ..right.clone()
        });
    }
    let built = program.build(Compiler::C, &["-O0"], "mistakes");
    let told = built.run(&subject.input.repeat(all.len()));
    for (source, told) in all.iter().zip(told.split_inclusive(program::END)) {
        let run = || compare(std::slice::from_ref(&subject), told);
        let is_right = catch_unwind(AssertUnwindSafe(run)).is_ok();
        let changed = text.lines().zip(source.lines()).find(|(a, b)| a != b);
        assert_eq!(is_right, changed.is_none(), "{changed:?}");
    }
}

/// The same under another name.
fn renamed(text: &str, name: &str) -> String {
    let upper = name.to_ascii_uppercase();
    text.replace("mistaken", name).replace("MISTAKEN", &upper)
}
