//! Arms that are off their design by noise of all sizes: nothing is lost next to where
//! the design is singular, and solving them takes a bounded number of steps.

mod measured;

use kin_codegen::Scalar;
use kin_codegen::certificate::recovered;
use kin_codegen::closed_form::{BranchSolution, ClosedForm, Reading, Refinement};
use kin_codegen::expr::inverse::FreeJoints;
use kin_codegen::geometry::{Linkage, conditioning, idealize, natural_target, size};
use kin_codegen::model::Model;
use kin_codegen::plan::{Plans, Target};
use kin_codegen::random::Random;
use kin_codegen::redundancy::{Asked, solve_redundant};
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::univariate::Kept;
use kin_runtime::Pose;
use measured::{configuration, measured};
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

/// Below this conditioning solutions may be lost.
const DROWNED: f64 = 1e-4;

fn design(path: &str) -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    written(std::fs::read_to_string(root.join(path)).unwrap())
}

fn written(text: impl Into<String>) -> Model {
    let source = Source {
        path: "arm".into(),
        text: text.into(),
    };
    Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap()
}

const NOISE: [f64; 11] = [
    1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2,
];

fn nothing_is_lost(design: &Model, noise: &[f64]) {
    let mut random = Random(0x5eed);
    for &noise in noise {
        let model = measured(design, noise, &mut random);
        let (chain, length) = (model.chain(), size(&model));
        let Certified { form, certificate } =
            solve(&model, &Linkage::new(&model), Target::Pose).unwrap();
        // Twelve digits leave as much, which no refinement is needed for.
        assert!(noise > 1e-11 || form.is_exact(), "{noise:e}");
        let is_refined = matches!(form.refinement, Refinement::Univariate(_));
        assert!(
            is_refined || form.elimination().is_some() || form.is_exact(),
            "{noise:e}"
        );
        assert!(certificate.excused_share < 0.02, "{noise:e}");
        for k in 0..600 {
            let q = configuration(6, k, &mut random);
            let target = chain.fk(&q);
            let solutions = form.solutions(&target);
            let numbers: BTreeSet<u32> = solutions.iter().map(|s| s.branch).collect();
            assert_eq!(numbers.len(), solutions.len(), "{noise:e} {q:?}");
            for solution in &solutions {
                let miss = Target::Pose.distance(&chain.fk(&solution.q), &target, length);
                assert!(
                    miss < Scalar::F64.tolerances().solved * length,
                    "{noise:e} {q:?}: {solution:?}"
                );
            }
            let conditioning = conditioning(&chain, &q, length, Target::Pose);
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(
                conditioning < DROWNED || back.is_ok(),
                "{noise:e}, conditioning {conditioning:e}: {back:?}"
            );
        }
    }
}

#[test]
fn nothing_is_lost_of_three_parallel_axes() {
    nothing_is_lost(&design("robots/ur5e.urdf"), &NOISE);
}

#[test]
fn nothing_is_lost_of_an_offset_elbow_and_a_wrist() {
    nothing_is_lost(&design("robots/kr6_r900.yaml"), &NOISE);
}

#[test]
fn nothing_is_lost_of_an_offset_shoulder_and_a_wrist() {
    nothing_is_lost(&design("robots/puma560.yaml"), &NOISE);
}

/// An instrument about a remote centre. Its roll changes no height of that centre over a plane along the
/// slide, where the loop is closed, and is crossed as if it stood at zero; but there the wrist does not
/// change the height over one of these planes, which it does elsewhere. Plans by that one had branches
/// of rounding alone, flagged at every target, and the eliminations that were asked at each lost some.
const REMOTE_CENTRE: &str = "\
robot: remote_centre
units: {angle: rad, length: m}
screws:
  - {name: yaw,   axis: [0, -1, 0], point: [0, 0.486, 0.152]}
  - {name: pitch, axis: [-1, 0, 0], point: [0, 0.486, 0.152]}
  - {name: slide, axis: [0, 0, -1], type: prismatic}
  - {name: roll,  axis: [0, 0, -1], point: [0, 0.486, 0.168]}
  - {name: wrist, axis: [1, 0, 0],  point: [0, 0.486, 0.168]}
  - {name: twist, axis: [0, 1, 0],  point: [0, 0.486, 0.159]}
home: {xyz: [0, 0.486, 0.159]}
";

#[test]
fn nothing_is_lost_about_a_remote_centre() {
    // A slide takes the turn of less to where it counts.
    nothing_is_lost(&written(REMOTE_CENTRE), &NOISE[3..]);
}

#[test]
fn all_plans_about_a_remote_centre_tell_solutions() {
    let model = written(REMOTE_CENTRE);
    let linkage = Linkage::new(&model);
    let reading = Reading::new(&model, &linkage, idealize(&model, 1e-12), Target::Pose).unwrap();
    let target = model.chain().fk(&[0.4, -0.7, 0.11, 1.3, 0.6, -0.9]);
    let mut plans = 0;
    for plan in Plans::new(&linkage, Target::Pose).take(40) {
        let form = reading.form(&plan, FreeJoints::Seeded);
        let branches = form.branches_at(&target, &[]);
        assert!(branches.iter().any(|branch| !branch.singular), "{plan}");
        plans += 1;
    }
    assert!(plans >= 20, "{plans}");
}

