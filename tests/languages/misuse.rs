//! What users do that was not meant.

use crate::js::JsRobot;
use crate::program::Compiler;
use kin_codegen::{Options, Source, generate_js};
use std::io::Write as _;
use std::path::Path;
use std::process::Stdio;

fn javascript(robot: &str) -> JsRobot {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read(robot, &root).unwrap();
    JsRobot::new(&generate_js(&source, &Options::default()).unwrap().source)
}

/// Compilers define these for the options that change what rounding and what is not a number are.
#[test]
fn c_for_other_numbers_is_refused() {
    if !Compiler::C.is_there() {
        return;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let code = std::fs::read_to_string(root.join("tests/golden/ur5e.c")).unwrap();
    let said = |options: &[&str]| {
        let mut command = Compiler::C.command();
        command.args(options).args(["-w", "-fsyntax-only", "-I"]);
        command.arg(root.join("tests/golden")).arg("-");
        let command = command.stdin(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut stdin = child.stdin.take().unwrap();
        stdin.write_all(code.as_bytes()).unwrap();
        drop(stdin);
        String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap()
    };
    assert_eq!(said(&["-O2"]), "");
    let parts = "compile without -ffast-math and its parts";
    for option in [
        "-ffast-math",
        "-ffinite-math-only",
        "-D__ASSOCIATIVE_MATH__=1",
    ] {
        let said = said(&[option]);
        assert!(said.contains(parts), "{option}: {said}");
    }
    let wider = said(&["-U__FLT_EVAL_METHOD__", "-D__FLT_EVAL_METHOD__=2"]);
    assert!(
        wider.contains("compile with -msse2 -mfpmath=sse"),
        "{wider}"
    );
    // A compiler that does not have the option names it.
    let shorter = said(&["-fsingle-precision-constant"]);
    assert!(
        shorter.contains("ur5e_constants_have_all_digits") || shorter.contains("-fsingle"),
        "{shorter}"
    );
}

/// Newton's method goes away from these solutions for some steps before it comes nearer.
#[test]
fn a_target_next_to_singular_ones_has_solutions_in_javascript() {
    let crx = javascript("tests/robots/crx10ial.yaml");
    let near = [
        0.000_034_347_132_347_464_22,
        3.141_592_618_922_835,
        1.570_798_606_184_771_6,
        1.570_796_326_794_547_7,
        5.789_638_760_371_755e-12,
        -5.579_011_029_955_714e-10,
    ];
    let input = near.map(|x| x.to_string()).join(" ");
    let count: usize = crx.call("count_of", &input).parse().unwrap();
    assert!(count > 0);
}

#[test]
fn parameters_that_are_too_many_or_too_few_are_told_in_javascript() {
    let panda = javascript("robots/panda.yaml");
    let said = panda.call("with_parameters", "0.3 0.5 -0.2 -1.8 0.4 1.9 0.6");
    let refused = "TypeError: a target takes 1 parameters here, numbers: joint7";
    let expected = [
        "true",
        refused,
        refused,
        refused,
        refused,
        "0",
        "not finite",
        "true",
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn arrays_that_are_too_long_or_too_short_are_told_in_javascript() {
    let kr6 = javascript("robots/kr6_r900.yaml");
    let said = kr6.call("with_lengths", "0.3 -1.5 1.2 0.4 0.9 0.6");
    let joints = |call: &str, what: &str, wanted: usize, count: &str| {
        format!(
            "TypeError: {call}: {what} is {wanted} numbers, a value of each joint, and not {count}"
        )
    };
    let pose = |call: &str, count: &str| {
        let rows = "the rows of the rotation with the translation at their ends";
        format!("TypeError: {call}: pose is 12 numbers, {rows}, and not {count}")
    };
    let expected = [
        joints("fk", "q", 6, "5"),
        joints("fk", "q", 6, "undefined"),
        joints("fk_jacobian", "q", 6, "7"),
        joints("fk_frame", "q", 6, "number"),
        pose("ik", "16"),
        joints("ik_seeded", "seed", 6, "5"),
        joints("ik_nearest", "seed", 6, "undefined"),
        joints("within_limits", "seed", 6, "5"),
        "TypeError: fk: q is numbers, and entry 0 is string".to_owned(),
        "TypeError: fk_jacobian: q is numbers, and entry 0 is null".to_owned(),
        "TypeError: ik: pose is numbers, and entry 0 is string".to_owned(),
        "TypeError: fk_frame: frame is the number of one of 1 frames, and not 99".to_owned(),
        "6".to_owned(),
        "6".to_owned(),
        "true".to_owned(),
        "6".to_owned(),
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), expected);

    let delta = javascript("robots/delta.yaml");
    let said = delta.call("mechanism_with_lengths", "0 0 0");
    let expected = [
        joints("gap", "q", 15, "3"),
        joints("platform", "q", 15, "4"),
        joints("close", "q", 15, "3"),
        "TypeError: close: resting is joints from 0 to 14, and 15 is none".to_owned(),
        "TypeError: close: resting is an array of joints, and not null".to_owned(),
        pose("ik", "3"),
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), expected);
}
