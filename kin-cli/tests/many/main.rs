//! `kin fk` and `kin ik`: tables in, tables out, read back.

mod answers;
mod columns;
mod faults;
mod folders;
mod hostile;
#[cfg(unix)]
mod killed;
mod resume;

use kin_cli::table::{Fault, Format, Header};
use kin_cli::{Done, Exit};
use std::fs;
use std::path::{Path, PathBuf};

const ALL: [Format; 3] = Format::ALL;

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("many")
        .join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A robot of the project, or one of a test by its whole path.
fn robot(name: &str) -> String {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    robots.join(name).to_str().unwrap().to_owned()
}

/// `kin fk` or `kin ik` of a table, with options behind.
fn kin(command: &str, file: &str, input: &Path, output: &Path, options: &[&str]) -> Done {
    let [input, output] = [input, output].map(|path| path.to_str().unwrap());
    let file = robot(file);
    let line = ["kin", command, &file, input, "-o", output];
    kin_cli::run(line.iter().chain(options))
}

fn succeeds(done: Done) -> Done {
    assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
    done
}

/// Columns of a table, read in portions of three rows.
fn read(path: &Path, columns: &[usize]) -> Result<Vec<Vec<f64>>, Fault> {
    let mut reader = Format::of(path)?.open(path)?;
    reader.select(columns)?;
    let mut all = vec![Vec::new(); columns.len()];
    let mut row = 0;
    while let Some(portion) = reader.next(3)? {
        assert_eq!(portion.first, row);
        let values = portion.decode()?;
        row += values.first().map_or(0, Vec::len) as u64;
        for (all, values) in all.iter_mut().zip(values) {
            all.extend(values);
        }
    }
    Ok(all)
}

/// Rows of a table as text.
fn csv(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().map(str::to_owned).collect()
}

/// Numbers between -1 and 1, the same ones again.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        // Numerical Recipes, 7.1.
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Random joint values of a robot as a table.
fn joints(robot: &kinematics::Robot, rows: usize, path: &Path) -> Vec<Vec<f64>> {
    let mut random = Random(rows as u64);
    let value = |limit: &kinematics::JointLimit, random: &mut Random| {
        let least = limit.lower().max(-3.0);
        let most = limit.upper().min(3.0);
        0.5 * (least + most) + 0.5 * (most - least) * random.next()
    };
    let row = |_| {
        robot
            .limits()
            .iter()
            .map(|limit| value(limit, &mut random))
            .collect()
    };
    let all: Vec<Vec<f64>> = (0..rows).map(row).collect();
    write(path, &robot.joint_names(), &all);
    all
}

fn write(path: &Path, names: &[&str], rows: &[Vec<f64>]) {
    let mut text = names.join(",") + "\n";
    for row in rows {
        let values: Vec<String> = row.iter().map(f64::to_string).collect();
        text += &(values.join(",") + "\n");
    }
    fs::write(path, text).unwrap();
}

fn load(name: &str, options: kinematics::RobotOptions) -> kinematics::Robot {
    let source = kinematics::RobotSource::read(&robot(name), Path::new("")).unwrap();
    kinematics::Robot::load(&source, &options).unwrap()
}
