//! Sweeps see what is right, and what was made wrong on purpose.

use kin_cli::sweep::{Draw, Kind, Replay, Settings, Tally, sweep};
use kin_codegen::arm::CompiledArm;
use kin_codegen::closed_form::{ClosedForm, Inverse, Refinement};
use kin_codegen::expr::inverse::InverseGraph;
use kin_codegen::expr::{Choice, Node, Tape};
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::{Compiled, Options, Scalar, Source, Target, compile, univariate};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

const SETTINGS: Settings = Settings {
    targets: 300,
    oracle: 10,
    seed: 5,
    draw: Draw::Anywhere,
};

fn source(file: &str) -> Source {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    Source::read(file, &root).unwrap()
}

fn arm(file: &str) -> (Model, ClosedForm) {
    compiled(&source(file), None)
}

fn compiled(source: &Source, target: Option<Target>) -> (Model, ClosedForm) {
    let options = Options {
        target,
        ..Options::default()
    };
    with_options(source, &options)
}

fn with_options(source: &Source, options: &Options) -> (Model, ClosedForm) {
    let Compiled::Arm(arm) = compile(source, options).unwrap() else {
        panic!("an arm");
    };
    let CompiledArm { model, inverse, .. } = *arm;
    (model, inverse.unwrap().form)
}

fn swept((model, form): &(Model, ClosedForm)) -> Tally {
    sweep(model, form, &SETTINGS, &|_| {})
}

/// What does not depend on the clock.
fn timeless(tally: Tally) -> Tally {
    Tally {
        seconds: 0.0,
        microseconds: 0.0,
        ..tally
    }
}

#[test]
fn sound_arms_are_clean() {
    for (file, most) in [
        ("robots/puma560.yaml", 8),
        ("robots/ur5e.urdf", 8),
        ("robots/stanford.yaml", 8),
        ("robots/scara.yaml", 2),
        ("robots/planar_2r.yaml", 2),
        ("robots/panda.yaml", 8),
        ("robots/iiwa14.yaml", 8),
        ("tests/robots/noisy/calibrated.yaml", 8),
        ("tests/robots/noisy/rounded_right_angles.yaml", 8),
    ] {
        let arm = arm(file);
        let tally = swept(&arm);
        assert!(tally.is_clean(), "{file}\n{tally}");
        // Near singular ones the snapped arms may lose.
        let exact = file.starts_with("robots/");
        assert!(tally.lost.near_singular == 0 || !exact, "{file}\n{tally}");
        assert_eq!(tally.targets, SETTINGS.targets);
        assert_eq!(tally.solutions.values().sum::<usize>(), SETTINGS.targets);
        assert_eq!(tally.solutions.last_key_value().unwrap().0, &most, "{file}");
        let replay = Replay::new(&arm.0, &arm.1, &tally.worst_at).unwrap();
        assert_eq!(replay.tally.worst_residual, tally.worst_residual);
        assert!(tally.worst_residual < 1e-9);
        assert!(tally.faults.iter().all(|fault| fault.near_singular));
        let seen = tally.oracle.unwrap();
        assert_eq!(seen.targets + seen.skipped, SETTINGS.oracle);
        assert!(seen.skipped <= 1, "{file}");
        assert!(seen.solutions >= 2 * seen.targets);
        assert_eq!(seen.overlooked, 0, "{file}");
    }
}

#[test]
fn a_part_of_a_pose_is_swept_as_such() {
    let file = source("robots/scara.yaml");
    let tally = swept(&compiled(&file, Some(Target::PositionYaw)));
    assert!(tally.is_clean(), "{tally}");
    assert_eq!(tally.solutions[&2], SETTINGS.targets);
}

#[test]
fn a_seed_is_a_sweep() {
    let arm = arm("robots/puma560.yaml");
    let other = Settings {
        seed: 6,
        ..SETTINGS
    };
    let first = timeless(swept(&arm));
    assert_eq!(first, timeless(swept(&arm)));
    let second = sweep(&arm.0, &arm.1, &other, &|_| {});
    assert_ne!(first.worst_residual, second.worst_residual);
}

