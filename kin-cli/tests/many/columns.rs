//! The forms that poses have in tables.

use super::*;
use kinematics::{Pose, RobotOptions};

/// Twenty poses of the UR5e in a folder, and its solutions to them as text.
fn poses(name: &str) -> (PathBuf, Vec<Pose>, Vec<String>) {
    let folder = folder(name);
    let robot = load("ur5e.urdf", RobotOptions::default());
    let rows = joints(&robot, 20, &folder.join("joints.csv"));
    let poses: Vec<Pose> = rows.iter().map(|q| robot.fk(q)).collect();
    let file = |name: &str| folder.join(name);
    succeeds(kin(
        "fk",
        "ur5e.urdf",
        &file("joints.csv"),
        &file("poses.csv"),
        &[],
    ));
    succeeds(kin(
        "ik",
        "ur5e.urdf",
        &file("poses.csv"),
        &file("solutions.csv"),
        &[],
    ));
    let solutions = csv(&file("solutions.csv"));
    (folder, poses, solutions)
}

/// Whether a file of the folder has the same solutions, to so many metres and radians.
fn same(folder: &Path, input: &str, solutions: &[String], by: f64) {
    let output = folder.join("again.csv");
    let done = succeeds(kin("ik", "ur5e.urdf", &folder.join(input), &output, &[]));
    assert_eq!(done.stderr, "", "{input}");
    let again = csv(&output);
    assert_eq!(again.len(), solutions.len(), "{input}");
    for (a, b) in again[1..].iter().zip(&solutions[1..]) {
        let numbers = |row: &str| -> Vec<f64> {
            row.split(',')
                .take(8)
                .map(|field| field.parse().unwrap())
                .collect()
        };
        let near = numbers(a)
            .into_iter()
            .zip(numbers(b))
            .all(|(a, b)| (a - b).abs() <= by);
        assert!(near, "{input}: {a}, {b}");
    }
}

#[test]
fn names_of_other_programs_are_taken() {
    let (folder, poses, solutions) = poses("names");
    let quaternion = |pose: &Pose| -> Vec<f64> {
        let ([x, y, z], [qx, qy, qz, qw]) = (pose.translation, pose.quaternion());
        // In another order, and with a column that is none of a pose.
        vec![0.5, qw, qx, qy, qz, z, y, x]
    };
    let rows: Vec<Vec<f64>> = poses.iter().map(quaternion).collect();
    for [q, p] in [
        ["q", ""],
        ["q", "t"],
        ["q", "p"],
        ["orientation.", "position."],
    ] {
        for prefix in ["", "pose."] {
            let mut names = vec!["stamp".to_owned()];
            names.extend(["w", "x", "y", "z"].map(|it| format!("{prefix}{q}{it}")));
            names.extend(["z", "y", "x"].map(|it| format!("{prefix}{p}{it}")));
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            write(&folder.join("named.csv"), &names, &rows);
            same(&folder, "named.csv", &solutions, 0.0);
        }
    }
}

#[test]
fn matrices_are_taken_row_by_row_and_from_few_digits() {
    let (folder, poses, solutions) = poses("matrices");
    let name = |i: usize| format!("m{}{}", i / 4, i % 4);
    let names: Vec<String> = (0..16).map(name).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let rows = |digits: f64| -> Vec<Vec<f64>> {
        let matrix = |pose: &Pose| pose.to_matrix().as_flattened().to_vec();
        let rounded = |row: Vec<f64>| row.iter().map(|x| (x * digits).round() / digits).collect();
        poses.iter().map(matrix).map(rounded).collect()
    };
    write(&folder.join("matrices.csv"), &names, &rows(1e15));
    same(&folder, "matrices.csv", &solutions, 1e-9);
    write(&folder.join("rounded.csv"), &names, &rows(1e9));
    same(&folder, "rounded.csv", &solutions, 1e-4);
    let mut last = rows(1e15);
    for row in &mut last {
        row[12..].copy_from_slice(&[1e-17, -1e-17, 0.0, 1.0 + 1e-15]);
    }
    write(&folder.join("last.csv"), &names, &last);
    same(&folder, "last.csv", &solutions, 1e-9);
    let twelve: Vec<Vec<f64>> = rows(1e15).iter().map(|row| row[..12].to_vec()).collect();
    write(&folder.join("twelve.csv"), &names[..12], &twelve);
    same(&folder, "twelve.csv", &solutions, 1e-9);
    // Column by column they are no poses, and none is made of them.
    let mut turned = rows(1e15);
    for row in &mut turned {
        *row = (0..16).map(|i| row[i % 4 * 4 + i / 4]).collect();
    }
    write(&folder.join("turned.csv"), &names, &turned);
    let output = folder.join("none.csv");
    let done = kin("ik", "ur5e.urdf", &folder.join("turned.csv"), &output, &[]);
    assert!(
        done.stderr
            .contains("it may be transposed; it and 19 others have no answer"),
        "{}",
        done.stderr
    );
    assert_eq!(csv(&output).len(), 1);
}

