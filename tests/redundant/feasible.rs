//! Feasible intervals against dense sampling, their ends against the solutions on both
//! sides, and all of it within limits.

use crate::random::Random;
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{
    Criterion, FeasibleInterval, JointLimit, Parameter, Pose, RedundantKinematics, Robot,
    RobotOptions, RobotSource, Solution, Solutions,
};
use std::f64::consts::{PI, TAU};
use std::path::Path;

for_every_robot! {
    as_many_branches_exist_as_there_are_solutions
    ends_are_where_solutions_meet
    limits_are_kept
}

/// Nearer to an end than this, counts are not compared.
const CLOSE: f64 = 1e-7;

/// Values of the parameter, evenly over its range.
fn values<K: RedundantKinematics<N>, const N: usize>(count: usize) -> impl Iterator<Item = f64> {
    let [from, to] = match K::PARAMETER {
        Parameter::Joint(joint) if !K::LIMITS[joint].is_revolute() => {
            [K::LIMITS[joint].lower(), K::LIMITS[joint].upper()]
        }
        _ => [-PI, PI],
    };
    (0..count).map(move |i| from + (to - from) * (i as f64 + 0.5) / count as f64)
}

fn is_near_end<const N: usize>(intervals: &[FeasibleInterval<N>], value: f64, by: f64) -> bool {
    let near = |end: f64| {
        let d = (value - end).rem_euclid(TAU);
        d.min(TAU - d) < by
    };
    let mut open = intervals.iter().filter(|interval| !interval.is_closed);
    open.any(|interval| near(interval.from) || near(interval.to))
}

/// How many of them hold a value; one that winds several times counts so.
fn holding<K: RedundantKinematics<N>, const N: usize>(
    intervals: &[FeasibleInterval<N>],
    value: f64,
) -> usize {
    let turns = match K::PARAMETER {
        Parameter::Joint(joint) => K::LIMITS[joint].is_revolute(),
        Parameter::Turn | Parameter::Swivel(_) => true,
    };
    let times = |interval: &FeasibleInterval<N>| {
        if !turns {
            return usize::from((interval.from..=interval.to).contains(&value));
        }
        if interval.is_closed {
            return ((interval.to - interval.from) / TAU).round() as usize;
        }
        let first = interval.from + (value - interval.from).rem_euclid(TAU);
        if first > interval.to {
            return 0;
        }
        1 + ((interval.to - first) / TAU) as usize
    };
    intervals.iter().map(times).sum()
}

fn as_many_branches_exist_as_there_are_solutions<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let mut intervals_seen = 0;
    for q in robot.random(8) {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        intervals_seen += intervals.len();
        for value in values::<K, N>(250).filter(|&v| !is_near_end(&intervals, v, CLOSE)) {
            let solutions = robot.arm.ik_at(&target, value).len();
            let held = holding::<K, N>(&intervals, value);
            assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
        }
    }
    assert!(intervals_seen > 16, "{intervals_seen}");
}

/// Whether the parameter ends there anyway.
fn is_stop<K: RedundantKinematics<N>, const N: usize>(end: f64) -> bool {
    let Parameter::Joint(joint) = K::PARAMETER else {
        return false;
    };
    let limit = K::LIMITS[joint];
    !limit.is_revolute() && [limit.lower(), limit.upper()].contains(&end)
}

/// How many reach their target to rounding. Where there are none, an elimination answers with what
/// misses it by less than is promised, as next to an end.
fn reaching<const N: usize>(solutions: &Solutions<N>) -> usize {
    match solutions.first() {
        Some(only) if solutions.len() == 1 && only.singular && only.residual > 1e-12 => 0,
        _ => solutions.len(),
    }
}

/// A billionth on either side of an end there are two solutions more, or two less.
fn ends_are_where_solutions_meet<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(8) {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        for interval in intervals.iter().filter(|interval| !interval.is_closed) {
            assert!(interval.from < interval.to, "{interval:?}");
            for end in [interval.from, interval.to] {
                let count = |value: f64| reaching(&robot.arm.ik_at(&target, value)) as isize;
                let change = count(end + 1e-9) - count(end - 1e-9);
                // Of two solutions so near to each other the univariate step may lose one.
                assert!(
                    change != 0 || is_stop::<K, N>(end),
                    "{change} at {end} of {interval:?} of {q:?}"
                );
            }
        }
    }
}

