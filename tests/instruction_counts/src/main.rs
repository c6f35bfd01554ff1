//! Counts the instructions of single calls in valgrind. Fails where they depend on what a
//! call is given, and where they are more than `counts.tsv` has; `BLESS=1` writes that file.

mod calls;
mod counts;
mod valgrind;

use calls::{CALLS, ELIMINATED, EXACT, KINDS, KINDS_OF_ELIMINATIONS};
use counts::{Counts, Table};
use std::process::ExitCode;

fn main() -> ExitCode {
    if let Some(robot) = std::env::args().nth(1) {
        calls::make(&robot);
        return ExitCode::SUCCESS;
    }
    if let Err(reason) = valgrind::counts_the_same_code() {
        println!("no instructions are counted: {reason}");
        return ExitCode::SUCCESS;
    }
    let table = counted();
    print!("{table}");
    let mut faults = jumps(&table);
    if std::env::var_os("BLESS").is_some() {
        table.write();
    } else {
        faults.extend(table.beyond(&Table::read()));
    }
    for fault in &faults {
        eprintln!("{fault}");
    }
    ExitCode::from(u8::from(!faults.is_empty()))
}

/// Of each robot and kind.
fn counted() -> Table {
    let mut rows = Vec::new();
    let exact = EXACT.iter().map(|robot| (robot, &KINDS[..]));
    let eliminated = ELIMINATED.iter();
    let eliminated = eliminated.map(|robot| (robot, &KINDS_OF_ELIMINATIONS[..]));
    for (robot, kinds) in exact.chain(eliminated) {
        let calls = valgrind::instructions(robot, kinds.len() * CALLS);
        for (kind, calls) in kinds.iter().zip(calls.chunks(CALLS)) {
            rows.push(Counts::of(robot, kind, calls));
        }
    }
    Table(rows)
}

/// Where what an exact closed form executes depends on what is given: by a single instruction, and of
/// `ik_nearest` by more than [`WRITTEN`]. Singular targets take more where an angle
/// that they leave free is asked for anew; most of them take no more than others, and of
/// `ik_nearest`, which runs again with the seed's angle and asks where the seed is, than two of these
/// and its pose.
fn jumps(table: &Table) -> Vec<String> {
    let mut faults = Vec::new();
    for robot in EXACT {
        let row = |kind: &str| table.row(robot, kind).expect("each kind was counted");
        for (call, may_differ_by) in [("ik", 0), ("ik_nearest", WRITTEN)] {
            let [regular, away, singular] = ["regular", "out of reach", "singular wrist"]
                .map(|target| row(&format!("{call}, {target}")));
            let least = regular.least.min(away.least);
            let most = regular.most.max(away.most);
            let again = match call {
                "ik_nearest" => (singular.median - row("fk").most).div_ceil(2),
                _ => singular.median,
            };
            let most = most.max(again);
            if most - least > may_differ_by {
                faults.push(format!(
                    "{call} of {robot} depends on the target: {least} to {most} instructions"
                ));
            }
        }
        for call in ["fk", "fk_jacobian"] {
            let Counts { least, most, .. } = row(call);
            if least != most {
                faults.push(format!(
                    "{call} of {robot} depends on the angles: {least} to {most} instructions"
                ));
            }
        }
    }
    faults
}

/// Instructions that write one solution down, if there is one.
const WRITTEN: u64 = 80;
