//! Six joints without a closed form: the constants of the elimination, and
//! what they are good for at run time, against the generic search.

mod aligned;
mod arms;
mod families;
mod right_angles;

use arms::{
    Neighbour, anywhere, chain, cobot, least_singular_value, miss, near_singular, patterns,
    random_arm, slides,
};
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::spec::ArmSpec;
use kin_codegen::univariate::{Arm, Family, MOST, choose, eliminate};
use kin_codegen::{Options, Source, compile};
use kin_runtime::__private::univariate::{Between, Elimination, Frames, Univariate};
use kin_runtime::{Pose, SearchOptions, Solution, Solutions, Target, Twist};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const GENERAL: [Neighbour; 5] = [Neighbour::General; 5];

fn solutions(frames: &Frames, eliminations: &[Elimination], target: &Pose) -> Solutions<6> {
    let arm = Univariate {
        frames: *frames,
        size: 2.0,
        counts: Target::Pose,
        eliminations,
    };
    arm.solutions(target)
}

fn chosen(frames: &Frames) -> Vec<Elimination> {
    choose(&(*frames).into(), 6)
        .iter()
        .take(MOST)
        .map(|kept| kept.elimination)
        .collect()
}

fn apart(frames: &Frames, a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let apart = |i: usize| {
        let d = (a[i] - b[i]).abs();
        match frames.slides(i) {
            true => d,
            false => (d % TAU).min(TAU - d % TAU),
        }
    };
    (0..6).map(apart).fold(0.0, f64::max)
}

/// Whether a configuration is among the solutions, which all reach the target, once.
fn check(frames: &Frames, found: &Solutions<6>, q: &[f64; 6], tolerance: f64) -> bool {
    let target = frames.forward(q);
    for (i, solution) in found.iter().enumerate() {
        let miss = miss(frames, &solution.q, &target);
        assert!(miss < 1e-11, "{q:?}: {:?} misses by {miss:e}", solution.q);
        assert!((0..6).all(|i| frames.slides(i) || (-PI..=PI).contains(&solution.q[i])));
        if !solution.singular {
            let double = found[..i]
                .iter()
                .find(|other| apart(frames, &other.q, &solution.q) < 1e-7);
            assert!(double.is_none(), "{q:?}: {:?} comes twice", solution.q);
        }
    }
    found
        .iter()
        .any(|solution| apart(frames, &solution.q, q) < tolerance)
}

/// A configuration anywhere is among the solutions of its target, unless it is nearly singular.
fn comes_back(
    frames: &Frames,
    eliminations: &[Elimination],
    pattern: &[Neighbour; 5],
    random: &mut Random,
) {
    let q = anywhere(random);
    let found = solutions(frames, eliminations, &frames.forward(&q));
    let sigma = least_singular_value(frames, &q);
    let tolerance = (1e-11 / sigma.powi(2)).clamp(1e-7, 1e-2);
    assert!(
        sigma < 1e-5 || check(frames, &found, &q, tolerance),
        "{pattern:?} lost {q:?}, σ {sigma:.1e}"
    );
}

#[test]
fn functionals_vanish_along_the_loop() {
    let mut random = Random(11);
    let patterns = [GENERAL].into_iter().chain(patterns().step_by(7));
    let mut slides = slides().into_iter().cycle();
    for (k, pattern) in patterns.chain([GENERAL; 42]).enumerate() {
        let frames = Frames {
            prismatic: if k < 36 { 0 } else { slides.next().unwrap() },
            ..random_arm(&pattern, &mut random)
        };
        for elimination in (0..6).flat_map(|kept| eliminate(&frames.into(), kept)) {
            let q = anywhere(&mut random);
            let joints = elimination.joints.map(usize::from);
            let along = joints.map(|joint| {
                if elimination.backwards {
                    -q[joint]
                } else {
                    q[joint]
                }
            });
            let coefficients = elimination.coefficients(&frames, &frames.forward(&q), along[0]);
            let [ta, tb] = [5, 4].map(|i| match frames.slides(joints[i]) {
                true => along[i],
                false => (0.5 * along[i]).tan(),
            });
            let scale = (1.0 + ta * ta) * (1.0 + tb * tb);
            for row in &coefficients[..6] {
                let powers = |k: usize| ta.powi(k as i32 / 3) * tb.powi(k as i32 % 3);
                let value: f64 = (0..9).map(|k| row[k] * powers(k)).sum();
                assert!(
                    value.abs() < 1e-11 * scale,
                    "{pattern:?} {joints:?}: {value:e}"
                );
            }
        }
    }
}

