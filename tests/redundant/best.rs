//! The best configuration against dense sampling of the parameter.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Criterion, JointLimit, Parameter, Pose, RedundantKinematics, Solution};
use std::f64::consts::{PI, TAU};

macro_rules! for_every_robot {
    ($($test:ident $robot:ident $path:literal,)*) => { $(
        #[test]
        fn $test() {
            no_sample_is_better(&Subject::new(crate::$robot, $path, Target::Pose));
        }
    )* };
}

for_every_robot! {
    iiwa14 Iiwa14 "../robots/iiwa14.yaml",
    panda Panda "../robots/panda.yaml",
    sawyer Sawyer "../robots/sawyer.yaml",
    rail Rail "robots/redundant/rail.yaml",
    ur5e Ur5e "../robots/ur5e.urdf",
}

/// Where a joint rests on a stop, its value jumps by a full turn beside the best.
#[test]
fn what_is_beside_a_stop_is_no_worse() {
    let limits = <crate::Panda as kinematics::Kinematics<7>>::LIMITS;
    let mut random = crate::random::Random::new(31);
    let mut found = 0;
    let given = [-2.8973, -1.7628, -1.57, -3.0718, -1e-7, PI, 2.8973];
    for k in 0..60 {
        let mut q = std::array::from_fn(|i| {
            let share = 0.5 + random.angle() / TAU;
            limits[i].lower() + share * (limits[i].upper() - limits[i].lower())
        });
        for _ in 0..k % 4 {
            let i = (random.angle().abs() / PI * 7.0) as usize % 7;
            q[i] = [limits[i].lower(), limits[i].upper()][k / 4 % 2];
        }
        let q = if k == 0 { given } else { q };
        let criterion = Criterion::Nearest(q);
        let target = kinematics::Kinematics::fk(&crate::Panda, &q);
        let best = crate::Panda.ik_best(&target, &criterion).unwrap();
        let least: f64 = (0..7).map(|i| (best[i] - q[i]).powi(2)).sum();
        for by in [1e-5, 1e-4, 1e-3, 1e-2] {
            for value in [q[6] - by, q[6] + by] {
                let all = crate::Panda.ik_at(&target, value);
                let beside = all
                    .iter()
                    .filter_map(|it| cost(&crate::Panda, &criterion, it));
                let beside = beside.fold(f64::INFINITY, f64::min);
                assert!(
                    least <= beside + 1e-9,
                    "{q:?}: {least}, {beside} at {value}"
                );
                found += usize::from(beside.is_finite());
            }
        }
    }
    assert!(found > 100, "{found}");
}

/// Within limits, by the same words as the documentation of [`Criterion`].
fn cost<K: RedundantKinematics<N>, const N: usize>(
    arm: &K,
    criterion: &Criterion<N>,
    solution: &Solution<N>,
) -> Option<f64> {
    let wind = |i: usize| {
        let (lower, upper) = (K::LIMITS[i].lower(), K::LIMITS[i].upper());
        let middle = 0.5 * (lower + upper);
        let towards = match criterion {
            Criterion::Nearest(seed) => seed[i],
            _ if middle.is_finite() => middle,
            _ => solution.q[i],
        };
        let all = (-3..=3).map(|k| match K::LIMITS[i] {
            JointLimit::Prismatic { .. } => solution.q[i],
            _ => solution.q[i] + TAU * f64::from(k),
        });
        let inside = all.filter(|q| (lower - 1e-9..=upper + 1e-9).contains(q));
        inside.min_by(|a, b| (a - towards).abs().total_cmp(&(b - towards).abs()))
    };
    let wound: Vec<f64> = (0..N).map(wind).collect::<Option<_>>()?;
    Some(match criterion {
        Criterion::Nearest(seed) => (0..N).map(|i| (wound[i] - seed[i]).powi(2)).sum(),
        Criterion::FarthestFromLimits => (0..N)
            .filter(|&i| (K::LIMITS[i].upper() - K::LIMITS[i].lower()).is_finite())
            .map(|i| {
                let (lower, upper) = (K::LIMITS[i].lower(), K::LIMITS[i].upper());
                (2.0 * wound[i] - lower - upper).abs() / (upper - lower)
            })
            .fold(0.0, f64::max),
        Criterion::Manipulability => -arm.manipulability(&solution.q).volume,
    })
}

fn no_sample_is_better<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let [from, to] = match K::PARAMETER {
        Parameter::Joint(joint) if !K::LIMITS[joint].is_revolute() => {
            [K::LIMITS[joint].lower(), K::LIMITS[joint].upper()]
        }
        _ => [-PI, PI],
    };
    let mut compared = 0;
    for q in robot.random(7) {
        let target: Pose = robot.chain.fk(&q);
        let seed = std::array::from_fn(|i| K::LIMITS[i].nearest(0.3, 0.3).unwrap_or(-0.5));
        let values = (0..600).map(|i| from + (to - from) * (f64::from(i) + 0.5) / 600.0);
        let all = values.flat_map(|value| robot.arm.ik_at(&target, value));
        let all: Vec<Solution<N>> = all.collect();
        for criterion in [
            Criterion::Nearest(seed),
            Criterion::FarthestFromLimits,
            Criterion::Manipulability,
        ] {
            let costs = all
                .iter()
                .filter_map(|found| cost(&robot.arm, &criterion, found));
            let sampled = costs.fold(f64::INFINITY, f64::min);
            let best = robot.arm.ik_best(&target, &criterion);
            let Some(best) = best else {
                assert!(
                    sampled.is_infinite(),
                    "{criterion:?} of {q:?}: none, and {sampled}"
                );
                continue;
            };
            let parameter = robot.arm.parameter_of(&target, &best);
            assert!(robot.miss(&best, &target, parameter) < 1e-9, "{best:?}");
            for (q, limit) in best.iter().zip(K::LIMITS) {
                assert!(
                    (limit.lower() - 1e-8..=limit.upper() + 1e-8).contains(q),
                    "{best:?}"
                );
            }
            let found = Solution {
                q: best,
                residual: 0.0,
                branch: 0,
                singular: false,
            };
            let least = cost(&robot.arm, &criterion, &found).unwrap();
            let slack = 1e-9 + 1e-6 * sampled.abs();
            assert!(
                least <= sampled + slack,
                "{criterion:?} of {q:?}: {least}, {sampled}"
            );
            compared += 1;
        }
    }
    assert!(compared > 3, "{compared}");
}
