//! What is said of arms of many kinds.

use kin_cli::check::{Verdict, check};
use kin_cli::explain::{ArmExplanation, ObjectKind, explain};
use kin_codegen::geometry::RowRelation;
use kin_codegen::{Ik, Options, Source, Target};
use std::path::Path;

fn robot(file: &str) -> Source {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    Source::read(file, &robots).unwrap()
}

fn told(source: &Source) -> ArmExplanation {
    explain(source, &Options::default()).unwrap().arm().unwrap()
}

/// A chain of revolute joints by Denavit-Hartenberg parameters d, a, alpha
/// (degrees).
fn chain(joints: &[[f64; 3]]) -> Source {
    let mut text = "robot: arm\nunits: {angle: deg, length: m}\ndh:\n".to_owned();
    for (i, [d, a, alpha]) in joints.iter().enumerate() {
        text += &format!("  - {{name: j{i}, theta: 0, d: {d}, a: {a}, alpha: {alpha}}}\n");
    }
    Source {
        path: "arm.yaml".into(),
        text,
    }
}

/// No two axes of the shoulder are parallel or meet.
const SKEW_SHOULDER: [[f64; 3]; 3] = [[0.3, 0.2, 80.0], [0.1, 0.3, 70.0], [0.1, 0.1, 60.0]];
const WRIST: [[f64; 3]; 3] = [[0.4, 0.0, 90.0], [0.0, 0.0, -90.0], [0.1, 0.0, 0.0]];

/// What a target fixes is named: a direction has no place.
#[test]
fn a_direction_of_the_tip_is_named_as_one() {
    let text = |source: &Source, target: Target| {
        let options = Options {
            target: Some(target),
            ..Options::default()
        };
        let explanation = explain(source, &options).unwrap().arm().unwrap();
        let steps = explanation.inverse.unwrap().steps;
        steps
            .into_iter()
            .map(|step| step.text)
            .collect::<Vec<_>>()
            .join("; ")
    };
    let ur5e = robot("ur5e.urdf");
    let direction = text(&ur5e, Target::Direction);
    assert!(
        direction.contains("until the tip's z axis is where the target has it"),
        "{direction}"
    );
    let position = text(&ur5e, Target::Position);
    assert!(
        position.contains("until the tip is where the target has it"),
        "{position}"
    );
}

#[test]
fn a_point_is_named_by_all_the_axes_through_it() {
    let explanation = told(&robot("puma560.yaml"));
    let steps = explanation.inverse.unwrap().steps;
    let elbow = steps.iter().find(|step| step.unknowns == ["q3"]).unwrap();
    assert_eq!(elbow.subproblem, "SP3");
    let texts: Vec<&str> = elbow.objects.iter().map(|o| o.text.as_str()).collect();
    let [shoulder, wrist] = [
        "the point where axes 1, 2 meet",
        "the point where axes 4, 5, 6 meet",
    ];
    assert!(
        texts.contains(&shoulder) && texts.contains(&wrist),
        "{texts:?}"
    );
    assert_eq!(elbow.roots, 2);
    assert!(!elbow.can_degenerate);
}

#[test]
fn a_plane_is_named_by_all_the_joints_that_move_in_it() {
    let explanation = told(&robot("ur5e.urdf"));
    let pan = &explanation.inverse.unwrap().steps[0];
    let plane = pan.objects.iter().find(|o| o.kind == ObjectKind::Plane);
    assert_eq!(plane.unwrap().joints, [2, 3, 4]);
}

#[test]
fn two_relations_are_both_told() {
    let source = chain(&[SKEW_SHOULDER, WRIST].concat());
    let inverse = told(&source).inverse.unwrap();
    let quartic = &inverse.steps[0];
    assert_eq!((quartic.subproblem.as_str(), quartic.roots), ("SP6", 4));
    assert_eq!(quartic.objects.len(), 4);
    assert!(quartic.text.contains("until both "), "{}", quartic.text);
}

#[test]
fn wrists_and_shoulders_have_their_names() {
    let of = |source: &Source| -> Vec<(RowRelation, Vec<usize>)> {
        let rows = told(source).axes.rows;
        rows.into_iter()
            .map(|row| (row.relation, row.joints))
            .collect()
    };
    assert_eq!(
        of(&robot("inverse_elbow.yaml")),
        [
            (RowRelation::Parallel, vec![4, 5]),
            (RowRelation::SphericalShoulder, vec![1, 2, 3]),
        ]
    );
    assert_eq!(
        of(&robot("stanford.yaml")),
        [(RowRelation::SphericalWrist, vec![4, 5, 6])]
    );
    // The fourth joint slides along the axes of the others.
    assert_eq!(
        of(&robot("scara.yaml")),
        [(RowRelation::Parallel, vec![1, 2, 3])]
    );
}

