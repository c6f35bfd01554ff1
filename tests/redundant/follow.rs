//! Along paths of targets: no jump where none is needed, every target reached, and the
//! joints farther from their limits than with the parameter at rest.

use crate::random::Random;
use kinematics::{Follow, JointLimit, Nearest, Pose, RedundantKinematics};

/// The parameter's rate in one step, and how far a joint may move.
const RATE: f64 = 2e-3;
const STEP: f64 = 0.05;

/// From `start`, 0.2 m in a direction and a quarter of a radian about it.
fn path(start: &Pose, direction: [f64; 3], share: f64) -> Pose {
    let shift = direction.map(|x| 0.2 * share * x);
    let turn = Pose::from_axis_angle(direction, 0.25 * share, [0.0; 3]);
    Pose {
        rotation: (turn * *start).rotation,
        translation: std::array::from_fn(|i| start.translation[i] + shift[i]),
    }
}

/// Follows a path; none if it ends before the target does.
fn followed<K: RedundantKinematics<N>, const N: usize>(
    arm: &K,
    start: &[f64; N],
    direction: [f64; 3],
    rate: f64,
) -> Option<[f64; N]> {
    let mut how = Follow::new(&K::LIMITS, rate);
    how.step = [STEP; N];
    let mut q = *start;
    let home = arm.fk(start);
    for i in 1..=400 {
        let target = path(&home, direction, f64::from(i) / 400.0);
        let before = arm.parameter_of(&target, &q);
        let step = arm.ik_follow(&target, &q, &how)?;
        if step.jumps {
            return None;
        }
        let next = step.solution.q;
        assert!(
            (step.parameter - before).abs() < 1.01 * rate + 1e-9,
            "{step:?}"
        );
        let moved = next.iter().zip(&q).all(|(a, b)| (a - b).abs() <= STEP);
        assert!(moved, "{q:?} to {next:?}");
        let reached = K::TARGET.distance(&arm.fk(&next), &target, 1.0);
        assert!(reached < 1e-8, "{reached} at {i}");
        let inside = |(q, limit): (&f64, JointLimit)| {
            (limit.lower() - 1e-8..=limit.upper() + 1e-8).contains(q)
        };
        assert!(next.iter().zip(K::LIMITS).all(inside), "{next:?}");
        q = next;
    }
    Some(q)
}

fn keeps_away_from_limits<K: RedundantKinematics<N>, const N: usize>(arm: &K) {
    let how = Follow::new(&K::LIMITS, RATE);
    let mut random = Random::new(12);
    let (mut done, mut better, mut stuck) = (0, 0, 0);
    for _ in 0..40 {
        let start: [f64; N] = std::array::from_fn(|i| {
            let (lower, upper) = (
                K::LIMITS[i].lower().max(-2.0),
                K::LIMITS[i].upper().min(2.0),
            );
            random.between(lower, upper)
        });
        let direction: [f64; 3] = random.unit_cube();
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let direction = direction.map(|x| x / length);
        let carried = followed(arm, &start, direction, RATE);
        let at_rest = followed(arm, &start, direction, 1e-9);
        if let (Some(carried), Some(at_rest)) = (carried, at_rest) {
            done += 1;
            better += usize::from(how.crowding(&carried) < how.crowding(&at_rest) + 1e-6);
        }
        // Downhill now may be a dead end later, but rarely.
        stuck += usize::from(at_rest.is_some() && carried.is_none());
    }
    assert!(done > 10 && 10 * better >= 9 * done, "{better} of {done}");
    assert!(stuck <= 1, "{stuck} beside {done}");
}

