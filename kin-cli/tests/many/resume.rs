//! Jobs that are interrupted give the same files as those that are not.

use super::*;
use kin_cli::batch::{Inverse, Job, Kept, Report, Task};
use kinematics::{Robot, RobotOptions};
use std::ops::ControlFlow;

/// Portions of the table.
const PORTIONS: usize = 12;

struct Fixture {
    folder: PathBuf,
    robot: Robot,
    format: Format,
}

impl Fixture {
    /// In a folder of the test's own.
    fn new(test: &str, format: Format) -> Self {
        let folder = folder(&format!("{test}_{}", format.extension()));
        let robot = load("ur5e.urdf", RobotOptions::default());
        joints(&robot, 5 * PORTIONS - 2, &folder.join("joints.csv"));
        let fixture = Fixture {
            folder,
            robot,
            format,
        };
        let (joints, poses) = (fixture.folder.join("joints.csv"), fixture.file("poses"));
        // Row groups of seven, which are taken by five: 5, 2, 5, 2 ...
        succeeds(kin("fk", "ur5e.urdf", &joints, &poses, &["--batch", "7"]));
        fixture
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder
            .join(name)
            .with_extension(self.format.extension())
    }

    /// Beside the output.
    fn hidden(&self, name: &str, ending: &str) -> PathBuf {
        let name = format!(".{name}.{}.{ending}", self.format.extension());
        self.folder.join(name)
    }

    /// All solutions to the poses, until so many portions are done.
    fn run(&self, output: &str, robot: &str, portions: usize) -> Report {
        let input = self.file("poses");
        let mut reader = self.format.open(&input).unwrap();
        let (task, columns) =
            Inverse::new(&self.robot, &[], Kept::default(), &input, reader.header()).unwrap();
        reader.select(&columns).unwrap();
        let job = Job {
            input: &input,
            reader,
            task: &task,
            encoder: self.format.encoder(task.columns()),
            output: self.file(output),
            batch: 5,
            is_strict: false,
            robot: robot.into(),
        };
        let mut told = 0;
        job.run(&mut |_| {
            told += 1;
            match told > portions {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })
        .unwrap()
    }

    fn bytes(&self, output: &str) -> Vec<u8> {
        fs::read(self.file(output)).unwrap()
    }
}

/// More portions than any table has.
const ALL_OF_IT: usize = usize::MAX;

#[test]
fn a_job_goes_on_where_it_was_stopped() {
    for format in ALL {
        let fixture = Fixture::new("goes_on", format);
        let whole = fixture.run("whole", "ur5e", ALL_OF_IT);
        assert!(!whole.is_stopped && whole.before == 0 && whole.tally.rows == 58);
        let mut before = 0;
        for portions in [1, 3, 0, 4] {
            let stopped = fixture.run("parts", "ur5e", portions);
            assert!(stopped.is_stopped && stopped.before == before);
            assert!(!fixture.file("parts").exists(), "a part is no table");
            before = stopped.tally.rows;
        }
        assert!(before > 20);
        let last = fixture.run("parts", "ur5e", ALL_OF_IT);
        assert_eq!((last.before, last.is_stopped), (before, false));
        assert_eq!((last.answers, &last.tally), (whole.answers, &whole.tally));
        assert_eq!(fixture.bytes("parts"), fixture.bytes("whole"));
        assert!(!fixture.hidden("parts", "partial").exists());
    }
}

/// Where files are cut off and damaged.
const SHARES: usize = 7;

#[test]
fn what_was_lost_or_damaged_is_made_again() {
    for format in ALL {
        let fixture = Fixture::new("made_again", format);
        fixture.run("whole", "ur5e", ALL_OF_IT);
        fixture.run("parts", "ur5e", 6);
        let files = ["partial", "journal"].map(|ending| fixture.hidden("parts", ending));
        let sound = files.clone().map(|file| fs::read(file).unwrap());
        // Cut off anywhere, as by a machine that went down; or with a bit turned.
        for (file, bytes) in files.iter().zip(&sound) {
            for share in 0..SHARES {
                let place = bytes.len() * share / SHARES;
                let mut damaged = bytes.clone();
                damaged[place] ^= 4;
                for damaged in [&bytes[..place], &damaged] {
                    for (file, bytes) in files.iter().zip(&sound) {
                        fs::write(file, bytes).unwrap();
                    }
                    fs::write(file, damaged).unwrap();
                    let _ = fs::remove_file(fixture.file("parts"));
                    fixture.run("parts", "ur5e", ALL_OF_IT);
                    assert!(fixture.bytes("parts") == fixture.bytes("whole"), "{share}");
                }
            }
        }
    }
}

#[test]
fn nothing_is_gone_on_with_that_was_made_otherwise() {
    let fixture = Fixture::new("made_otherwise", Format::Parquet);
    fixture.run("parts", "ur5e", 6);
    let other = fixture.run("parts", "another robot", 6);
    assert_eq!(other.before, 0);
    // The same size and rows, written later.
    let poses = fixture.bytes("poses");
    std::thread::sleep(std::time::Duration::from_millis(20));
    fs::write(fixture.file("poses"), poses).unwrap();
    let later = fixture.run("parts", "another robot", 6);
    assert_eq!(later.before, 0);
    // A copy that has the time of what it replaces.
    #[cfg(unix)]
    {
        let poses = fixture.file("poses");
        let written = fs::metadata(&poses).unwrap().modified().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(20));
        let file = fs::File::options().write(true).open(&poses).unwrap();
        file.set_modified(written).unwrap();
        let copied = fixture.run("parts", "another robot", ALL_OF_IT);
        assert_eq!(copied.before, 0);
    }
}

/// Nor is something else written, or replaced.
#[cfg(unix)]
#[test]
fn an_output_is_a_file_or_a_link_to_one() {
    use std::os::unix::fs::symlink;
    let folder = folder("links");
    let robot = load("ur5e.urdf", RobotOptions::default());
    let input = folder.join("joints.csv");
    joints(&robot, 5, &input);
    let at = |name: &str| folder.join(name);
    let run = |output: &str| kin("fk", "ur5e.urdf", &input, &at(output), &["--format", "csv"]);

    fs::write(at("far.csv"), "old").unwrap();
    symlink("far.csv", at("near.csv")).unwrap();
    succeeds(run("near.csv"));
    assert!(fs::symlink_metadata(at("near.csv")).unwrap().is_symlink());
    assert_eq!(csv(&at("far.csv")).len(), 6);

    symlink("/dev/null", at("device.csv")).unwrap();
    let done = run("device.csv");
    assert_ne!(done.exit, Exit::Success);
    assert!(
        done.stderr.contains("is no file, and would be replaced"),
        "{}",
        done.stderr
    );

    for (output, hidden) in [("a.csv", ".a.csv.partial"), ("b.csv", ".b.csv.journal")] {
        fs::write(at("victim"), "kept").unwrap();
        symlink("victim", at(hidden)).unwrap();
        let done = run(output);
        assert_ne!(done.exit, Exit::Success);
        assert!(
            done.stderr.contains(&format!("{hidden}, which is no file")),
            "{}",
            done.stderr
        );
        assert_eq!(fs::read_to_string(at("victim")).unwrap(), "kept");
    }
}
