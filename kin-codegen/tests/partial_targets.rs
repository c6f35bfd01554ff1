//! Arms that are asked for part of a pose: files off their design, targets that an arm cannot
//! choose, and joints that move nothing but noise.

mod measured;

use kin_codegen::arm::CompiledArm;
use kin_codegen::certificate::recovered;
use kin_codegen::closed_form::Inverse;
use kin_codegen::geometry::{Linkage, conditioning, size};
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::{Compiled, Options, Target, compile};
use kin_runtime::{Pose, SearchOptions};
use measured::{configuration, measured};
use std::f64::consts::PI;

fn source(text: &str) -> Source {
    Source {
        path: "arm.yaml".into(),
        text: text.into(),
    }
}

fn compiled(text: &str, target: Target) -> Result<CompiledArm, String> {
    let options = Options {
        target: Some(target),
        ..Options::default()
    };
    match compile(&source(text), &options) {
        Ok(Compiled::Arm(arm)) => Ok(*arm),
        Ok(Compiled::Mechanism(_)) => panic!("no arm"),
        Err(error) => Err(error.to_string()),
    }
}

fn model(text: &str) -> Model {
    Model::new(&ArmSpec::parse(&source(text)).unwrap(), None, None).unwrap()
}

/// Every configuration comes back from its target, with as many others as the numerical search
/// finds.
fn is_complete(model: &Model, target: Target, found: &Certified, count: usize) {
    let (chain, length) = (model.chain(), size(model));
    let turn = chain.twists().iter().map(|twist| twist.angular);
    let axis = turn.into_iter().find(|axis| *axis != [0.0; 3]).unwrap();
    let seen = |pose: &Pose| target.stands_for(pose, axis, chain.home());
    let near_singular = found.form.near_singular().max(1e-4);
    let options = SearchOptions {
        target,
        ..SearchOptions::default()
    };
    let mut random = Random(0x51de);
    for k in 0..count {
        let q = configuration(model.joints.len(), k, &mut random);
        let pose = chain.fk(&q);
        let solutions = found.form.solutions(&pose);
        let independent = conditioning(&chain, &q, length, target);
        if independent > near_singular {
            recovered(model, &q, &solutions, independent).unwrap();
        }
        for solution in &solutions {
            let miss = target.distance(&seen(&chain.fk(&solution.q)), &seen(&pose), length);
            assert!(miss < 1e-9 * length, "{q:?}: {miss:e}");
        }
        if k % 20 == 0 && independent > 1e-2 {
            let all = chain.ik_all(&pose, &options);
            let regular = all.iter().filter(|it| it.conditioning > 1e-3).count();
            assert!(solutions.len() >= regular, "{q:?}");
        }
    }
}

const SHOULDER_FIRST: &str = "\
robot: shoulder
units: {angle: rad, length: m}
joints:
  - {name: roll,  xyz: [0, 0, 0.2], rpy: [0.4, 0.2, 0.7], axis: [0, 0, 1]}
  - {name: pitch, xyz: [0.05, 0.02, 0.25], rpy: [0.3, 0, 0], axis: [0, 1, 0]}
  - {name: yaw,   xyz: [0, 0, 0], axis: [1, 0, 0]}
tip: {link: hand, xyz: [0.08, 0.11, 0.14]}
";

/// Two axes that meet but for noise leave one of the two unknowns of the quartic to that: it has to
/// be the one that the quartic is in.
#[test]
fn axes_that_nearly_meet_are_solved_as_they_are_for_positions() {
    let design = model(SHOULDER_FIRST);
    let mut random = Random(0x0ff5e7);
    for noise in [1e-5, 1e-4, 1e-3] {
        let model = measured(&design, noise, &mut random);
        let found = solve(&model, &Linkage::new(&model), Target::Position).unwrap();
        assert!(found.form.is_exact(), "{noise:e}: {}", found.form.plan);
        assert_eq!(found.certificate.excused, 0, "{noise:e}");
        is_complete(&model, Target::Position, &found, 200);
    }
}