/// An axis of the wrist is two degrees off a right angle, and passes 4 mm beside the point of the others.
/// Read as a wrist, it is never stretched; next to that, where the first axis moves the wrist little, its
/// root has no value by more than the first derivatives allow for, but what it tells is in doubt.
const SKEW_WRIST: &str = "\
robot: skew_wrist
units: {angle: rad, length: m}
screws:
  - {name: a, axis: [0, 0, -1], point: [0, 0, 0]}
  - {name: b, axis: [0.999396, 0.034755, 0], point: [-0.014774, -0.150604, 0.16]}
  - {name: c, axis: [-0.999396, -0.034755, 0], point: [-0.014774, -0.150604, 0.52]}
  - {name: d, axis: [-0.034755, 0.999396, 0], point: [0.027726, -0.394787, 0.5625]}
  - {name: e, axis: [-0.999396, -0.034755, 0], point: [0.032726, -0.517869, 0.5625]}
  - {name: f, axis: [0, 1, 0], point: [0.027726, -0.611395, 0.5625]}
home: {xyz: [0.027726, -0.611395, 0.5625]}
";

#[test]
fn no_branch_that_is_in_doubt_is_dropped() {
    let model = written(SKEW_WRIST);
    let (chain, length) = (model.chain(), size(&model));
    let found = solve(&model, &Linkage::new(&model), Target::Pose).unwrap();
    assert!(matches!(found.form.refinement, Refinement::Univariate(_)));
    for (q, least) in [
        ([-1.567, -1.731, -2.116, -0.911, 0.0239, -1.795], 3e-3),
        (
            [
                0.49494950,
                -2.22072391,
                -2.82852853,
                -0.84308019,
                -0.00694337,
                2.6011,
            ],
            1e-4,
        ),
        (
            [
                1.7442353583137375,
                -2.848446576541183,
                -1e-6,
                -0.5549516679352049,
                1e-12,
                PI,
            ],
            1e-4,
        ),
    ] {
        let conditioning = conditioning(&chain, &q, length, Target::Pose);
        let back = recovered(
            &model,
            &q,
            &found.form.solutions(&chain.fk(&q)),
            conditioning,
        );
        assert!(conditioning > least, "{conditioning:e}");
        assert!(back.is_ok(), "{back:?}");
    }
    let mut random = Random(0x5eed);
    for _ in 0..20_000 {
        let mut q = configuration(6, 0, &mut random);
        // Next to where the wrist is stretched.
        q[4] = random.between(-0.05, 0.05);
        let conditioning = conditioning(&chain, &q, length, Target::Pose);
        if conditioning > DROWNED {
            let solutions = found.form.solutions(&chain.fk(&q));
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(back.is_ok(), "{conditioning:e}: {back:?}");
        }
    }
}

/// Right angles of three digits. Where all joints are nearly at quarter turns, a family of solutions is
/// near: more than one vector is then nearly taken to zero at every value of the kept joint, so that what
/// is read from a root leads to the solution at another one, or is off as that of an extraneous root.
const THREE_DIGITS: &str = "\
robot: three_digits
units: {angle: rad, length: m}
joints:
  - {name: waist,    axis: [0, 0, 1]}
  - {name: shoulder, xyz: [0.075, 0.015, 0.05597], rpy: [-1.57, 0, 0], axis: [0, 0, 1]}
  - {name: elbow,    xyz: [-0.3, 0, 0], axis: [0, 0, 1]}
  - {name: forearm,  xyz: [-0.15, 0, 0], rpy: [0, 1.57, 0], axis: [0, 0, 1]}
  - {name: hand,     xyz: [0, 0, -0.15], rpy: [0, 1.57, 3.14], axis: [0, 0, 1]}
tip: {xyz: [0.08, 0, 0], rpy: [0, -1.57, 0]}
";

#[test]
fn solutions_beside_a_family_are_told_apart() {
    let model = written(THREE_DIGITS);
    let (chain, length, target) = (model.chain(), size(&model), Target::PositionAxis);
    let linkage = Linkage::for_target(&model, target);
    let Certified { form, .. } = solve(&model, &linkage, target).unwrap();
    assert!(form.elimination().is_some());
    let is_recovered = |q: &[f64]| {
        let conditioning = conditioning(&chain, q, length, target);
        let back = recovered(&model, q, &form.solutions(&chain.fk(q)), conditioning);
        assert!(
            conditioning < DROWNED || back.is_ok(),
            "{conditioning:e}: {back:?}"
        );
    };
    for q in [
        [
            0.16005556804228993,
            -1.5707963418707656,
            1.5707959538550846,
            3.1415676578436837,
            -1.5707963267676381,
        ],
        [
            0.7118185782144688,
            1.5707963267314526,
            1.5707963824435733,
            9.17656453862701e-12,
            -1.5707849703320966,
        ],
        [
            -1.7049261421401924,
            -0.7162264212558909,
            1.570796326803671,
            -3.1408344230200647,
            -1.5707963452398064,
        ],
    ] {
        is_recovered(&q);
    }
    let mut random = Random(0x5eed);
    for _ in 0..10_000 {
        let mut q = configuration(5, 0, &mut random);
        for joint in &mut q[1..] {
            let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let off = sign * 10_f64.powf(random.between(-12.0, -3.0));
            *joint = random.below(4) as f64 * FRAC_PI_2 - PI + off;
        }
        is_recovered(&q);
    }
}

