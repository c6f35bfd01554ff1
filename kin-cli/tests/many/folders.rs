//! Folders of tables, shared by machines.

use super::*;
use kinematics::RobotOptions;

/// Five tables, two of them in a folder of their own, and what is none.
fn tables(name: &str) -> (PathBuf, Vec<&'static str>) {
    let folder = folder(name);
    fs::create_dir_all(folder.join("in/day=2")).unwrap();
    let robot = load("ur5e.urdf", RobotOptions::default());
    let names = ["a", "b", "c", "day=2/a", "day=2/b"];
    for (rows, name) in names.iter().enumerate() {
        joints(&robot, 10 + rows, &folder.join(format!("in/{name}.csv")));
    }
    for other in ["_SUCCESS", ".b.csv.crc", "readme.txt", "_temporary.csv"] {
        fs::write(folder.join("in").join(other), "no table").unwrap();
    }
    (folder, names.to_vec())
}

fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        match entry.path().is_dir() {
            true => found.extend(files(&entry.path()).iter().map(|it| format!("{name}/{it}"))),
            false => found.push(name),
        }
    }
    found.sort();
    found
}

#[test]
fn a_folder_is_answered_by_a_folder() {
    let (folder, names) = tables("whole");
    let (input, output) = (folder.join("in"), folder.join("out"));
    let done = succeeds(kin(
        "fk",
        "ur5e.urdf",
        &input,
        &output,
        &["--format", "parquet"],
    ));
    assert!(
        done.stdout.contains("out: 60 poses of 60 rows in 5 tables"),
        "{}",
        done.stdout
    );
    let expected: Vec<String> = names.iter().map(|name| format!("{name}.parquet")).collect();
    assert_eq!(files(&output), expected);
    for (rows, name) in names.iter().enumerate() {
        let one = folder.join("one.parquet");
        succeeds(kin(
            "fk",
            "ur5e.urdf",
            &input.join(format!("{name}.csv")),
            &one,
            &[],
        ));
        assert_eq!(read(&one, &[0]).unwrap()[0].len(), 10 + rows);
        let of_folder = output.join(format!("{name}.parquet"));
        assert_eq!(fs::read(one).unwrap(), fs::read(of_folder).unwrap());
    }
    let table = kin("fk", "ur5e.urdf", &input, &folder.join("all.csv"), &[]);
    let reason = "is named as a table, where the input is a folder";
    assert!(table.stderr.contains(reason), "{}", table.stderr);
    for inside in ["in/out", "./in/./out", "in/day=2/../out", "out/../in/out"] {
        let done = kin("fk", "ur5e.urdf", &input, &folder.join(inside), &[]);
        let reason = "is the folder of the input, or in it";
        assert!(done.stderr.contains(reason), "{inside}: {}", done.stderr);
    }
}

#[cfg(unix)]
#[test]
fn links_lead_to_a_folder_once_and_to_no_output_within() {
    let (folder, _) = tables("links");
    let input = folder.join("in");
    std::os::unix::fs::symlink(&input, folder.join("link")).unwrap();
    std::os::unix::fs::symlink("..", input.join("day=2/loop")).unwrap();
    let inside = kin("fk", "ur5e.urdf", &input, &folder.join("link/out"), &[]);
    assert!(
        inside
            .stderr
            .contains("is the folder of the input, or in it"),
        "{}",
        inside.stderr
    );
    let done = succeeds(kin(
        "fk",
        "ur5e.urdf",
        &folder.join("link"),
        &folder.join("out"),
        &[],
    ));
    assert!(
        done.stdout.contains("60 rows in 5 tables"),
        "{}",
        done.stdout
    );
}

#[test]
fn machines_share_a_folder() {
    let (folder, names) = tables("shared");
    let (input, output) = (folder.join("in"), folder.join("out"));
    let mut seen = Vec::new();
    for share in ["1/3", "2/3", "3/3"] {
        succeeds(kin("fk", "ur5e.urdf", &input, &output, &["--share", share]));
        seen.push(files(&output).len());
    }
    assert_eq!(seen, [2, 4, names.len()]);
}

#[test]
fn what_is_done_of_a_folder_is_not_done_again() {
    let (folder, names) = tables("again");
    let (input, output) = (folder.join("in"), folder.join("out"));
    let broken = input.join("b.csv");
    let sound = fs::read_to_string(&broken).unwrap();
    fs::write(&broken, sound.replacen("0.", "abc", 1)).unwrap();
    let done = kin("fk", "ur5e.urdf", &input, &output, &[]);
    assert_eq!(done.exit, Exit::Broken);
    assert!(done.stderr.contains("b.csv: row "), "{}", done.stderr);
    let written = |name: &str| fs::metadata(output.join(name)).unwrap().modified().unwrap();
    let before = written("a.csv");
    assert!(!output.join("b.csv").exists() && output.join("c.csv").exists());

    fs::write(&broken, sound).unwrap();
    let done = succeeds(kin("fk", "ur5e.urdf", &input, &output, &[]));
    assert!(
        done.stdout.contains("60 poses of 60 rows in 5 tables"),
        "{}",
        done.stdout
    );
    assert_eq!(written("a.csv"), before);
    let expected: Vec<String> = names.iter().map(|name| format!("{name}.csv")).collect();
    assert_eq!(files(&output), expected, "nothing else is left");
}

#[test]
fn two_tables_of_one_output_are_told() {
    let (folder, _) = tables("twins");
    fs::write(folder.join("in/a.npy"), "").unwrap();
    let (input, output) = (folder.join("in"), folder.join("out"));
    let done = kin("fk", "ur5e.urdf", &input, &output, &["--format", "csv"]);
    assert!(
        done.stderr.contains("`a.csv` would have the same output"),
        "{}",
        done.stderr
    );
}