fn limits_are_kept<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let mut held_at_all = 0;
    for q in robot.random(5) {
        let target: Pose = robot.chain.fk(&q);
        let intervals = robot.arm.feasible_within(&target, &K::LIMITS);
        for value in values::<K, N>(250).filter(|&v| !is_near_end(&intervals, v, CLOSE)) {
            let solutions = robot
                .arm
                .ik_at(&target, value)
                .within_limits(&K::LIMITS)
                .len();
            let held = holding::<K, N>(&intervals, value);
            assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
            held_at_all += held;
        }
        for interval in intervals.iter().filter(|it| it.to - it.from > CLOSE) {
            let inside = |(q, limit): (&f64, JointLimit)| {
                (limit.lower() - 1e-8..=limit.upper() + 1e-8).contains(q)
            };
            let all = interval.middle.iter().zip(K::LIMITS).all(inside);
            assert!(all, "{interval:?}");
        }
    }
    assert!(held_at_all > 0);
}

/// Of a Sawyer, with a value of the parameter at which two solutions exist between two samples
/// alone, for a hundredth of a radian.
pub const SHORT_LIVED: [([f64; 7], f64); 5] = [
    (
        [
            -2.0616411680635767,
            1.210609812164141,
            2.8155527219824137,
            0.18236020398025854,
            2.6714318091984195,
            -2.422998064654227,
            2.068256876073683,
        ],
        2.0640263734084936,
    ),
    (
        [
            1.0307934060312585,
            -0.27385694619999823,
            -0.03370534047099216,
            0.6386630201523076,
            0.442736742214469,
            -2.250367857500089,
            -1.558480739367221,
        ],
        0.5749114556069319,
    ),
    (
        [
            2.4870549922285274,
            -0.4427126410326476,
            -1.3469106298760634,
            0.33443592850150905,
            2.8270194423581296,
            1.1335325017720432,
            1.2716100654888782,
        ],
        -0.5372123437638545,
    ),
    (
        [
            -0.9148435219776557,
            -2.331215990729774,
            0.18690113980274123,
            -0.03964913717993647,
            -2.536612107251266,
            2.3798421082773764,
            1.120726802549896,
        ],
        1.0759954838545047,
    ),
    (
        [
            -0.8238756622754896,
            -1.5970702394055205,
            1.314371791152245,
            0.7646420174281687,
            0.4354486945776128,
            -2.122190144914424,
            2.268171323284097,
        ],
        2.5368360677737583,
    ),
];

#[test]
fn short_lived_branches_without_a_plan_are_found() {
    for (q, value) in SHORT_LIVED {
        let target = kinematics::Kinematics::fk(&crate::Sawyer, &q);
        let intervals = crate::Sawyer.feasible(&target);
        let solutions = crate::Sawyer.ik_at(&target, value).len();
        let held = holding::<crate::Sawyer, 7>(&intervals, value);
        assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
        assert!(solutions > 0);
    }
}

/// Of a plan with a quartic: where two of its roots are real for less than samples are apart.
#[test]
fn branches_of_a_quartic_between_two_samples_are_found() {
    let cases = [
        (
            [
                0.6757653780083204,
                0.2941411211391922,
                -2.0066016863084517,
                -0.4209746982836484,
                0.05395236203595921,
                3.0223688123979704,
                1.9860066598075607,
            ],
            3.0223688123979704,
        ),
        (
            [
                2.1406992613830327,
                0.34737177630865146,
                2.061450712767862,
                -0.5086528888428483,
                -0.4154432668332193,
                1.1903628249763771,
                -1.7305591952364454,
            ],
            0.77,
        ),
    ];
    for (q, value) in cases {
        let target = crate::PandaByWrist.fk(&q);
        let intervals = crate::PandaByWrist.feasible(&target);
        let solutions = crate::PandaByWrist.ik_at(&target, value).len();
        let held = holding::<crate::PandaByWrist, 7>(&intervals, value);
        assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
        assert!(solutions > 0);
    }
}

