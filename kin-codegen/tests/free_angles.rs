//! Three parallel axes and a wrist, with the wrist stretched or over the first axis: a sum of angles or
//! the first is free then, but not every value of it leaves the elbow a root.

use kin_codegen::closed_form::ClosedForm;
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::{Options, compile};
use kin_runtime::Target;
use std::f64::consts::{FRAC_PI_2, PI};

/// Of each arm, as many with the elbow anywhere and with the arm straight.
const CONFIGURATIONS: usize = 100;

/// The arm of a file, solved for a target.
fn solved(text: String, target: Target) -> (Model, ClosedForm) {
    let source = Source {
        path: "arm.yaml".into(),
        text,
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let form = solve(&model, &Linkage::new(&model), target).unwrap().form;
    (model, form)
}

/// The arm of some lines of Denavit and Hartenberg's parameters: α, a, θ and d.
fn arm_of(links: &[(&str, f64, f64, f64)]) -> (Model, ClosedForm) {
    let links = links.iter().enumerate().map(|(i, (alpha, a, theta, d))| {
        format!(
            "- {{name: q{}, alpha: {alpha}, a: {a}, theta: {theta}, d: {d}}}\n",
            i + 1
        )
    });
    let head = "robot: arm\nunits: {angle: rad, length: m}\ndh:\n";
    solved(head.to_owned() + &links.collect::<String>(), Target::Pose)
}

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
    arm_of(&links)
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

/// The fifth and sixth axes meet a little way off the fourth, and where they do may be over the first.
#[test]
fn a_wrist_over_the_base_is_answered_whatever_the_elbow_does() {
    let mut random = Random(0xba5e);
    let right_angle = FRAC_PI_2.to_string();
    let back = format!("-{right_angle}");
    for i in 0..6 {
        let mut length = |from, to| random.between(from, to);
        let [upper, lower, wrist] = [length(0.2, 0.5), length(0.2, 0.5), length(0.05, 0.15)];
        // Of some the shoulder is off the first axis.
        let shoulder = if i % 2 == 0 { 0.0 } else { length(-0.05, 0.05) };
        let base = length(0.05, 0.2);
        let (model, form) = arm_of(&[
            (&right_angle, shoulder, 0.0, base),
            ("0", upper, 0.0, 0.0),
            ("0", lower, 0.0, 0.0),
            (&right_angle, wrist, 0.0, 0.0),
            (&back, 0.0, 0.0, 0.0),
            ("0", 0.0, 0.0, 0.1),
        ]);
        let chain = model.chain();
        let mut over = Vec::new();
        while over.len() < CONFIGURATIONS {
            let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
            let reach = shoulder + upper * q[1].cos() + lower * (q[1] + q[2]).cos();
            if reach.abs() < wrist {
                q[3] = (-reach / wrist).acos() - q[1] - q[2];
                over.push(q);
            }
        }
        over.retain(|q| form.solutions(&chain.fk(q)).is_empty());
        assert_eq!(over.len(), 0, "arm {i}: {over:?}");
    }
}

/// Of an arm of links in one plane, then yaw and roll, that is stretched straight up: the first angle is
/// free, and at one value of it, and the opposite one, a later root is double; at others it is none.
/// Next to that as well, and the frames of base and tool turned.
#[test]
fn an_arm_straight_up_is_answered() {
    let mut random = Random(0x7ec4);
    for i in 0..6 {
        let mut length = |from, to| random.between(from, to);
        let [upper, lower, wrist] = [length(0.2, 0.5), length(0.2, 0.5), length(0.05, 0.15)];
        let turned = [(); 6].map(|()| length(-3.0, 3.0));
        let text = format!(
            "robot: up\nunits: {{angle: rad, length: m}}\njoints:\n\
             - {{name: j1, rpy: [{}, {}, {}], axis: [0, 0, 1]}}\n\
             - {{name: j2, xyz: [0, 0, 0.2], axis: [0, 1, 0]}}\n\
             - {{name: j3, xyz: [0, 0, {upper}], axis: [0, 1, 0]}}\n\
             - {{name: j4, xyz: [0, 0, {lower}], axis: [0, 1, 0]}}\n\
             - {{name: j5, xyz: [0, 0, {wrist}], axis: [1, 0, 0]}}\n\
             - {{name: j6, axis: [0, 0, 1]}}\n\
             tip: {{link: tip, xyz: [0, 0, 0.1], rpy: [{}, {}, {}]}}\n",
            turned[0], turned[1], turned[2], turned[3], turned[4], turned[5]
        );
        let (model, form) = solved(text, Target::Pose);
        let chain = model.chain();
        let is_missing = |k: &usize| {
            let off = [0.0, 1e-12, 1e-10, 1e-9, 1e-7, 1e-6][k % 6];
            let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
            for q in &mut q[1..4] {
                *q = off * random.between(-1.0, 1.0);
            }
            // There a direction to turn in is lost as well.
            let is_in_line = q[4].cos().abs() < 0.01;
            !is_in_line && form.solutions(&chain.fk(&q)).is_empty()
        };
        let missing = (0..120).filter(is_missing).count();
        assert_eq!(missing, 0, "arm {i}");
    }
}

/// Of a desk arm's five joints the last is at a right angle: its tool's axis lies along the three parallel
/// ones, whose sum is free. The plan that tells most is none of those that are tried first.
#[test]
fn a_tool_along_the_elbow_is_answered_whatever_the_elbow_does() {
    let mut random = Random(0xde5c);
    for i in 0..3 {
        let mut length = |from, to| random.between(from, to);
        let [shoulder, upper, lower] = [length(0.01, 0.03), length(0.1, 0.3), length(0.1, 0.3)];
        let [wrist, aside, tip, above] = [
            length(0.04, 0.08),
            length(0.001, 0.01),
            length(0.08, 0.15),
            length(0.01, 0.03),
        ];
        let text = format!(
            "robot: desk\nunits: {{angle: rad, length: m}}\njoints:\n\
             - {{name: j1, xyz: [0, 0, 0.06], axis: [0, 0, 1]}}\n\
             - {{name: j2, xyz: [{shoulder}, 0, 0.05], axis: [0, 1, 0]}}\n\
             - {{name: j3, xyz: [0, 0, {upper}], axis: [0, 1, 0]}}\n\
             - {{name: j4, xyz: [{lower}, 0, 0], axis: [0, 1, 0]}}\n\
             - {{name: j5, xyz: [{wrist}, 0, {aside}], axis: [1, 0, 0]}}\n\
             tip: {{link: tip, xyz: [{tip}, 0, {above}]}}\n"
        );
        let (model, form) = solved(text, Target::PositionAxis);
        let chain = model.chain();
        let is_missing = |k: &usize| {
            let mut q: [f64; 5] = std::array::from_fn(|_| random.between(-PI, PI));
            q[4] = if k.is_multiple_of(2) {
                FRAC_PI_2
            } else {
                -FRAC_PI_2
            };
            let target = chain.fk(&q);
            form.solved::<5>(&target, &[]).is_empty()
        };
        let missing = (0..CONFIGURATIONS).filter(is_missing).count();
        assert_eq!(missing, 0, "arm {i}");
    }
}

/// Seven joints and a wrist of which one is given, with the sum of three free as well: where what a plan
/// divides by vanishes is found from starts that are no half turn apart.
#[test]
fn a_free_sum_beside_a_given_joint_turns() {
    let text = "robot: arm\nunits: {angle: rad, length: m}\njoints:\n\
         - {name: j1, xyz: [0, 0, 0.05], axis: [0, 0, 1]}\n\
         - {name: j2, xyz: [0.02, 0, 0.01], axis: [0, 1, 0]}\n\
         - {name: j3, xyz: [0.11, 0, 0], axis: [0, 1, 0]}\n\
         - {name: j4, xyz: [0.095, 0, 0], axis: [0, 1, 0]}\n\
         - {name: j5, xyz: [0.018, 0, 0], axis: [1, 0, 0]}\n\
         - {name: j6, xyz: [0.018, 0, 0], axis: [0, 0, 1]}\n\
         - {name: j7, xyz: [0.02, 0, 0], axis: [0, 0, 1]}\n\
         tip: {link: tip, xyz: [0, 0, 0.03]}\n";
    let source = Source {
        path: "arm.yaml".into(),
        text: text.into(),
    };
    let options = Options {
        free: vec!["j7".into()],
        ..Options::default()
    };
    let compiled = compile(&source, &options).unwrap();
    let arm = compiled.arm().unwrap();
    let form = arm.form().unwrap();
    let chain = arm.model.chain();
    let mut random = Random(0xf5ee);
    for _ in 0..CONFIGURATIONS {
        let mut q: [f64; 7] = std::array::from_fn(|_| random.between(-PI, PI));
        q[4] = FRAC_PI_2;
        let found = form.solved::<6>(&chain.fk(&q), &q[6..]);
        assert!(!found.is_empty(), "{q:?}");
    }
}

/// The first three axes are parallel, and where the fourth and fifth joints are at right angles the
/// sixth is as well: no relation tells its angle, and the quartic of both is nothing but rounding.
#[test]
fn a_fourth_parallel_axis_leaves_a_pair_of_relations_free() {
    let mut random = Random(0x5_b6);
    let (right_angle, half_turn) = (FRAC_PI_2.to_string(), PI.to_string());
    let back = format!("-{right_angle}");
    for i in 0..6 {
        let mut length = |from, to| random.between(from, to);
        let (model, form) = arm_of(&[
            (&half_turn, length(0.2, 0.5), 0.0, length(0.1, 0.4)),
            ("0", length(0.1, 0.4), 0.0, 0.0),
            (&back, 0.0, 0.0, 0.0),
            (&right_angle, length(0.2, 0.4), 0.0, length(0.1, 0.2)),
            (&right_angle, length(0.02, 0.1), 0.0, 0.0),
            ("0", 0.0, 0.0, length(0.2, 0.4)),
        ]);
        let chain = model.chain();
        let is_missing = |k: &usize| {
            let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
            q[3] = FRAC_PI_2 - PI * (k % 2) as f64;
            q[4] = FRAC_PI_2 - PI * (k / 2 % 2) as f64;
            if k / 4 % 2 == 1 {
                q[2] = PI * (k / 8 % 2) as f64;
            }
            let solutions = form.solutions(&chain.fk(&q));
            // All of the family is singular, and told to be.
            !solutions.iter().any(|it| it.singular) || solutions.iter().any(|it| !it.singular)
        };
        let missing = (0..2 * CONFIGURATIONS).filter(is_missing).count();
        assert_eq!(missing, 0, "arm {i}, {}", form.plan);
    }
}
