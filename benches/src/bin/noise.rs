//! Arms off their design by noise of every decade: what is lost, by how well conditioned it
//! is, what the certificate excuses, and how long solving takes.
//! `cargo run --release --bin noise`, with how many targets for each arm and decade as an
//! argument. A table for arms of six joints, and one for arms of seven, of which one is given: that
//! which they choose.
//!
//! Two targets of three are next to round values, where the designs are singular. The branches
//! of the design are interpreted, not generated: about a microsecond more each time.

#[path = "../../../kin-codegen/tests/measured/mod.rs"]
mod measured;

use kin_codegen::certificate::recovered;
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::random::Random;
use kin_codegen::redundancy::{Asked, solve_redundant};
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use measured::{configuration, measured};
use std::path::Path;
use std::time::Instant;

const SIX: [&str; 3] = [
    "robots/ur5e.urdf",
    "robots/kr6_r900.yaml",
    "robots/puma560.yaml",
];
const SEVEN: [&str; 2] = ["robots/panda.yaml", "robots/iiwa14.yaml"];

/// Bounds of the classes of conditioning.
const CLASSES: [f64; 4] = [1e-3, 1e-4, 1e-5, 0.0];

fn design(path: &str) -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read(path, &root).expect("a robot of this project");
    Model::new(&ArmSpec::parse(&source).expect("an arm"), None, None).expect("a chain")
}

/// What one decade came to.
#[derive(Default)]
struct Tally {
    /// By class: lost of how many.
    lost: [[usize; 2]; CLASSES.len()],
    excused: f64,
    micros: Vec<f64>,
}

fn tally(tally: &mut Tally, design: &Model, noise: f64, count: usize) {
    let mut random = Random(0x5eed);
    let model = measured(design, noise, &mut random);
    let chain = model.chain();
    let joints = model.joints.len();
    let linkage = Linkage::new(&model);
    let solved = match joints {
        6 => solve(&model, &linkage, Target::Pose),
        _ => solve_redundant(&model, &linkage, Target::Pose, &Asked::default()).map(|it| it.0),
    };
    let Certified { form, certificate } = solved.expect("such arms are always solved");
    tally.excused = tally.excused.max(certificate.excused_share);
    for k in 0..count {
        let q = configuration(joints, k, &mut random);
        let target = chain.fk(&q);
        let (given, solved) = form.split(&q);
        let time = || {
            let start = Instant::now();
            let solutions = form.solutions_at(&target, &given);
            (start.elapsed(), solutions)
        };
        let ((first, solutions), (second, _)) = (time(), time());
        tally.micros.push(first.min(second).as_secs_f64() * 1e6);
        let held = model.locked(&form.given.locked, &given);
        let conditioning = form
            .given
            .conditioning(&held.chain(), &solved, Target::Pose);
        let class = CLASSES.iter().position(|&bound| conditioning >= bound);
        let [lost, all] = &mut tally.lost[class.expect("a number")];
        *all += 1;
        *lost += usize::from(recovered(&held, &solved, &solutions, conditioning).is_err());
    }
}

fn main() {
    let count = std::env::args()
        .nth(1)
        .map_or(10_000, |n| n.parse().expect("a number"));
    for arms in [&SIX[..], &SEVEN] {
        table(arms, count);
    }
}

fn table(arms: &[&str], count: usize) {
    println!(
        "| noise | lost above 1e-3 | 1e-4 to 1e-3 | 1e-5 to 1e-4 | below | excused % | p50 µs | p99 | worst |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let designs: Vec<Model> = arms.iter().map(|path| design(path)).collect();
    for decade in (2..=12).rev() {
        let mut all = Tally::default();
        for design in &designs {
            tally(&mut all, design, 10_f64.powi(-decade), count);
        }
        let lost = all.lost.map(|[lost, all]| format!("{lost} of {all}"));
        all.micros.sort_by(f64::total_cmp);
        let at = |share: f64| all.micros[((all.micros.len() - 1) as f64 * share) as usize];
        println!(
            "| 1e-{decade} | {} | {:.2} | {:.1} | {:.1} | {:.1} |",
            lost.join(" | "),
            100.0 * all.excused,
            at(0.5),
            at(0.99),
            at(1.0)
        );
    }
}
