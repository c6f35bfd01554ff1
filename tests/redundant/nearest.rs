//! The one solution that a controller asks for that chooses the parameter itself, and why
//! there is none.

use crate::random::Random;
use kinematics::{Criterion, JointLimit, Nearest, NoSolution, Pose, RedundantKinematics};

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
    assert!(found.is_err());
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