/// Branches that come or go twice within a tenth of a radian of an end of another.
#[test]
fn branches_that_come_or_go_twice_next_to_an_end_are_found() {
    let cases = [
        (
            [
                1.7376908961661242,
                0.4289988774383815,
                -3.005153261921508,
                0.5850349813397857,
                -1.6234128120319118,
                3.10056150254625,
                1.0407981515632754,
            ],
            1.85,
        ),
        (
            [
                2.7684988376167095,
                2.356683638229635,
                1.0829518366628275,
                2.5162889777447273,
                0.1027535165237965,
                -2.9338200935525176,
                -0.01663453502974699,
            ],
            1.0815,
        ),
        (
            [
                -0.2978820348688358,
                -1.684943726803471,
                -1.0675481475512392,
                1.5676961799133755,
                -1.4541791632163328,
                -2.9555568180911163,
                -1.6804183273331887,
            ],
            -0.78,
        ),
        (
            [
                -0.12823310111450015,
                1.5501095630233728,
                0.897914748833883,
                -0.5141578789963868,
                2.556304459657193,
                -2.9896587085053943,
                1.5432222466673995,
            ],
            -3.095,
        ),
    ];
    for (q, value) in cases {
        let target = kinematics::Kinematics::fk(&crate::Panda, &q);
        let intervals = crate::Panda.feasible(&target);
        let solutions = crate::Panda.ik_at(&target, value).len();
        let held = holding::<crate::Panda, 7>(&intervals, value);
        assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
    }
}

/// Nearer than this to a value at which a branch exists alone, rounding lets solutions be.
const BLURRED: f64 = 0.05;

/// Targets with a symmetry: roots meet, stay met or are free, at single values or at all.
fn right_angles_have_their_intervals<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let (mut held_at_all, mut held_within) = (0, 0);
    for (k, q) in robot.structured().enumerate() {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        let (points, lengths): (Vec<_>, Vec<_>) = intervals.iter().partition(|it| it.from == it.to);
        let lengths: Vec<_> = lengths.into_iter().copied().collect();
        let points: Vec<_> = points.into_iter().copied().collect();
        // Not at values where joints are at right angles and solutions meet.
        let values = values::<K, N>(41).map(|value| value + 0.0123);
        for value in values.filter(|&v| !is_near_end(&lengths, v, 1e-4)) {
            if is_near_end(&points, value, BLURRED) {
                continue;
            }
            let solutions = robot.arm.ik_at(&target, value).len();
            let held = holding::<K, N>(&lengths, value);
            assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
            held_at_all += held;
        }
        // Which takes longer.
        if k % 8 == 0 {
            held_within += within_limits_and_best(robot, &q, &lengths, &points);
        }
    }
    assert!(held_at_all > 1000, "{held_at_all}");
    assert!(held_within > 20, "{held_within}");
}

/// How many solutions within limits there were.
fn within_limits_and_best<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    q: &[f64; N],
    lengths: &[FeasibleInterval<N>],
    points: &[FeasibleInterval<N>],
) -> usize {
    let target = robot.chain.fk(q);
    let within = robot.arm.feasible_within(&target, &K::LIMITS);
    let mut held_at_all = 0;
    for value in values::<K, N>(41).map(|value| value + 0.0123) {
        let is_near = |ends: &[_], near: f64| is_near_end(ends, value, near);
        if is_near(lengths, 1e-4) || is_near(&within, 1e-4) || is_near(points, BLURRED) {
            continue;
        }
        let solutions = robot.arm.ik_at(&target, value);
        let solutions = solutions.within_limits(&K::LIMITS).len();
        let held = holding::<K, N>(&within, value);
        assert_eq!(held, solutions, "at {value} of {q:?}: {within:#?}");
        held_at_all += held;
    }
    let best = robot.arm.ik_best(&target, &Criterion::FarthestFromLimits);
    assert!(best.is_some() || held_at_all == 0, "of {q:?}");
    if let Some(best) = best {
        let miss = robot.miss(&best, &target, robot.arm.parameter_of(&target, &best));
        assert!(miss < 1e-9, "{miss} of {q:?}: {best:?}");
    }
    held_at_all
}

/// [`right_angles_have_their_intervals`] of arms whose branches come from square roots.
macro_rules! right_angles {
    ($($test:ident $robot:ident $path:literal $counts:ident,)*) => { $(
        #[test]
        fn $test() {
            let robot = Subject::new(crate::$robot, $path, Target::$counts);
            right_angles_have_their_intervals(&robot);
        }
    )* };
}

right_angles! {
    right_angles_of_an_iiwa Iiwa14 "../robots/iiwa14.yaml" Pose,
    right_angles_of_an_iiwa_by_its_flange IiwaByFlange "../robots/iiwa14.yaml" Pose,
    right_angles_of_an_iiwa_by_its_elbow IiwaByElbow "../robots/iiwa14.yaml" Pose,
    right_angles_of_a_panda Panda "../robots/panda.yaml" Pose,
    right_angles_of_a_ur5e Ur5e "../robots/ur5e.urdf" Pose,
    right_angles_of_a_kr6 Kr6R900 "../robots/kr6_r900.yaml" Pose,
}