#[test]
fn harmonics_above_the_degree_vanish() {
    let mut random = Random(12);
    for pattern in [GENERAL].into_iter().chain(patterns().step_by(7)) {
        let frames = random_arm(&pattern, &mut random);
        for elimination in (0..6).flat_map(|kept| eliminate(&frames.into(), kept)) {
            let arm = Univariate {
                frames,
                size: 2.0,
                counts: Target::Pose,
                eliminations: &[],
            };
            let mut noises: Vec<f64> = (0..9)
                .map(|_| {
                    arm.outcome(&elimination, &frames.forward(&anywhere(&mut random)))
                        .0
                        .noise
                })
                .collect();
            noises.sort_by(f64::total_cmp);
            assert!(
                noises[4] < 1e-9,
                "{pattern:?} {:?}: {noises:?}",
                elimination.joints
            );
        }
    }
}

#[test]
fn a_general_arm_has_the_solutions_that_the_search_finds() {
    let mut random = Random(13);
    for _ in 0..24 {
        let frames = random_arm(&GENERAL, &mut random);
        let (chain, eliminations) = (chain(&frames), chosen(&frames));
        assert_eq!(eliminations[0].degree, 8);
        for _ in 0..3 {
            let q = anywhere(&mut random);
            let target = frames.forward(&q);
            let found = solutions(&frames, &eliminations, &target);
            assert!(check(&frames, &found, &q, 1e-6), "{q:?} is lost");
            let expected = chain.ik_all(&target, &SearchOptions::default());
            assert_eq!(found.len(), expected.len(), "{q:?}");
        }
    }
}

#[test]
fn nothing_is_lost_on_any_pattern_of_neighbours() {
    let mut random = Random(14);
    for pattern in patterns() {
        let frames = random_arm(&pattern, &mut random);
        let eliminations = chosen(&frames);
        // Four parallel axes are singular in every configuration; three at either end
        // are solved in closed form.
        let parallel = |rows: &[Neighbour]| rows.iter().all(|row| *row == Neighbour::Parallel);
        let refused = pattern.windows(3).any(parallel)
            || [&pattern[..2], &pattern[3..]]
                .iter()
                .all(|row| parallel(row));
        assert_eq!(eliminations.is_empty(), refused, "{pattern:?}");
        for _ in 0..if refused { 0 } else { 8 } {
            comes_back(&frames, &eliminations, &pattern, &mut random);
        }
    }
}

/// A joint that is given in the middle moves what two joints on either side of it do: of all
/// patterns of the neighbours on these sides.
#[test]
fn nothing_is_lost_with_a_joint_given_in_the_middle() {
    let mut random = Random(0x313);
    for pattern in patterns().filter(|pattern| pattern[2] == Neighbour::General) {
        let mut family = Family::from(random_arm(&pattern, &mut random));
        let mut side = || random.between(-0.7, 0.7);
        let direction = [side(), side(), 1.0];
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        family.between.push(Between {
            behind: 3,
            twist: Twist::revolute(direction.map(|x| x / length), [side(), side(), side()]),
        });
        let eliminations: Vec<Elimination> = choose(&family, 6)
            .iter()
            .map(|kept| kept.elimination)
            .take(MOST)
            .collect();
        assert!(eliminations.iter().all(|it| it.moved), "{pattern:?}");
        // Three parallel axes move nothing in nine independent ways, and are solved in closed form.
        let parallel = |side: &[Neighbour]| side.iter().all(|it| *it == Neighbour::Parallel);
        let has_three = [&pattern[..2], &pattern[3..]].into_iter().any(parallel);
        assert!(has_three || !eliminations.is_empty(), "{pattern:?}");
        for _ in 0..if eliminations.is_empty() { 0 } else { 8 } {
            let frames = family
                .frames
                .at(&family.between, &[random.between(-PI, PI)]);
            comes_back(&frames, &eliminations, &pattern, &mut random);
        }
    }
}