#[test]
fn aligned_targets_are_near_singular_ones() {
    let (model, form) = arm("robots/ur5e.urdf");
    let aligned = Settings {
        draw: Draw::Aligned,
        ..SETTINGS
    };
    let tally = sweep(&model, &form, &aligned, &|_| {});
    assert!(tally.near_singular > SETTINGS.targets / 20, "{tally}");
    assert!(tally.is_clean(), "{tally}");
    assert_eq!(tally.unanswered, 0, "{tally}");
}

fn in_single_precision(source: &Source) -> (Model, ClosedForm) {
    let options = Options {
        scalar: Scalar::F32,
        ..Options::default()
    };
    with_options(source, &options)
}

/// What is rounded to seven digits is held against the search as what is not: one solution in two
/// that is left out is seen.
#[test]
fn single_precision_is_compared() {
    let (model, mut form) = in_single_precision(&source("robots/ur5e.urdf"));
    let settings = Settings {
        oracle: 60,
        ..SETTINGS
    };
    let compared = |form: &ClosedForm| sweep(&model, form, &settings, &|_| {}).oracle.unwrap();
    let all = compared(&form);
    assert!(all.is_clean() && all.solutions > 400, "{all:?}");

    let plus = Node::Sign(Choice(0));
    tamper(&mut form, |inverse| {
        inverse.invalid = inverse.graph.find(plus).unwrap();
    });
    let half = compared(&form);
    assert!(half.missing.regular > 100, "{half:?}");
}

/// Four joints whose last axes pass each other by three micrometres have a second solution to every
/// target in seven digits, and none near it in sixteen.
#[test]
fn what_seven_digits_add_is_not_held_against_sixteen() {
    let source = Source {
        path: "arm.yaml".into(),
        text: "\
robot: arm
units: {angle: rad, length: m}
screws:
  - {name: yaw, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: shoulder, axis: [0, 1, 0], point: [0, 0, 0.14]}
  - {name: elbow, axis: [0, 1, 0], point: [0.05, 0, 0.49]}
  - {name: wrist, axis: [1, 0, 0], point: [0.288, 0, 0.490003]}
home: {xyz: [0.288, 0, 0.490003], rpy: [0, 1.5707963267948966, 0]}
"
        .into(),
    };
    let tally = swept(&in_single_precision(&source));
    assert_eq!(tally.solutions.get(&2), Some(&SETTINGS.targets), "{tally}");
    assert!(tally.oracle.as_ref().unwrap().is_clean(), "{tally}");
}

/// One of these targets has a solution at the very tolerance; seven digits tell a distance to a
/// tenth of a millionth, and it is kept to with that.
#[test]
fn single_precision_keeps_to_its_tolerance() {
    let (model, form) = in_single_precision(&source("robots/ur5e.urdf"));
    let settings = Settings {
        targets: 2000,
        oracle: 0,
        seed: 9,
        ..SETTINGS
    };
    let tally = sweep(&model, &form, &settings, &|_| {});
    assert_eq!(tally.unsound, 0, "{tally}");
}

#[test]
fn progress_comes_to_all_targets() {
    let (model, form) = arm("robots/planar_2r.yaml");
    let done = AtomicUsize::new(0);
    let count = |more| {
        done.fetch_add(more, Ordering::Relaxed);
    };
    sweep(&model, &form, &SETTINGS, &count);
    assert_eq!(done.into_inner(), SETTINGS.targets);
}

#[test]
fn no_targets_are_none() {
    let (model, form) = arm("robots/planar_2r.yaml");
    let none = Settings {
        targets: 0,
        ..SETTINGS
    };
    let tally = sweep(&model, &form, &none, &|_| {});
    assert_eq!((tally.targets, tally.is_clean()), (0, true));
}