/// Where `ik_follow` jumps, by a scan of the parameters in reach: how often it had to, and how often not.
pub fn jumps<K: RedundantKinematics<N>, const N: usize>(
    arm: &K,
    random: &mut Random,
    mut start: impl FnMut(&mut Random) -> [f64; N],
) -> [usize; 2] {
    const PATHS: usize = 60;
    const SHORT: f64 = 2.5e-3;
    let mut how = Follow::new(&K::LIMITS, SHORT);
    how.step = [SHORT; N];
    let mut counts = [0, 0];
    for _ in 0..PATHS {
        let mut q = start(random);
        let home = arm.fk(&q);
        let direction: [f64; 3] = random.unit_cube();
        for i in 1..=400 {
            let target = path(&home, direction, 0.5 * f64::from(i) / 400.0);
            match arm.ik_follow(&target, &q, &how) {
                Some(step) if !step.jumps => q = step.solution.q,
                _ => {
                    let mut nearest = Nearest::new(q, &K::LIMITS);
                    nearest.step = how.step;
                    let own = arm.parameter_of(&target, &q);
                    let goes_on = (-200..=200).any(|k| {
                        let parameter = own + SHORT * f64::from(k) / 200.0;
                        let all = arm.ik_seeded_at(&target, parameter, &q);
                        all.nearest_by(&nearest).is_some()
                    });
                    counts[usize::from(goes_on)] += 1;
                    break;
                }
            }
        }
    }
    counts
}

/// Within the limits, one joint next to a stop.
pub fn next_to_a_stop<const N: usize>(
    limits: [JointLimit; N],
) -> impl FnMut(&mut Random) -> [f64; N] {
    move |random| {
        let ends = limits.map(|it| [it.lower().max(-3.0), it.upper().min(3.0)]);
        let mut q = ends.map(|[lower, upper]| random.between(lower, upper));
        let joint = random.below(N);
        q[joint] = ends[joint][random.below(2)];
        q
    }
}

#[test]
fn a_jump_is_one_at_all_parameters_in_reach() {
    let random = &mut Random::new(91);
    let panda = jumps(&crate::Panda, random, next_to_a_stop(crate::Panda::LIMITS));
    let iiwa = jumps(
        &crate::Iiwa14,
        random,
        next_to_a_stop(crate::Iiwa14::LIMITS),
    );
    let turned = jumps(&crate::Ur5e, random, next_to_a_stop(crate::Ur5e::LIMITS));
    for [had_to, had_not_to] in [panda, iiwa, turned] {
        assert!(had_not_to == 0 && had_to > 0, "{had_not_to} and {had_to}");
    }
}

#[test]
fn an_iiwa() {
    keeps_away_from_limits(&crate::Iiwa14);
}

#[test]
fn a_panda() {
    keeps_away_from_limits(&crate::Panda);
}

#[test]
fn a_ur5e_with_a_tool_that_turns() {
    keeps_away_from_limits(&crate::Ur5e);
}

#[test]
fn a_step_too_long_is_a_jump() {
    let start = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    let mut how = Follow::new(&crate::Panda::LIMITS, RATE);
    how.step = [1e-4; 7];
    let target = path(&crate::Panda.fk(&start), [0.0, 0.0, 1.0], 0.1);
    let step = crate::Panda.ik_follow(&target, &start, &how).unwrap();
    assert!(step.jumps);
    assert!(
        crate::Panda
            .fk(&step.solution.q)
            .translation_distance(&target)
            < 1e-9
    );
    let far = Pose::from_translation([3.0, 0.0, 0.0]);
    assert_eq!(crate::Panda.ik_follow(&far, &start, &how), None);
}

/// 1.02 is how much room there is: Σ 1 / 0.02 at the stops.
#[test]
fn joints_are_most_crowded_at_their_stops() {
    for stop in [2.8973, 1.7628, 3.0718, 6.0] {
        let limits = [JointLimit::revolute(-stop, stop), JointLimit::Continuous];
        let how = Follow::new(&limits, RATE);
        for q in [stop, -stop, stop + 1e-9, 2.0 * stop] {
            let crowding = how.crowding(&[q, 0.4]);
            assert!((crowding - 50.0).abs() < 1e-6, "{crowding} at {q}");
        }
        assert_eq!(how.crowding(&[0.0, 9.0]), 0.0);
    }
}

