//! Answers against the generic product of exponentials, and against each other.

use super::*;
use kinematics::{JointLimit, Pose, RobotOptions, Target};

/// Of a table of solutions.
struct Solution {
    target: usize,
    branch: f64,
    q: Vec<f64>,
    residual: f64,
}

fn solutions(path: &Path, joints: usize) -> Vec<Solution> {
    let columns = read(path, &(0..joints + 3).collect::<Vec<_>>()).unwrap();
    let solution = |row: usize| Solution {
        target: columns[0][row] as usize,
        branch: columns[1][row],
        q: columns[2..joints + 2]
            .iter()
            .map(|column| column[row])
            .collect(),
        residual: columns[joints + 2][row],
    };
    (0..columns[0].len()).map(solution).collect()
}

/// Joint values, poses and solutions in every format: whatever the generic chain says.
#[test]
fn every_solution_reaches_its_target_in_every_format() {
    let folder = folder("formats");
    let robot = load("ur5e.urdf", RobotOptions::default());
    let rows = joints(&robot, 100, &folder.join("joints.csv"));
    for format in ALL {
        let file = |name: &str| folder.join(name).with_extension(format.extension());
        succeeds(kin(
            "fk",
            "ur5e.urdf",
            &folder.join("joints.csv"),
            &file("poses"),
            &[],
        ));
        succeeds(kin(
            "ik",
            "ur5e.urdf",
            &file("poses"),
            &file("solutions"),
            &["--batch", "7"],
        ));
        let solutions = solutions_of(&folder, format);
        for (target, q) in rows.iter().enumerate() {
            let pose = robot.chain().fk(q);
            let here = solutions.iter().filter(|it| it.target == target);
            let mut is_found = false;
            for solution in here {
                let reached = robot.chain().fk(&solution.q);
                let residual = Target::Pose.distance(&reached, &pose, 1.0);
                assert!(residual < 1e-9 && solution.residual < 1e-9);
                is_found |= solution.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-6);
            }
            assert!(is_found, "{target}: {q:?}");
        }
        let count: usize = rows.iter().map(|q| robot.ik(&robot.fk(q)).len()).sum();
        assert_eq!(solutions.len(), count);
    }
    // All of it again, to the last bit, from the shortest digits and from bytes.
    let [text, array, groups] = ALL.map(|format| solutions_of(&folder, format));
    for other in [array, groups] {
        assert_eq!(text.len(), other.len());
        for (a, b) in text.iter().zip(&other) {
            assert_eq!((a.target, a.branch, &a.q), (b.target, b.branch, &b.q));
        }
    }
}

fn solutions_of(folder: &Path, format: Format) -> Vec<Solution> {
    solutions(
        &folder.join("solutions").with_extension(format.extension()),
        6,
    )
}

#[test]
fn poses_are_in_the_order_of_rows_however_many_are_taken_at_once() {
    let folder = folder("order");
    let robot = load("ur5e.urdf", RobotOptions::default());
    let rows = joints(&robot, 200, &folder.join("joints.csv"));
    let poses = |batch: &str| {
        let output = folder.join(format!("poses{batch}.csv"));
        let input = folder.join("joints.csv");
        succeeds(kin("fk", "ur5e.urdf", &input, &output, &["--batch", batch]));
        output
    };
    let one = poses("1");
    assert_eq!(fs::read(&one).unwrap(), fs::read(poses("64")).unwrap());
    assert_eq!(fs::read(&one).unwrap(), fs::read(poses("1000")).unwrap());
    let columns = read(&one, &[0, 1, 2, 3, 4, 5, 6]).unwrap();
    for (row, q) in rows.iter().enumerate() {
        let [x, y, z, qx, qy, qz, qw] = std::array::from_fn(|i| columns[i][row]);
        let read = Pose::from_quaternion([qx, qy, qz, qw], [x, y, z]);
        assert!(Target::Pose.distance(&read, &robot.chain().fk(q), 1.0) < 1e-12);
    }
}