#[test]
fn the_closed_form_of_another_arm_is_unsound_and_loses() {
    let (model, _) = arm("robots/puma560.yaml");
    let mut longer = source("robots/puma560.yaml");
    longer.text = longer.text.replace("431.8", "431.801");
    let tally = swept(&(model, compiled(&longer, None).1));
    assert_eq!(tally.unsound, 8 * SETTINGS.targets, "{tally}");
    // But for badly conditioned ones, that a micrometre hardly moves.
    assert!(10 * tally.lost.regular > 9 * SETTINGS.targets, "{tally}");
    let seen = tally.oracle.as_ref().unwrap();
    assert_eq!(seen.missing.regular, seen.solutions, "{tally}");
    assert!(!tally.is_clean());
    assert!((1e-7..1e-4).contains(&tally.worst_residual), "{tally}");
}

#[test]
fn a_refinement_onto_another_arm_is_unsound() {
    let (model, mut form) = arm("tests/robots/noisy/calibrated.yaml");
    assert!(!form.is_exact());
    let mut other = model.clone();
    other.home.translation[0] += 1e-6;
    let given = Linkage::new(&other);
    let arm = univariate::Arm::keeping_each(&other, &given).remove(0);
    (form.given, form.refinement) = (given, Refinement::Univariate(Box::new(arm)));
    let tally = swept(&(model, form));
    assert!(tally.unsound > SETTINGS.targets, "{tally}");
}

/// Changes the expressions of a form.
fn tamper(form: &mut ClosedForm, change: impl Fn(&mut InverseGraph)) {
    let Inverse::Expressions(inverse) = &mut form.inverse else {
        panic!("the plan is of subproblems");
    };
    change(inverse);
    inverse.tape = Tape::new(&inverse.graph, &inverse.outputs());
}

#[test]
fn a_branch_left_out_is_lost_and_missing() {
    let (model, mut form) = arm("robots/puma560.yaml");
    // +1 where the first choice is a plus.
    let plus = Node::Sign(Choice(0));
    tamper(&mut form, |inverse| {
        inverse.invalid = inverse.graph.find(plus).unwrap();
    });
    let tally = swept(&(model, form));
    assert_eq!(tally.solutions[&4], SETTINGS.targets, "{tally}");
    let half = SETTINGS.targets / 2;
    assert!(tally.lost.regular.abs_diff(half) < half / 2, "{tally}");
    let seen = tally.oracle.as_ref().unwrap();
    assert_eq!(2 * seen.missing.regular, seen.solutions, "{tally}");
    assert_eq!((tally.unsound, tally.doubled.regular), (0, 0), "{tally}");
    assert_eq!(seen.extra.regular, 0, "{tally}");
    assert!(!tally.is_clean());
}

#[test]
fn a_choice_without_effect_doubles() {
    let (model, mut form) = arm("robots/planar_2r.yaml");
    let two_roots = |step: &&kin_codegen::plan::Step| step.subproblem.choices() == 1;
    let step = form.plan.steps.iter().find(two_roots).unwrap().clone();
    form.plan.steps.push(step);
    let tally = swept(&(model, form));
    assert_eq!(tally.doubled.regular, 2 * SETTINGS.targets, "{tally}");
    assert_eq!(tally.lost.regular, 0, "{tally}");
    assert!(!tally.is_clean());
}

#[test]
fn faults_can_be_replayed() {
    let (model, mut form) = arm("robots/puma560.yaml");
    let plus = Node::Sign(Choice(0));
    tamper(&mut form, |inverse| {
        inverse.invalid = inverse.graph.find(plus).unwrap();
    });
    let tally = swept(&(model.clone(), form.clone()));
    let regular = tally.faults.iter().filter(|fault| !fault.near_singular);
    let lost = |kind| regular.clone().filter(move |fault| fault.kind == kind);
    assert_eq!(lost(Kind::Lost).count(), 5, "the first few");
    for fault in lost(Kind::Lost) {
        let replay = Replay::new(&model, &form, &fault.q).unwrap();
        assert_eq!(replay.tally.lost.regular, 1);
        assert_eq!((replay.solutions.len(), replay.found.len()), (4, 8));
        assert!(replay.solutions.iter().all(|solution| !solution.is_q));
        let missing = replay.found.iter().filter(|it| it.solution.is_none());
        assert_eq!(missing.count(), 4);
        let text = replay.to_string();
        let values: Vec<String> = fault.q.iter().map(|x| format!("{x:?}")).collect();
        assert!(text.contains(&values.join(",")), "{text}");
        assert!(tally.to_string().contains(&values.join(",")), "{tally}");
    }
}

