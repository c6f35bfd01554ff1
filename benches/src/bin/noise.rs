//! Arms off their design by noise of every decade: what is lost, by how well conditioned it
//! is, what the certificate excuses, and how long solving takes.
//! `cargo run --release --bin noise`, with how many targets for each arm and decade as an
//! argument.
//!
//! Two targets of three are next to round values, where the designs are singular. The branches
//! of the design are interpreted, not generated: about a microsecond more each time.

#[path = "../../../kin-codegen/tests/measured/mod.rs"]
mod measured;

use kin_codegen::certificate::recovered;
use kin_codegen::geometry::{Linkage, conditioning, size};
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::random::Random;
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use measured::{configuration, measured};
use std::path::Path;
use std::time::Instant;

const ARMS: [&str; 3] = [
    "robots/ur5e.urdf",
    "robots/kr6_r900.yaml",
    "robots/puma560.yaml",
];

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
    let (chain, length) = (model.chain(), size(&model));
    let solved = solve(&model, &Linkage::new(&model), Target::Pose);
    let Certified { form, certificate } = solved.expect("six joints are always solved");
    tally.excused = tally.excused.max(certificate.excused_share);
    for k in 0..count {
        let q = configuration(k, &mut random);
        let target = chain.fk(&q);
        let time = || {
            let start = Instant::now();
            let solutions = form.solutions(&target);
            (start.elapsed(), solutions)
        };
        let ((first, solutions), (second, _)) = (time(), time());
        tally.micros.push(first.min(second).as_secs_f64() * 1e6);
        let conditioning = conditioning(&chain, &q, length, Target::Pose);
        let class = CLASSES.iter().position(|&bound| conditioning >= bound);
        let [lost, all] = &mut tally.lost[class.expect("a number")];
        *all += 1;
        *lost += usize::from(recovered(&model, &q, &solutions, conditioning).is_err());
    }
}

fn main() {
    let count = std::env::args()
        .nth(1)
        .map_or(10_000, |n| n.parse().expect("a number"));
    println!(
        "| noise | lost above 1e-3 | 1e-4 to 1e-3 | 1e-5 to 1e-4 | below | excused % | p50 µs | p99 | worst |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let designs = ARMS.map(design);
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