/// Of seven joints, at values of one that is given: at an end of the chain, where an arm is not asked
/// for another, or between the others, for which eliminations are asked that do not depend on it.
/// Two of the configurations tried while an arm of the last kind is compiled are 2.4e-3 rad apart,
/// at a conditioning of 4e-4 and where no pivot of the Jacobian is below 5e-3.
fn nothing_is_lost_of_seven(path: &str, free: Option<usize>) {
    let design = design(path);
    let mut random = Random(0x5eed);
    let asked = Asked {
        joints: free.into_iter().collect(),
        ..Asked::default()
    };
    for noise in [1e-10, 1e-9, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        let model = measured(&design, noise, &mut random);
        let (chain, length) = (model.chain(), size(&model));
        let solved = solve_redundant(&model, &Linkage::new(&model), Target::Pose, &asked);
        let (Certified { form, certificate }, redundancy) = solved.unwrap();
        match free {
            Some(joint) => assert_eq!(redundancy.joints, [joint], "{noise:e}"),
            None => assert!(matches!(redundancy.joints[..], [0 | 6]), "{noise:e}"),
        }
        let kept = &form.elimination().unwrap().kept;
        // One that is never sure and loses random targets says nothing of those near singular.
        let says = |kept: &Kept| kept.unsure < 100.0 || kept.lost == 0;
        assert!(kept.iter().all(says), "{noise:e}: {kept:?}");
        assert!(certificate.excused_share < 0.03, "{noise:e}");
        for k in 0..300 {
            let q = configuration(7, k, &mut random);
            let target = chain.fk(&q);
            let (parameters, solved) = form.split(&q);
            let solutions = form.solutions_at(&target, &parameters);
            let numbers: BTreeSet<u32> = solutions.iter().map(|s| s.branch).collect();
            assert_eq!(numbers.len(), solutions.len(), "{noise:e} {q:?}");
            for solution in &solutions {
                let whole = form.whole(&solution.q, &parameters);
                let miss = Target::Pose.distance(&chain.fk(&whole), &target, length);
                assert!(
                    miss < Scalar::F64.tolerances().solved * length,
                    "{noise:e} {q:?}: {solution:?}"
                );
            }
            let held = model.locked(&redundancy.joints, &parameters);
            let conditioning = conditioning(&held.chain(), &solved, length, Target::Pose);
            let back = recovered(&held, &solved, &solutions, conditioning);
            assert!(
                conditioning < DROWNED || back.is_ok(),
                "{noise:e}, conditioning {conditioning:e}: {back:?}"
            );
        }
    }
}

#[test]
fn nothing_is_lost_of_a_spherical_shoulder() {
    nothing_is_lost_of_seven("robots/panda.yaml", None);
}

#[test]
fn nothing_is_lost_of_a_spherical_shoulder_and_wrist() {
    nothing_is_lost_of_seven("robots/iiwa14.yaml", None);
}

#[test]
fn nothing_is_lost_at_values_of_an_inner_joint() {
    nothing_is_lost_of_seven("robots/iiwa14.yaml", Some(2));
    nothing_is_lost_of_seven("robots/iiwa14.yaml", Some(5));
}

/// Solutions next to a singularity of the design are there in twos and fours: the
/// branches alone do not tell them.
#[test]
fn branches_alone_lose_some() {
    let mut random = Random(0x5eed);
    let model = measured(&design("robots/kr6_r900.yaml"), 1e-3, &mut random);
    let linkage = Linkage::new(&model);
    let mut form = solve(&model, &linkage, Target::Pose).unwrap().form;
    let chain = model.chain();
    let lost = |form: &ClosedForm| {
        let mut random = Random(7);
        let mut lost = 0;
        for k in 0..600 {
            let q = configuration(6, k, &mut random);
            let conditioning = conditioning(&chain, &q, linkage.size, Target::Pose);
            let solutions = form.solutions(&chain.fk(&q));
            lost += usize::from(recovered(&model, &q, &solutions, conditioning).is_err());
        }
        lost
    };
    assert_eq!(lost(&form), 0);
    let Refinement::Univariate(arm) = &mut form.refinement else {
        panic!("the arm is refined beside an elimination");
    };
    arm.kept.clear();
    assert!(lost(&form) > 0);
}

/// The share of random targets at which the branches are not known to be all solutions, an
/// elimination being asked. Derivatives of the roots by the target tell; bounds of what every
/// step makes of the one before, multiplied, would ask at each.
#[test]
fn branches_are_known_to_be_all() {
    for (path, noise, most) in [
        ("robots/ur5e.urdf", 1e-4, 0.2),
        ("robots/kr6_r900.yaml", 1e-4, 0.2),
        ("robots/puma560.yaml", 1e-4, 0.2),
        ("robots/ur5e.urdf", 1e-3, 0.5),
        ("robots/kr6_r900.yaml", 1e-3, 0.5),
    ] {
        let mut random = Random(0x5eed);
        let model = measured(&design(path), noise, &mut random);
        let form = solve(&model, &Linkage::new(&model), Target::Pose)
            .unwrap()
            .form;
        let chain = model.chain();
        let count = 400;
        let mut unknown = 0;
        for _ in 0..count {
            let q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
            let branches = form.branches_at(&chain.fk(&q), &[]);
            unknown += usize::from(branches.iter().any(|branch| branch.singular));
        }
        let share = unknown as f64 / f64::from(count);
        assert!(share < most, "{path} {noise:e}: {share}");
    }
}

/// Rows that vanish with the relations of the design keep the degree low and extraneous roots out, as
/// far as the noise of what is left of them allows.
#[test]
fn roots_are_clear_as_far_as_noise_allows() {
    for (noise, is_clear) in [(1e-3, true), (1e-4, true), (1e-7, false)] {
        let mut random = Random(0x5eed);
        let model = measured(&design("robots/ur5e.urdf"), noise, &mut random);
        let certified = solve(&model, &Linkage::new(&model), Target::Pose).unwrap();
        let kept = &certified.form.elimination().unwrap().kept[0];
        let said = format!("{noise:e}: degree {}", kept.elimination.degree);
        assert_eq!(kept.elimination.degree == 8, is_clear, "{said}");
        assert_eq!(kept.unsure < 10.0, is_clear, "{said}: {kept:?}");
        assert!(kept.noise < 1e-10, "{said}: {}", kept.noise);
    }
}

