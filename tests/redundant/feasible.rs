//! Feasible intervals against dense sampling, their ends against the solutions on both
//! sides, and all of it within limits.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{FeasibleInterval, Parameter, Pose, RedundantKinematics};
use std::f64::consts::{PI, TAU};

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

/// A billionth on either side of an end there are two solutions more, or two less.
fn ends_are_where_solutions_meet<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(8) {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        for interval in intervals.iter().filter(|interval| !interval.is_closed) {
            assert!(interval.from < interval.to, "{interval:?}");
            for end in [interval.from, interval.to] {
                let count = |value: f64| robot.arm.ik_at(&target, value).len() as isize;
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
    for q in robot.random(8) {
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
    }
    assert!(held_at_all > 0);
}

/// Two solutions that exist between two samples alone, for a hundredth of a radian.
#[test]
fn short_lived_branches_without_a_plan_are_found() {
    let cases = [
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
    for (q, value) in cases {
        let target = kinematics::Kinematics::fk(&crate::Sawyer, &q);
        let intervals = crate::Sawyer.feasible(&target);
        let solutions = crate::Sawyer.ik_at(&target, value).len();
        let held = holding::<crate::Sawyer, 7>(&intervals, value);
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

/// Targets with a symmetry, whose roots meet where an interval has its middle.
#[test]
fn targets_with_right_angles_have_their_intervals() {
    let robot = Subject::new(crate::Panda, "../robots/panda.yaml", Target::Pose);
    for q in robot.structured() {
        let target = robot.chain.fk(&q);
        let intervals = robot.arm.feasible(&target);
        // Not at values where joints are at right angles and solutions meet.
        let values = values::<crate::Panda, 7>(61).map(|value| value + 0.0123);
        for value in values.filter(|&v| !is_near_end(&intervals, v, 1e-4)) {
            let solutions = robot.arm.ik_at(&target, value).len();
            let held = holding::<crate::Panda, 7>(&intervals, value);
            assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
        }
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
                let mut limits = [kinematics::JointLimit::Continuous; 7];
                limits[joint] = kinematics::JointLimit::revolute(upper - 6.2, upper);
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
