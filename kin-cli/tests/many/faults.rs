//! What is said about tables that cannot be taken.

use super::*;

/// What `kin` says of a table.
fn said(command: &str, name: &str, bytes: &[u8]) -> String {
    let folder = folder(&format!("fault_{command}_{}", name.replace('.', "_")));
    let (input, output) = (folder.join(name), folder.join("out.csv"));
    fs::write(&input, bytes).unwrap();
    let done = kin(command, "ur5e.urdf", &input, &output, &[]);
    assert_eq!(done.exit, Exit::Broken, "{name}: {}", done.stderr);
    assert!(!output.exists(), "{name}");
    let (reason, remedy) = done.stderr.split_once("\nhelp: ").unwrap();
    assert!(!remedy.trim().is_empty());
    let (_, behind) = reason.split_once(&format!("/{name}: ")).unwrap();
    behind.to_owned()
}

const NAMES: &str = "shoulder_pan_joint,shoulder_lift_joint,elbow_joint,\
                     wrist_1_joint,wrist_2_joint,wrist_3_joint";

#[test]
fn text_that_is_no_table_is_told_by_row_and_column() {
    let rows = |rows: &str| format!("{NAMES}\n0,0,0,0,0,0\n{rows}\n");
    let long = format!("{NAMES}\n\"{}", "1".repeat(3 << 20));
    for (text, expected) in [
        (String::new(), "is empty"),
        ("\n\n".into(), "is empty"),
        ("\u{feff}".into(), "the first line cannot be read"),
        (
            "a,b\n1,2\n".into(),
            "no column `shoulder_pan_joint`; there are `a`, `b`",
        ),
        (
            "0.1,0.2\n".into(),
            "the first line has the number 0.1 in place of a name",
        ),
        (
            format!("{NAMES},elbow_joint\n"),
            "two columns are called `elbow_joint`",
        ),
        (
            rows("1,2,abc,4,5,6"),
            "row 1, column `elbow_joint`: `abc` is no number",
        ),
        (
            rows("1,2,\u{1b}[31m,4,5,6"),
            "row 1, column `elbow_joint`: `\\u{1b}[31m` is no number",
        ),
        (
            rows("1,2,3"),
            "row 1: 3 fields, where the first line has 6 names",
        ),
        (
            rows("1,2,3,4,5,6\"\n1,2,3,4,5,6"),
            "row 1, column `wrist_3_joint`",
        ),
        (
            long,
            "row 0: the row does not end within a million characters",
        ),
    ] {
        let said = said("fk", "joints.csv", text.as_bytes());
        assert!(said.starts_with(expected), "{expected}\n{said}");
    }
}

#[test]
fn columns_that_make_no_poses_are_told() {
    for (names, expected) in [
        ("x,y", "no columns for the position; there are `x`, `y`"),
        (
            "x,y,z",
            "no columns for the rotation; there are `x`, `y`, `z`",
        ),
        ("x,x,y,z,qx,qy,qz,qw", "two columns are called `x`"),
        (
            "pose.x,x,y,z,qx,qy,qz,qw",
            "the columns `pose.x` and `x` are the same",
        ),
        (
            "x,y,z,tx,ty,tz",
            "a row has its position twice, as `x` and `tx`",
        ),
        (
            "x,y,z,qx,qy,qz,qw,r00,r01,r02,r10,r11,r12,r20,r21,r22",
            "a row has its rotation twice, as a quaternion and as a matrix",
        ),
    ] {
        assert_eq!(said("ik", "poses.csv", names.as_bytes()), expected);
    }
    let long = said("ik", "poses.csv", "long".repeat(100_000).as_bytes());
    assert!(long.len() < 200 && long.ends_with("longlong` …"), "{long}");
}

