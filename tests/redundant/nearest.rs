//! The one solution that a controller asks for that chooses the parameter itself, and why
//! there is none.

use crate::random::Random;
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{
    Criterion, Follow, JointLimit, Nearest, NoSolution, Parameter, Pose, RedundantKinematics,
    Robot, SelfMotionOptions, self_motions,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

fn anywhere(random: &mut Random) -> [f64; 7] {
    std::array::from_fn(|_| random.angle())
}

#[test]
fn it_is_the_nearest_of_all_within_limits() {
    let mut random = Random::new(31);
    let (mut found, mut none) = (0, 0);
    for _ in 0..300 {
        let target = crate::Panda.fk(&anywhere(&mut random));
        let (parameter, seed) = (random.angle(), anywhere(&mut random));
        let limits = crate::Panda::LIMITS;
        let all = crate::Panda.ik_at(&target, parameter);
        // By hand: full turns that are inside the limits.
        let way = |q: &[f64; 7]| -> Option<f64> {
            let each = (0..7).map(|i| {
                let turns = (-2..=2).map(|k| q[i] + f64::from(k) * std::f64::consts::TAU);
                let inside = turns.filter(|q| (limits[i].lower()..=limits[i].upper()).contains(q));
                inside.map(|q| (q - seed[i]).powi(2)).min_by(f64::total_cmp)
            });
            each.sum()
        };
        let least = all
            .iter()
            .filter_map(|solution| way(&solution.q))
            .min_by(f64::total_cmp);
        let nearest = crate::Panda.ik_nearest_at(&target, parameter, &seed);
        match (nearest, least) {
            (Some(nearest), Some(least)) => {
                let own: f64 = nearest
                    .q
                    .iter()
                    .zip(&seed)
                    .map(|(a, b)| (a - b).powi(2))
                    .sum();
                assert!((own - least).abs() < 1e-9, "{own} {least}");
                found += 1;
            }
            (None, None) => none += 1,
            other => panic!("{other:?}"),
        }
    }
    assert!(found > 20 && none > 20, "{found} {none}");
}

#[test]
fn a_reason_is_told() {
    let q = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    let target = crate::Panda.fk(&q);
    let mut nearest = Nearest::new(q, &crate::Panda::LIMITS);
    let found = crate::Panda
        .try_ik_nearest_at(&target, 0.6, &nearest)
        .unwrap();
    assert!(found.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9));
    nearest.seed[1] += 0.2;
    nearest.step = [0.1; 7];
    let found = crate::Panda.try_ik_nearest_at(&target, 0.6, &nearest);
    assert!(
        matches!(found, Err(NoSolution::BeyondStep { joint: 1, by, .. }) if (by - 0.1).abs() < 1e-9),
        "{found:?}"
    );
    let narrow = [JointLimit::revolute(-0.1, 0.1); 7];
    let found = crate::Panda.try_ik_nearest_at(&target, 0.6, &Nearest::new(q, &narrow));
    assert!(
        matches!(found, Err(NoSolution::OutsideLimits { .. })),
        "{found:?}"
    );
    let free = Nearest::new(q, &crate::Panda::LIMITS);
    let far = Pose::from_translation([3.0, 0.0, 0.0]);
    let found = crate::Panda.try_ik_nearest_at(&far, 0.6, &free);
    assert_eq!(found, Err(NoSolution::OutOfReach { approximate: None }));
    let mut bent = target;
    bent.rotation[0][0] += 1e-3;
    let found = crate::Panda.try_ik_nearest_at(&bent, 0.6, &free);
    assert!(
        matches!(found, Err(NoSolution::NotRotation { .. })),
        "{found:?}"
    );
    let found = crate::Panda.try_ik_nearest_at(&far, f64::NAN, &free);
    assert_eq!(found, Err(NoSolution::NotFinite));
}

