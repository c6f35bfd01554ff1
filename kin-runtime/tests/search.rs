//! The numerical search finds all solutions, each once, and nothing else.

use core::f64::consts::PI;
use kin_runtime::__private::math::wrap;
use kin_runtime::{Chain, ChainSolution, Pose, SearchOptions, Target, Twist};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A chain that reaches along x: axes and the places that they go through.
fn chain<const N: usize>(joints: [([f64; 3], [f64; 3]); N], tool: [f64; 3]) -> Chain {
    let twists = joints.map(|(axis, point)| Twist::revolute(axis, point));
    Chain::new(twists.into(), Pose::from_translation(tool))
}

/// A spherical wrist behind an offset shoulder with two parallel axes.
fn wrist_arm() -> Chain {
    let wrist = [0.9, 0.0, 1.35];
    chain(
        [
            (Z, [0.0; 3]),
            (Y, [0.15, 0.0, 0.5]),
            (Y, [0.15, 0.0, 1.2]),
            (X, wrist),
            (Y, wrist),
            (X, wrist),
        ],
        [1.0, 0.0, 1.35],
    )
}

/// Three parallel axes, the last two crossing: the proportions of a UR5.
fn parallel_arm() -> Chain {
    let minus_z = [0.0, 0.0, -1.0];
    chain(
        [
            (Z, [0.0; 3]),
            (Y, [0.0, 0.0, 0.089]),
            (Y, [0.425, 0.0, 0.089]),
            (Y, [0.817, 0.0, 0.089]),
            (minus_z, [0.817, 0.109, 0.0]),
            (Y, [0.817, 0.0, -0.005]),
        ],
        [0.817, 0.192, -0.005],
    )
}

fn planar(n: usize) -> Chain {
    let lengths = [0.0, 0.5, 0.9, 1.1];
    let twists = lengths[..n]
        .iter()
        .map(|&x| Twist::revolute(Z, [x, 0.0, 0.0]))
        .collect();
    Chain::new(twists, Pose::from_translation([lengths[n], 0.0, 0.0]))
}

fn solve(chain: &Chain, target: &Pose) -> Vec<ChainSolution> {
    chain.ik_all(target, &SearchOptions::default())
}

fn differ(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| wrap(x - y).abs())
        .fold(0.0, f64::max)
}

fn assert_sound_and_distinct(chain: &Chain, target: &Pose, found: &[ChainSolution]) {
    for (i, solution) in found.iter().enumerate() {
        let reached = chain.fk(&solution.q);
        assert!(reached.translation_distance(target) < 1e-11);
        assert!(reached.rotation_distance(target) < 1e-11);
        assert!(solution.residual < 1e-11);
        assert!(
            found[..i]
                .iter()
                .all(|other| differ(&other.q, &solution.q) > 1e-5)
        );
    }
}

#[test]
fn six_joint_arms_have_their_eight_solutions() {
    let q = [0.3, -0.4, 0.5, 0.6, 0.7, -0.8];
    for chain in [wrist_arm(), parallel_arm()] {
        let target = chain.fk(&q);
        let found = solve(&chain, &target);
        assert_eq!(found.len(), 8);
        assert_sound_and_distinct(&chain, &target, &found);
        assert!(found.iter().any(|solution| differ(&solution.q, &q) < 1e-10));
        assert!(
            found
                .iter()
                .all(|solution| solution.q.iter().all(|a| *a > -PI && *a <= PI))
        );
        assert!(found.iter().all(|solution| solution.conditioning > 1e-4));
    }
}

#[test]
fn an_arm_of_sixteen_solutions_shows_all() {
    // Manseur and Doty, "A robot manipulator with 16 real inverse kinematic
    // solution sets", International Journal of Robotics Research 8, 1989:
    // Denavit-Hartenberg a, d, alpha, and the pose at the given joint values.
    let dh = [
        (0.3, 0.0, 0.5 * PI),
        (1.0, 0.0, PI / 180.0),
        (0.0, 0.2, 0.5 * PI),
        (1.5, 0.0, PI / 180.0),
        (0.0, 0.0, 0.5 * PI),
        (0.0, 0.0, 0.0),
    ];
    let mut frame = Pose::IDENTITY;
    let mut twists = Vec::new();
    for (a, d, alpha) in dh {
        twists.push(frame.adjoint(&Twist::revolute(Z, [0.0; 3])));
        frame =
            frame * Pose::from_translation([a, 0.0, d]) * Pose::from_axis_angle(X, alpha, [0.0; 3]);
    }
    let chain = Chain::new(twists, frame);
    let target = Pose {
        rotation: [
            [-0.760117, -0.641689, 0.102262],
            [0.133333, 0.0, 0.991071],
            [-0.635959, 0.766965, 0.085558],
        ],
        translation: [-1.140175, 0.0, 0.0],
    };
    let target = Pose::from_quaternion(target.quaternion(), target.translation);
    let found = solve(&chain, &target);
    assert_sound_and_distinct(&chain, &target, &found);
    assert_eq!(found.len(), 16);
}