/// Fewer joints than a pose has coordinates: what reaches few targets is told, and what would
/// reach more is a target that those joints are solved for.
#[test]
fn too_few_joints_for_whole_poses_are_told() {
    let few = [[0.3, 0.0, 90.0], [0.0, 0.3, 0.0], [0.0, 0.2, 0.0]];
    let four = chain(&[&few[..], &[[0.0, 0.1, 0.0]]].concat());
    let five = |alpha| chain(&[&few[..], &[[0.0, 0.0, 90.0], [0.1, 0.0, alpha]]].concat());
    let arms = [
        // The last joint turns about the tip's z axis, and the others cannot choose that as well.
        (five(0.0), 5, Target::Position),
        (five(90.0), 5, Target::PositionAxis),
        (four, 4, Target::Position),
        (robot("scara.yaml"), 4, Target::PositionYaw),
    ];
    for (source, joints, target) in arms {
        let explanation = told(&source);
        let text = explanation.to_string();
        let expected = format!(
            "  Targets are whole poses. With {joints} joints few of them are within reach, those of \
             `fk`, and no others have solutions. With `target = {}` they are {}.\n",
            target.word(),
            target.phrase()
        );
        assert!(text.contains(&expected), "{text}");
        let options = Options {
            target: Some(target),
            ..Options::default()
        };
        let explanation = explain(&source, &options).unwrap().arm().unwrap();
        let targets = explanation.inverse.unwrap().targets.unwrap();
        assert!(targets.ends_with("the rest of a pose is not read."));
    }
    assert_eq!(told(&robot("ur5e.urdf")).inverse.unwrap().targets, None);
    // Three coordinates of four joints, which are solved as four: positions would be refused.
    let rack = told(&robot("../tests/robots/coupled/rack.yaml"));
    let targets = rack.inverse.unwrap().targets.unwrap();
    assert!(
        targets.ends_with("and no others have solutions."),
        "{targets}"
    );
}

#[test]
fn branches_share_work() {
    let cost = told(&robot("ur5e.urdf")).inverse.unwrap().cost;
    let cost = cost.unwrap();
    let (one, all) = (cost.one_branch, cost.all_branches);
    assert!(all.multiplications > one.multiplications);
    assert!(all.multiplications < 8 * one.multiplications);
    assert!(all.roots < 8 * one.roots);
}

/// Of seven skew joints with two links on either side of the middle one that are a pair of Bennett's
/// linkage, that one leaves no closed form if it stays free.
fn without_plan() -> (Source, Options) {
    let inner = Options {
        free: vec!["j3".into()],
        ..Options::default()
    };
    let mut joints = [[0.1, 0.2, 70.0]; 7];
    joints[1][0] = 0.0;
    joints[5][0] = 0.0;
    (chain(&joints), inner)
}

#[test]
fn a_redundant_arm_is_explained() {
    let inverse = told(&robot("iiwa14.yaml")).inverse.unwrap();
    assert_eq!(inverse.free, ["swivel"]);
    let text =
        "turn q1 and q2 until the point where axes 3, 4, 5 meet is where the swivel angle has it";
    assert!(
        inverse.steps.iter().any(|step| step.text == text),
        "{:#?}",
        inverse.steps
    );
    let inverse = told(&robot("panda.yaml")).inverse.unwrap();
    assert_eq!(inverse.free, ["q7"]);
    assert_eq!(inverse.weighed[0].free, inverse.free);
    // The cheapest first, but for the elbow, at few of whose values there are solutions.
    let planned = inverse.weighed.iter().filter(|it| it.weight.is_some());
    let planned: Vec<_> = planned.collect();
    let (last, others) = planned.split_last().unwrap();
    assert_eq!(last.free, ["q4"]);
    assert!(others.len() > 1 && others.is_sorted_by_key(|it| it.weight));
    let general = told(&without_plan().0).inverse.unwrap();
    assert!(general.weighed.iter().all(|it| it.weight.is_none()));
    // What is kept is numbered as the arm's joints, the free one in front among them.
    let first = Options {
        free: vec!["j0".into()],
        ..Options::default()
    };
    let general = explain(&without_plan().0, &first).unwrap().arm().unwrap();
    let general = general.inverse.unwrap();
    assert_eq!(general.free, ["q1"]);
    assert_eq!(general.steps[0].unknowns[0], general.kept[0].unknown);
    assert!(
        general.kept.iter().all(|kept| kept.unknown != "q1"),
        "{general:?}"
    );
}

#[test]
fn a_redundant_arm_without_plan_is_explained() {
    let (source, options) = without_plan();
    let explanation = explain(&source, &options).unwrap().arm().unwrap();
    assert_eq!(explanation.chain.joints.len(), 7);
    assert!(explanation.inverse.is_none());
    assert!(explanation.refusal.is_some());
    assert!(explanation.fk_jacobian.multiplications > 0);
    assert!(explanation.to_string().contains("skew"));
}