/// Of three skew axes two relations have to tell the first and the last angle, of which a short
/// link leaves one small coefficients.
#[test]
fn three_skew_joints_with_a_short_last_link_are_solved_for_positions() {
    for link in [0.1, 0.016, 1e-3, 1e-4] {
        let text = format!(
            "\
robot: finger
units: {{angle: rad, length: m}}
joints:
  - {{name: sweep, xyz: [0.22, 0.033, 0], axis: [0, 1, 0]}}
  - {{name: twist, xyz: [-0.404, -0.407, -0.27], axis: [-1, 0, 0]}}
  - {{name: turn,  xyz: [-0.01, 0.124, -0.049], axis: [0, 0, -1]}}
tip: {{link: nail, xyz: [{link}, 0, 0]}}
"
        );
        let model = model(&text);
        let found = solve(&model, &Linkage::new(&model), Target::Position).unwrap();
        assert!(found.form.is_exact(), "{link}: {}", found.form.plan);
        is_complete(&model, Target::Position, &found, 200);
    }
}

const FIVE: &str = "\
robot: five
units: {angle: rad, length: m}
joints:
  - {name: waist,    xyz: [0, 0, 0.11],  axis: [0, 0, 1]}
  - {name: shoulder, xyz: [0.03, 0, 0.05], axis: [0, 1, 0]}
  - {name: elbow,    xyz: [0.03, 0, 0.12], axis: [0, 1, 0]}
  - {name: pitch,    xyz: [0.135, 0, 0], axis: [0, 1, 0]}
  - {name: roll,     xyz: [0.06, 0, 0],  axis: [1, 0, 0]}
tip: {link: pen, xyz: [0.05, 0.02, 0.01], rpy: [0.2, 0.4, 0.1]}
";

#[test]
fn five_joints_off_their_design_are_solved_by_an_elimination() {
    let design = model(FIVE);
    let mut random = Random(0xf1fe);
    for noise in [1e-6, 1e-4, 1e-3] {
        let model = measured(&design, noise, &mut random);
        let found = solve(&model, &Linkage::new(&model), Target::PositionAxis).unwrap();
        let is_elimination = matches!(found.form.inverse, Inverse::Univariate(_));
        assert!(is_elimination, "{noise:e}: {}", found.form.plan);
        assert_eq!(found.certificate.excused, 0, "{noise:e}");
        is_complete(&model, Target::PositionAxis, &found, 100);
    }
}

/// The last joint turns about the tip's z axis, but for a rounded digit: next to the turn of the
/// tool it is one joint too many, and its place in the Jacobian is noise.
#[test]
fn a_joint_that_moves_nothing_but_noise_is_one_too_many() {
    let rolling = |off: f64| {
        let tip = format!("tip: {{link: pen, xyz: [0.05, {off}, 0], rpy: [0, {RIGHT}, 0]}}");
        FIVE.lines().take(8).collect::<Vec<_>>().join("\n") + "\n" + &tip + "\n"
    };
    for off in [0.0, 1e-9, 1e-7, 1e-6] {
        let arm = compiled(&rolling(off), Target::PositionAxis).unwrap();
        assert!(arm.redundancy.is_some_and(|it| it.turn), "{off:e}");
    }
    let arm = compiled(&rolling(0.01), Target::PositionAxis).unwrap();
    assert!(arm.redundancy.is_none());
}

const RIGHT: f64 = std::f64::consts::FRAC_PI_2;

/// A SCARA arm whose slide comes first turns about the axes behind it.
#[test]
fn the_turn_of_a_projected_target_is_about_the_joints_that_turn() {
    let text = "\
robot: scara
units: {angle: rad, length: m}
screws:
  - {name: lift, axis: [0, 0.6, 0.8], type: prismatic}
  - {name: shoulder, axis: [0, 0.6, 0.8], point: [0, 0, 0]}
  - {name: elbow, axis: [0, 0.6, 0.8], point: [0.3, 0, 0]}
  - {name: wrist, axis: [0, 0.6, 0.8], point: [0.5, 0.04, -0.03]}
home: {xyz: [0.6, 0.08, -0.06], rpy: [0.2, 0.1, 0.5]}
";
    for target in [Target::PositionYaw, Target::Planar] {
        let arm = compiled(text, target).unwrap();
        // The lift is one too many for a planar target alone.
        let given = arm.redundancy.map_or(0, |it| it.parameters());
        assert_eq!(given, usize::from(target == Target::Planar), "{target:?}");
    }
    let arm = compiled(text, Target::Planar).unwrap();
    let (chain, form) = (arm.model.chain(), arm.inverse.unwrap().form);
    let mut random = Random(0x11f7);
    for k in 0..100 {
        let q = configuration(4, k, &mut random);
        let (parameters, solved) = form.split(&q);
        let solutions = form.solutions_at(&chain.fk(&q), &parameters);
        let given = arm.model.locked(&[0], &parameters);
        recovered(&given, &solved, &solutions, 1e-3).unwrap();
    }
    let arm = compiled(text, Target::PositionYaw).unwrap();
    is_complete(&arm.model, Target::PositionYaw, &arm.inverse.unwrap(), 100);
}

