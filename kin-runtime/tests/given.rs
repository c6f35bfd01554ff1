//! The numerical search with parameters beside the target.

use core::f64::consts::PI;
use kin_runtime::__private::math::wrap;
use kin_runtime::{Chain, ChainSolution, Parameter, Pose, SearchOptions, Swivel, Target, Twist};

const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Spherical shoulder, elbow, spherical wrist, on a base that is nowhere special; its links have
/// frames that are the base's at home, turned.
fn shoulder_and_wrist() -> (Chain, Swivel) {
    let base = Pose::from_axis_angle([0.6, 0.0, 0.8], 0.7, [0.1, -0.2, 0.3]);
    let turning = [Z, Y, Z, Y, Z, Y, Z];
    let heights = [0.36, 0.36, 0.36, 0.78, 1.18, 1.18, 1.18];
    let joint = |(axis, z)| base.adjoint(&Twist::revolute(axis, [0.0, 0.0, z]));
    let twists = turning.into_iter().zip(heights).map(joint).collect();
    let home = base * Pose::from_axis_angle(Y, 0.4, [0.0, 0.05, 1.33]);
    let link = Pose::from_axis_angle(Y, -1.1, [0.3, 0.2, 0.1]);
    let chain = Chain::new(twists, home).with_links(vec![link; 7]);
    let at = |z| base.transform_point([0.0, 0.0, z]);
    let swivel = Swivel {
        shoulder: at(0.36),
        link: 2,
        // Any point of the upper arm tells the side.
        elbow: link.inverse().transform_point(at(0.7)),
        wrist: home.inverse().transform_point(at(1.18)),
        reference: base.rotate(Z),
    };
    (chain, swivel)
}

fn swivel_of(chain: &Chain, swivel: &Swivel, q: &[f64]) -> f64 {
    let links: [Pose; 7] = chain.fk_links(q).try_into().unwrap();
    swivel.angle(&links, &chain.fk(q))
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let each = a.iter().zip(b).map(|(x, y)| wrap(x - y).abs());
    each.fold(0.0, f64::max)
}

fn search(chain: &Chain, target: &Pose, given: &[(Parameter, f64)]) -> Vec<ChainSolution> {
    let options = SearchOptions {
        given,
        ..Default::default()
    };
    let found = chain.ik_all(target, &options);
    for solution in &found {
        assert!(chain.fk(&solution.q).translation_distance(target) < 1e-11);
        assert!(chain.fk(&solution.q).rotation_distance(target) < 1e-11);
        let again = chain.ik_from(target, &options, &solution.q).unwrap();
        assert!(apart(&again.q, &solution.q) < 1e-9, "{again:?}");
    }
    found
}

const Q: [f64; 7] = [0.3, 0.7, -0.5, 1.2, 0.4, -0.9, 2.1];

#[test]
fn a_joint_that_is_given_keeps_its_value() {
    let (chain, _) = shoulder_and_wrist();
    let target = chain.fk(&Q);
    for joint in [0, 2, 4, 6] {
        let found = search(&chain, &target, &[(Parameter::Joint(joint), Q[joint])]);
        assert!(found.iter().all(|solution| solution.q[joint] == Q[joint]));
        assert!(
            found.iter().any(|solution| apart(&solution.q, &Q) < 1e-9),
            "{joint}"
        );
        let wound = search(
            &chain,
            &target,
            &[(Parameter::Joint(joint), Q[joint] + 2.0 * PI)],
        );
        assert_eq!(found.len(), wound.len());
    }
}

/// Turning the elbow about the line from shoulder to wrist leaves eight branches, wherever it
/// is; each of those that locked joints tell has one of them.
#[test]
fn a_swivel_angle_leaves_eight_branches_and_those_of_locked_joints_are_among_them() {
    let (chain, swivel) = shoulder_and_wrist();
    let target = chain.fk(&Q);
    let at = |angle: f64| search(&chain, &target, &[(Parameter::Swivel(swivel), angle)]);
    for angle in [-2.9, -1.1, 0.0, 0.8, 3.1] {
        let found = at(angle);
        assert_eq!(found.len(), 8, "{angle}");
        for solution in &found {
            let own = swivel_of(&chain, &swivel, &solution.q);
            assert!(wrap(own - angle).abs() < 1e-9, "{own} for {angle}");
            assert!(solution.conditioning > 1e-4);
        }
    }
    for joint in [0, 2, 6] {
        let locked = search(&chain, &target, &[(Parameter::Joint(joint), Q[joint])]);
        assert!(!locked.is_empty());
        for solution in &locked {
            let found = at(swivel_of(&chain, &swivel, &solution.q));
            let same = |other: &&ChainSolution| apart(&other.q, &solution.q) < 1e-8;
            assert_eq!(found.iter().filter(same).count(), 1, "{solution:?}");
        }
    }
}

/// A slide in front, its value and the swivel angle; and the turn of a tool beside a joint.
#[test]
fn several_are_given_at_once() {
    let (arm, swivel) = shoulder_and_wrist();
    let along = [0.0, 0.6, 0.8];
    let slide = [&[Twist::prismatic(along)], arm.twists()].concat();
    let links = (0..8).map(|_| arm.fk_links(&[0.0; 7])[0]).collect();
    let chain = Chain::new(slide, *arm.home()).with_links(links);
    let q = [&[0.35], &Q[..]].concat();
    let target = chain.fk(&q);
    let moved = Pose::from_translation(along.map(|x| 0.35 * x));
    let swivel = Swivel {
        shoulder: moved.transform_point(swivel.shoulder),
        link: 3,
        ..swivel
    };
    let angle = {
        let links = chain.fk_links(&q);
        let elbow = links[3].transform_point(swivel.elbow);
        swivel.of_points(elbow, target.transform_point(swivel.wrist))
    };
    let given = [
        (Parameter::Swivel(swivel), angle),
        (Parameter::Joint(0), 0.35),
    ];
    let found = search(&chain, &target, &given);
    assert_eq!(found.len(), 8);
    assert!(found.iter().any(|solution| apart(&solution.q, &q) < 1e-9));

    let options = SearchOptions {
        target: Target::PositionAxis,
        given: &[(Parameter::Turn, 0.6), (Parameter::Joint(6), Q[6])],
        ..Default::default()
    };
    let target = arm.fk(&Q).turned(-0.6);
    let found = arm.ik_all(&target, &options);
    assert!(found.iter().any(|solution| apart(&solution.q, &Q) < 1e-9));
    for solution in &found {
        assert!((target.turn_to(&arm.fk(&solution.q)) - 0.6).abs() < 1e-9);
    }
}