#[test]
fn fewer_joints_are_solved_where_the_target_closes() {
    let arm = planar(3);
    let target = arm.fk(&[0.4, 0.8, -0.3]);
    let found = solve(&arm, &target);
    assert_eq!(found.len(), 2);
    assert_sound_and_distinct(&arm, &target, &found);
    let tilted = target * Pose::from_axis_angle(X, 1e-3, [0.0; 3]);
    assert!(solve(&arm, &tilted).is_empty());
}

#[test]
fn prismatic_joints_do_not_wrap() {
    let arm = [
        Twist::revolute(Z, [0.0; 3]),
        Twist::prismatic(X),
        Twist::prismatic(Z),
    ];
    let arm = Chain::new(arm.into(), Pose::from_translation([0.2, 0.0, 0.0]));
    let found = solve(&arm, &arm.fk(&[0.5, 9.0, -7.0]));
    assert_eq!(found.len(), 1);
    assert!((found[0].q[1] - 9.0).abs() < 1e-10 && (found[0].q[2] + 7.0).abs() < 1e-10);
}

#[test]
fn positions_alone_can_be_asked_for() {
    let options = SearchOptions {
        target: Target::Position,
        ..Default::default()
    };
    let target = Pose::from_translation([0.3, 0.4, 0.0]);
    let found = planar(2).ik_all(&target, &options);
    assert_eq!(found.len(), 2);
    for solution in found {
        assert!(planar(2).fk(&solution.q).translation_distance(&target) < 1e-12);
    }
    let shoulder = chain(
        [(Z, [0.0; 3]), (Y, [0.1, 0.0, 0.0]), (Y, [0.6, 0.0, 0.0])],
        [1.0, 0.0, 0.0],
    );
    let target = shoulder.fk(&[0.3, 0.2, 1.9]);
    assert_eq!(shoulder.ik_all(&target, &options).len(), 4);
}

#[test]
fn out_of_reach_is_empty() {
    assert!(solve(&wrist_arm(), &Pose::from_translation([9.0, 0.0, 0.0])).is_empty());
}

#[test]
fn a_stretched_arm_is_found_once_and_badly_conditioned() {
    let found = solve(&planar(3), &planar(3).fk(&[0.4, 0.0, 0.7]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].conditioning < 1e-5);
}

#[test]
fn families_end_at_the_limit_and_are_badly_conditioned() {
    let options = SearchOptions {
        max_solutions: 20,
        ..Default::default()
    };
    // q5 = 0: the wrist's first and last axes are one.
    let target = wrist_arm().fk(&[0.3, -0.4, 0.5, 0.6, 0.0, -0.8]);
    let found = wrist_arm().ik_all(&target, &options);
    assert_eq!(found.len(), 20);
    assert!(
        found
            .iter()
            .filter(|solution| solution.conditioning < 1e-6)
            .count()
            > 10
    );
}

#[test]
fn answers_do_not_vary() {
    let target = parallel_arm().fk(&[0.1, 0.2, -0.3, 0.4, 0.5, 0.6]);
    assert_eq!(
        solve(&parallel_arm(), &target),
        solve(&parallel_arm(), &target)
    );
}

#[test]
fn a_descent_from_a_start_stays_with_its_solution() {
    let chain = wrist_arm();
    let target = chain.fk(&[0.3, -0.4, 0.5, 0.6, 0.7, -0.8]);
    let options = SearchOptions::default();
    for solution in solve(&chain, &target) {
        let start: Vec<f64> = solution.q.iter().map(|x| x + 1e-3).collect();
        let found = chain.ik_from(&target, &options, &start).unwrap();
        assert!(differ(&found.q, &solution.q) < 1e-10);
        assert!(found.residual < 1e-11);
    }
    let away = Pose::from_translation([100.0, 0.0, 0.0]);
    assert_eq!(chain.ik_from(&away, &options, &[0.1; 6]), None);
}