/// Axes that are parallel but for noise tilt and lift the tip by as little, which projected targets
/// do not read; in frames that are not those of the base.
#[test]
fn projected_targets_do_not_see_how_noise_tilts_the_tip() {
    let text = "\
robot: turned_over
units: {angle: rad, length: m}
joints:
  - {name: shoulder, xyz: [0.1, 0, 0.2], rpy: [0.7, -0.4, 0.3], axis: [0, 0, 1]}
  - {name: elbow, xyz: [0.3, 0, 0.05], rpy: [3.141592653589793, 0, 0.2], axis: [0, 0, 1]}
  - {name: lift, axis: [0, 0, 1], type: prismatic}
  - {name: wrist, xyz: [0.25, 0, 0], axis: [0, 0, 1]}
tip: {link: tool, xyz: [0.06, 0, 0.1], rpy: [0.5, 0, 0]}
";
    let lift = text.lines().find(|line| line.contains("lift")).unwrap();
    let planar = text.replace(&format!("{lift}\n"), "");
    let mut random = Random(0x5ca2a);
    for noise in [1e-13, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3] {
        for (text, target) in [(text, Target::PositionYaw), (&planar, Target::Planar)] {
            let model = measured(&model(text), noise, &mut random);
            let found = solve(&model, &Linkage::for_target(&model, target), target);
            let found = found.unwrap_or_else(|error| panic!("{target:?}, {noise:e}: {error:?}"));
            is_complete(&model, target, &found, 200);
        }
    }
}

/// Read to 1e-8 radians this arm has a plan by how the digits of its half turns tilt its axes, which
/// lost one target in a thousand next to where the arm is stretched.
#[test]
fn projected_targets_are_solved_by_axes_that_are_read_as_parallel() {
    let text = "\
robot: rounded
units: {angle: rad, length: m}
joints:
  - {name: a, xyz: [0.361, 0.05, 0.061], axis: [0, 0, -1]}
  - {name: b, xyz: [0.303, 0, -0.082], rpy: [3.1416, 3.1416, 0], axis: [0, 0, 1]}
  - {name: c, xyz: [0.262, 0, 0.049], rpy: [3.1416, 0, 3.1416], axis: [0, 0, 1]}
  - {name: d, xyz: [0.131, 0, 0.089], rpy: [3.1416, 0, 1.5708], axis: [0, 0, 1], type: prismatic}
";
    let arm = compiled(text, Target::PositionYaw).unwrap();
    let plan = arm.inverse.unwrap().form.plan;
    assert_eq!(plan.branches(), 2, "{plan}");
}

/// Height is not read from a planar target, and a slide that is off the plane changes it.
#[test]
fn slides_that_lift_the_tip_have_no_planar_targets() {
    let lifting = "robot: lifting\nunits: {angle: rad, length: m}\njoints:\n\
        - {name: a, axis: [0, 0, 1]}\n\
        - {name: slide, type: prismatic, xyz: [0.3, 0, 0], axis: [1, 0, 0.2]}\n\
        - {name: b, xyz: [0.3, 0, 0], axis: [0, 0, 1]}\n\
        - {name: tool, type: fixed, xyz: [0.2, 0, 0]}\n";
    let message = compiled(lifting, Target::Planar).unwrap_err();
    let reason = "`planar` targets leave the height to an arm whose slides go across its axes, and \
                  `slide` is 11.31° from that";
    assert!(message.contains(reason), "{message}");
    let remedy = "leave out `target`, or choose `position`;";
    assert!(message.contains(remedy), "{message}");
    assert!(compiled(lifting, Target::Position).is_ok());
    let level = lifting.replace("[1, 0, 0.2]", "[1, 0, 0]");
    assert!(compiled(&level, Target::Planar).is_ok());
    let another = "- {name: c, xyz: [0.2, 0, 0], axis: [0, 0, 1]}\n- {name: tool";
    let longer = lifting.replace("- {name: tool", another);
    assert!(compiled(&longer, Target::Planar).is_ok());
}