/// A rail called `y` in front of an arm, as they often are, and poses with a column `y`.
#[test]
fn a_column_of_a_joint_is_none_of_a_pose() {
    let folder = folder("rail");
    let file = folder.join("rail.yaml");
    let arm = fs::read_to_string(robot("ur10e.yaml")).unwrap();
    let rail = "  - {name: y, type: prismatic, a: 0, alpha: 0, theta: 0, limits: [0, 2]}\n";
    let (head, rows) = arm.split_once("dh:\n").unwrap();
    fs::write(&file, format!("{head}dh:\n{rail}{rows}")).unwrap();
    let file = file.to_str().unwrap();
    let (poses, output) = (folder.join("poses.csv"), folder.join("out.csv"));
    let asked = |names: &str, options: &[&str]| {
        let values = "0.4,0.3,0.5,0,0,0,1,0.5";
        let count = names.split(',').count();
        let values: Vec<&str> = values.split(',').take(count).collect();
        fs::write(&poses, format!("{names}\n{}\n", values.join(","))).unwrap();
        kin(
            "ik",
            file,
            &poses,
            &output,
            &[&["--free", "y"], options].concat(),
        )
    };
    for names in ["x,y,z,qx,qy,qz,qw", "px,y,z,qx,qy,qz,qw"] {
        let refused = asked(names, &[]);
        assert_eq!(refused.exit, Exit::Broken, "{names}");
        let expected = "the column `y` has the values of the joint `y`, not what poses have so\n\
                        help: call the columns of the pose `px`, `py`, `pz`";
        assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    }
    // What is missing is not what the joint has taken.
    let refused = asked("px,py,pz,y", &[]);
    let expected = "no columns for the rotation; there are `px`, `py`, `pz`, `y`";
    assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    let rail_of = |done: Done| {
        succeeds(done);
        let rows = csv(&output);
        let column = rows[0].split(',').position(|name| name == "y").unwrap();
        let value = |row: &String| row.split(',').nth(column).unwrap().to_owned();
        let values: Vec<String> = rows[1..].iter().map(value).collect();
        assert!(!values.is_empty());
        values
    };
    for value in rail_of(asked("px,py,pz,qx,qy,qz,qw,y", &[])) {
        assert_eq!(value, "0.5");
    }
    for value in rail_of(asked("x,y,z,qx,qy,qz,qw", &["--at", "0.7"])) {
        assert_eq!(value, "0.7");
    }
    let joints = folder.join("joints.csv");
    fs::write(&joints, format!("y,{NAMES}\n0.5,0,-1,1,0,1,0\n")).unwrap();
    let clash = kin("fk", file, &joints, &output, &["--free", "y"]);
    assert!(
        clash
            .stderr
            .contains("the robot has a joint `y`, as the poses have a column"),
        "{}",
        clash.stderr
    );
    let options = ["--free", "y", "--matrix"];
    let matrices = folder.join("matrices.csv");
    succeeds(kin("fk", file, &joints, &matrices, &options));
    for value in rail_of(kin("ik", file, &matrices, &output, &["--free", "y"])) {
        assert_eq!(value, "0.5");
    }
}

#[test]
fn degrees_are_seen_by_joints_far_beyond_their_stops() {
    let folder = folder("degrees");
    let (joints, poses) = (folder.join("joints.csv"), folder.join("poses.csv"));
    fs::write(&joints, format!("{NAMES}\n0,1,2,1,2,3\n10,-90,90,0,45,0\n")).unwrap();
    let done = succeeds(kin("fk", "ur5e.urdf", &joints, &poses, &[]));
    let expected = "row 1: joint `shoulder_lift_joint` at -90 is more than a turn beyond its stops\n\
                    help: values are radians and metres, not degrees";
    assert!(done.stderr.contains(expected), "{}", done.stderr);
    fs::write(&joints, format!("{NAMES}\n0,6.3,-12,1,2,3\n")).unwrap();
    assert_eq!(
        succeeds(kin("fk", "ur5e.urdf", &joints, &poses, &[])).stderr,
        ""
    );
}

#[test]
fn arrays_that_are_no_rows_of_numbers_are_told() {
    let array = |descr: &str, shape: &str| kin_cli::table::npy_head(descr, shape, 0);
    let fortran =
        String::from_utf8_lossy(&array("'<f8'", "(2, 6)")[10..]).replace("False", "True ");
    let fortran = [&array("'<f8'", "(2, 6)")[..10], fortran.as_bytes()].concat();
    for (bytes, expected) in [
        (vec![], "is no NPY file"),
        (b"\x93NUMPY\x01\x00\xff\xff{".to_vec(), "is no NPY file"),
        (
            b"\x93NUMPY\x02\x00\xff\xff\xff\xff{".to_vec(),
            "is no NPY file",
        ),
        (array("'<f8'", "-1"), "is no NPY file"),
        (array("'<f8'", "()"), "has no rows"),
        (array("'<f8'", "(2, 0)"), "has rows of no numbers"),
        (
            array("'<f8'", "(2, 5)"),
            "rows of 5 numbers, where the robot has 6 joints",
        ),
        (
            array("'<f8'", "(2, 4000000000, 4000000000)"),
            "has rows of more than 10000 numbers",
        ),
        (array("'<f8'", "(2, 6)"), "ends after 0 of 2 rows"),
        (
            array("'<f8'", "(9223372036854775807, 6)"),
            "ends after 0 of 9223372036854775807 rows",
        ),
        (
            array("'>f8'", "(2, 6)"),
            "has the type `>f8`, where integers, truth values and little-endian reals of 4 or 8 bytes are read",
        ),
        (
            array("'<c16'", "(2, 6)"),
            "has the type `<c16`, where integers, truth values and little-endian reals of 4 or 8 bytes are read",
        ),
        (
            array("'|O'", "(2, 6)"),
            "has the type `|O`, where integers, truth values and little-endian reals of 4 or 8 bytes are read",
        ),
        (
            array("[('a', '<f8')]", "(2,)"),
            "no column `shoulder_pan_joint`; there are `a`",
        ),
        (
            array("[('a', '<f8', (3,))]", "(2,)"),
            "has fields with titles or of several numbers",
        ),
        (array("[]", "(2,)"), "has rows of no numbers"),
        (fortran, "has its numbers column by column (Fortran order)"),
    ] {
        assert_eq!(said("fk", "joints.npy", &bytes), expected);
    }
}