/// What is given beside a pose goes from one table to the next: a joint, the swivel angle, the turn
/// of the tool.
#[test]
fn poses_are_written_with_what_is_given_beside_them() {
    for (file, options, name) in [
        ("panda.yaml", &["--given"][..], "joint7"),
        ("panda.yaml", &["--free", "joint3"], "joint3"),
        ("iiwa14.yaml", &["--given"], "swivel"),
        (
            "xarm6.yaml",
            &["--given", "--target", "position_axis"],
            "turn",
        ),
    ] {
        let folder = folder(&format!("given_{name}"));
        let [input, poses, output] =
            ["joints.csv", "poses.csv", "solutions.csv"].map(|it| folder.join(it));
        let target = options.contains(&"position_axis");
        let robot = load(
            file,
            RobotOptions {
                target: target.then_some(Target::PositionAxis),
                ..RobotOptions::default()
            },
        );
        let rows = joints(&robot, 10, &input);
        succeeds(kin("fk", file, &input, &poses, options));
        let head = csv(&poses)[0].clone();
        assert!(head.ends_with(&format!("qw,{name}")), "{head}");
        let others: Vec<&str> = options
            .iter()
            .copied()
            .filter(|it| *it != "--given")
            .collect();
        succeeds(kin("ik", file, &poses, &output, &others));
        let solutions = csv(&output);
        for (row, q) in rows.iter().enumerate() {
            let is_it = |line: &&String| {
                let mut fields = line
                    .split(',')
                    .map(|it| it.parse::<f64>().unwrap_or(f64::NAN));
                let target = fields.next().unwrap();
                let near = |(a, b): (f64, &f64)| (0.5 * (a - b)).sin().abs() < 1e-6;
                target == row as f64 && fields.skip(1).zip(q).all(near)
            };
            assert!(
                solutions[1..].iter().any(|line| is_it(&line)),
                "{name} {q:?}"
            );
        }
    }
}

#[test]
fn an_arm_that_reaches_few_whole_poses_is_told_of_other_targets() {
    let folder = folder("few");
    let (input, output) = (folder.join("poses.csv"), folder.join("solutions.csv"));
    let names = ["x", "y", "z", "qx", "qy", "qz", "qw"];
    write(&input, &names, &[vec![0.3, 0.2, 0.3, 0.0, 0.6, 0.0, 0.8]]);
    let arm = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots/targets/welder.yaml");
    let done = succeeds(kin(
        "ik",
        arm.to_str().unwrap(),
        &input,
        &output,
        &["--target", "pose"],
    ));
    let expected = "help: a robot of 5 joints reaches few whole poses: say what of them counts, for \
                    example `--target position_axis`; poses are in metres";
    assert!(done.stderr.contains(expected), "{}", done.stderr);
}