/// Of all values of the parameter: no value has one that is nearer.
#[test]
fn the_nearest_of_all_parameters_is_the_best() {
    let mut random = Random::new(32);
    let mut compared = 0;
    for _ in 0..10 {
        let target = crate::Iiwa14.fk(&anywhere(&mut random));
        let seed = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let way = |q: &[f64; 7]| {
            q.iter()
                .zip(&seed)
                .map(|(a, b): (&f64, &f64)| (a - b).powi(2))
                .sum()
        };
        let best = crate::Iiwa14.ik_best(&target, &Criterion::Nearest(seed));
        let least = (0..400).filter_map(|i| {
            let found = crate::Iiwa14.ik_nearest_at(&target, 0.0157 * f64::from(i), &seed)?;
            Some(way(&found.q))
        });
        let least: f64 = least.fold(f64::INFINITY, f64::min);
        let Some(best) = best else {
            assert!(least.is_infinite());
            continue;
        };
        let own: f64 = way(&best);
        assert!(own <= least + 1e-9, "{own} {least}");
        compared += 1;
    }
    assert!(compared > 4, "{compared}");
}

for_every_robot! { a_seed_that_reaches_a_singular_target_is_the_answer }

/// With the parameter given, along a path, and of all parameters; also where an angle is free.
fn a_seed_that_reaches_a_singular_target_is_the_answer<
    K: RedundantKinematics<N>,
    const N: usize,
>(
    robot: &Subject<K, N>,
) {
    // Off its design an arm has isolated solutions there, which Newton's method from those of the
    // design misses by up to a radian; without an elimination beside nothing tells the others.
    let is_alone = matches!(K::PARAMETER, Parameter::Swivel(_) | Parameter::Joint(4));
    if robot.path.contains("stray") && is_alone {
        return;
    }
    // Where roots of a quartic have met, what is behind them is known to the root of rounding, and
    // an angle that is free is not always seen to be.
    if robot.path.contains("panda") && K::PARAMETER == Parameter::Joint(5) {
        return;
    }
    let arm = &robot.arm;
    let mut singular = 0;
    for q in robot.structured() {
        let stops = q.map(|x| JointLimit::Revolute {
            lower: x - 3.0,
            upper: x + 3.0,
        });
        let target = arm.fk(&q);
        let parameter = arm.parameter_of(&target, &q);
        let nearest = Nearest::new(q, &stops);
        let is_seed = |found: &[f64; N]| (0..N).all(|i| (found[i] - q[i]).abs() < 1e-6);
        let found = arm.try_ik_nearest_at(&target, parameter, &nearest);
        assert!(
            found.is_ok_and(|found| is_seed(&found.q)),
            "{q:?} at {parameter}: {found:?}"
        );
        singular += usize::from(found.unwrap().singular);
        let step = arm.ik_follow(&target, &q, &Follow::new(&stops, 0.0));
        assert!(
            step.is_some_and(|step| is_seed(&step.solution.q)),
            "{q:?}: {step:?}"
        );
    }
    assert!(singular > 10, "{}: {singular}", robot.path);
}

/// Its second joint straight up, a Panda can share the turn between the first and the third as it
/// likes, an iiwa with its elbow out.
#[test]
fn a_seed_that_reaches_a_singular_target_is_the_best() {
    let best = |arm: &dyn Fn(&[f64; 7]) -> Option<[f64; 7]>, q: [f64; 7]| {
        let found = arm(&q).unwrap();
        let apart = (0..7).map(|i| (found[i] - q[i]).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-6, "{q:?}: {found:?}");
    };
    let panda = |q: &[f64; 7]| crate::Panda.ik_best(&crate::Panda.fk(q), &Criterion::Nearest(*q));
    best(&panda, [-0.6, 0.0, 0.4, -1.57, 0.3, 1.2, -0.4]);
    best(&panda, [1.5, 0.0, 0.0, -1.57, -2.8, 0.17, -1.57]);
    let iiwa = |q: &[f64; 7]| crate::Iiwa14.ik_best(&crate::Iiwa14.fk(q), &Criterion::Nearest(*q));
    best(&iiwa, [-0.6, 0.0, 0.3, 0.0, 1.57, 0.31, -1.57]);
    best(&iiwa, [-0.9, 0.0, -1.3, 1.57, -1.57, -1.57, -0.3]);
}