/// The chain with joints at its tip for what of a target does not count: it
/// reaches a whole pose where the chain reaches what counts.
fn freed(chain: &Chain, target: Target) -> Chain {
    let home = *chain.home();
    let spin = Twist::revolute(home.rotate(Z), home.translation);
    let turns = [X, Y, Z].map(|axis| Twist::revolute(axis, home.translation));
    let slides = [X, Y, Z].map(Twist::prismatic);
    let mut twists = chain.twists().to_vec();
    match target {
        Target::Pose | Target::PositionYaw | Target::Planar => {}
        Target::Position => twists.extend(turns),
        Target::PositionAxis => twists.push(spin),
        Target::Orientation => twists.extend(slides),
        Target::Direction => {
            twists.push(spin);
            twists.extend(slides);
        }
    }
    Chain::new(twists, home)
}

#[test]
fn every_part_of_a_pose_has_the_solutions_of_an_arm_freed_of_the_rest() {
    let wrist = wrist_arm();
    let first = |n: usize| Chain::new(wrist.twists()[..n].to_vec(), *wrist.home());
    let last = |n: usize| Chain::new(wrist.twists()[6 - n..].to_vec(), *wrist.home());
    let bent = Pose::from_axis_angle(Y, 0.4, [0.0; 3]);
    let bent = |chain: Chain| Chain::new(chain.twists().to_vec(), *chain.home() * bent);
    let scara = {
        let mut twists = planar(3).twists().to_vec();
        twists.push(Twist::prismatic(Z));
        Chain::new(twists, Pose::from_axis_angle(X, PI, [1.1, 0.0, 0.3]))
    };
    let q = [0.3, -0.4, 0.5, 0.6, 0.7, -0.8];
    for (chain, target, count) in [
        (wrist.clone(), Target::Pose, 8),
        (first(3), Target::Position, 4),
        (bent(first(5)), Target::PositionAxis, 8),
        (scara, Target::PositionYaw, 2),
        (planar(3), Target::Planar, 2),
        (bent(last(2)), Target::Direction, 2),
        (bent(last(3)), Target::Orientation, 2),
    ] {
        let n = chain.twists().len();
        let pose = chain.fk(&q[..n]);
        let options = SearchOptions {
            target,
            ..Default::default()
        };
        let found = chain.ik_all(&pose, &options);
        assert_eq!(found.len(), count, "{target:?} {found:?}");
        let whole = solve(&freed(&chain, target), &pose);
        for solution in &found {
            assert!(target.distance(&chain.fk(&solution.q), &pose, 1.0) < 1e-11);
        }
        // Three further turns make an orientation in two ways.
        let among = |q: &[f64], all: &[ChainSolution]| {
            all.iter()
                .any(|other| differ(&other.q[..n], &q[..n]) < 1e-9)
        };
        assert!(
            found.iter().all(|solution| among(&solution.q, &whole)),
            "{target:?}"
        );
        assert!(
            whole.iter().all(|solution| among(&solution.q, &found)),
            "{target:?}"
        );
    }
}

/// How it is tilted, and how high it is, is not read of a planar target.
#[test]
fn a_planar_target_stands_for_the_pose_that_the_arm_can_take() {
    let chain = planar(3);
    let options = SearchOptions {
        target: Target::Planar,
        ..Default::default()
    };
    let flat = chain.fk(&[0.3, -0.4, 0.5]);
    let tilted =
        Pose::from_translation([0.0, 0.0, 0.7]) * flat * Pose::from_axis_angle(X, 0.2, [0.0; 3]);
    let (expected, found) = (
        chain.ik_all(&flat, &options),
        chain.ik_all(&tilted, &options),
    );
    assert_eq!(found.len(), 2);
    let stands_for = Target::Planar.stands_for(&tilted, Z, chain.home());
    for (a, b) in found.iter().zip(&expected) {
        assert!(chain.fk(&a.q).translation_distance(&stands_for) < 1e-11);
        assert!(chain.fk(&a.q).rotation_distance(&stands_for) < 1e-11);
        assert!((a.q[0] - b.q[0]).abs() < 0.1);
    }
    let options = SearchOptions::default();
    assert!(chain.ik_all(&tilted, &options).is_empty());
}

/// Of an arm that turns about nothing the first axis is that of its first slide.
#[test]
fn a_projected_target_of_slides_alone_stands_for_a_pose() {
    let slides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let chain = Chain::new(slides.map(Twist::prismatic).to_vec(), Pose::IDENTITY);
    let target = Pose::from_axis_angle([0.0, 0.0, 1.0], PI, [0.1, 0.2, 0.3]);
    let options = SearchOptions {
        target: Target::PositionYaw,
        ..SearchOptions::default()
    };
    let found = chain.ik_all(&target, &options);
    assert_eq!(found.len(), 1);
    assert!((found[0].q[2] - 0.3).abs() < 1e-11, "{found:?}");
}