/// Off its design, a straight elbow leaves solutions that no branch of the design tells, for half
/// a hundredth of a turn of the first joint.
#[test]
fn intervals_next_to_a_straight_elbow_of_a_gen3_are_found() {
    let path = "robots/redundant/gen3.yaml";
    let source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let robot = Robot::load(&source, &RobotOptions::default()).unwrap();
    let mut random = Random::new(26);
    for k in 0..24 {
        let mut q: [f64; 7] = std::array::from_fn(|_| random.angle());
        // Nearer to it they are shorter than what may be left out.
        q[3] = random.angle() / PI;
        q[3] = q[3].signum() * (0.01 + 0.02 * q[3].abs());
        if k == 0 {
            q = [
                -0.19032, 1.58349, -1.09357, 0.01025, -2.94431, 2.02768, 1.81246,
            ];
        }
        let target = robot.fk(&q);
        let intervals = robot.along_parameter().feasible(&target);
        let own = intervals.iter().any(|interval| interval.contains(q[0]));
        assert!(own, "{q:?}: {intervals:?}");
    }
}

fn read(path: &str, free: &[&str]) -> Robot {
    let source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let options = RobotOptions {
        free: free.iter().map(|&name| name.to_owned()).collect(),
        ..RobotOptions::default()
    };
    Robot::load(&source, &options).unwrap()
}

/// At right angles double roots are everywhere in one part of the turn: what is looked at there is not
/// missing elsewhere.
#[test]
fn what_is_spent_on_one_part_of_the_turn_leaves_the_others_theirs() {
    let robot = read("robots/redundant/xarm7.yaml", &["joint6"]);
    let right = PI / 2.0;
    let target = robot.fk(&[right, -right, -right, PI, 0.0, PI, 0.0]);
    let along = robot.along(0, &[0.0]);
    let intervals = along.feasible(&target);
    let mut reached = 0;
    for i in 0..1000 {
        let value = -PI + TAU * (f64::from(i) + 0.5) / 1000.0;
        let near = |value: f64| {
            let mut ends = intervals
                .iter()
                .flat_map(|it| [it.from - 1e-3, it.to + 1e-3]);
            ends.any(|end| (end - value).abs() < 3e-3)
        };
        let holds = |value: f64| intervals.iter().any(|it| it.contains(value));
        if !along.ik_at(&target, value).is_empty() {
            assert!(holds(value) || near(value), "{value}: {intervals:#?}");
            reached += 1;
        }
    }
    assert!(reached > 20, "{reached}");
}

/// A wrist that is straight whatever the slide: solutions are a circle of half a metre, and none
/// goes on in one way. They are there where it is, and nowhere else.
#[test]
fn branches_that_are_singular_throughout_end_where_solutions_do() {
    let robot = read("robots/redundant/gantry_arm.yaml", &["x", "joint6"]);
    let target = robot.fk(&[0.0, 0.0, PI, 0.0, 0.0, -PI / 2.0, 0.0, 0.0]);
    let along = robot.along(0, &[0.0, 0.0]);
    let intervals = along.feasible(&target);
    assert!(!intervals.is_empty());
    for i in 0..250 {
        let value = -1.0 + 2.5 * (f64::from(i) + 0.5) / 250.0;
        let there = !along.ik_at(&target, value).is_empty();
        let holds = intervals.iter().any(|it| it.contains(value));
        assert_eq!(there, holds, "{value}: {intervals:#?}");
    }
    let within = along.feasible_within(&target, robot.limits());
    assert!(
        !within.is_empty() && within.iter().all(|it| it.to < 1e-6),
        "{within:#?}"
    );
    let best = along
        .ik_best::<8>(&target, &Criterion::Nearest([0.1; 8]))
        .unwrap();
    assert!(
        robot.fk(&best).translation_distance(&target) < 1e-9,
        "{best:?}"
    );
}

