//! Three parallel axes and a wrist, with the wrist stretched: a sum of angles is free then, but not every
//! value of it leaves the elbow a root.

use kin_codegen::closed_form::ClosedForm;
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use kin_runtime::Target;
use std::f64::consts::{FRAC_PI_2, PI};

/// Of each arm, as many with the elbow anywhere and with the arm straight.
const CONFIGURATIONS: usize = 100;

/// An arm of the build of Universal Robots, its lengths drawn at random and where its second and fourth
/// joints are at zero, with this for a right angle, and axes that are parallel but for another.
fn arm(right_angle: &str, tilt: &str, random: &mut Random) -> (Model, ClosedForm) {
    let zeros = [(); 2].map(|()| random.between(-PI, PI));
    let mut length = |from, to| random.between(from, to);
    let (upper, lower) = (length(0.3, 0.6), length(0.3, 0.6));
    let offsets = [(); 3].map(|()| length(0.08, 0.2));
    let links = [
        (right_angle, 0.0, 0.0, length(0.1, 0.2)),
        (tilt, -upper, zeros[0], 0.0),
        (tilt, -lower, 0.0, 0.0),
        (right_angle, 0.0, zeros[1], offsets[0]),
        (&format!("-{right_angle}"), 0.0, 0.0, offsets[1]),
        ("0", 0.0, 0.0, offsets[2]),
    ];
    let links = links.iter().enumerate().map(|(i, (alpha, a, theta, d))| {
        format!(
            "- {{name: q{}, alpha: {alpha}, a: {a}, theta: {theta}, d: {d}}}\n",
            i + 1
        )
    });
    let head = "robot: arm\nunits: {angle: rad, length: m}\ndh:\n";
    let text = head.to_owned() + &links.collect::<String>();
    let source = Source {
        path: "arm.yaml".into(),
        text,
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let form = solve(&model, &Linkage::new(&model), Target::Pose)
        .unwrap()
        .form;
    (model, form)
}

/// How many targets with the fifth joint at an angle have no solution with its first joint there and
/// the wrist stretched.
fn without_family(model: &Model, form: &ClosedForm, fifth: f64, random: &mut Random) -> usize {
    let chain = model.chain();
    let is_missing = |k: &usize| {
        let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
        q[4] = fifth;
        if k % 2 == 1 {
            q[2] = 0.0;
        }
        let solutions = form.solutions(&chain.fk(&q));
        let near = |angle: f64| angle.sin().abs() < 2e-3;
        let first = |a: f64| near(0.5 * (a - q[0]));
        !solutions.iter().any(|it| first(it.q[0]) && near(it.q[4]))
    };
    (0..2 * CONFIGURATIONS).filter(is_missing).count()
}

#[test]
fn a_stretched_wrist_is_answered_whatever_the_elbow_does() {
    let mut random = Random(0x0f_5eed);
    let exact = FRAC_PI_2.to_string();
    let digits = [
        (&exact[..], "0"),
        (&exact, "1e-11"),
        (&exact, "4e-11"),
        ("1.57079632679", "0"),
        ("1.5708", "0"),
    ];
    for (right_angle, tilt) in digits {
        for i in 0..4 {
            let (model, form) = arm(right_angle, tilt, &mut random);
            assert!(form.is_exact());
            // Two right angles that are off by as much are none together where the fifth joint is at
            // a half turn, and the arm is singular no more.
            let ends = match right_angle == exact {
                true => &[0.0, PI][..],
                false => &[0.0],
            };
            for &fifth in ends {
                let missing = without_family(&model, &form, fifth, &mut random);
                assert_eq!(missing, 0, "arm {i}, {right_angle}, {tilt}, q5 = {fifth}");
            }
        }
    }
}
