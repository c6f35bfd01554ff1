//! The comments of generated code: every step of the plan is opened by one,
//! and nothing but comments tells the printed code from the tokens.

use kin_codegen::{Options, Source, generate};
use std::path::Path;

const ROBOTS: [&str; 8] = [
    "robots/ur5e.urdf",
    "robots/kr6_r900.yaml",
    "robots/scara.yaml",
    "robots/stanford.yaml",
    "robots/planar_2r.yaml",
    "tests/robots/noisy/calibrated.yaml",
    "tests/robots/table/parallel_123.yaml",
    "robots/delta.yaml",
];

fn generated(robot: &str) -> kin_codegen::Generated {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read(robot, &root).unwrap();
    generate(&source, &Options::default()).unwrap()
}

/// The function that computes the branches, line by line; a comment that takes several
/// is one.
fn branches(code: &str) -> Vec<String> {
    let lines = code.lines().map(str::trim_start);
    let body = lines.skip_while(|line| !line.contains("lanes::entries("));
    let body = body.take_while(|line| !line.starts_with("Lanes {"));
    let mut whole: Vec<String> = Vec::new();
    for line in body {
        match (line.strip_prefix("// "), whole.last_mut()) {
            (Some(rest), Some(before)) if before.starts_with("//") && number(line).is_none() => {
                before.push(' ');
                before.push_str(rest);
            }
            _ => whole.push(line.to_owned()),
        }
    }
    whole
}

/// The number of a heading, if the line is one.
fn number(line: &str) -> Option<usize> {
    let (number, _) = line.strip_prefix("// ")?.split_once(". ")?;
    number.parse().ok()
}

/// Whether a heading is of values that branches share; its step comes later.
fn is_ahead(line: &str) -> bool {
    line.ends_with(" share)")
}

#[test]
fn every_step_is_opened_once() {
    for robot in &ROBOTS[..7] {
        let code = generated(robot).code();
        let body = branches(&code);
        let headings = body.iter().filter(|line| !is_ahead(line));
        let mut numbers: Vec<usize> = headings.filter_map(|line| number(line)).collect();
        numbers.sort_unstable();
        let plan = code
            .lines()
            .find_map(|line| line.split_once("Solved by "))
            .unwrap()
            .1;
        let steps = plan.split(") ").count();
        assert_eq!(numbers, (1..=steps).collect::<Vec<_>>(), "{robot}: {plan}");
    }
}

#[test]
fn headings_stand_in_the_order_of_the_plan() {
    for robot in &ROBOTS[..7] {
        let code = generated(robot).code();
        let body = branches(&code);
        assert!(body.iter().any(|line| number(line).is_some()), "{robot}");
        // In front of the loops, and in each of them.
        for stretch in body.split(|line| line.starts_with("for k in")) {
            let numbers: Vec<usize> = stretch.iter().filter_map(|line| number(line)).collect();
            assert!(numbers.is_sorted(), "{robot}: {numbers:?}");
        }
    }
}

#[test]
fn a_step_is_named_with_what_it_is_given() {
    let code = generated("robots/ur5e.urdf").code();
    let opened = [
        "// 1. q1 by SP4",
        "// 2. q2+q3+q4 and q5 by SP2, given q1",
        "// 3. q6 by SP1, given q1 and q2+q3+q4",
    ];
    let lines = branches(&code);
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    for heading in opened {
        assert!(lines.contains(&heading), "{heading}");
    }
    // What stands under a heading is the step's.
    let under = |heading: &str, statement: &str| {
        let begin = lines.iter().position(|line| *line == heading).unwrap();
        let behind = lines[begin + 1..].iter();
        let mut stretch = behind.take_while(|line| !line.starts_with("//"));
        assert!(
            stretch.any(|line| line.starts_with(statement)),
            "{statement} under {heading}"
        );
    };
    under(opened[0], "let s1 =");
    under(opened[1], "let c234 =");
    under(opened[2], "let s6 =");
}

#[test]
fn tokens_are_the_code_without_comments() {
    for robot in ROBOTS {
        let generated = generated(robot);
        let code = generated.code();
        let tokens = prettyplease::unparse(&syn::parse2(generated.tokens).unwrap());
        // Numbers share lines in the one.
        let words = |text: &str| -> String {
            let lines = text.lines().map(str::trim_start);
            let lines = lines.filter(|line| !line.starts_with("//") || line.starts_with("///"));
            let text: Vec<&str> = lines.flat_map(str::split_whitespace).collect();
            text.concat()
        };
        assert!(words(&code) == words(&tokens), "{robot}");
        assert!(!code.contains("__comment"), "{robot}");
    }
}