#[test]
fn files_that_are_none_of_these_are_told() {
    assert_eq!(
        said("fk", "joints.csv", b"\xff\xfea\0,\0b\0\n\0"),
        "is in UTF-16"
    );
    assert!(said("fk", "joints.parquet", b"").starts_with("is no Parquet file: "));
    assert!(said("fk", "joints.parquet", b"PAR1....PAR1").starts_with("is no Parquet file: "));
    for (name, bytes, found) in [
        ("packed.csv", &b"PAR1\x15\x04\x15\x80\0"[..], "parquet"),
        ("array.csv", b"\x93NUMPY\x01\0v\0", "npy"),
        ("array.parquet", b"\x93NUMPY\x01\0v\0", "npy"),
    ] {
        let expected = format!("the content is that of a `.{found}` file");
        assert_eq!(said("fk", name, bytes), expected);
    }
    let said = said("fk", "joints.txt", b"");
    assert_eq!(said, "the name does not tell the format of the table");

    let folder = folder("missing");
    let input = folder.join("joints.csv");
    let done = kin("fk", "ur5e.urdf", &input, &folder.join("out.csv"), &[]);
    assert!(
        done.stderr.contains("joints.csv: cannot be read: "),
        "{}",
        done.stderr
    );
    fs::write(&input, format!("{NAMES}\n")).unwrap();
    let nowhere = folder.join("no/folder/out.csv");
    let done = kin("fk", "ur5e.urdf", &input, &nowhere, &[]);
    assert!(
        done.stderr.contains("out.csv: cannot be written: "),
        "{}",
        done.stderr
    );
    let done = kin("fk", "ur5e.urdf", &input, &input, &[]);
    assert!(
        done.stderr.contains("joints.csv: is the input"),
        "{}",
        done.stderr
    );
    assert_eq!(fs::read_to_string(&input).unwrap(), format!("{NAMES}\n"));
    let done = kin(
        "fk",
        "ur5e.urdf",
        &input,
        &folder.join("out.csv"),
        &["--share", "2/2"],
    );
    assert!(
        done.stderr
            .contains("joints.csv: is one table, and `--share` takes"),
        "{}",
        done.stderr
    );
}

#[test]
fn a_table_without_rows_has_none() {
    let folder = folder("no_rows");
    fs::write(folder.join("joints.csv"), NAMES).unwrap();
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
            &[],
        ));
        let columns = read(&file("solutions"), &[0, 1, 2]).unwrap();
        assert_eq!(columns, vec![Vec::<f64>::new(); 3]);
    }
}

#[test]
fn options_that_say_nothing_of_this_robot_are_refused() {
    let folder = folder("options");
    let input = folder.join("poses.csv");
    fs::write(&input, "x,y,z,qx,qy,qz,qw\n").unwrap();
    for (file, options, expected) in [
        (
            "ur5e.urdf",
            &["--at", "1"][..],
            "nothing is given beside a pose of this robot",
        ),
        (
            "panda.yaml",
            &["--at", "1,2"],
            "`--at` has 2 values, for joint7",
        ),
        (
            "panda.yaml",
            &["--at", "nan"],
            "of `--at` have to be finite",
        ),
        (
            "ur5e.urdf",
            &["--no-ik"],
            "leave out `--no-ik` (`--ik none`)",
        ),
        (
            "ur5e.urdf",
            &["--share", "3/2"],
            "two numbers, for example 3/16",
        ),
        ("ur5e.urdf", &["--batch", "0"], "0 is not in 1..=1000000"),
    ] {
        let done = kin("ik", file, &input, &folder.join("out.csv"), options);
        assert_eq!(done.exit, Exit::Usage);
        assert!(done.stderr.contains(expected), "{}", done.stderr);
    }
}
