//! Arms off their design by noise of every decade: what is lost, by how well conditioned it
//! is, what the certificate excuses, and how long solving takes.
//! `cargo run --release --bin noise`, with how many targets for each arm and decade as an
//! argument.
//!
//! Two targets of three are next to round values, where the designs are singular. The branches
//! of the design are interpreted, not generated: about a microsecond more each time.

use kin_codegen::certificate::recovered;
use kin_codegen::geometry::{Linkage, conditioning, size};
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::random::Random;
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use std::f64::consts::{FRAC_PI_2, PI};
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

/// The design with every axis turned by up to `noise` radians and shifted by up to as
/// much of the arm's size.
fn measured(design: &Model, noise: f64, random: &mut Random) -> Model {
    let mut model = design.clone();
    let length = size(design);
    for joint in &mut model.joints {
        let mut side = || [0; 3].map(|_| noise * random.between(-1.0, 1.0));
        let (turn, shift) = (side(), side());
        let axis = joint.axis;
        let turned = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            axis[i] + turn[j] * axis[k] - turn[k] * axis[j]
        });
        let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
        joint.axis = turned.map(|x| x / norm);
        for (x, shift) in joint.point.iter_mut().zip(shift) {
            *x += length * shift;
        }
    }
    model
}

fn configuration(k: usize, random: &mut Random) -> Vec<f64> {
    let mut q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
    for _ in 0..k % 3 {
        let round = random.below(4) as f64 * FRAC_PI_2;
        q[random.below(6)] = round + 10_f64.powf(random.between(-6.0, -1.0));
    }
    q
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