/// One or two slides anywhere, between axes in general position and others.
#[test]
fn nothing_is_lost_with_slides() {
    let mut random = Random(20);
    let mut lost = Vec::new();
    for (k, prismatic) in slides().into_iter().cycle().take(84).enumerate() {
        let others: Vec<_> = patterns().collect();
        let pattern = if k < 42 {
            GENERAL
        } else {
            others[random.below(243)]
        };
        let frames = Frames {
            prismatic,
            ..random_arm(&pattern, &mut random)
        };
        let eliminations = chosen(&frames);
        assert!(
            pattern != GENERAL || !eliminations.is_empty(),
            "{prismatic:06b}"
        );
        for i in 0..if eliminations.is_empty() { 0 } else { 12 } {
            let mut q = anywhere(&mut random);
            if i % 3 == 0 {
                q[random.below(6)] = random.below(4) as f64 * FRAC_PI_2;
            }
            let found = solutions(&frames, &eliminations, &frames.forward(&q));
            let sigma = least_singular_value(&frames, &q);
            let tolerance = (1e-11 / sigma.powi(2)).clamp(1e-7, 1e-2);
            if sigma > 1e-5 && !check(&frames, &found, &q, tolerance) {
                lost.push((pattern, prismatic, q, sigma));
            }
        }
    }
    assert!(lost.is_empty(), "{lost:#?}");
}

/// A slide may go far, and full turns mean nothing to it.
#[test]
fn slides_have_the_solutions_that_the_search_finds() {
    let mut random = Random(21);
    for prismatic in slides() {
        let frames = Frames {
            prismatic,
            ..random_arm(&GENERAL, &mut random)
        };
        let (chain, eliminations) = (chain(&frames), chosen(&frames));
        let q = anywhere(&mut random);
        let target = frames.forward(&q);
        let found = solutions(&frames, &eliminations, &target);
        assert!(check(&frames, &found, &q, 1e-6), "{q:?} is lost");
        // With slides the search finds some from few of its starts.
        let patient = SearchOptions {
            stable_doublings: 5,
            ..SearchOptions::default()
        };
        let expected = chain.ik_all(&target, &patient);
        assert_eq!(found.len(), expected.len(), "{prismatic:06b} {q:?}");
    }
}

#[test]
fn pairs_that_have_nearly_met_are_both_found() {
    let mut random = Random(15);
    let mut lost = 0;
    for _ in 0..12 {
        let frames = random_arm(&GENERAL, &mut random);
        let eliminations = chosen(&frames);
        for k in 0..60 {
            let distance = 10_f64.powi(-1 - k % 5);
            let q = near_singular(&frames, distance, &mut random);
            let found = solutions(&frames, &eliminations, &frames.forward(&q));
            let sigma = least_singular_value(&frames, &q);
            let tolerance = (1e-11 / sigma.powi(2)).clamp(1e-7, 1e-2);
            lost += usize::from(sigma > 1e-5 && !check(&frames, &found, &q, tolerance));
        }
    }
    assert_eq!(lost, 0);
}

#[test]
fn aligned_configurations_are_found() {
    let mut random = Random(16);
    let aligned = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
    for _ in 0..12 {
        let frames = random_arm(&GENERAL, &mut random);
        let eliminations = chosen(&frames);
        for _ in 0..40 {
            let q = std::array::from_fn(|_| aligned[random.below(4)]);
            let found = solutions(&frames, &eliminations, &frames.forward(&q));
            assert!(check(&frames, &found, &q, 1e-6), "{q:?}");
        }
    }
}

/// Next to round configurations of a cobot with an offset wrist three or four solutions
/// share the kept joint's value, or nearly: a change of sign may hide three roots.
#[test]
fn solutions_that_nearly_share_a_value_are_told_apart() {
    let mut random = Random(18);
    let frames = cobot();
    let eliminations = chosen(&frames);
    let mut lost = Vec::new();
    for k in 0..6000 {
        let mut q = anywhere(&mut random);
        for _ in 0..1 + k % 3 {
            let round = random.below(4) as f64 * FRAC_PI_2;
            q[random.below(6)] = round + 10_f64.powf(random.between(-6.0, -1.0));
        }
        let found = solutions(&frames, &eliminations, &frames.forward(&q));
        let sigma = least_singular_value(&frames, &q);
        let tolerance = (1e-11 / sigma.powi(2)).clamp(1e-7, 1e-2);
        if sigma > 1e-5 && !check(&frames, &found, &q, tolerance) {
            lost.push((q, sigma));
        }
    }
    assert!(lost.is_empty(), "{lost:?}");
}