/// A thousandth as large, an arm has as many branches in doubt.
#[test]
fn doubt_does_not_depend_on_the_unit_of_length() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots/noisy");
    let text = std::fs::read_to_string(root.join("calibrated.yaml")).unwrap();
    let in_doubt = |unit: &str| {
        let model = written(text.replace("length: m}", unit));
        let linkage = Linkage::new(&model);
        let form = solve(&model, &linkage, Target::Pose).unwrap().form;
        let chain = model.chain();
        let mut random = Random(0x5eed);
        let branches = (0..2000).flat_map(|k| {
            let q = configuration(6, k, &mut random);
            form.branches_at(&chain.fk(&q), &[])
        });
        branches.filter(|branch| branch.singular).count()
    };
    let metres = in_doubt("length: m}");
    let millimetres = in_doubt("length: mm}");
    assert!(
        metres > 0 && metres.abs_diff(millimetres) <= metres / 100,
        "{metres} {millimetres}"
    );
}

/// How far the tips of an arm and of its design get apart tells which branches are in doubt: few
/// configurations take them farther, and none much.
#[test]
fn the_tips_get_hardly_farther_apart_than_is_said() {
    for path in [
        "robots/ur5e.urdf",
        "robots/kr6_r900.yaml",
        "robots/puma560.yaml",
    ] {
        let mut random = Random(0x5eed);
        for _ in 0..5 {
            let model = measured(&design(path), 1e-4, &mut random);
            let form = solve(&model, &Linkage::new(&model), Target::Pose)
                .unwrap()
                .form;
            let chains = [&model, &form.idealized.model].map(Model::chain);
            let mut most = 0.0_f64;
            for _ in 0..3000 {
                let q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
                let [a, b] = [0, 1].map(|i| chains[i].fk(&q));
                most = most.max(Target::Pose.distance(&a, &b, size(&model)));
            }
            assert!(
                form.tip_shift > 0.9 * most,
                "{path}: {} {most}",
                form.tip_shift
            );
            assert!(
                form.tip_shift < 1.2 * most,
                "{path}: {} {most}",
                form.tip_shift
            );
        }
    }
}