#[test]
fn arms_that_tilt_the_tip_have_no_projected_targets() {
    for target in [Target::PositionYaw, Target::Planar] {
        let message = compiled(FIVE, target).unwrap_err();
        let reason = format!(
            "`{}` is for arms all of whose joints turn about parallel axes, and those of `waist` and \
             `shoulder` are 90.00° apart",
            target.word()
        );
        assert!(message.contains(&reason), "{message}");
        let remedy = "leave out `target`, or choose `position` or `position_axis`";
        assert!(message.contains(remedy), "{message}");
    }
}

#[test]
fn arms_whose_axes_are_parallel_but_for_noise_have_projected_targets() {
    let noisy = "\
robot: noisy
units: {angle: rad, length: m}
joints:
  - {name: a, axis: [0, 0, 1]}
  - {name: b, xyz: [0.3, 0, 0], rpy: [0.0001, 0, 0], axis: [0, 0, 1]}
  - {name: c, xyz: [0.2, 0, 0], axis: [0, 0, 1]}
tip: {link: tool, xyz: [0.1, 0, 0]}
";
    for target in [Target::PositionYaw, Target::Planar] {
        compiled(noisy, target).unwrap();
    }
}

/// A gantry without a wrist, and an arm with a joint to spare, whose remedy is that of the noise.
#[test]
fn projected_targets_are_refused_for_what_is_wrong_with_them() {
    let gantry = "\
robot: gantry
units: {angle: rad, length: m}
joints:
  - {name: x, axis: [1, 0, 0], type: prismatic}
  - {name: y, axis: [0, 1, 0], type: prismatic}
  - {name: z, axis: [0, 0, 1], type: prismatic}
tip: {link: tool, xyz: [0, 0, -0.1]}
";
    for target in [Target::PositionYaw, Target::Planar] {
        let message = compiled(gantry, target).unwrap_err();
        let word = target.word();
        let reason = format!("`{word}` has a turn about the joints' axes, and no joint turns");
        assert!(message.contains(&reason), "{message}");
        assert!(
            message.contains("leave out `target`, or choose `position`"),
            "{message}"
        );
    }
    let scara = "\
robot: scara
units: {angle: rad, length: m}
joints:
  - {name: a, axis: [0, 0, 1]}
  - {name: b, xyz: [0.3, 0, 0], rpy: [3.1416, 0, 0], axis: [0, 0, 1]}
  - {name: c, xyz: [0.2, 0, 0], axis: [0, 0, 1]}
  - {name: d, axis: [0, 0, 1], type: prismatic}
";
    let message = compiled(scara, Target::Planar).unwrap_err();
    assert!(
        message.contains("write right angles and half turns with all their digits"),
        "{message}"
    );
}

/// Where nearly every configuration is near to singular, nothing was seen, and nothing is promised.
#[test]
fn an_arm_that_is_nearly_singular_everywhere_is_refused() {
    let text = "\
robot: twins
units: {angle: rad, length: m}
screws:
  - {name: a, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: b, axis: [0, 0, 1], point: [0.00001, 0, 0]}
home: {xyz: [0.9, 0.3, 0]}
";
    let message = compiled(text, Target::Position).unwrap_err();
    assert!(message.contains("so near to singular"), "{message}");
    assert!(message.contains("if the file rounds them"), "{message}");
}