#[test]
fn an_array_of_matrices_is_taken_as_numpy_saves_it() {
    let (folder, poses, solutions) = poses("arrays");
    let entries = |pose: &Pose| pose.to_matrix().as_flattened().to_vec();
    for (shape, keep) in [("(20, 4, 4)", 16), ("(20, 3, 4)", 12), ("(20, 16)", 16)] {
        let mut bytes = kin_cli::table::npy_head("'<f8'", shape, 0);
        for pose in &poses {
            bytes.extend(entries(pose)[..keep].iter().flat_map(|x| x.to_le_bytes()));
        }
        fs::write(folder.join("array.npy"), &bytes).unwrap();
        same(&folder, "array.npy", &solutions, 1e-9);
    }
    let mut bytes = kin_cli::table::npy_head("'<f4'", "(20, 4, 4)", 0);
    for pose in &poses {
        bytes.extend(entries(pose).iter().flat_map(|x| (*x as f32).to_le_bytes()));
    }
    fs::write(folder.join("single.npy"), &bytes).unwrap();
    same(&folder, "single.npy", &solutions, 1e-2);
}

#[test]
fn text_is_taken_with_a_mark_quotes_and_other_separators() {
    let (folder, _, solutions) = poses("text");
    let text = fs::read_to_string(folder.join("poses.csv")).unwrap();
    let quoted = |line: &str| format!("\"{}\"", line.replace(',', "\",\""));
    let all_quoted: Vec<String> = text.lines().map(quoted).collect();
    let named = |line: &str| format!("\"a,b\";{}\n", line.replace(',', ";"));
    let comma_in_name: String = text.lines().map(named).collect();
    for (name, text) in [
        ("mark", format!("\u{feff}{text}")),
        ("breaks", text.replace('\n', "\r\n")),
        ("blank", text.replace('\n', "\n\n")),
        ("quotes", all_quoted.join("\r\n")),
        ("spaces", text.replace(',', " , ")),
        ("semicolons", text.replace(',', ";")),
        ("tabs", text.replace(',', "\t")),
        ("comma", comma_in_name),
        ("end", text.trim_end().to_owned()),
    ] {
        let name = format!("{name}.csv");
        fs::write(folder.join(&name), text).unwrap();
        same(&folder, &name, &solutions, 0.0);
    }
}