/// Next to a straight second joint the first and the third turn by half a turn while the parameter
/// hardly moves: what is nearest lies between values of it that are 1e-5 apart. A trace of the
/// self-motion goes by the joints.
#[test]
fn the_nearest_is_found_where_joints_turn_within_little_of_the_parameter() {
    fn of<K: RedundantKinematics<7>>(arm: &K, near: usize, off: f64) -> usize {
        let mut random = Random::new(77);
        let mut compared = 0;
        for _ in 0..12 {
            let mut q: [f64; 7] = anywhere_within(&K::LIMITS, &mut random);
            q[near] = off;
            let seed: [f64; 7] = anywhere_within(&K::LIMITS, &mut random);
            let way = |q: &[f64; 7]| -> Option<f64> {
                let ways = (0..7).map(|i| Some(K::LIMITS[i].nearest(q[i], seed[i])? - seed[i]));
                ways.map(|way| way.map(|way| way * way)).sum()
            };
            let options = SelfMotionOptions {
                step: 0.02,
                ..SelfMotionOptions::default()
            };
            let motions = self_motions(arm, &[q], &options).unwrap();
            let traced = motions.components[0].path.iter().filter_map(way);
            let traced = traced.fold(f64::INFINITY, f64::min);
            if traced.is_infinite() {
                continue;
            }
            let best = arm.ik_best(&arm.fk(&q), &Criterion::Nearest(seed)).unwrap();
            let own = way(&best).unwrap();
            assert!(own <= traced + 1e-6, "{q:?} from {seed:?}: {own}, {traced}");
            compared += 1;
        }
        compared
    }
    for off in [1e-2, -1e-3, 1e-5, -1e-7] {
        let compared = of(&crate::Panda, 1, off) + of(&crate::Iiwa14, 5, off);
        assert!(compared > 8, "{off}: {compared}");
    }
}

fn anywhere_within(limits: &[JointLimit; 7], random: &mut Random) -> [f64; 7] {
    limits.map(|limit| random.between(limit.lower().max(-PI), limit.upper().min(PI)))
}

/// With the shoulder straight up and joint 5 a quarter turn away, what tells the shoulder's angles is
/// shorter than the rounding of what is before it.
#[test]
fn beside_two_singularities_it_rests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let robot = Robot::from_yaml(folder.join("robots/panda.yaml")).unwrap();
    let mut random = Random::new(59);
    for k in 0..1400 {
        let off = 10_f64.powi(-7 - k % 7);
        let mut q: [f64; 7] = std::array::from_fn(|_| random.between(-1.5, 1.5));
        q[1] = off * random.between(-1.0, 1.0);
        q[3] = random.between(-2.8, -0.8);
        q[4] = FRAC_PI_2 + off * random.between(-1.0, 1.0);
        q[5] += 1.8;
        let target = crate::Panda.fk(&q);
        let generated = crate::Panda.ik_nearest_at(&target, q[6], &q).unwrap();
        let at_run_time = robot.ik_nearest_at(&target, &q[6..], &q).unwrap();
        for nearest in [&generated.q[..], &at_run_time.q] {
            let moved = nearest.iter().zip(&q).map(|(a, b)| (a - b).abs());
            let moved = moved.fold(0.0, f64::max);
            assert!(moved < 1e-6, "{moved} from {q:?}");
        }
    }
}

/// With the elbow straight to within little, what tells the shoulder's turn from the wrist's is shorter
/// than the rounding of what is before it: of all turns that reach the target it is the seed's.
#[test]
fn next_to_a_straight_elbow_the_seed_is_followed() {
    let iiwa = crate::IiwaByFlange;
    let mut random = Random::new(61);
    let (mut far, mut count) = (0, 0);
    for k in 0..2100 {
        let off = 10_f64.powi(-6 - k % 7);
        let mut q: [f64; 7] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        q[3] = off * random.between(-1.0, 1.0);
        let mut from = q;
        for (from, by) in from.iter_mut().zip([0.0, 3e-4, 0.0, 1e-3, 0.0, -2e-4]) {
            *from += by;
        }
        let target = iiwa.fk(&q);
        let nearest = iiwa.ik_nearest_at(&target, q[6], &from).unwrap();
        assert!(nearest.residual < 1e-11, "{nearest:?}");
        let moved = nearest.q.iter().zip(&from).map(|(a, b)| (a - b).abs());
        far += usize::from(moved.fold(0.0, f64::max) > 0.1);
        count += 1;
    }
    // Next to where the shoulder or the wrist is straight as well another branch is nearer.
    assert!(40 * far < count, "{far} of {count}");
}