/// Where curves cross, nothing tells how they go on, however near to each other samples are.
#[test]
fn curves_that_cross_are_not_cut_to_pieces() {
    let robot = Subject::new(crate::Sawyer, "../robots/sawyer.yaml", Target::Pose);
    let q = [PI, PI, 0.0, PI, 0.0, PI / 2.0, PI];
    let intervals = robot.arm.feasible(&robot.chain.fk(&q));
    assert!((1..100).contains(&intervals.len()), "{}", intervals.len());
}

/// Stretched, an arm with spherical shoulder and wrist has no choice of its last joint.
#[test]
fn a_branch_that_exists_at_one_value_has_an_interval_without_length() {
    let robot = Subject::new(crate::IiwaByFlange, "../robots/iiwa14.yaml", Target::Pose);
    for q in [
        [2.0134, 0.3345, 2.4981, 0.0, -0.7515, -1.5639, PI],
        [0.706, -1.0745, -PI, 0.0, -0.4691, -0.6149, 0.3],
    ] {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        for value in [q[6], q[6] + PI] {
            let here = intervals.iter().filter(|it| {
                let off = (it.from - value).rem_euclid(TAU);
                off.min(TAU - off) < 1e-7
            });
            assert_ne!(here.count(), 0, "{value} of {q:?}: {intervals:#?}");
            assert!(!robot.search(&target, value).is_empty());
            assert!(robot.search(&target, value + 0.3).is_empty());
        }
        for interval in &intervals {
            assert_eq!(interval.from, interval.to);
            let miss = robot.miss(&interval.middle, &target, interval.from);
            assert!(miss < 1e-9, "{miss:e} of {interval:?}");
        }
    }
}

/// Two roots touch zero at two values, and which of two families is singular changes there.
#[test]
fn branches_that_are_one_for_half_a_turn_are_not_two() {
    let robot = Subject::new(crate::IiwaByFlange, "../robots/iiwa14.yaml", Target::Pose);
    let q = [-PI / 2.0, 0.0, 0.7034, -0.0292, PI / 2.0, 0.0, 0.0344];
    let target = robot.chain.fk(&q);
    let intervals = robot.arm.feasible(&target);
    for value in [-2.5, -1.0, 0.5, 2.0] {
        assert_eq!(holding::<crate::IiwaByFlange, 7>(&intervals, value), 6);
        assert_eq!(robot.arm.ik_at(&target, value).len(), 6);
    }
    assert!(intervals.iter().any(|interval| !interval.is_closed));
}

/// The wrist of a UR5e stretched at every turn of its tool: an angle is free, and the seed's value
/// leaves the elbow out of reach.
#[test]
fn a_free_joint_that_turns_for_a_later_root_keeps_its_branch() {
    let robot = Subject::new(crate::Ur5e, "../robots/ur5e.urdf", Target::Pose);
    for (q, count) in [
        ([-PI, 0.0, -0.4691, -0.6149, 0.0, PI / 2.0], 2),
        ([-1.9959, -PI / 2.0, -0.577, -0.9436, 0.0, 0.0], 4),
        ([-PI / 2.0, 0.0, 0.0, -PI / 2.0, 0.0, 0.0], 1),
    ] {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        assert_eq!(intervals.len(), count, "{intervals:#?}");
        assert!(intervals.iter().all(|interval| interval.is_closed));
        assert!(!robot.search(&target, 0.7).is_empty());
    }
}

/// A joint that looks over its limit between two samples and comes back.
#[test]
fn a_limit_that_is_hardly_passed_cuts_an_interval() {
    let robot = Subject::new(crate::Panda, "../robots/panda.yaml", Target::Pose);
    let mut cuts = 0;
    for q in robot.random(12) {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        let Some(interval) = intervals.iter().find(|it| it.to - it.from > 1.0) else {
            continue;
        };
        // The branch along the interval, by continuity from its middle.
        let count = 4000;
        let value = |i: usize| {
            let middle = 0.5 * (interval.from + interval.to);
            middle + 0.45 * (interval.to - interval.from) * i as f64 / count as f64
        };
        let mut here = interval.middle;
        let mut branch = Vec::new();
        for i in 0..count {
            let all = robot.arm.ik_at(&target, value(i));
            let near = |a: &[f64; 7]| robot.apart(a, &here);
            let next = all.iter().min_by(|a, b| near(&a.q).total_cmp(&near(&b.q)));
            here = next.unwrap().q;
            branch.push(here);
        }
        for joint in 0..6 {
            let at = |i: usize| branch[i][joint];
            let peaks = (1..count - 1).filter(|&i| at(i) > at(i - 1) && at(i) > at(i + 1));
            // No wrap from π to −π.
            let peaks = peaks.filter(|&i| at(i) - at(i - 1) < 0.1 && at(i) - at(i + 1) < 0.1);
            for peak in peaks {
                let upper = at(peak) - 1e-6;
                let mut limits = [JointLimit::Continuous; 7];
                limits[joint] = JointLimit::revolute(upper - 6.2, upper);
                let within = robot.arm.feasible_within(&target, &limits);
                let solutions = robot.arm.ik_at(&target, value(peak)).within_limits(&limits);
                let held = holding::<crate::Panda, 7>(&within, value(peak));
                assert_eq!(held, solutions.len(), "q{} at {}", joint + 1, value(peak));
                cuts += 1;
            }
        }
    }
    assert!(cuts > 5, "{cuts}");
}