#[test]
fn forward_kinematics_alone_is_no_refusal() {
    let source = chain(&[[0.1, 0.2, 70.0]; 6]);
    let options = Options {
        ik: Ik::None,
        ..Options::default()
    };
    let explanation = explain(&source, &options).unwrap().arm().unwrap();
    assert_eq!((explanation.inverse, explanation.refusal), (None, None));
    let verdict = check(&source, &options).verdict;
    assert!(matches!(verdict, Verdict::Solved { .. }));
}

#[test]
fn a_broken_file_is_told_from_an_arm_without_closed_form() {
    let (general, options) = without_plan();
    let broken = Source {
        text: general.text.replace("70", "7O"),
        ..general.clone()
    };
    let verdict = |source: &Source| check(source, &options).verdict;
    assert!(matches!(verdict(&general), Verdict::Refused(_)));
    assert!(matches!(verdict(&broken), Verdict::Broken(_)));
}

fn told_of_mechanism(file: &str) -> String {
    let explanation = explain(&robot(file), &Options::default());
    explanation.unwrap().to_string()
}

#[test]
fn a_stewart_platform_is_explained() {
    let text = told_of_mechanism("stewart.yaml");
    for line in [
        "stewart, from stewart.yaml: 6 chains from frame to platform, 36 joints, 6 of them actuated",
        "  leg1, UP*S",
        "  Grübler: 36 joints - 6 x 5 loops = 6, in space",
        "  By rank: 6, all of them motions of the platform",
        "  slide1, slide2, slide3, slide4, slide5, slide6",
        "  Targets are whole poses of the platform.",
        "  Newton's method on the structure equation, from a seed, in at most 60 steps.",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
}

#[test]
fn a_delta_is_explained() {
    let text = told_of_mechanism("delta.yaml");
    for line in [
        "  arm1, R*UU",
        "  Grübler: 15 joints - 6 x 2 loops = 3, in space",
        "  motor1, motor2, motor3",
        "  2 assembly modes at most.",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    assert!(text.contains("three spheres meet"), "{text}");
}

/// The directions that a step is read from are not told of: plans that differ in them alone would
/// be the same words again.
/// One that moves as the joint that it mimics does is told from it.
#[test]
fn joints_that_mimic_others_say_what_they_move_by() {
    let explanation = told(&robot("../tests/robots/coupled/remote_centre.yaml"));
    let text = explanation.to_string();
    let row = |name: &str| {
        let words = |line: &&str| line.split_whitespace().nth(1) == Some(name);
        text.lines().find(words).unwrap().to_owned()
    };
    assert!(!row("pitch").contains("moves"));
    assert!(
        row("bottom").ends_with("-53.0° to 53.0°, moves by −q2"),
        "{}",
        row("bottom")
    );
    assert!(
        row("end").ends_with("-53.0° to 53.0°, moves by q2"),
        "{}",
        row("end")
    );
    let joints = explanation.chain.joints.iter();
    let mimics: Vec<bool> = joints.map(|joint| joint.mimic.is_some()).collect();
    assert_eq!(
        mimics,
        [false, false, true, true, false, false, false, false]
    );
}

/// What a target leaves free is eliminated as a joint is, or kept.
#[test]
fn the_turn_about_the_tool_may_be_kept() {
    let options = Options {
        target: Some(Target::PositionAxis),
        ..Options::default()
    };
    let source = robot("../tests/robots/targets/five_skew.yaml");
    let explanation = explain(&source, &options).unwrap().arm().unwrap();
    let text = explanation.to_string();
    assert!(
        text.contains("so is the turn about the tool: degree 8"),
        "{text}"
    );
}

#[test]
fn no_plan_is_told_of_twice() {
    for file in ["iiwa14.yaml", "panda.yaml", "ur5e.urdf"] {
        let inverse = told(&robot(file)).inverse.unwrap();
        assert_eq!(inverse.others.len(), 3, "{file}");
        for (i, other) in inverse.others.iter().enumerate() {
            let before = &inverse.others[..i];
            assert!(*other != inverse.plan && !before.contains(other), "{file}");
        }
    }
}

/// Two joints about one direction behind three about another: five ways in all.
#[test]
fn a_square_jacobian_that_is_singular_everywhere_is_told() {
    let text = "robot: deficient\nunits: {angle: deg, length: m}\njoints:\n\
        - {name: j1, axis: [0, 0, 1]}\n\
        - {name: j2, xyz: [0.4, 0, 0], axis: [0, 0, 1]}\n\
        - {name: j3, xyz: [0.3, 0, 0], axis: [0, 0, 1]}\n\
        - {name: j4, type: prismatic, axis: [0, 0, 1]}\n\
        - {name: j5, xyz: [0.1, 0, 0], axis: [0, 1, 0]}\n\
        - {name: j6, xyz: [0, 0, 0.2], axis: [0, 1, 0]}\n\
        tip: {xyz: [0.1, 0, 0]}\n";
    let source = Source {
        path: "deficient.yaml".into(),
        text: text.into(),
    };
    let explained = told(&source).to_string();
    assert!(
        explained.contains("The Jacobian has less than full rank everywhere"),
        "{explained}"
    );
}