/// Whatever solution moves by the steps, though another is nearer by the norm.
#[test]
fn what_moves_by_steps_is_no_jump() {
    let mut random = Random::new(78);
    let (mut followed, mut farther) = (0, 0);
    for _ in 0..60 {
        let limits = crate::Panda::LIMITS;
        let q: [f64; 7] =
            std::array::from_fn(|i| random.between(limits[i].lower(), limits[i].upper()));
        let target = crate::Panda.fk(&q.map(|q| q + random.between(-0.3, 0.3)));
        let parameter = crate::Panda.parameter_of(&target, &q);
        let mut ways = Vec::new();
        for solution in &crate::Panda.ik_seeded_at(&target, parameter, &q) {
            let moved = |i: usize| Some((limits[i].nearest(solution.q[i], q[i])? - q[i]).abs());
            let moved: Option<Vec<f64>> = (0..7).map(moved).collect();
            ways.extend(moved);
        }
        let norm = |way: &[f64]| way.iter().map(|x| x * x).sum::<f64>();
        let least = ways
            .iter()
            .map(|way| norm(way))
            .fold(f64::INFINITY, f64::min);
        for way in &ways {
            let mut how = Follow::new(&limits, 0.0);
            how.step = std::array::from_fn(|i| way[i] + 1e-7);
            let step = crate::Panda.ik_follow(&target, &q, &how).unwrap();
            assert!(!step.jumps, "{q:?}: {way:?}, {step:?}");
            followed += 1;
            farther += usize::from(norm(way) > least + 1e-6);
        }
    }
    assert!(followed > 60 && farther > 30, "{followed} {farther}");
}

/// At a stop, where only a step of the parameter that is longer than allowed leads on.
#[test]
fn no_probe_is_an_answer() {
    let mut random = Random::new(23);
    let limits = crate::Panda::LIMITS;
    let mut found = 0;
    for k in 0..300 {
        let mut q: [f64; 7] =
            std::array::from_fn(|i| random.between(limits[i].lower(), limits[i].upper()));
        q[k % 6] = if k % 4 < 2 {
            limits[k % 6].upper()
        } else {
            limits[k % 6].lower()
        };
        let mut target = crate::Panda.fk(&q);
        target.translation[k % 3] += 1e-6;
        for rate in [0.0, 1e-6] {
            let mut how = Follow::new(&limits, rate);
            how.step = [STEP; 7];
            let before = crate::Panda.parameter_of(&target, &q);
            if let Some(step) = crate::Panda.ik_follow(&target, &q, &how) {
                let moved = (step.parameter - before).abs();
                assert!(moved <= rate + 1e-9, "{moved:e} by {rate:e} from {q:?}");
                found += 1;
            }
        }
    }
    assert!(found > 300, "{found}");
}

/// From next to where the shoulder is straight up, or the wrist straight, to there: of the values of the
/// parameter that are near one keeps the other joints at rest.
fn follows_into_a_singularity<K: RedundantKinematics<N>, const N: usize>(arm: &K, joint: usize) {
    let mut random = Random::new(24);
    let mut steps = 0;
    for k in 0..200 {
        let mut q: [f64; N] = std::array::from_fn(|i| {
            let travel = K::LIMITS[i];
            let reach = |stop: f64| stop.clamp(-1.5, 1.5);
            random.between(reach(travel.lower()), reach(travel.upper()))
        });
        q[joint] = 0.0;
        let mut from = q;
        from[joint] = if k % 2 == 0 { 1e-3 } else { 1e-2 };
        let target = arm.fk(&q);
        let [before, after] = [from, q].map(|q| arm.parameter_of(&target, &q));
        let mut how = Follow::new(&K::LIMITS, 2e-2);
        how.step = [0.1; N];
        if (after - before).abs() > how.rate {
            continue;
        }
        let step = arm.ik_follow(&target, &from, &how).unwrap();
        assert!(!step.jumps, "{from:?}: {step:?}");
        steps += 1;
    }
    assert!(steps > 50, "{steps}");
}

#[test]
fn an_iiwa_is_followed_to_where_its_shoulder_is_straight_up() {
    follows_into_a_singularity(&crate::Iiwa14, 1);
}

#[test]
fn a_torch_is_followed_to_where_its_wrist_is_straight() {
    follows_into_a_singularity(&crate::Torch, 4);
}
