//! Two links of one length: folded, the end of one is on the axis of the other, which may then have
//! any angle. Next to that the arm has both bends of its elbow, half a turn apart.

use kin_codegen::closed_form::{BranchSolution, ClosedForm};
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use kin_runtime::Target;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// How far from folded, radians.
const NEXT_TO: [f64; 9] = [1e-10, 1e-9, 1e-8, 3e-8, 1e-7, 3e-7, 1e-6, 1e-4, 1e-2];

/// Joints from the shoulder on, and the tip's place in the frame of the last.
struct Arm {
    joints: String,
    tip: [f64; 3],
    /// Of the joint between the two links.
    elbow: usize,
    target: Target,
    /// How near to folded, radians, its plan tells the angle that is free there.
    told_from: f64,
    /// How many solutions next to the fold have the shoulder of the one that is asked for.
    solutions: usize,
    /// The most of them folded: half as many, unless the links differ by more than rounding, which
    /// leaves the two bends apart.
    most_folded: usize,
}

fn solved(arm: &Arm, random: &mut Random) -> (Model, ClosedForm) {
    let turned = [(); 6].map(|()| random.between(-3.0, 3.0));
    let [x, y, z] = arm.tip;
    let text = format!(
        "robot: arm\nunits: {{angle: rad, length: m}}\njoints:\n\
         - {{name: placed, type: fixed, xyz: [0.1, -0.2, 0.3], rpy: [{}, {}, {}]}}\n{}\
         tip: {{link: tip, xyz: [{x}, {y}, {z}], rpy: [{}, {}, {}]}}\n",
        turned[0], turned[1], turned[2], arm.joints, turned[3], turned[4], turned[5]
    );
    let source = Source {
        path: "arm.yaml".into(),
        text,
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let form = solve(&model, &Linkage::new(&model), arm.target)
        .unwrap()
        .form;
    (model, form)
}

fn apart(a: f64, b: f64) -> f64 {
    (a - b - ((a - b) / TAU).round() * TAU).abs()
}

/// Configurations with the elbow so far from an angle and, if there is a wrist, it away from stretched.
fn with_elbow<const N: usize>(
    arm: &Arm,
    elbow: f64,
    off: f64,
    random: &mut Random,
) -> Vec<[f64; N]> {
    let drawn = (0..20).map(|k| {
        let mut q: [f64; N] = std::array::from_fn(|_| random.between(-PI, PI));
        q[arm.elbow] = elbow + if k % 2 == 0 { off } else { -off };
        q
    });
    let is_bent = |q: &[f64; N]| q.get(arm.elbow + 2).is_none_or(|it| it.sin().abs() > 0.1);
    drawn.filter(is_bent).collect()
}

/// Both bends are found next to the fold, the one asked for as exactly as its target tells it; folded,
/// one stands for all angles of the link, and stretched the two are one.
fn has_both_bends<const N: usize>(arm: &Arm, random: &mut Random) {
    let (model, form) = solved(arm, random);
    let chain = model.chain();
    // With its shoulder, and the elbow no farther from folded or stretched.
    let beside = |q: &[f64; N], elbow: f64, off: f64| {
        let is_folded = |it: &&BranchSolution| apart(it.q[arm.elbow], elbow) < 2.0 * off + 1e-6;
        let has_shoulder =
            |it: &&BranchSolution| (0..arm.elbow - 1).all(|i| apart(it.q[i], q[i]) < 1e-4);
        let solutions = form.solutions(&chain.fk(q));
        let solutions = solutions.iter().filter(is_folded).filter(has_shoulder);
        solutions.cloned().collect::<Vec<_>>()
    };
    for off in NEXT_TO.into_iter().filter(|off| *off >= arm.told_from) {
        for q in with_elbow(arm, PI, off, random) {
            let solutions = beside(&q, PI, off);
            // What the shoulder is off moves the ends of the links apart.
            let is_near = |it: &BranchSolution| {
                let off_by = |joints: Range<usize>| {
                    let joints = joints.map(|i| apart(it.q[i], q[i]));
                    joints.fold(0.0, f64::max)
                };
                off_by(0..N) < (1e-13 + 4.0 * off_by(0..arm.elbow - 1)) / off + 1e-9
            };
            assert!(
                solutions.iter().any(is_near),
                "{off:e} from folded: {q:?} is none of {solutions:?}"
            );
            assert_eq!(solutions.len(), arm.solutions, "{off:e} from folded: {q:?}");
        }
    }
    for elbow in [0.0, PI] {
        let mut told = 0;
        for q in with_elbow(arm, elbow, 0.0, random) {
            let solutions = beside(&q, elbow, 0.0);
            // Rounding of a shoulder that is nearly singular moves the two apart.
            let off =
                |it: &BranchSolution| (0..arm.elbow - 1).any(|i| apart(it.q[i], q[i]) > 1e-14);
            if solutions.iter().any(off) {
                continue;
            }
            told += 1;
            let counts = arm.solutions / 2..=arm.most_folded;
            assert!(counts.contains(&solutions.len()), "{q:?}: {solutions:?}");
            assert!(solutions.iter().all(|it| it.singular), "{solutions:?}");
        }
        assert!(told > 5, "{told} of 20");
    }
}

#[test]
fn a_folded_arm_with_a_wrist() {
    let mut random = Random(0xf01d);
    // In a file whose axes are off their design the links are equal but for some digits.
    for (shoulder, longer) in [
        (0.05, 0.0),
        (0.1, 0.0),
        (0.15, 0.0),
        (0.1, 1e-12),
        (0.1, 1e-10),
        (0.1, 1e-8),
    ] {
        let length = random.between(0.2, 0.6);
        let other = length + longer;
        let arm = Arm {
            joints: format!(
                "- {{name: q1, axis: [0, 0, 1]}}\n\
                 - {{name: q2, xyz: [{shoulder}, 0, 0.3], axis: [0, 1, 0]}}\n\
                 - {{name: q3, xyz: [0, 0, {length}], axis: [0, 1, 0]}}\n\
                 - {{name: q4, axis: [0, 0, 1]}}\n\
                 - {{name: q5, xyz: [0, 0, {other}], axis: [0, 1, 0]}}\n\
                 - {{name: q6, axis: [0, 0, 1]}}\n"
            ),
            tip: [0.0, 0.0, 0.1],
            elbow: 2,
            target: Target::Pose,
            told_from: 1e-10,
            solutions: 4,
            most_folded: if longer == 0.0 { 2 } else { 4 },
        };
        has_both_bends::<6>(&arm, &mut random);
    }
}

/// Their ends meet beside the plane of the links only when seen along the parallel axes.
#[test]
fn a_folded_arm_of_three_parallel_axes() {
    let mut random = Random(0x3f01d);
    for _ in 0..3 {
        let length = random.between(0.2, 0.6);
        let [offset, wrist, tool] = [(); 3].map(|()| random.between(0.05, 0.15));
        let arm = Arm {
            joints: format!(
                "- {{name: q1, axis: [0, 0, 1]}}\n\
                 - {{name: q2, xyz: [0, 0, 0.3], axis: [0, 1, 0]}}\n\
                 - {{name: q3, xyz: [0, 0, {length}], axis: [0, 1, 0]}}\n\
                 - {{name: q4, xyz: [0, {offset}, {length}], axis: [0, 1, 0]}}\n\
                 - {{name: q5, xyz: [0, 0, {wrist}], axis: [0, 0, 1]}}\n\
                 - {{name: q6, axis: [0, 1, 0]}}\n"
            ),
            tip: [0.0, tool, 0.0],
            elbow: 2,
            target: Target::Pose,
            told_from: 1e-10,
            solutions: 2,
            most_folded: 1,
        };
        has_both_bends::<6>(&arm, &mut random);
    }
}

#[test]
fn a_folded_arm_of_two_joints() {
    let mut random = Random(0x2f01d);
    for _ in 0..3 {
        let length = random.between(0.2, 0.6);
        let arm = Arm {
            joints: format!(
                "- {{name: q1, axis: [0, 0, 1]}}\n\
                 - {{name: q2, xyz: [{length}, 0, 0], axis: [0, 0, 1]}}\n"
            ),
            tip: [length, 0.0, 0.0],
            elbow: 1,
            target: Target::Position,
            told_from: 1e-8,
            solutions: 2,
            most_folded: 1,
        };
        has_both_bends::<2>(&arm, &mut random);
    }
}

#[test]
fn a_folded_scara() {
    let mut random = Random(0x5f01d);
    for _ in 0..3 {
        let length = random.between(0.2, 0.6);
        let arm = Arm {
            joints: format!(
                "- {{name: q1, axis: [0, 0, 1]}}\n\
                 - {{name: q2, xyz: [{length}, 0, 0.1], axis: [0, 0, 1]}}\n\
                 - {{name: q3, type: prismatic, xyz: [{length}, 0, 0], axis: [0, 0, -1]}}\n\
                 - {{name: q4, axis: [0, 0, 1]}}\n"
            ),
            tip: [0.0, 0.0, -0.05],
            elbow: 1,
            target: Target::Pose,
            told_from: 1e-10,
            solutions: 2,
            most_folded: 1,
        };
        has_both_bends::<4>(&arm, &mut random);
    }
}

/// Their difference would be missing from all solutions.
#[test]
fn links_that_are_nearly_equal_are_not_taken_for_it() {
    let mut random = Random(0x4f01d);
    for more in [1e-3, 1e-4, 1e-5, 1e-6] {
        let length = random.between(0.2, 0.6);
        let arm = Arm {
            joints: format!(
                "- {{name: q1, axis: [0, 0, 1]}}\n\
                 - {{name: q2, xyz: [0.1, 0, 0.3], axis: [0, 1, 0]}}\n\
                 - {{name: q3, xyz: [0, 0, {length}], axis: [0, 1, 0]}}\n"
            ),
            tip: [0.0, 0.0, length * (1.0 + more)],
            elbow: 2,
            target: Target::Position,
            told_from: 0.0,
            solutions: 2,
            most_folded: 1,
        };
        let (model, form) = solved(&arm, &mut random);
        let chain = model.chain();
        for q in with_elbow::<3>(&arm, 2.0, 0.0, &mut random) {
            let solutions = form.solutions(&chain.fk(&q));
            assert!(!solutions.is_empty(), "{more:e}: {q:?}");
            assert!(
                solutions.iter().all(|it| it.residual < 1e-13),
                "{more:e}: {solutions:?}"
            );
        }
    }
}
