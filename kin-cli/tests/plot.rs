//! `kin plot`: the pictures that it writes.

use kin_cli::{Done, Exit};
use std::fmt::Write;
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

fn plot_table(robot: &str, table: &Path, output: &Path) -> Done {
    let [table, output] = [table, output].map(|path| path.to_str().unwrap());
    kin_cli::run(["kin", "plot", robot, table, "-o", output])
}

/// A table of a closed curve that a UR5e follows, and one target that it cannot reach.
fn curve(name: &str) -> PathBuf {
    let mut text = String::from("x,y,z,qx,qy,qz,qw\n");
    for k in 0..40 {
        let angle = std::f64::consts::TAU * f64::from(k) / 40.0;
        let (sin, cos) = angle.sin_cos();
        let x = if k == 30 { 9.0 } else { 0.4 + 0.15 * cos };
        let _ = writeln!(text, "{x},{},{},1,0,0,0", 0.25 * sin, 0.35 + 0.1 * sin);
    }
    let path = temporary(name);
    fs::write(&path, text).unwrap();
    path
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
        ("in m<", 0),
        ("in m\n", 6),
        ("along the path in mm", 5),
        ("branch 1", 1),
    ] {
        assert_eq!(text.matches(words).count(), count, "{words}");
    }
    // What is taken: one curve in each panel, and the line of the legend.
    let taken = |line: &&str| {
        let is_line = line.contains("stroke=\"#14161A\"") && line.contains("stroke-width=\"12\"");
        let of_views = line.contains("points=") && line.matches(',').count() <= 2;
        is_line && !of_views
    };
    assert_eq!(text.lines().filter(taken).count(), 5);
    assert!(
        text.starts_with("<svg width=\"1200\" height=\""),
        "{}",
        &text[..80]
    );
    assert!(text.contains("viewBox=\"0 0 4800 "));
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
            .starts_with("`--from` takes 4 finite numbers below 1e12, for "),
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
            .starts_with("`--to` takes 4 finite numbers below 1e12, for ")
    );
    let far = plot(
        "../robots/scara.yaml",
        "0.3,0.8,0,0",
        "1e307,0.1,0.02,-0.4",
        &svg,
    );
    assert!(
        far.stderr
            .starts_with("`--to` takes 4 finite numbers below 1e12")
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

#[test]
fn poses_and_their_solutions_are_one_picture() {
    let (ur5e, table) = ("../robots/ur5e.urdf", curve("curve.csv"));
    let drawn = |table: &Path| {
        let svg = temporary("curve.svg");
        let done = plot_table(ur5e, table, &svg);
        assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
        // One of 40 is out of reach, and the wrist keeps its way.
        assert!(
            done.stdout
                .starts_with("39 of 40 points within limits; least singular value"),
            "{}",
            done.stdout
        );
        fs::read_to_string(svg).unwrap()
    };
    let of_poses = drawn(&table);
    assert_eq!(of_poses.matches("target of the table").count(), 7);
    for ending in ["csv", "npy", "parquet"] {
        let solutions = temporary(&format!("curve_solutions.{ending}"));
        let done = kin_cli::run([
            "kin",
            "ik",
            ur5e,
            table.to_str().unwrap(),
            "-o",
            solutions.to_str().unwrap(),
        ]);
        assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
        assert!(drawn(&solutions) == of_poses, "{ending}");
    }
}

#[test]
fn a_table_of_joints_is_taken_as_it_stands() {
    let table = temporary("joints.csv");
    // The second row has a gap, the last one is beyond the limit of the first joint.
    fs::write(
        &table,
        "wrist_3_joint,shoulder_pan_joint,shoulder_lift_joint,elbow_joint,wrist_1_joint,wrist_2_joint\n\
         0.2,0.3,-1.2,1.1,0.4,0.8\n0.2,,-1.2,1.1,0.4,0.8\n0.2,7.0,-1.2,1.1,0.4,0.8\n",
    )
    .unwrap();
    let svg = temporary("joints.svg");
    let done = plot_table("../robots/ur5e.urdf", &table, &svg);
    assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
    assert!(
        done.stdout.starts_with("1 of 3 points within limits"),
        "{}",
        done.stdout
    );
    assert!(!done.stdout.contains("degrees"), "{}", done.stdout);
    let degrees = temporary("degrees.csv");
    fs::write(
        &degrees,
        "shoulder_pan_joint,shoulder_lift_joint,elbow_joint,wrist_1_joint,wrist_2_joint,wrist_3_joint\n\
         10,-90,90,0,45,0\n",
    )
    .unwrap();
    let done = plot_table("../robots/ur5e.urdf", &degrees, &temporary("degrees.svg"));
    assert_eq!(
        done.stdout.lines().last().unwrap(),
        "joint `shoulder_lift_joint` at -90 is more than a turn beyond its stops: values are radians \
         and metres, not degrees"
    );
    let (from, to) = ("0.1,-1.2,1.1,0.4,0.8,0", "30,-70,90,20,40,0");
    let done = plot("../robots/ur5e.urdf", from, to, &temporary("degrees.svg"));
    assert_eq!(
        done.stdout.lines().last().unwrap(),
        "joint `shoulder_pan_joint` at 30 is more than a turn beyond its stops: values are radians \
         and metres, not degrees"
    );
    assert_eq!(
        fs::read_to_string(svg)
            .unwrap()
            .matches("row of the table")
            .count(),
        7
    );
}

#[test]
fn mechanisms_are_driven_and_follow_tables() {
    let delta = "../robots/delta.yaml";
    let svg = temporary("delta.svg");
    let done = plot(delta, "0,0,0", "0.5,0.9,1.2", &svg);
    assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
    assert!(
        done.stdout
            .starts_with("31 of 31 points within limits; distance from actuator singularities 0."),
        "{}",
        done.stdout
    );
    let text = fs::read_to_string(&svg).unwrap();
    for (words, count) in [
        ("motor", 3),
        ("along the drive in %", 4),
        ("all postures", 1),
        ("elbow", 0),
    ] {
        assert_eq!(text.matches(words).count(), count, "{words}");
    }
    // The base and the platform of the one figure that is in front, where they are no lines.
    assert_eq!(text.matches("<polygon opacity=\"0.16\"").count(), 2);

    // Positions, the last of which is out of reach; then the motors that lead to the others.
    let table = temporary("delta_positions.csv");
    fs::write(
        &table,
        "x,y,z\n0,0,-0.2\n0.03,0,-0.2\n0.05,0.02,-0.21\n0,0,-3\n",
    )
    .unwrap();
    let done = plot_table(delta, &table, &svg);
    assert!(
        done.stdout.starts_with("3 of 4 points within limits"),
        "{}",
        done.stderr
    );
    let motors = temporary("five_bar_motors.csv");
    fs::write(
        &motors,
        "right_motor,left_motor\n0.1,0.2\n0.1,0.25\n-1.5,1.5\n",
    )
    .unwrap();
    let done = plot_table("../robots/five_bar.yaml", &motors, &svg);
    assert!(
        done.stdout.starts_with("2 of 3 points"),
        "{}{}",
        done.stdout,
        done.stderr
    );
}

#[test]
fn what_is_wrong_with_a_table_is_said() {
    let svg = temporary("wrong_table.svg");
    let says = |robot: &str, name: &str, text: &str, expected: &[&str]| {
        let table = temporary(name);
        fs::write(&table, text).unwrap();
        let done = plot_table(robot, &table, &svg);
        assert_eq!(done.exit, Exit::Broken, "{}", done.stdout);
        for words in expected {
            assert!(done.stderr.contains(words), "{words}: {}", done.stderr);
        }
    };
    let scara = "../robots/scara.yaml";
    says(
        scara,
        "neither.csv",
        "a,b\n1,2\n",
        &[
            "no columns for the position; there are `a`, `b`",
            "; or after the joints: ",
        ],
    );
    says(
        scara,
        "empty.csv",
        "x,y,z,qx,qy,qz,qw\n",
        &["the table has no rows\nhelp: give it a row for each point of the path"],
    );
    says(
        scara,
        "bent.csv",
        "x,y,z,qx,qy,qz,qw\n0,0,0,1,1,0,0\n",
        &["bent.csv: row 0: the quaternion has not the length 1"],
    );
    says(
        scara,
        "gaps.csv",
        "shoulder,elbow,wrist,lift\n1,nan,0,0\n1,,0,inf\n",
        &["gaps.csv: no row has a finite number for every joint\nhelp: give values of the joints"],
    );
    says(
        "../robots/delta.yaml",
        "gap.csv",
        "motor1,motor2,motor3\n1,nan,0\n",
        &["gap.csv: no row has a finite number for every joint"],
    );
    let mut long = String::from("x,y,z\n");
    long += &"0,0,-0.2\n".repeat(100_001);
    says(
        "../robots/delta.yaml",
        "long.csv",
        &long,
        &[
            "a picture has no room for more than 100000 rows",
            "plot some of them, or every hundredth",
        ],
    );
    says(
        "../robots/delta.yaml",
        "other.csv",
        "a\n1\n",
        &["; or after the joints: motor1, motor2, motor3"],
    );
    let done = plot("../robots/five_bar.yaml", "1.5,-1.5", "0,0", &svg);
    assert_eq!(done.exit, Exit::Usage);
    assert!(
        done.stderr
            .starts_with("`--from` is no place that the actuated joints bring the mechanism"),
        "{}",
        done.stderr
    );
    let done = plot("../robots/delta.yaml", "0,0", "0,0,0", &svg);
    assert!(
        done.stderr
            .starts_with("`--from` takes 3 finite numbers below 1e12, for motor1, motor2, motor3"),
        "{}",
        done.stderr
    );
    let done = kin_cli::run(["kin", "plot", scara, "-o", "nowhere.svg"]);
    assert_eq!(done.exit, Exit::Usage);
}