/// An island of the parameter of less than 1e-3 rad, on which the third joint makes a third of a turn:
/// three points of its curve lead nowhere by Newton's method at a value of the parameter.
#[test]
fn limits_cut_an_island_between_few_points() {
    let q = [
        1.427_894_618_560_699,
        -0.972_175_879_107_454,
        2.564_366_786_551_624_4,
        2.630_914_636_979_406_9,
        -0.924_787_328_724_790_3,
        3.058_923_518_799_376,
        2.209_497_321_966_020_8,
    ];
    let arm = crate::PandaByWrist;
    let target = arm.fk(&q);
    for width in [1e-5, 1e-3, 0.1, 0.2] {
        for joint in [2, 4] {
            let mut limits = [JointLimit::revolute(-7.0, 7.0); 7];
            let from = q[joint] - 0.115 * width;
            limits[joint] = JointLimit::revolute(from, from + width);
            let within = arm.feasible_within(&target, &limits);
            let held = within.iter().filter(|it| it.contains(q[5]));
            let solutions = arm.ik_at(&target, q[5]);
            let kept = |it: &&Solution<7>| limits[joint].nearest(it.q[joint], 0.0).is_some();
            let expected = solutions.iter().filter(kept).count();
            assert!(expected > 0);
            assert_eq!(held.count(), expected, "{joint} {width}: {within:?}");
        }
    }
}

/// A joint that is clamped leaves points of the curves: where it has its value.
#[test]
fn limits_that_leave_a_single_value_leave_points() {
    let q = [0.3, 0.5, -0.4, -1.8, 0.6, 1.9, 0.7];
    let target = crate::Panda.fk(&q);
    for joint in 0..7 {
        let mut limits = crate::Panda::LIMITS;
        let value = JointLimit::revolute(q[joint], q[joint]);
        limits[joint] = value;
        let within = crate::Panda.feasible_within(&target, &limits);
        let is_own = |it: &FeasibleInterval<7>| (0..7).all(|i| (it.middle[i] - q[i]).abs() < 1e-6);
        assert_eq!(
            within.iter().filter(|it| is_own(it)).count(),
            1,
            "{joint}: {within:?}"
        );
        for interval in &within {
            assert_eq!(interval.from, interval.to);
            assert!(
                value.nearest(interval.middle[joint], 0.0).is_some(),
                "{interval:?}"
            );
            let all = crate::Panda.ik_at(&target, interval.from);
            assert!(!all.within_limits(&limits).is_empty(), "{interval:?}");
        }
    }
}

/// An arm may be singular whatever the turn of the tool, where solutions come and go by rounding.
#[test]
fn targets_that_are_singular_throughout_have_few_intervals() {
    let xarm6 = Subject::new(crate::Xarm6, "../robots/xarm6.yaml", Target::Pose);
    assert_few_intervals(&xarm6, 200);
    let torch = Subject::new(crate::Torch, "robots/redundant/torch.yaml", Target::Pose);
    assert_few_intervals(&torch, 20);
}

fn assert_few_intervals<K: RedundantKinematics<6>>(robot: &Subject<K, 6>, targets: usize) {
    let mut seen = 0;
    for q in robot.structured().take(targets) {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        assert!(intervals.len() <= 32, "{} of {q:?}", intervals.len());
        for interval in &intervals {
            let turn = robot.arm.parameter_of(&target, &interval.middle);
            let miss = robot.miss(&interval.middle, &target, turn);
            assert!(miss < 1e-9, "{miss} of {interval:?} of {q:?}");
        }
        seen += intervals.len();
    }
    assert!(seen > targets, "{seen}");
}