#[test]
fn a_target_without_a_solution_has_a_row_if_asked_for() {
    let folder = folder("empty");
    let (input, output) = (folder.join("poses.csv"), folder.join("solutions.csv"));
    let names = ["x", "y", "z", "qx", "qy", "qz", "qw"];
    let far = vec![9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let near = vec![0.4, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0];
    let missing = vec![f64::NAN, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0];
    write(&input, &names, std::slice::from_ref(&far));
    let done = succeeds(kin("ik", "ur5e.urdf", &input, &output, &[]));
    assert!(
        done.stderr
            .contains("no row has a solution\nhelp: poses are in metres"),
        "{}",
        done.stderr
    );
    write(&input, &names, &[far, near, missing]);
    let done = succeeds(kin("ik", "ur5e.urdf", &input, &output, &[]));
    assert!(
        done.stdout.contains("of 3 rows, 1 of them without any"),
        "{}",
        done.stdout
    );
    assert!(
        done.stderr.contains("poses.csv: row 2: a value is missing"),
        "{}",
        done.stderr
    );
    assert!(csv(&output)[1..].iter().all(|row| row.starts_with("1,")));
    assert!(csv(&output).len() > 2);

    let kept = succeeds(kin("ik", "ur5e.urdf", &input, &output, &["--keep-empty"]));
    // Empty rows are no solutions.
    let [own, without] = [&kept, &done].map(|done| done.stdout.split(';').next());
    assert_eq!(own, without);
    let rows = csv(&output);
    let empty = ",-1,NaN,NaN,NaN,NaN,NaN,NaN,NaN,false,false";
    assert_eq!(rows[1], format!("0{empty}"));
    assert_eq!(rows[rows.len() - 1], format!("2{empty}"));

    let strict = kin(
        "ik",
        "ur5e.urdf",
        &input,
        &folder.join("strict.csv"),
        &["--strict"],
    );
    assert_eq!(strict.exit, Exit::Broken);
    assert!(
        strict
            .stderr
            .contains("poses.csv: row 2: a value is missing")
    );
    assert!(!folder.join("strict.csv").exists());
}

#[test]
fn limits_are_told_or_asked_for() {
    let folder = folder("limits");
    let robot = load("kr6_r900.yaml", RobotOptions::default());
    joints(&robot, 40, &folder.join("joints.csv"));
    let file = |name: &str| folder.join(name);
    succeeds(kin(
        "fk",
        "kr6_r900.yaml",
        &file("joints.csv"),
        &file("poses.npy"),
        &[],
    ));
    succeeds(kin(
        "ik",
        "kr6_r900.yaml",
        &file("poses.npy"),
        &file("all.csv"),
        &[],
    ));
    let inside = ["--within-limits"];
    succeeds(kin(
        "ik",
        "kr6_r900.yaml",
        &file("poses.npy"),
        &file("inside.csv"),
        &inside,
    ));
    let (all, inside) = (csv(&file("all.csv")), csv(&file("inside.csv")));
    let marked = all.iter().filter(|row| row.ends_with(",true,false"));
    assert_eq!(
        marked.collect::<Vec<_>>(),
        inside[1..].iter().collect::<Vec<_>>()
    );
    assert!(inside.len() > 40 && all.len() > inside.len());
    for solution in solutions(&file("inside.csv"), 6) {
        for (limit, &value) in robot.limits().iter().zip(&solution.q) {
            let off = (limit.lower() - value).max(value - limit.upper());
            assert!(off <= JointLimit::TOLERANCE);
        }
    }
}

/// A value that rests on its stop but for 8e-10 is within limits, and is not moved: its residual would
/// not be true of the stop.
#[test]
fn what_rests_on_a_stop_reaches_its_target() {
    let folder = folder("stop");
    let robot = load("kr6_r900.yaml", RobotOptions::default());
    let [input, poses, output] = ["joints.csv", "poses.npy", "all.csv"].map(|it| folder.join(it));
    let mut q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    q[1] = robot.limits()[1].upper() + 8e-10;
    let names = robot.joint_names().join(",");
    let values = q.map(|x| x.to_string()).join(",");
    fs::write(&input, format!("{names}\n{values}\n")).unwrap();
    succeeds(kin("fk", "kr6_r900.yaml", &input, &poses, &[]));
    let options = ["--within-limits"];
    succeeds(kin("ik", "kr6_r900.yaml", &poses, &output, &options));
    let solutions = solutions(&output, 6);
    let apart = |it: &Solution| {
        it.q.iter()
            .zip(q)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    };
    assert!(solutions.iter().any(|it| apart(it) < 1e-12));
    for solution in &solutions {
        let reached = robot.chain().fk(&solution.q);
        let missed = Target::Pose.distance(&reached, &robot.chain().fk(&q), 1.0);
        assert!(missed < 1e-13, "{missed:e}");
    }
}

/// What is given beside a target: by a column, or for all targets.
#[test]
fn arms_with_a_joint_to_spare_are_given_it() {
    for (file, name, target) in [
        ("panda.yaml", "joint7", None),
        ("iiwa14.yaml", "swivel", None),
        ("ur5e.urdf", "turn", Some(Target::PositionAxis)),
    ] {
        let folder = folder(name);
        let options = RobotOptions {
            target,
            ..RobotOptions::default()
        };
        let robot = load(file, options);
        assert_eq!(robot.parameter_names(), [name]);
        let rows = joints(&robot, 20, &folder.join("joints.csv"));
        let word = target.unwrap_or_default().word();
        let options = ["--target", word];
        let (input, output) = (folder.join("poses.csv"), folder.join("solutions.csv"));
        succeeds(kin("fk", file, &folder.join("joints.csv"), &input, &[]));
        let without = kin("ik", file, &input, &output, &options);
        assert!(
            without.stderr.contains(&format!("no column `{name}`")),
            "{}",
            without.stderr
        );

        let given = |q: &Vec<f64>| robot.redundancy(&robot.fk(q), q)[0];
        let mut lines = csv(&input);
        lines[0] += &format!(",{name}");
        for (line, q) in lines[1..].iter_mut().zip(&rows) {
            *line += &format!(",{}", given(q));
        }
        fs::write(folder.join("given.csv"), lines.join("\n")).unwrap();
        succeeds(kin(
            "ik",
            file,
            &folder.join("given.csv"),
            &output,
            &options,
        ));
        let found = solutions(&output, robot.joints());
        for (target, q) in rows.iter().enumerate() {
            let mut here = found.iter().filter(|it| it.target == target);
            let is_same = |it: &Solution| it.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-6);
            assert!(here.any(is_same), "{file}: {target}");
        }
        let value = given(&rows[0]).to_string();
        let for_all = [&options[..], &["--at", &value]].concat();
        succeeds(kin("ik", file, &input, &output, &for_all));
        let first = |found: Vec<Solution>| {
            let here = found.into_iter().filter(|it| it.target == 0);
            here.map(|it| it.q).collect::<Vec<_>>()
        };
        assert_eq!(first(solutions(&output, robot.joints())), first(found));
    }
}