/// Only what counts of a target is needed, and read.
#[test]
fn positions_alone_are_targets_of_arms_that_reach_positions() {
    let folder = folder("positions");
    let file = folder.join("arm.yaml");
    let text = "
robot: arm
units: {angle: rad, length: m}
screws:
  - {name: waist, axis: [0, 0, 1], point: [0, 0, 0.5]}
  - {name: shoulder, axis: [0, 1, 0], point: [0.1, 0, 0.5]}
  - {name: elbow, axis: [0, 1, 0], point: [0.5, 0, 0.5]}
home: {xyz: [0.8, 0, 0.5]}
";
    fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let robot = load(file, RobotOptions::default());
    assert_eq!(robot.target(), kinematics::Target::Position);
    let rows = joints(&robot, 20, &folder.join("joints.csv"));
    let position = |q: &Vec<f64>| robot.fk(q).translation.to_vec();
    let positions: Vec<Vec<f64>> = rows.iter().map(position).collect();
    write(&folder.join("positions.csv"), &["x", "y", "z"], &positions);
    let output = folder.join("solutions.csv");
    succeeds(kin("ik", file, &folder.join("positions.csv"), &output, &[]));
    let joints: Vec<usize> = (0..robot.joints() + 2).collect();
    let columns = read(&output, &joints).unwrap();
    assert!(columns[0].len() >= 20);
    for row in 0..columns[0].len() {
        let q: Vec<f64> = columns[2..].iter().map(|column| column[row]).collect();
        let reached = robot.chain().fk(&q).translation;
        let wanted = &positions[columns[0][row] as usize];
        assert!(
            reached
                .iter()
                .zip(wanted)
                .all(|(a, b)| (a - b).abs() < 1e-9)
        );
    }
}

/// As other programs write Parquet: compressed, of other kinds of numbers, with values missing.
#[test]
fn values_that_parquet_leaves_out_are_missing() {
    use parquet::basic::{Compression, ZstdLevel};
    use parquet::data_type::{ByteArrayType, FloatType, Int32Type};
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    let folder = folder("nulls");
    let path = folder.join("numbers.parquet");
    let schema = "message numbers { optional float a; optional int32 b; optional binary c; }";
    let schema = parquet::schema::parser::parse_message_type(schema).unwrap();
    for compression in [
        Compression::UNCOMPRESSED,
        Compression::SNAPPY,
        Compression::LZ4_RAW,
        Compression::GZIP(Default::default()),
        Compression::ZSTD(ZstdLevel::default()),
    ] {
        let properties = WriterProperties::builder().set_compression(compression);
        let file = fs::File::create(&path).unwrap();
        let (schema, properties) = (schema.clone().into(), properties.build().into());
        let mut file = SerializedFileWriter::new(file, schema, properties).unwrap();
        let mut group = file.next_row_group().unwrap();
        let levels = [1, 0, 1, 1, 0];
        let mut column = group.next_column().unwrap().unwrap();
        let floats = [0.5, -1.0, 2.0];
        column
            .typed::<FloatType>()
            .write_batch(&floats, Some(&levels), None)
            .unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let integers = [7, 8, 9, 10, 11];
        column
            .typed::<Int32Type>()
            .write_batch(&integers, Some(&[1; 5]), None)
            .unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column
            .typed::<ByteArrayType>()
            .write_batch(&[], Some(&[0; 5]), None)
            .unwrap();
        column.close().unwrap();
        group.close().unwrap();
        file.close().unwrap();

        let columns = read(&path, &[0, 1]).unwrap();
        let expected = [0.5, f64::NAN, -1.0, 2.0, f64::NAN];
        let bits = |values: &[f64]| values.iter().map(|it| it.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&columns[0]), bits(&expected));
        assert_eq!(columns[1], [7.0, 8.0, 9.0, 10.0, 11.0]);
        let text = read(&path, &[2]).unwrap_err();
        assert_eq!(text.reason, "has no numbers");
    }
}

#[test]
fn integers_without_a_sign_have_none() {
    use parquet::data_type::{Int32Type, Int64Type};
    use parquet::file::writer::SerializedFileWriter;
    let path = folder("unsigned").join("numbers.parquet");
    let schema = "message numbers { required int32 a (INTEGER(32, false)); \
                  required int64 b (UINT_64); required int32 c (INT_32); }";
    let schema = parquet::schema::parser::parse_message_type(schema).unwrap();
    let file = fs::File::create(&path).unwrap();
    let mut file = SerializedFileWriter::new(file, schema.into(), Default::default()).unwrap();
    let mut group = file.next_row_group().unwrap();
    for wide in [false, true, false] {
        let mut column = group.next_column().unwrap().unwrap();
        let written = match wide {
            true => column
                .typed::<Int64Type>()
                .write_batch(&[-1, 5], None, None),
            false => column
                .typed::<Int32Type>()
                .write_batch(&[-1_294_967_296, 5], None, None),
        };
        assert_eq!(written.unwrap(), 2);
        column.close().unwrap();
    }
    group.close().unwrap();
    file.close().unwrap();
    let columns = read(&path, &[0, 1, 2]).unwrap();
    assert_eq!(columns[0], [3e9, 5.0]);
    assert_eq!(columns[1], [u64::MAX as f64, 5.0]);
    assert_eq!(columns[2], [-1_294_967_296.0, 5.0]);
}