#[test]
fn a_replay_pairs_the_solutions_of_both() {
    let (model, form) = arm("robots/ur5e.urdf");
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let replay = Replay::new(&model, &form, &q).unwrap();
    assert_eq!((replay.solutions.len(), replay.found.len()), (8, 8));
    for (i, solution) in replay.solutions.iter().enumerate() {
        let pair = solution.found.unwrap();
        assert_eq!(replay.found[pair].solution, Some(i));
        assert!(solution.residual < 1e-12 && !solution.singular);
    }
    let own = replay.solutions.iter().filter(|solution| solution.is_q);
    assert_eq!(own.count(), 1);
    assert!(replay.tally.is_clean() && !replay.near_singular);
}

#[test]
fn a_singular_configuration_is_replayed_as_one() {
    let (model, form) = arm("robots/ur5e.urdf");
    let q = [0.3, -1.2, 1.5, -0.7, 0.0, 0.4];
    let replay = Replay::new(&model, &form, &q).unwrap();
    assert!(replay.near_singular && replay.conditioning < 1e-12);
    assert!(replay.solutions.iter().any(|solution| solution.singular));
    assert_eq!(replay.tally.oracle.as_ref().unwrap().skipped, 1);
    assert!(replay.tally.is_clean());
}

#[test]
fn a_configuration_of_another_length_is_not_replayed() {
    let (model, form) = arm("robots/ur5e.urdf");
    assert!(Replay::new(&model, &form, &[0.1; 5]).is_none());
}

#[test]
fn a_target_without_answers_is_told_from_a_lost_configuration() {
    let (model, mut form) = arm("robots/scara.yaml");
    tamper(&mut form, |inverse| {
        inverse.invalid = inverse.graph.one();
    });
    let replay = Replay::new(&model, &form, &[0.3, 0.8, 0.1, -0.4]).unwrap();
    let text = replay.to_string();
    assert!(
        text.contains("  closed form: none, though q is a solution\n"),
        "{text}"
    );
    assert!(text.contains("  numerical search\n"), "{text}");
    let tally = swept(&(model, form));
    assert_eq!(tally.solutions[&0], SETTINGS.targets, "{tally}");
    assert_eq!(tally.lost.regular, SETTINGS.targets, "{tally}");
    let kinds: Vec<Kind> = tally.faults.iter().map(|fault| fault.kind).collect();
    let expected = [[Kind::Unanswered; 5], [Kind::Missing; 5]].concat();
    assert_eq!(kinds, expected, "{tally}");
}

/// Of a finger whose joints do not turn alike, a target that it reaches beyond its stops alone is
/// none that it has to answer.
#[test]
fn coordinates_that_do_not_repeat_are_drawn_within_their_limits() {
    let joint = |name: &str, parent: &str, child: &str, mimic: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/>\
             <child link=\"{child}\"/><origin xyz=\"0.04 0 0\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"0\" upper=\"2.094\" effort=\"0\" velocity=\"0\"/>{mimic}</joint>"
        )
    };
    let text = format!(
        "<robot name=\"finger\"><link name=\"palm\"/><link name=\"near\"/><link name=\"far\"/>\
         {}{}</robot>",
        joint("knuckle", "palm", "near", ""),
        joint(
            "middle",
            "near",
            "far",
            "<mimic joint=\"knuckle\" multiplier=\"1.3\"/>"
        ),
    );
    let path = "finger.urdf".into();
    let finger = compiled(&Source { path, text }, None);
    for draw in [Draw::Anywhere, Draw::Aligned] {
        let settings = Settings { draw, ..SETTINGS };
        let tally = sweep(&finger.0, &finger.1, &settings, &|_| {});
        assert!(tally.is_clean(), "{tally}");
    }
}