/// A crane whose last link hangs down: the turn of the tip that its targets leave free is about the
/// direction of the slewing axis then. A plan that tells both turns at once told neither, and the arm is
/// regular; nor did any configuration show it where the tip's axis was none of those that are aligned.
#[test]
fn the_axis_of_a_free_turn_may_be_that_of_a_joint() {
    let behind = |third: &str, last: &str| {
        format!(
            "robot: crane\nunits: {{angle: deg, length: m}}\ndh:\n\
             - {{name: slew, theta: 0, d: 2.4, a: 0, alpha: 90}}\n\
             - {{name: boom, theta: 0, d: 0, a: 3.5, alpha: 0}}\n{third}{last}"
        )
    };
    let jib = "- {name: jib, theta: 90, d: 0, a: 0, alpha: 90}\n";
    let telescope = "- {name: telescope, type: prismatic, theta: 0, d: 3, a: 0, alpha: 0}\n";
    let tilted = "tip: {rpy: [0, 30, 0]}\n";
    let mut random = Random(0xc4a7e);
    for text in [
        behind(jib, telescope),
        behind(jib, &format!("{telescope}{tilted}")),
    ] {
        let target = Target::PositionAxis;
        let arm = compiled(&text, target).unwrap();
        let found = arm.inverse.unwrap();
        assert!(found.certificate.is_complete());
        let chain = arm.model.chain();
        let hanging = |q: &[f64]| {
            let axis = chain.fk(q).rotation.map(|row| row[2]);
            axis[0].hypot(axis[1])
        };
        for k in 0..300 {
            let mut q: Vec<f64> = (0..4).map(|_| random.between(-2.0, 2.0)).collect();
            // The sum of boom and jib with which the tip's axis is upright.
            let upright = [0.0, PI / 2.0, -PI / 2.0, PI].map(|sum| sum - q[1]);
            let off = [0.0, 1e-13, 1e-12, 1e-10, 1e-6][k % 5];
            let turns = upright
                .into_iter()
                .chain(upright.map(|it| it - PI / 6.0))
                .chain(upright.map(|it| it + PI / 6.0));
            let at = |third: f64| vec![q[0], q[1], third, q[3]];
            let third = turns
                .min_by(|a, b| hanging(&at(*a)).total_cmp(&hanging(&at(*b))))
                .unwrap();
            q[2] = third + off;
            assert!(hanging(&q) < 2.0 * off + 1e-12);
            let independent = conditioning(&chain, &q, size(&arm.model), target);
            if independent > 1e-3 {
                let solutions = found.form.solutions(&chain.fk(&q));
                recovered(&arm.model, &q, &solutions, independent).unwrap();
            }
        }
    }
}

/// Where one of two parallel joints is given and a slide stands beside them, a direction behind the
/// slide is turned by the sum of both, and not by the given one once more.
#[test]
fn a_slide_beside_parallel_joints_leaves_their_sum_alone() {
    let slide = "  - {name: slide, axis: [0, 0.6, 0.8], type: prismatic}\n";
    let turns = [("shoulder", 0.0), ("elbow", 0.3)].map(|(name, x)| {
        format!("  - {{name: {name}, axis: [0, 0.6, 0.8], point: [{x}, 0, 0]}}\n")
    });
    let turns = turns.concat();
    for (first, last) in [(slide, ""), ("", slide)] {
        let text = format!(
            "robot: scara\nunits: {{angle: rad, length: m}}\nscrews:\n{first}{turns}{last}\
             home: {{xyz: [0.5, 0.08, -0.06], rpy: [0.2, 0.1, 0.5]}}\n"
        );
        let arm = compiled(&text, Target::Orientation).unwrap();
        let (chain, form) = (arm.model.chain(), arm.inverse.unwrap().form);
        let mut random = Random(0x0a11);
        for k in 0..100 {
            let q = configuration(3, k, &mut random);
            let (parameters, solved) = form.split(&q);
            let solutions = form.solutions_at(&chain.fk(&q), &parameters);
            let given = arm.model.locked(&form.given.locked, &parameters);
            recovered(&given, &solved, &solutions, 1e-2).unwrap();
        }
    }
}

