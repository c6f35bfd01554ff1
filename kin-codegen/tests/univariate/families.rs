//! Targets with a family of solutions beside regular ones.

use kin_codegen::certificate::recovered;
use kin_codegen::geometry::{Linkage, conditioning, size};
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use std::f64::consts::{FRAC_PI_2, PI};

/// A CRX with a slide in place of its elbow: with the slide along the shoulder's axis, four regular
/// solutions to a target that a whole curve of singular ones reaches as well.
const SLIDE: &str = "
robot: arm
units: {angle: rad, length: m}
screws:
- {name: j1, axis: [0, 0, 1], point: [0, 0, 0.161]}
- {name: j2, axis: [0, 1, 0], point: [0, 0, 0.161]}
- {name: j3, axis: [0, -1, 0], type: prismatic}
- {name: j4, axis: [-1, 0, 0], point: [0, 0, 0.441]}
- {name: j5, axis: [0, -1, 0], point: [0.28, 0, 0.441]}
- {name: j6, axis: [-1, 0, 0], point: [0.28, -0.111, 0.441]}
home: {xyz: [0.403, -0.111, 0.441]}
";

fn read(text: &str) -> Model {
    let path = "arm.yaml".into();
    let text = text.into();
    let spec = ArmSpec::parse(&Source { path, text }).unwrap();
    Model::new(&spec, None, None).unwrap()
}

/// The polynomials vanish for the family, and next to its targets they nearly do: what
/// is taken nearly to zero at the value that two regular solutions share is more than theirs.
#[test]
fn regular_solutions_are_found_beside_a_family() {
    let model = read(SLIDE);
    let form = solve(&model, &Linkage::new(&model), Target::Pose)
        .unwrap()
        .form;
    let (chain, size) = (model.chain(), size(&model));
    let met = [FRAC_PI_2, PI, 0.5, PI, FRAC_PI_2, FRAC_PI_2];
    let mut random = Random(7);
    for decade in -15..=-2 {
        let off = if decade == -15 {
            0.0
        } else {
            10f64.powi(decade)
        };
        for _ in 0..20 {
            let q = met.map(|x| x + off * random.between(-1.0, 1.0));
            let solutions = form.solutions(&chain.fk(&q));
            let conditioning = conditioning(&chain, &q, size, Target::Pose);
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(
                conditioning > 0.05 && back.is_ok(),
                "off by {off:e}: {back:?}"
            );
        }
    }
}
