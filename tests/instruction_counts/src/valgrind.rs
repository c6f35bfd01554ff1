//! Calls of this program, run again in valgrind, whose processor has AVX2 and no AVX-512.

use std::process::{Command, Stdio};

/// Whether valgrind is there, and runs what is compiled for AVX2: the counts are of that.
pub fn counts_the_same_code() -> Result<(), String> {
    #[cfg(not(all(target_arch = "x86_64", not(target_feature = "avx2"))))]
    return Err("they are those of x86-64's default target".to_owned());
    #[cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]
    {
        if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")) {
            return Err("this processor has no AVX2".to_owned());
        }
        let mut version = Command::new("valgrind");
        version.arg("--version").stdout(Stdio::null());
        let run = version.status().map(drop);
        run.map_err(|error| format!("valgrind cannot be run ({error})"))
    }
}

/// What each of so many calls takes.
pub fn instructions(robot: &str, calls: usize) -> Vec<u64> {
    let folder = std::env::temp_dir().join(format!("instruction_counts-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("there is a place for valgrind's files");
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .args([
            "--zero-before=*start_counting*",
            "--dump-after=*one_counted_call*",
        ])
        .arg(format!(
            "--callgrind-out-file={}",
            folder.join("call").display()
        ))
        .arg(std::env::current_exe().expect("this program has a path"))
        .arg(robot)
        .status()
        .expect("valgrind can be run");
    assert!(status.success(), "valgrind: {status}");
    let counts = (1..=calls).map(|call| {
        let file = folder.join(format!("call.{call}"));
        let text = std::fs::read_to_string(file).expect("valgrind has written every call down");
        let total = text.lines().find_map(|line| line.strip_prefix("totals: "));
        let total = total.and_then(|count| count.trim().parse().ok());
        total.unwrap_or_else(|| panic!("no count: {text}"))
    });
    let counts = counts.collect();
    std::fs::remove_dir_all(&folder).expect("valgrind's files can be removed");
    counts
}