/// Three axes that are off right angles by a hair or by far: nothing but their directions counts, and
/// subproblems solve these as they are.
#[test]
fn a_wrist_off_its_right_angles_is_solved_for_orientations_as_it_is() {
    for noise in [1e-9, 1e-7, 4e-6, 3e-5, 6e-4, 5e-3, 0.3] {
        let text = format!(
            "robot: wrist\nunits: {{angle: rad, length: m}}\nscrews:\n\
             - {{name: a, axis: [0, 0, 1], point: [0, 0, 0]}}\n\
             - {{name: b, axis: [{noise}, 1, {}], point: [0.1, 0, 0]}}\n\
             - {{name: c, axis: [{}, {noise}, 1], point: [0, 0.02, 0]}}\n\
             home: {{xyz: [0, 0, 0.1], rpy: [0.3, -0.4, 1]}}\n",
            0.7 * noise,
            -0.4 * noise,
        );
        let arm = compiled(&text, Target::Orientation).unwrap();
        let found = arm.inverse.as_ref().unwrap();
        assert!(found.form.is_exact(), "{noise}: {}", found.form.plan);
        assert_eq!(found.certificate.lost, 0, "{noise}");
        is_complete(&arm.model, Target::Orientation, found, 300);
    }
}

/// A wrist behind an elbow, the axes of which are parallel and meet but for noise.
const SIX_OFF: &str = "
robot: six
units: {angle: rad, length: m}
joints:
  - {name: base,     axis: [0, 0, 1]}
  - {name: shoulder, xyz: [0.03, 1e-6, 0.35], axis: [0, 1, 0]}
  - {name: elbow,    xyz: [3e-6, 0, 0.42],    axis: [1e-6, 1, 0]}
  - {name: roll,     xyz: [0.05, 0, 0.02],    axis: [1, 0, 2e-6]}
  - {name: pitch,    xyz: [0.4, 0, 3e-6],     axis: [0, 1, 1e-6]}
  - {name: spin,     xyz: [0, 2e-6, 0],       axis: [1, 0, 0]}
tip: {link: tool, xyz: [0.1, 0.02, 0.01], rpy: [0.2, 0.4, 0.1]}
";

/// The joints that come with a target that does not need them are joints of the arm all the same.
#[test]
fn the_singularities_of_an_arm_with_joints_to_spare_are_those_of_all_its_joints() {
    let names = |target: Target, free: &[&str]| {
        let options = Options {
            target: Some(target),
            free: free.iter().map(|&joint| joint.to_owned()).collect(),
            ..Options::default()
        };
        let Compiled::Arm(arm) = compile(&source(SIX_OFF), &options).unwrap() else {
            panic!("no arm")
        };
        let singular = arm.singular().map(|it| it.singularities.clone());
        singular.map(|all| all.into_iter().map(|it| it.name).collect::<Vec<_>>())
    };
    let known = names(Target::Pose, &[]).unwrap();
    assert_eq!(known.len(), 3, "{known:?}");
    for free in [
        ["base", "roll", "pitch"],
        ["base", "roll", "spin"],
        ["base", "pitch", "spin"],
    ] {
        assert_eq!(
            names(Target::Position, &free).as_ref(),
            Some(&known),
            "{free:?}"
        );
    }
}

/// Folded, the legs of three joints and a tool askew nearly reach the target of their mirror image:
/// by less than the tolerance where sines and cosines are taken as they are found, and by more where
/// they are those of angles.
#[test]
fn a_folded_leg_returns_nothing_beyond_the_tolerance() {
    let text = "\
robot: leg
units: {angle: rad, length: m}
screws:
  - {name: wheel, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: knee, axis: [3.464102e-7, 3.071796e-7, -1], point: [0, -0.175, -0.012]}
  - {name: hip, axis: [3.464102e-7, 3.071796e-7, -1], point: [0, -0.343, 0.0842]}
home: {xyz: [0.161472, -0.403018, 0.231898], rpy: [0.10125439246414365, 0.5169484524672391, 2.9432290157433263]}
";
    let arm = compiled(text, Target::PositionAxis).unwrap();
    let (chain, length, form) = (arm.model.chain(), size(&arm.model), arm.form().unwrap());
    let mut random = Random(0xf01d);
    for _ in 0..4000 {
        let [wheel, hip] = [(); 2].map(|()| random.between(-PI, PI));
        let pose = chain.fk(&[wheel, PI + random.between(-5e-3, 5e-3), hip]);
        for solution in form.solutions(&pose) {
            let miss = Target::PositionAxis.distance(&chain.fk(&solution.q), &pose, length);
            assert!(miss <= 1e-9 * length, "{:?}: {miss:e}", solution.q);
        }
    }
}