/// Arrays have letters outside of ASCII from the third version of the format on.
#[test]
fn names_of_arrays_are_those_of_the_joints() {
    let folder = folder("letters");
    let file = folder.join("arm.yaml");
    let names = ["\u{e9}", "\u{e8}", "it's", "x\\\\y"];
    let screws: String = names
        .iter()
        .enumerate()
        .map(|(i, name)| format!("  - {{name: \"{name}\", axis: [0, 0, 1], point: [{i}, 0, 0]}}\n"))
        .collect();
    let text = format!(
        "robot: arm\nunits: {{angle: rad, length: m}}\nscrews:\n{screws}home: {{xyz: [4, 0, 0]}}\n"
    );
    fs::write(&file, text).unwrap();
    let (poses, solutions) = (folder.join("poses.csv"), folder.join("solutions.npy"));
    fs::write(&poses, "x,y,z\n2.5,1,0\n").unwrap();
    let options = [
        "--target", "position", "--free", "\u{e9}", "--free", "x\\y", "--at", "0.1,0.2",
    ];
    succeeds(kin(
        "ik",
        file.to_str().unwrap(),
        &poses,
        &solutions,
        &options,
    ));
    let reader = Format::Npy.open(&solutions).unwrap();
    let Header::Names(found) = reader.header() else {
        panic!("records have names");
    };
    for name in ["\u{e9}", "\u{e8}", "it's", "x\\y"] {
        assert!(found.iter().any(|it| it == name), "{name}: {found:?}");
    }
    assert_eq!(fs::read(&solutions).unwrap()[6], 3);
    let again = folder.join("again.csv");
    let done = succeeds(kin("fk", file.to_str().unwrap(), &solutions, &again, &[]));
    assert!(done.stdout.contains("of 2 rows"), "{}", done.stdout);
}

/// Robots whose joints are numbers have tables that begin with these.
#[test]
fn numbers_may_be_names_of_joints() {
    let folder = folder("columns_numbers");
    let arm = folder.join("arm.yaml");
    let joint = |name: u8| format!("  - {{name: \"{name}\", xyz: [0.3, 0, 0], axis: [0, 0, 1]}}\n");
    let joints = [8, 0].map(joint).concat();
    let head = "robot: arm\nunits: {angle: rad, length: m}\njoints:\n";
    let tip = "tip: {link: tool, xyz: [0.2, 0, 0]}\n";
    fs::write(&arm, format!("{head}{joints}{tip}")).unwrap();
    let [values, poses, solutions, again] =
        ["q.csv", "p.csv", "s.csv", "again.csv"].map(|name| folder.join(name));
    fs::write(&values, "8,0\n0.3,0.4\n").unwrap();
    let arm = arm.to_str().unwrap();
    succeeds(kin("fk", arm, &values, &poses, &[]));
    succeeds(kin("ik", arm, &poses, &solutions, &[]));
    succeeds(kin("fk", arm, &solutions, &again, &[]));
    assert_eq!(csv(&solutions)[0].split(',').nth(2), Some("8"));
    let target = read(&poses, &[0, 1]).unwrap();
    for (reached, wanted) in read(&again, &[0, 1]).unwrap().iter().zip(target) {
        assert_eq!(reached.len(), 2);
        assert!(reached.iter().all(|x| (x - wanted[0]).abs() < 1e-12));
    }
}
