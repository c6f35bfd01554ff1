//! Slides that turns between them make nearly parallel: a solution that makes up for little by far
//! travels is none, since their rounding alone leaves the tip off the target.

use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use kin_runtime::Target;
use std::f64::consts::PI;

/// Turns between them about two axes that meet, and one parallel to the first.
const TURNS_BETWEEN: &str = "units: {angle: deg, length: m}
dh:
  - {name: q1, type: prismatic, theta: 0, a: 0.5, alpha: 0}
  - {name: q2, d: 0, a: 0.4, alpha: 0}
  - {name: q3, d: 0, a: 0, alpha: 90}
  - {name: q4, d: 0, a: 0, alpha: 90}
  - {name: q5, type: prismatic, theta: 90, a: 0.3, alpha: 0}
";
/// One turn between them that makes them parallel.
const TURN_BETWEEN: &str = "units: {angle: rad, length: m}
joints:
  - {name: q1, type: prismatic, axis: [0, 0, 1]}
  - {name: q2, xyz: [0.4, 0, 0], axis: [0.6, 0, 0.8]}
  - {name: q3, axis: [0, 0, 1]}
  - {name: q4, type: prismatic, xyz: [0, 0.5, 0], axis: [0, 0, 1]}
  - {name: q5, xyz: [0, 0, 0.4], axis: [0, 0, -1]}
tip: {link: tip, xyz: [0, 0.45, 0], rpy: [-0.3, 1.1, -0.7]}
";

/// Solves targets at which joints are off a quarter turn by little.
fn nothing_is_unsound(joints: &str, target: Target) {
    let text = format!("robot: arm\n{joints}");
    let source = Source {
        path: "arm.yaml".into(),
        text,
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let linkage = Linkage::new(&model);
    let form = solve(&model, &linkage, target).unwrap().form;
    let (chain, size) = (model.chain(), linkage.size);
    let mut random = Random(0x51de);
    let (mut found, mut asked) = (0, 0);
    for _ in 0..2000 {
        let mut q: Vec<f64> = (0..5).map(|_| random.between(-1.0, 1.0)).collect();
        for (joint, q) in q.iter_mut().enumerate() {
            if model.joints[joint].is_revolute() && random.below(3) > 0 {
                let quarters = random.below(4) as f64 - 2.0;
                *q = quarters * PI / 2.0 + 10f64.powf(random.between(-12.0, -3.0));
            }
        }
        let pose = chain.fk(&q);
        let solutions = form.solutions_at(&pose, &[]);
        for solution in &solutions {
            let missed = target.distance(&chain.fk(&solution.q), &pose, size);
            assert!(missed <= 2e-9 * size, "{q:?}: {missed:e} by {solution:?}");
        }
        asked += 1;
        found += usize::from(!solutions.is_empty());
    }
    assert!(found > asked * 9 / 10, "{found} of {asked}");
}

#[test]
fn turns_between() {
    nothing_is_unsound(TURNS_BETWEEN, Target::Pose);
}

#[test]
fn one_turn_between() {
    nothing_is_unsound(TURN_BETWEEN, Target::PositionAxis);
}
