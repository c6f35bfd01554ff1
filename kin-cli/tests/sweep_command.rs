//! `kin check` on random targets, and on one configuration.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn check(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kin"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    command.arg("check").args(arguments).current_dir(root);
    command.output().unwrap()
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn a_sweep_tells_what_it_counted() {
    let swept = check(&["robots/ur5e.urdf", "--targets", "200", "--oracle", "5"]);
    assert_eq!(swept.status.code(), Some(0));
    assert_eq!(stderr(&swept), "", "no progress bar without a terminal");
    let lines: Vec<&str> = stdout(&swept).lines().collect();
    let beginnings = [
        "robots/ur5e.urdf: solved: ",
        "  200 targets of seed 1 in ",
        "  solutions: 8 to 1",
        "  worst residual ",
        "  lost 0, unsound 0, doubled 0",
        "  near singular 0, below a conditioning of 1.0e-5; 0 of these unanswered",
        "  numerical search: ",
    ];
    assert_eq!(lines.len(), beginnings.len(), "{lines:#?}");
    for (line, beginning) in lines.iter().zip(beginnings) {
        assert!(line.starts_with(beginning), "{line}");
    }
    let aligned = check(&["robots/ur5e.urdf", "--targets", "50", "--aligned"]);
    assert!(stdout(&aligned).contains("\n  50 aligned targets of seed 1 in "));
    assert!(lines[6].contains(" solutions of 5 targets; missing 0, extra 0"));
}

#[test]
fn a_sweep_serves_programs() {
    let files = ["robots/scara.yaml", "tests/ui/robots/singular.yaml"];
    let swept = check(&[&["--json", "--targets", "50", "--seed", "7"], &files[..]].concat());
    assert_eq!(swept.status.code(), Some(3), "the second file is refused");
    let json: Value = serde_json::from_slice(&swept.stdout).unwrap();
    assert_eq!(json["schema"], 4);
    let [solved, refused] = &json["files"].as_array().unwrap()[..] else {
        panic!("{json:#}");
    };
    assert_eq!(
        keys(solved),
        [
            "diagnostics",
            "file",
            "plan",
            "replay",
            "structure",
            "sweep",
            "text",
            "tip_shift",
            "verdict"
        ]
    );
    assert_eq!(solved["verdict"], "solved");
    let sweep = &solved["sweep"];
    for (key, expected) in [
        ("seed", 7),
        ("targets", 50),
        ("unsound", 0),
        ("near_singular", 0),
        ("unanswered", 0),
    ] {
        assert_eq!(sweep[key], expected, "{key}");
    }
    assert_eq!(sweep["solutions"]["2"], 50);
    assert_eq!(sweep["lost"]["regular"], 0);
    assert_eq!(sweep["doubled"]["near_singular"], 0);
    assert!(sweep["oracle"].is_null() && sweep["faults"].as_array().unwrap().is_empty());
    assert!(sweep["worst_residual"].as_f64().unwrap() < 1e-12);
    assert!(sweep["microseconds"].as_f64().unwrap() > 0.0);
    assert!(sweep["seconds"].as_f64().unwrap() > 0.0);
    assert_eq!(
        (&refused["verdict"], &refused["sweep"]),
        (&"refused".into(), &Value::Null)
    );
    let remedy = refused["diagnostics"][0]["remedy"].as_str().unwrap();
    assert!(remedy.contains("`ik = none`"), "{remedy}");
}

#[test]
fn one_configuration_is_shown_in_full() {
    let q = "--at=-0.3,-1.2,1.5,-0.7,1.1,0.4";
    let shown = check(&["robots/ur5e.urdf", q]);
    assert_eq!(shown.status.code(), Some(0));
    let text = stdout(&shown);
    for expected in [
        "  q            -0.3,-1.2,1.5,-0.7,1.1,0.4\n",
        "  translation  ",
        "  rotation     ",
        "  closed form\n     1. ",
        ", this is q\n",
        "  numerical search\n     1. ",
        ", answered as 8\n",
        "  lost 0, unsound 0, doubled 0\n",
    ] {
        assert!(text.contains(expected), "no `{expected}` in\n{text}");
    }
    let json = check(&[
        "robots/ur5e.urdf",
        "--at",
        "-0.3, -1.2, 1.5, -0.7, 1.1, 0.4",
        "--json",
    ]);
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    let replay = &json["files"][0]["replay"];
    assert_eq!(replay["q"][0], -0.3);
    assert_eq!(replay["solutions"].as_array().unwrap().len(), 8);
    assert_eq!(replay["found"].as_array().unwrap().len(), 8);
    assert_eq!(replay["rotation"][2].as_array().unwrap().len(), 3);
    assert_eq!(replay["tally"]["lost"]["regular"], 0);
}

#[test]
fn a_configuration_has_a_value_for_each_joint() {
    let refused = check(&["robots/ur5e.urdf", "--at", "1,2,3"]);
    assert_eq!(refused.status.code(), Some(1));
    assert_eq!(
        stderr(&refused),
        "robots/ur5e.urdf: --at has 3 values, and the arm 6 joints\nhelp: give a number for each of \
         shoulder_pan_joint, shoulder_lift_joint, elbow_joint, wrist_1_joint, wrist_2_joint, \
         wrist_3_joint, radians and metres\n"
    );
    let wrong = check(&["robots/ur5e.urdf", "--at", "1,2,x"]);
    assert_eq!(wrong.status.code(), Some(2));
    let infinite = check(&["robots/ur5e.urdf", "--at", "1,2,3,4,5,inf"]);
    assert_eq!(infinite.status.code(), Some(1));
}

#[test]
fn an_oracle_needs_targets() {
    assert_eq!(
        check(&["robots/scara.yaml", "--oracle", "5"]).status.code(),
        Some(2)
    );
    assert_eq!(
        check(&["robots/scara.yaml", "--seed", "5"]).status.code(),
        Some(2)
    );
}

/// Right angles of ten digits are right, and of five joints that are off by these the other solutions
/// miss their target by more than what the search takes, and less than what solutions may.
#[test]
fn the_search_is_no_stricter_than_what_it_is_held_against() {
    let text = "\
robot: desk
units: {angle: rad, length: m}
dh:
  - {name: j1, theta: 0, d: 0.069, a: 0, alpha: 1.5707963268}
  - {name: j2, theta: 1.5707963268, d: 0, a: 0.146, alpha: 0}
  - {name: j3, theta: -1.5707963268, d: 0, a: 0.187, alpha: 0}
  - {name: j4, theta: -1.5707963268, d: 0, a: 0, alpha: -1.5707963268}
  - {name: j5, theta: 0, d: 0.086, a: 0, alpha: 0}
";
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("desk.yaml");
    std::fs::write(&file, text).unwrap();
    let sweep = ["--targets", "2000", "--aligned", "--oracle", "10"];
    let swept = check(&[&[file.to_str().unwrap()][..], &sweep].concat());
    assert_eq!(swept.status.code(), Some(0), "{}", stdout(&swept));
    assert!(
        stdout(&swept).contains("missing 0, extra 0"),
        "{}",
        stdout(&swept)
    );
}
