//! A process that is killed leaves what the next one goes on with.

use super::*;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SIGKILL: i32 = 9;
/// Poses, and how many of them make a portion.
const ROWS: usize = 40_000;
const PORTION: &str = "50";

fn solving(poses: &Path, output: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kin"));
    command.arg("ik").arg(robot("ur5e.urdf")).arg(poses);
    command.arg("-o").arg(output).args(["--batch", PORTION]);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Kills a process as soon as so many bytes stand in a file; whether it was still running.
fn killed_at(mut child: Child, file: &Path, bytes: u64) -> bool {
    let begin = Instant::now();
    let written = || fs::metadata(file).map_or(0, |it| it.len());
    while written() < bytes && child.try_wait().unwrap().is_none() {
        assert!(
            begin.elapsed() < Duration::from_secs(60),
            "nothing is written"
        );
        std::thread::sleep(Duration::from_millis(1));
    }
    // Not asked to stop: it can put nothing in order.
    let _ = child.kill();
    child.wait().unwrap().signal() == Some(SIGKILL)
}

#[test]
fn a_killed_process_is_gone_on_with() {
    let folder = folder("killed");
    let ur5e = load("ur5e.urdf", kinematics::RobotOptions::default());
    let [inputs, poses] = ["joints.csv", "poses.npy"].map(|name| folder.join(name));
    joints(&ur5e, ROWS, &inputs);
    succeeds(kin("fk", "ur5e.urdf", &inputs, &poses, &[]));
    let [whole, parts] = ["whole.npy", "parts.npy"].map(|name| folder.join(name));
    let done = solving(&poses, &whole).output().unwrap();
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let length = fs::metadata(&whole).unwrap().len();

    let mut before = 0;
    for share in [8, 3] {
        let child = solving(&poses, &parts).spawn().unwrap();
        let hidden = folder.join(".parts.npy.partial");
        assert!(
            killed_at(child, &hidden, length / share),
            "it was done before"
        );
        assert!(!parts.exists(), "a part is no table");
        let left = fs::metadata(&hidden).unwrap().len();
        assert!(left >= before && left < length, "{before} {left} {length}");
        before = left;
    }
    let done = solving(&poses, &parts).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr) + String::from_utf8_lossy(&done.stdout);
    assert!(done.status.success(), "{said}");
    assert!(said.contains("rows were done before"), "{said}");
    assert!(fs::read(&parts).unwrap() == fs::read(&whole).unwrap());
    assert!(!folder.join(".parts.npy.partial").exists());
}