#[test]
fn what_is_no_pose_or_out_of_reach_has_no_solutions() {
    let mut random = Random(17);
    let frames = random_arm(&GENERAL, &mut random);
    let eliminations = chosen(&frames);
    let far = Pose::from_translation([100.0, 0.0, 0.0]);
    let nothing = Pose::from_translation([f64::NAN, 0.0, 0.0]);
    let infinite = Pose::from_translation([f64::INFINITY, 0.0, 0.0]);
    let none = Pose {
        rotation: [[0.0; 3]; 3],
        translation: [0.3; 3],
    };
    let huge = Pose {
        rotation: [[1e300; 3]; 3],
        translation: [1e300; 3],
    };
    for target in [far, nothing, infinite, none, huge] {
        assert!(solutions(&frames, &eliminations, &target).is_empty());
    }
}

/// An elbow arm with a wrist whose last axis passes the others' point by so much.
fn offset_wrist(offset: f64) -> Source {
    let text = format!(
        "robot: arm\nunits: {{angle: deg, length: m}}\nscrews:\n\
         - {{name: a, axis: [0, 0, 1], point: [0, 0, 0]}}\n\
         - {{name: b, axis: [0, 1, 0], point: [0.07, 0, 0.35]}}\n\
         - {{name: c, axis: [0, 1, 0], point: [0.07, 0, 0.71]}}\n\
         - {{name: d, axis: [1, 0, 0], point: [0.07, 0, 0.71]}}\n\
         - {{name: e, axis: [0, 1, 0], point: [0.45, 0, 0.71]}}\n\
         - {{name: f, axis: [1, 0, 0], point: [0.45, 0, {}]}}\n\
         home: {{xyz: [0.52, 0, 0.71]}}\n",
        0.71 + offset
    );
    Source {
        path: "arm.yaml".into(),
        text,
    }
}