/// Where branches are known to be all, they are the same at every target that is off by as much as
/// the arms differ, by whatever turn and push: none of them ends, and another one is not known.
#[test]
fn known_branches_are_those_of_targets_beside() {
    let mut compared = 0;
    for path in [
        "robots/ur5e.urdf",
        "robots/kr6_r900.yaml",
        "robots/puma560.yaml",
    ] {
        let mut random = Random(0x5eed);
        let model = measured(&design(path), 1e-3, &mut random);
        let form = solve(&model, &Linkage::new(&model), Target::Pose)
            .unwrap()
            .form;
        let chain = model.chain();
        let numbers = |branches: &[BranchSolution]| -> BTreeSet<u32> {
            branches.iter().map(|branch| branch.branch).collect()
        };
        for k in 0..1500 {
            let target = chain.fk(&configuration(6, k, &mut random));
            let here = form.branches_at(&target, &[]);
            if here.iter().any(|branch| branch.singular) {
                continue;
            }
            for _ in 0..8 {
                let mut off = [0; 6].map(|_| random.between(-1.0, 1.0));
                let length = off.iter().map(|x| x * x).sum::<f64>().sqrt();
                off = off.map(|x| x / length);
                let turn = off[3..].iter().map(|x| x * x).sum::<f64>().sqrt();
                let axis = [3, 4, 5].map(|i| off[i] / turn);
                let size = size(&model);
                let angle = turn * form.tip_shift / size;
                let mut beside = target * Pose::from_axis_angle(axis, angle, [0.0; 3]);
                for (x, push) in beside.translation.iter_mut().zip(off) {
                    *x += push * form.tip_shift;
                }
                let there = form.branches_at(&beside, &[]);
                let known = there.iter().filter(|branch| !branch.singular);
                let known: Vec<_> = known.cloned().collect();
                let (here, there, known) = (numbers(&here), numbers(&there), numbers(&known));
                assert!(here.is_subset(&there), "{path}: {here:?} {there:?}");
                assert!(known.is_subset(&here), "{path}: {here:?} {known:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// The common normal of two axes that are nearly parallel is far away: frames there would cost
/// digits, and Newton's method would not come as near to its targets as solutions have to.
#[test]
fn nearly_parallel_axes_cost_no_digits() {
    let mut random = Random(0x5eed);
    for decade in 1..=12 {
        for multiple in [1.0, 2.0, 5.0] {
            let tilt = multiple * 10_f64.powi(-decade);
            let model = measured(&design("robots/tx60.yaml"), tilt, &mut random);
            let (chain, linkage) = (model.chain(), Linkage::new(&model));
            for k in 0..20 {
                let q = configuration(6, k, &mut random);
                let (here, _) = linkage.fk_jacobian::<6>(q[..].try_into().unwrap(), &[]);
                let apart = Target::Pose.distance(&here, &chain.fk(&q), linkage.size);
                assert!(apart < 2e-14 * linkage.size, "{tilt:e} {q:?}: {apart:e}");
            }
        }
    }
}

/// A slide that goes far beside a wrist that is off its point: the elimination that does best
/// on random targets loses round configurations, and others are never sure and lose none. Of the
/// first arm each loses some near the wrist's singularity, and two together none.
#[test]
fn round_configurations_of_a_noisy_arm_with_a_slide_come_back() {
    let design = design("robots/stanford.yaml");
    for (noise, seed, drowned) in [
        (1e-3, 2, DROWNED),
        (1e-3, 7, 1e-3),
        (2e-3, 4, 1e-3),
        (2e-3, 8, 1e-3),
    ] {
        let mut random = Random(0x9e37_79b9 * seed + 12345);
        let model = measured(&design, noise, &mut random);
        let solved = solve(&model, &Linkage::new(&model), Target::Pose);
        let Certified { form, certificate } = solved.expect("a plan");
        assert_eq!(certificate.lost, 0, "{noise:e} {seed}");
        let (chain, length) = (model.chain(), size(&model));
        for k in 0..600 {
            let q = configuration(6, k, &mut random);
            let conditioning = conditioning(&chain, &q, length, Target::Pose);
            let solutions = form.solutions(&chain.fk(&q));
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(conditioning < drowned || back.is_ok(), "{seed}: {back:?}");
        }
    }
}

/// Next to a singular wrist two solutions share what the joints in front of it do, and next to a
/// stretched elbow what those behind it do: where one elimination tells some of both, another is
/// asked where it is not sure.
#[test]
fn nothing_is_lost_of_a_wrist_that_pushes() {
    let text = "\
robot: pusher
units: {angle: rad, length: m}
screws:
  - {name: shoulder, axis: [0, -1, 0], point: [0, 0, 0.04]}
  - {name: elbow, axis: [0, -1, 0], point: [0.02, 0, 0.27]}
  - {name: roll, axis: [-0.7, 0, 0.71], point: [0.09, -0.0002, 0.195]}
  - {name: pitch, axis: [0, -1, 0], point: [0.178, -0.0007, 0.1085]}
  - {name: turn, axis: [-0.7, 0, 0.71], point: [0.221, 0.0004, 0.0706]}
  - {name: push, axis: [0, 1, 0], type: prismatic}
home: {xyz: [0.313, -0.025, -0.022]}
";
    let model = written(text);
    let form = solve(&model, &Linkage::new(&model), Target::Pose)
        .unwrap()
        .form;
    let (chain, length) = (model.chain(), size(&model));
    let mut random = Random(0xf17);
    let mut tried = 0;
    for k in 0..4000 {
        let mut q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
        q[3] = f64::from(k % 2) * PI + random.between(-0.02, 0.02);
        q[5] *= 0.01;
        let conditioning = conditioning(&chain, &q, length, Target::Pose);
        if conditioning > 10.0 * DROWNED {
            recovered(&model, &q, &form.solutions(&chain.fk(&q)), conditioning).unwrap();
            tried += 1;
        }
    }
    assert!(tried > 1000, "{tried}");
}

/// Five joints reach poses in one way: where the subproblem that comes first has nearly a double
/// root, its branch is off by the root of the noise and misses the target by as much, although the arm
/// is regular. A humanoid's arm in frames of six digits.
#[test]
fn nothing_is_lost_of_five_joints() {
    nothing_is_lost_of_short(&design("tests/languages/humanoid.yaml"), 3000);
}

/// With short offsets a nearly double root is off by a tenth of a radian, and with a joint behind the
/// tip that makes six, another solution is near. Where no branch tells a solution, the elimination has
/// to, and one that is rarely sure has another behind it.
#[test]
fn nothing_is_lost_of_five_joints_with_short_offsets() {
    for [roll, bend] in [[1e-6, 1e-6], [0.0, 1e-5]] {
        let roll = 0.014 + roll;
        let text = format!(
            "\
robot: humanoid
units: {{angle: rad, length: m}}
joints:
  - {{name: shoulder_pitch, xyz: [0, 0.1, 0.25], axis: [0, 0.96, 0.28]}}
  - {{name: shoulder_roll, xyz: [0, 0.048, {roll}], axis: [1, 0, 0]}}
  - {{name: shoulder_yaw, xyz: [0, 0.006, -0.103], axis: [0, 0, 1]}}
  - {{name: elbow, xyz: [{bend}, 0.002, -0.0855], axis: [0, 1, 0]}}
  - {{name: wrist_roll, xyz: [0.1, 0, {bend}], axis: [1, 0, 0]}}
"
        );
        nothing_is_lost_of_short(&written(text), 12_000);
    }
}

const MIRRORED: &str = "\
robot: mirrored
units: {angle: rad, length: m}
joints:
  - {name: shoulder, xyz: [0, 0, -0.057], axis: [0, 1, 0]}
  - {name: elbow, xyz: [0, 0, 0.38], axis: [0, 1, 0]}
  - {name: roll, xyz: [0, -0.153, -0.377], axis: [1, 0, 0]}
  - {name: yaw, xyz: [0, 0, -0.049], axis: [0, 0, -1]}
  - {name: pitch, xyz: [0, 0, 0], axis: [0, 1, 0]}
tip: {link: tool, xyz: [0.075, -0.081, 0]}
";

const NARROW_SHOULDER: &str = "\
robot: narrow_shoulder
units: {angle: rad, length: m}
joints:
  - {name: turn, xyz: [0, -0.025, 0], axis: [0.069, 0, 1]}
  - {name: tilt, xyz: [0, 0, 0.063], axis: [0, 0, -1]}
  - {name: swing, xyz: [0, -0.311, 0], axis: [0, -1, 0]}
  - {name: roll, xyz: [0.414, 0, -0.136], axis: [1, 0, 0]}
  - {name: nod, xyz: [0, 0, 0], axis: [-0.2, -0.51, 0.83]}
tip: {link: tool, xyz: [-0.434, 0, 0]}
";

/// Five joints are regular where a root is double, so that what noise there is counts by its root, and
/// off its design an arm comes near to a target with the mirror image of a solution: with the joint
/// behind its tip by as little as the noise.
#[test]
fn five_joints_lose_nothing_to_faint_noise() {
    for (design, noise, seed) in [
        (MIRRORED, 1e-7, 5),
        (MIRRORED, 1e-9, 2),
        (MIRRORED, 1e-10, 1),
        (NARROW_SHOULDER, 3e-11, 3),
        (NARROW_SHOULDER, 1e-10, 0),
    ] {
        let model = measured(&written(design), noise, &mut Random(seed));
        nothing_is_lost_of_short(&model, 4000);
    }
}

fn nothing_is_lost_of_short(model: &Model, targets: usize) {
    let form = solve(model, &Linkage::new(model), Target::Pose)
        .expect("a plan")
        .form;
    assert!(matches!(form.refinement, Refinement::Univariate(_)));
    let (chain, length) = (model.chain(), size(model));
    let mut random = Random(0x5eed);
    for k in 0..targets {
        let q = configuration(5, k, &mut random);
        let conditioning = conditioning(&chain, &q, length, Target::Pose);
        let solutions = form.solutions(&chain.fk(&q));
        let back = recovered(model, &q, &solutions, conditioning);
        assert!(conditioning < DROWNED || back.is_ok(), "{back:?}");
        for solution in &solutions {
            assert!(solution.residual <= 1e-9 * length, "{solution:?}");
        }
    }
}

/// Two parallel axes, but for noise of 1e-4 rad.
const TWO_PARALLEL: &str = "
robot: two_parallel
units: {angle: rad, length: m}
joints:
  - name: a
    xyz: [-0.23678955995193446, -0.34287039555932886, -0.30753399387695635]
    axis: [0.800316023964675, 0.47418748141964256, 0.36729806039125823]
  - name: b
    xyz: [-0.1971027211682397, 0.4481183512514772, -0.14921510589798523]
    axis: [-0.8003094877962845, -0.4742047748415574, -0.3671853633121412]
  - name: c
    xyz: [-0.0023564660150577304, 0.018862119299110025, -0.01918268900666417]
    axis: [-0.08713501704261323, 0.697829153462044, -0.7108518324596081]
  - name: d
    xyz: [0.009485689417990212, -0.07604853850811563, 0.07751935749796801]
    axis: [1.3374818615621327, 0.5808191644614922, -1.5293652320649938]
  - name: e
    xyz: [0.0024225408788196255, -0.0021863322644064373, -0.002383918078809176]
    axis: [-0.5933995871791188, 0.5368552253120696, 0.5997489898471212]
tip: {link: tip, xyz: [-0.3076104951624049, 0.5282953326770102, -0.011940661733157998]}
";

/// Three axes that meet, a slide and a joint behind it, but for noise of 1e-3.
const WRIST_BEFORE_SLIDE: &str = "
robot: wrist_that_slides
units: {angle: rad, length: m}
joints:
  - name: a
    xyz: [-0.00014455736590332808, -0.06624775636425, 0.4980762378808916]
    axis: [-0.0006033632520145025, -1.0010081736530463, 0.0004308974681708449]
    limits: [-3.1, 3.1]
  - name: b
    xyz: [-0.00024025765480802954, -0.28515727402693997, -0.27815617553813554]
    axis: [-0.0002819195204869762, 0.0016826943670912536, -1.0018617210947975]
    limits: [-3.1, 3.1]
  - name: c
    xyz: [-0.00023072938322844696, 0.00010406995130104584, 0.00011864910608358866]
    axis: [0.0014095624590887855, -0.9995045193265649, -0.001255146416382376]
    limits: [-3.1, 3.1]
  - name: d
    xyz: [0.0002936313956068832, 9.028133793434679e-05, -0.0005724625011717146]
    axis: [-1.3756084845441128, 0.11549091902833745, 1.7837006685109822]
    limits: [-3.1, 3.1]
  - name: e
    xyz: [0.00011572408521358812, -0.4980816598304229, 6.931071287793783e-05]
    axis: [-0.0007688304371811219, 0.0007031278106154117, 0.9989946277297096]
    limits: [-1, 1]
    type: prismatic
  - name: f
    xyz: [-1.7710808021708216e-05, 1.5726315228838897e-05, 0.0001947020001504659]
    axis: [-1.0006602522577568, 0.0011945656141416855, 0.0017362481233508793]
    limits: [-3.1, 3.1]
tip: {link: tip, xyz: [0.0003142391268154432, -0.000516732643402505, -3.4550687862040405e-05]}
";

fn comes_back<const N: usize>(arm: &str, lost: &[[f64; N]]) {
    let model = written(arm);
    let linkage = Linkage::new(&model);
    let form = solve(&model, &linkage, Target::Pose).expect("a plan").form;
    for q in lost {
        let solutions = form.solutions(&model.chain().fk(q));
        let back = recovered(&model, q, &solutions, 1.0);
        assert!(back.is_ok(), "{back:?}");
    }
}

/// With a joint behind the tip this arm is nearly singular where it is not itself, and one elimination
/// cannot tell its solutions apart: another one does.
#[test]
fn five_joints_are_asked_in_two_ways() {
    let lost = [
        [
            2.489976795052005,
            -0.765776202479516,
            -1.63263242412624,
            -0.7732130815640983,
            1.1103167957976199,
        ],
        [
            -2.378796433886249,
            2.530031621537252,
            1.7049286876994787,
            0.047448557455724405,
            -2.688141730901151,
        ],
        [
            0.6101583049339232,
            -0.5023907109241437,
            -2.0957174673925216,
            -0.6953052969593263,
            1.0415750046775503,
        ],
        [
            -2.322777963398348,
            -0.5141749906570943,
            -1.871040269098673,
            -0.7136104292678818,
            -2.571373906191445,
        ],
        [
            -2.227290866933422,
            2.5586854916938373,
            -1.7002788303541294,
            -0.6888895070195957,
            -2.8714739544220524,
        ],
        [
            -0.6667527564407809,
            -0.5766549437535127,
            0.7186499611343415,
            -0.8244248297506762,
            -2.645136110226943,
        ],
    ];
    comes_back(TWO_PARALLEL, &lost);
}

/// One elimination is not sure of its answer at every other target, and has lost these.
#[test]
fn what_one_is_not_sure_of_another_finds() {
    let lost = [
        [
            1.0402349496943635,
            0.6611072024341236,
            -0.6791274719463685,
            -0.3774582712742882,
            0.735788855089097,
            2.847875545936372,
        ],
        [
            2.304557478529334,
            0.9129627498205024,
            -1.7327628868630462,
            0.04221597196631066,
            -0.11551881641048611,
            1.8756542741122826,
        ],
        [
            0.47298823471590357,
            -1.2766316367342139,
            -0.17396567339821623,
            3.1206026819875956,
            -0.1713349280227543,
            -2.064790152293069,
        ],
    ];
    comes_back(WRIST_BEFORE_SLIDE, &lost);
}

/// The leg of a quadruped as it was exported: what is parallel and what meets does so to a few
/// millionths.
const LEG: &str = "
robot: leg
units: {angle: rad, length: m}
joints:
  - {name: hip,   xyz: [0.1934, 0.0465, 0],        rpy: [0.000002, 0, -0.000001], axis: [1, 0, 0]}
  - {name: thigh, xyz: [0, 0.0955, 0.000003],      rpy: [0, 0.000003, 0.000002],  axis: [0, 1, 0]}
  - {name: knee,  xyz: [0, 0.000001, -0.213],      rpy: [-0.000004, 0, 0.000003], axis: [0, 1, 0]}
tip: {link: foot, xyz: [0, 0, -0.213]}
";

/// Three joints reach positions. Of the two relations of the first and the last each depends, but for
/// noise, on one of them alone, so that neither can be eliminated: roots are as far apart as solutions in
/// both together. Random, next to round values, and folded, where the links are as long as each other.
#[test]
fn legs_of_any_noise_have_all_their_solutions() {
    let design = written(LEG);
    for decade in 2..=10 {
        let mut random = Random(0x1e9);
        let model = measured(&design, 10_f64.powi(-decade), &mut random);
        let form = solve(&model, &Linkage::new(&model), Target::Position)
            .expect("a plan")
            .form;
        assert!(form.is_exact(), "1e-{decade}");
        let (chain, length) = (model.chain(), size(&model));
        let mut whole = 0;
        for k in 0..2000 {
            let mut q = configuration(3, k, &mut random);
            if k % 10 == 9 {
                q[2] = PI + 10_f64.powf(random.between(-12.0, -2.0));
            }
            let solutions = form.solutions(&chain.fk(&q));
            assert!(!solutions.is_empty(), "1e-{decade}: {q:?}");
            let conditioning = conditioning(&chain, &q, length, Target::Position);
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(conditioning < 1e-7 || back.is_ok(), "1e-{decade}: {back:?}");
            whole += usize::from(solutions.len() == 4);
        }
        assert!(whole > 1500, "1e-{decade}: {whole}");
    }
}

/// Rounding lets a planar arm leave its plane by what it is; it was asked for positions then, of which
/// the distance from the plane told a joint.
#[test]
fn planar_arms_are_asked_for_poses_whatever_their_noise() {
    let arm = |last: &str| {
        written(format!(
            "robot: arm\nunits: {{angle: rad, length: m}}\nhome: {{xyz: [0.7, 0.2, 0]}}\nscrews:\n  - \
             {{name: a, axis: [0, 0, 1], point: [0, 0, 0]}}\n  - {{name: b, axis: [0, 0, 1], point: \
             [0.4, 0.1, 0]}}\n  - {{name: c, {last}}}\n"
        ))
    };
    let third = "axis: [0, 0, 1], point: [0.6, -0.1, 0]";
    let slide = "type: prismatic, axis: [0.8, 0.6, 0]";
    for design in [third, slide].map(arm) {
        for noise in [1e-12, 1e-9, 1e-7, 1e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 3e-4] {
            for seed in 0..4 {
                let mut random = Random(0x3f + seed);
                let model = measured(&design, noise, &mut random);
                assert_eq!(natural_target(&model), Target::Pose, "{noise:e}");
                let form = solve(&model, &Linkage::new(&model), Target::Pose)
                    .unwrap_or_else(|refused| panic!("{noise:e}: {refused:?}"))
                    .form;
                for k in 0..100 {
                    let q = configuration(3, k, &mut random);
                    let conditioning = conditioning(&model.chain(), &q, size(&model), Target::Pose);
                    let solutions = form.solutions(&model.chain().fk(&q));
                    let back = recovered(&model, &q, &solutions, conditioning);
                    assert!(
                        conditioning < DROWNED || back.is_ok(),
                        "{noise:e}: {back:?}"
                    );
                }
            }
        }
    }
}

/// Axes that are parallel but for the digits of a right angle are read as parallel: without that
/// every plan degenerates, and each was tried.
#[test]
fn a_boom_of_rounded_right_angles_is_one_of_parallel_axes() {
    let mut text = "\
robot: pump
units: {angle: rad, length: m}
joints:
  - {name: slew, axis: [0, 0, 1]}
"
    .to_string();
    for boom in 1..5 {
        let turn = ["-1.5707963", "1.5707963"][boom % 2];
        let axis = ["[0, 1, 0]", "[0, 0, 1]"][boom % 2];
        text += &format!(
            "  - {{name: boom{boom}, xyz: [0.{}, 0, 0], rpy: [{turn}, 0, 0], axis: {axis}}}\n",
            4 + boom
        );
    }
    let model = written(text);
    let linkage = Linkage::new(&model);
    let found = solve_redundant(&model, &linkage, Target::Pose, &Asked::default());
    let (Certified { form, certificate }, _) = found.expect("a plan");
    assert_eq!(certificate.lost, 0);
    let plan = form.plan.to_string();
    assert!(plan.contains("q2+q3+q4+q5"), "{plan}");
}

/// Right angles of five digits leave a wrist on a shoulder whose axes meet at 90.0002 degrees: it
/// passes the first axis at some micrometres. There the shoulder's root is the wrist's distance
/// from that axis, whose square is lost in a difference of squares of the whole arm's length.
#[test]
fn a_wrist_beside_the_first_axis_of_a_rounded_shoulder_is_found() {
    let model = written(
        "robot: rounded\nunits: {angle: rad, length: m}\njoints:\n\
         - {name: j1, xyz: [0, 0, 0.262], axis: [0, 0, 1]}\n\
         - {name: j2, rpy: [1.5708, 0, 0], axis: [0, 0, 1]}\n\
         - {name: j3, xyz: [0, 0.73, 0], rpy: [3.1416, 0, 1.5708], axis: [0, 0, 1]}\n\
         - {name: j4, rpy: [1.5708, 0, 1.5708], axis: [0, 0, 1]}\n\
         - {name: j5, xyz: [0, 0, 0.57], rpy: [1.5708, 0, 3.1416], axis: [0, 0, 1]}\n\
         - {name: j6, rpy: [1.5708, 0, 3.1416], axis: [0, 0, 1]}\n\
         - {name: tip, type: fixed, xyz: [0, 0.109, 0], rpy: [-1.5708, 1.5708, 0]}\n",
    );
    let (linkage, chain) = (Linkage::new(&model), model.chain());
    let Certified { form, certificate } = solve(&model, &linkage, Target::Pose).unwrap();
    assert!(form.is_exact());
    assert_eq!((certificate.lost, certificate.unanswered), (0, 0));
    let from_axis = |q: &[f64]| {
        let [x, y, _] = chain.fk_links(q)[4].translation;
        x.hypot(y)
    };
    let mut random = Random(0x0e1f);
    for k in 0..40 {
        let mut q = configuration(6, 3 * k, &mut random);
        // The shoulder's angle that takes the wrist nearest to the axis.
        let at = |angle: f64| {
            let mut q = q.clone();
            q[1] = angle;
            from_axis(&q)
        };
        let step = PI / 64.0;
        let tried = (0..128).map(|k| f64::from(k) * step);
        let best = tried.min_by(|&a, &b| at(a).total_cmp(&at(b))).unwrap();
        let (mut low, mut high) = (best - step, best + step);
        while high - low > 1e-12 {
            let third = (high - low) / 3.0;
            match at(low + third) < at(high - third) {
                true => high -= third,
                false => low += third,
            }
        }
        for off in [1e-8, 3e-8, 1e-7, 3e-7, 1e-6, 1e-5, 1e-3] {
            q[1] = low + off;
            let found = form.solutions(&chain.fk(&q));
            let apart = |found: &BranchSolution| {
                let joints = found.q.iter().zip(&q);
                let apart = joints.map(|(a, b)| ((a - b + PI).rem_euclid(2.0 * PI) - PI).abs());
                apart.fold(0.0, f64::max)
            };
            let nearest = found.iter().map(apart).fold(f64::INFINITY, f64::min);
            assert!(
                nearest < 1e-6,
                "{off:e} at {q:?}: {nearest:e} of {}",
                found.len()
            );
        }
    }
}

/// With noise of 1e-11 to 1e-10 the wrist passes the first axis as closely: there Newton's steps led away
/// from all branches, and no elimination tells a solution.
#[test]
fn a_wrist_on_the_first_axis_has_a_solution() {
    let (right, half) = (FRAC_PI_2, PI);
    let design = written(format!(
        "robot: upright\nunits: {{angle: rad, length: m}}\njoints:\n\
         - {{name: j1, xyz: [0, 0, 0.29], axis: [0, 0, 1]}}\n\
         - {{name: j2, rpy: [{right:?}, 0, 0], axis: [0, 0, 1]}}\n\
         - {{name: j3, xyz: [0, 0.27, 0], rpy: [{half:?}, 0, {right:?}], axis: [0, 0, 1]}}\n\
         - {{name: j4, xyz: [0, 0.07, 0], rpy: [{right:?}, 0, {right:?}], axis: [0, 0, 1]}}\n\
         - {{name: j5, xyz: [0, 0, 0.302], rpy: [{right:?}, 0, {half:?}], axis: [0, 0, 1]}}\n\
         - {{name: j6, rpy: [{right:?}, 0, {half:?}], axis: [0, 0, 1]}}\n\
         - {{name: tip, type: fixed, xyz: [0, 0.072, 0]}}\n",
    ));
    let mut random = Random(0x0e20);
    let (mut refined, mut tried) = (0, 0);
    for noise in [1e-12, 1e-11, 2e-11, 5e-11, 1e-10, 1e-9] {
        let model = measured(&design, noise, &mut random);
        let (linkage, chain) = (Linkage::new(&model), model.chain());
        let form = solve(&model, &linkage, Target::Pose).unwrap().form;
        refined += usize::from(!form.is_exact());
        for k in 0..40 {
            let mut q = configuration(6, 3 * k, &mut random);
            let along = |angle: f64| {
                let mut q = q.clone();
                q[1] = angle;
                let [x, y, _] = chain.fk_links(&q)[4].translation;
                x * q[0].cos() + y * q[0].sin()
            };
            let step = PI / 16.0;
            let mut places = (0..32).map(|k| f64::from(k) * step);
            let Some(start) = places.find(|&at| along(at) * along(at + step) < 0.0) else {
                continue;
            };
            let (mut low, mut high) = (start, start + step);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match along(low) * along(middle) <= 0.0 {
                    true => high = middle,
                    false => low = middle,
                }
            }
            q[1] = low;
            tried += 1;
            let target = chain.fk(&q);
            let found = form.solutions(&target);
            assert!(!found.is_empty(), "{noise:e}: {q:?}");
            for solution in &found {
                let miss = Target::Pose.distance(&chain.fk(&solution.q), &target, size(&model));
                assert!(miss < 1e-9 * size(&model), "{noise:e}: {miss:e} at {q:?}");
            }
        }
    }
    assert!(refined > 1 && tried > 150, "{refined}, {tried}");
}
