//! Files that were cut off or damaged: an error or an answer, never a panic.

use super::*;
use kinematics::RobotOptions;

/// A table of poses in this format.
fn poses(folder: &Path, format: Format) -> PathBuf {
    let robot = load("ur5e.urdf", RobotOptions::default());
    joints(&robot, 30, &folder.join("joints.csv"));
    let poses = folder.join("poses").with_extension(format.extension());
    let input = folder.join("joints.csv");
    succeeds(kin("fk", "ur5e.urdf", &input, &poses, &["--batch", "9"]));
    poses
}

/// Reads all columns that can be read.
fn take(path: &Path) -> Result<(), Fault> {
    let columns: Vec<usize> = match Format::of(path)?.open(path)?.header() {
        Header::Names(names) => (0..names.len()).collect(),
        Header::Width(width) => (0..*width).collect(),
    };
    read(path, &columns).map(drop)
}

#[test]
fn what_was_cut_off_is_an_error() {
    for format in [Format::Npy, Format::Parquet] {
        let folder = folder(&format!("cut_{}", format.extension()));
        let path = poses(&folder, format);
        let whole = fs::read(&path).unwrap();
        take(&path).unwrap();
        for length in (0..whole.len()).rev() {
            fs::write(&path, &whole[..length]).unwrap();
            assert!(take(&path).is_err(), "{length} of {}", whole.len());
        }
    }
}

#[test]
fn what_was_damaged_is_an_error_or_read() {
    // What the library says when it panics is caught, and told as a fault; not here as well.
    std::panic::set_hook(Box::new(|_| {}));
    for format in ALL {
        let folder = folder(&format!("damaged_{}", format.extension()));
        let path = poses(&folder, format);
        let whole = fs::read(&path).unwrap();
        let mut random = Random(7);
        let mut faults = 0;
        for _ in 0..1000 {
            let mut damaged = whole.clone();
            // Heads and footers are short, and say the most.
            let share = random.next().abs();
            let share = if random.next() > 0.0 {
                share.powi(8)
            } else {
                share
            };
            let place = (share * whole.len() as f64) as usize;
            let place = if random.next() > 0.0 {
                place
            } else {
                whole.len() - 1 - place
            };
            damaged[place] = (random.next() * 128.0) as i8 as u8;
            fs::write(&path, &damaged).unwrap();
            faults += usize::from(take(&path).is_err());
        }
        assert!(faults > 0 && faults < 1000, "{faults}");
    }
    let _ = std::panic::take_hook();
}