/// Two roots 2e-4 apart are known to half of their digits, and what follows from one of
/// them looks like an extraneous root's. Lengths as a CRX-30iA's.
#[test]
fn roots_that_have_nearly_met_are_not_extraneous() {
    let source = Source {
        path: "arm.yaml".into(),
        text: "\
robot: offset_wrist
units: {angle: rad, length: m}
screws:
  - {name: a, axis: [0, 0, 1],  point: [0, 0, 0.37]}
  - {name: b, axis: [0, 1, 0],  point: [0, 0, 0.37]}
  - {name: c, axis: [0, -1, 0], point: [0, 0, 1.32]}
  - {name: d, axis: [-1, 0, 0], point: [0, 0, 1.32]}
  - {name: e, axis: [0, -1, 0], point: [0.75, 0, 1.32]}
  - {name: f, axis: [-1, 0, 0], point: [0.75, -0.185, 1.32]}
home: {xyz: [0.93, -0.185, 1.32]}
"
        .into(),
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let arm = Arm::new(&Linkage::new(&model)).unwrap();
    let chain = model.chain();
    let at = [
        -0.7618901807945826,
        -0.29853813479853253,
        2.9298264456040974,
        3.1415578029100155,
        1.6816917321542262,
        -2.655148342510275,
    ];
    let mut random = Random(19);
    for _ in 0..200 {
        let off = 10_f64.powf(random.between(-14.0, -6.0));
        let q = at.map(|x| x + off * random.between(-1.0, 1.0));
        let found: Solutions<6> = arm.solutions(&chain.fk(&q));
        let known = found
            .iter()
            .any(|solution| apart(&arm.frames, &solution.q, &q) < 1e-6);
        assert!(known && found.len() == 12, "{q:?}: {found:?}");
    }
}

/// Eight solutions in two fours, each of which shares the three joints that are kept up to 1e-3.
#[test]
fn four_solutions_that_have_almost_met_are_all_found() {
    let source = Source {
        path: "xarm6.yaml".into(),
        text: include_str!("../../../robots/xarm6.yaml").into(),
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let arm = Arm::new(&Linkage::new(&model)).unwrap();
    let chain = model.chain();
    let at = [
        3.0776154601465926,
        -0.9580783495955061,
        -2.9135827366114655,
        3.14195863438341,
        -0.9376459902799974,
        -0.9876951411421047,
    ];
    let mut random = Random(29);
    for _ in 0..300 {
        let off = 10_f64.powf(random.between(-6.0, -2.0));
        let q = at.map(|x| x + off * random.between(-1.0, 1.0));
        let found: Solutions<6> = arm.solutions(&chain.fk(&q));
        let is_known = |found: &Solution<6>| apart(&arm.frames, &found.q, &q) < 1e-6;
        assert!(found.iter().any(is_known), "{q:?}: {found:?}");
    }
}

/// At home one step of this elimination is zero for all angles, and what is left of it by
/// rounding the same for all: a smooth polynomial with wrong roots.
#[test]
fn a_smooth_polynomial_may_be_rounding() {
    let source = Source {
        path: "arm.yaml".into(),
        text: "\
robot: wrist_on_a_slide
units: {angle: rad, length: m}
screws:
  - {name: j0, axis: [-0.23582508593579787, -0.875788518187008, -0.4211662382660537], point: [-0.14540659269191672, -0.15539940560499316, -0.30774656381402843]}
  - {name: j1, axis: [-0.5911394446950443, -0.2147064455190519, 0.7774672335077595], point: [-0.3507298817546378, -0.04031911970742845, -0.43208134189718717]}
  - {name: j2, axis: [-0.7469698387237931, -0.6644083696688119, 0.024445415745737664], point: [-0.5240052627080227, -0.10325408619347184, -0.20418937448782526]}
  - {name: j3, type: prismatic, axis: [-0.11395232744323017, 0.15075093460771172, -0.9819821906659879]}
  - {name: j4, axis: [-0.33989240079474486, -0.7916056592735616, 0.5077732132439192], point: [-0.5240052627080227, -0.10325408619347184, -0.20418937448782526]}
  - {name: j5, type: prismatic, axis: [-0.33989240079474486, -0.7916056592735616, 0.5077732132439192]}
home: {xyz: [-0.9333643903872504, -0.18555747971829872, -0.32234549096785636], rpy: [-0.25881420416338624, 0.48673168093131935, 3.0532339764834227]}
"
        .into(),
    };
    let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
    let arm = Arm::new(&Linkage::new(&model)).unwrap();
    let chain = model.chain();
    let mut random = Random(22);
    for k in 0..100 {
        let off = match k {
            0 => 0.0,
            _ => 10_f64.powf(random.between(-14.0, -4.0)),
        };
        let q: [f64; 6] = std::array::from_fn(|_| off * random.between(-1.0, 1.0));
        let found: Solutions<6> = arm.solutions(&chain.fk(&q));
        let known = |found: &&Solution<6>| arm.frames.within(1e-5, &found.q, &q);
        assert!(found.iter().any(|found| known(&found)), "{q:?}: {found:?}");
    }
}

/// Next to where two slides are parallel there are solutions that take them against each other as
/// far as one likes; where rounding is more than what a solution may miss, they are none.
#[test]
fn slides_do_not_go_farther_than_numbers_tell() {
    let source = Source {
        path: "against.yaml".into(),
        text: "\
robot: against
units: {angle: rad, length: m}
screws:
  - {name: j0, type: prismatic, axis: [1, 0, 0], limits: [-1, 1]}
  - {name: j1, axis: [0, 1, 0], point: [0, 0.45, 0]}
  - {name: j2, axis: [1, 0, 0], point: [0, 0.55, 0]}
  - {name: j3, type: prismatic, axis: [1, 0, 0], limits: [-1, 1]}
  - {name: j4, axis: [0, 1, 0], point: [0, 0.65, 0]}
  - {name: j5, axis: [0, 0, 1], point: [0.1, 0.65, 0]}
home: {xyz: [0.17, 0.7000000000000001, 0.11]}
"
        .into(),
    };
    // Of its certificate's targets one has such solutions, as long as home has this last digit.
    let compiled = compile(&source, &Options::default()).unwrap();
    assert!(compiled.arm().unwrap().form().is_some());
}

/// As the IRB 140 of some files, whose wrist misses its point by two centimetres.
#[test]
fn an_offset_that_was_designed_is_no_noise() {
    let plan = |offset: f64| {
        let compiled = compile(&offset_wrist(offset), &Options::default()).unwrap();
        let form = compiled.arm().unwrap().form().unwrap().clone();
        (form.expressions().is_some(), form.is_exact())
    };
    assert_eq!(plan(0.0), (true, true));
    assert_eq!(plan(1e-4), (true, false), "noise");
    assert_eq!(plan(0.02), (false, true));
}
