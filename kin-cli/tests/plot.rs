//! `kin plot`: the pictures that it writes.

use kin_cli::{Done, Exit};
use std::fs;
use std::path::{Path, PathBuf};

fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn plot(robot: &str, from: &str, to: &str, output: &Path) -> Done {
    let (from, to) = (format!("--from={from}"), format!("--to={to}"));
    let output = output.to_str().unwrap();
    kin_cli::run([
        "kin", "plot", robot, &from, &to, "--steps", "30", "-o", output,
    ])
}

#[test]
fn a_panel_for_each_joint() {
    let (svg, png) = (temporary("scara.svg"), temporary("scara.png"));
    let scara = "../robots/scara.yaml";
    for output in [&svg, &png] {
        let done = plot(scara, "0.3,0.8,0.05,0.2", "0.9,1.1,0.02,-0.4", output);
        assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
        assert!(
            done.stdout.starts_with("31 of 31 points within limits"),
            "{}",
            done.stdout
        );
    }
    let text = fs::read_to_string(svg).unwrap();
    for (words, count) in [
        ("in °", 3),
        ("in mm", 6),
        ("along the path in mm", 5),
        ("branch 1", 1),
    ] {
        assert_eq!(text.matches(words).count(), count, "{words}");
    }
    // What is taken: one curve in each panel, and the line of the legend.
    let taken = text
        .lines()
        .filter(|line| line.contains("stroke=\"#14161A\"") && line.contains("stroke-width=\"3\""));
    assert_eq!(taken.count(), 6);
    assert_eq!(fs::read(png).unwrap()[..4], *b"\x89PNG");
}

#[test]
fn names_stay_text() {
    let robot = temporary("hostile_plot.yaml");
    let name = "</text><script>alert(1)</script>&";
    let text = format!(
        "robot: \"{name}\"\nunits: {{angle: rad, length: m}}\nbase: frame\nscrews:\n  \
         - {{name: \"{name}\", axis: [0, 0, 1], point: [0, 0, 0]}}\n  \
         - {{name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}}\nhome: {{xyz: [0.9, 0, 0]}}\n"
    );
    fs::write(&robot, text).unwrap();
    let svg = temporary("hostile.svg");
    let done = plot(robot.to_str().unwrap(), "0.3,0.8", "0.9,1.1", &svg);
    assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
    let text = fs::read_to_string(svg).unwrap();
    assert!(!text.contains("<script"));
    assert_eq!(text.matches("&lt;script&gt;").count(), 2);
}

#[test]
fn what_is_wrong_is_said() {
    let svg = temporary("wrong.svg");
    let done = plot("../robots/scara.yaml", "0.3,0.8", "0.9,1.1,0.02,-0.4", &svg);
    assert_eq!(done.exit, Exit::Usage);
    assert!(
        done.stderr
            .starts_with("`--from` takes 4 finite numbers, for "),
        "{}",
        done.stderr
    );
    let nan = plot(
        "../robots/scara.yaml",
        "0.3,0.8,0,0",
        "0.9,NaN,0.02,-0.4",
        &svg,
    );
    assert!(
        nan.stderr
            .starts_with("`--to` takes 4 finite numbers, for ")
    );
    let gif = temporary("wrong.gif");
    let done = plot(
        "../robots/scara.yaml",
        "0,0.8,0,0",
        "0.9,1.1,0.02,-0.4",
        &gif,
    );
    assert_eq!(done.exit, Exit::Usage);
    assert!(done.stderr.contains("pictures are written as .svg or .png"));
    assert!(!gif.exists());
}
