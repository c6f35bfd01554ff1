//! Answers between the stops of the joints, held against trying all turns.

use kin_runtime::__private::math;
use kin_runtime::{JointLimit, Nearest, Solution, Solutions};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const CONTINUOUS: JointLimit = JointLimit::Continuous;

fn revolute(lower: f64, upper: f64) -> JointLimit {
    JointLimit::Revolute { lower, upper }
}

fn prismatic(lower: f64, upper: f64) -> JointLimit {
    JointLimit::Prismatic { lower, upper }
}

/// SplitMix64 (G. Steele, D. Lea, C. Flood, 2014), between two bounds.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    fn angle(&mut self) -> f64 {
        self.between(-PI, PI)
    }
}

/// An answer of configurations; the last joint slides.
fn answers(qs: &[[f64; 3]]) -> Solutions<3> {
    let mut all = Solutions::with_prismatic(0b100);
    for (branch, &q) in (0..).zip(qs) {
        all.push(Solution {
            q,
            residual: 0.0,
            branch,
            singular: false,
        });
    }
    all
}

fn random_answers(random: &mut Random) -> Solutions<3> {
    let one = |_| [random.angle(), random.angle(), random.between(-1.0, 1.0)];
    answers(&[0; 8].map(one))
}

/// Narrower than a turn or several turns wide, anywhere.
fn random_limits(random: &mut Random) -> [JointLimit; 3] {
    let mut range = |width: f64| {
        let lower = random.between(-10.0, 6.0);
        revolute(lower, lower + random.between(0.0, width))
    };
    let (a, b) = (range(20.0), range(6.0));
    let lower = random.between(-1.0, 0.5);
    [a, b, prismatic(lower, lower + random.between(0.0, 1.0))]
}

fn inside(limit: &JointLimit, value: f64) -> bool {
    limit.lower() <= value && value <= limit.upper()
}

/// All q + 2πk inside the limits, |k| ≤ 5, in any order.
fn by_trying(all: &Solutions<3>, limits: &[JointLimit; 3]) -> Vec<[f64; 3]> {
    let turns = || (-5..=5).map(|k| TAU * f64::from(k));
    let mut found = Vec::new();
    for s in all {
        for a in turns() {
            for b in turns() {
                let q = [s.q[0] + a, s.q[1] + b, s.q[2]];
                if (0..3).all(|i| inside(&limits[i], q[i])) {
                    found.push(q);
                }
            }
        }
    }
    found
}

fn sorted(mut qs: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    qs.sort_by(|a, b| a.partial_cmp(b).unwrap());
    qs
}

#[test]
fn windings_are_all_there_are() {
    let mut random = Random(1);
    let mut most = 0;
    for _ in 0..1000 {
        let (all, limits) = (random_answers(&mut random), random_limits(&mut random));
        let found = sorted(all.with_full_turns(&limits).map(|s| s.q).collect());
        let expected = sorted(by_trying(&all, &limits));
        assert_eq!(found.len(), expected.len(), "{limits:?}");
        for (a, b) in found.iter().zip(&expected) {
            assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-12), "{a:?}, {b:?}");
        }
        most = most.max(found.len());
    }
    assert!(
        most > 16,
        "limits should be wide enough for more than {most}"
    );
}

#[test]
fn within_keeps_one_winding_of_each_that_has_any() {
    let mut random = Random(2);
    for _ in 0..1000 {
        let (all, limits) = (random_answers(&mut random), random_limits(&mut random));
        let kept = all.within_limits(&limits);
        for s in &all {
            let windings: Vec<_> = all
                .with_full_turns(&limits)
                .filter(|w| w.branch == s.branch)
                .collect();
            let own: Vec<_> = kept.iter().filter(|k| k.branch == s.branch).collect();
            assert_eq!(own.len(), usize::from(!windings.is_empty()));
            let moved = |w: &Solution<3>, i: usize| (w.q[i] - s.q[i]).abs();
            for kept in own {
                let least = |i: usize| {
                    windings
                        .iter()
                        .map(|w| moved(w, i))
                        .fold(f64::INFINITY, f64::min)
                };
                assert!(
                    (0..3).all(|i| moved(kept, i) <= least(i) + 1e-12),
                    "{kept:?}"
                );
            }
        }
    }
}

#[test]
fn the_nearest_within_is_the_nearest_winding() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let (all, limits) = (random_answers(&mut random), random_limits(&mut random));
        let seed = [
            random.between(-9.0, 9.0),
            random.between(-9.0, 9.0),
            random.angle(),
        ];
        let travel = |q: &[f64; 3]| (0..3).map(|i| (q[i] - seed[i]).powi(2)).sum::<f64>();
        let least = by_trying(&all, &limits)
            .iter()
            .map(travel)
            .fold(f64::INFINITY, f64::min);
        match all.nearest(&seed, &limits) {
            Some(nearest) => assert!((travel(&nearest.q) - least).abs() < 1e-9 * least),
            None => assert_eq!(least, f64::INFINITY),
        }
    }
}

#[test]
fn weights_decide_which_is_nearest() {
    let mut random = Random(4);
    for _ in 0..1000 {
        let all = random_answers(&mut random);
        let seed = [
            random.between(-9.0, 9.0),
            random.angle(),
            random.between(-1.0, 1.0),
        ];
        let weights = [random.between(0.0, 2.0), 0.0, random.between(0.0, 5.0)];
        let mut nearest = Nearest::new(seed, &[CONTINUOUS; 3]);
        nearest.weights = weights;
        let distance = |q: &[f64; 3]| {
            let turned = math::wrap(q[0] - seed[0]) * weights[0];
            turned.hypot((q[2] - seed[2]) * weights[2])
        };
        let least = all
            .iter()
            .map(|s| distance(&s.q))
            .fold(f64::INFINITY, f64::min);
        let nearest = all.nearest_by(&nearest).unwrap();
        assert!((distance(&nearest.q) - least).abs() < 1e-12);
    }
    let all = answers(&[[0.1, 0.0, 0.0], [0.0, 0.2, 0.0]]);
    let nearest = |weights| {
        let mut nearest = Nearest::new([0.0; 3], &[CONTINUOUS; 3]);
        nearest.weights = weights;
        all.nearest_by(&nearest).unwrap().branch
    };
    assert_eq!(nearest([1.0; 3]), 0);
    assert_eq!(nearest([3.0, 1.0, 1.0]), 1);
    // Of equals the first.
    assert_eq!(nearest([0.0; 3]), 0);
}

#[test]
fn no_joint_steps_further_than_it_may() {
    let mut random = Random(5);
    let mut kept = 0;
    for _ in 0..1000 {
        let (all, limits) = (random_answers(&mut random), random_limits(&mut random));
        let seed = [random.angle(), random.angle(), random.between(-1.0, 1.0)];
        let step = [0; 3].map(|_| random.between(1.0, 9.0));
        let moved = |q: &[f64; 3]| (0..3).map(|i| (q[i] - seed[i]).powi(2)).sum::<f64>();
        let allowed = |q: &[f64; 3]| (0..3).all(|i| (q[i] - seed[i]).abs() <= step[i]);
        let expected = by_trying(&all, &limits)
            .into_iter()
            .filter(allowed)
            .min_by(|a, b| moved(a).total_cmp(&moved(b)));
        let mut nearest = Nearest::new(seed, &limits);
        nearest.step = step;
        let found = all.nearest_by(&nearest).map(|s| s.q);
        kept += usize::from(found.is_some());
        assert_eq!(found.is_some(), expected.is_some());
        if let (Some(a), Some(b)) = (found, expected) {
            assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-12), "{a:?}, {b:?}");
        }
    }
    assert!((100..900).contains(&kept), "{kept} of 1000 tell nothing");
}

#[test]
fn a_solution_at_a_stop_is_inside() {
    for q in [-PI, -FRAC_PI_2, -1.0, 0.0, 1.0, FRAC_PI_2, PI] {
        for k in [-2.0, -1.0, 0.0, 1.0, 2.0] {
            let stop = q + TAU * k;
            for limit in [
                revolute(stop, stop),
                revolute(stop, stop + 1.0),
                revolute(stop - 1.0, stop),
            ] {
                let limits = [limit, CONTINUOUS, prismatic(0.3, 0.3)];
                let all = answers(&[[q, 0.0, 0.3]]);
                let found: Vec<_> = all.with_full_turns(&limits).collect();
                assert_eq!(found.len(), 1, "{q} in {limit:?}");
                assert!(inside(&limit, found[0].q[0]), "{found:?}");
                assert_eq!(all.within_limits(&limits).len(), 1);
                assert!(all.nearest(&[9.0; 3], &limits).is_some());
            }
        }
    }
}

/// Beyond a stop by less than the accuracy of answers is at the stop.
#[test]
fn a_solution_beyond_a_stop_is_moved_onto_it_or_outside() {
    let all = |q: f64| answers(&[[q, 0.0, q]]);
    let limits = [revolute(-1.0, 1.0), CONTINUOUS, prismatic(-1.0, 1.0)];
    for side in [-1.0, 1.0] {
        for by in [1e-16, 1e-12, 0.9 * JointLimit::TOLERANCE] {
            let found: Vec<_> = all(side * (1.0 + by)).with_full_turns(&limits).collect();
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].q, [side, 0.0, side]);
        }
        for by in [1.1 * JointLimit::TOLERANCE, 1e-6, 0.1] {
            let outside = all(side * (1.0 + by));
            assert_eq!(outside.with_full_turns(&limits).count(), 0);
            assert!(outside.within_limits(&limits).is_empty());
            assert_eq!(outside.nearest(&[0.0; 3], &limits), None);
        }
    }
}

/// A full turn away from a value that hardly rests on a stop is another that does as well.
#[test]
fn rounding_at_a_stop_loses_no_turn() {
    let mut random = Random(11);
    for _ in 0..10_000 {
        let lower = random.between(-9.0, 9.0);
        let limit = revolute(lower, lower + 2.0 * TAU);
        for by in [0.4, 0.5, 0.9, 1.0, 1.1] {
            let by = by * JointLimit::TOLERANCE;
            for (q, seed) in [
                (lower - by, lower),
                (lower + 2.0 * TAU + by, lower + 2.0 * TAU),
            ] {
                let value = limit.nearest(q, seed);
                assert!(
                    value.is_some_and(|it| inside(&limit, it)),
                    "{q} in {limit:?}"
                );
            }
        }
    }
}

/// Where weights and seeds make more of a motion than a number is, it is one.
#[test]
fn a_motion_beyond_numbers_is_a_motion() {
    let all = answers(&[[1.0, -1.0, 0.2], [-2.0, 2.0, 0.1]]);
    let limits = [CONTINUOUS, CONTINUOUS, prismatic(0.0, 1.0)];
    for weight in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e200] {
        let mut nearest = Nearest::new([0.5; 3], &limits);
        nearest.weights[1] = weight;
        assert!(all.nearest_by(&nearest).is_some(), "{weight}");
    }
    let far = Nearest::new([0.0, 0.0, 1e200], &limits);
    assert!(all.nearest_by(&far).is_some());
}

#[test]
fn without_stops_there_is_one_winding() {
    let infinite = f64::INFINITY;
    let rail = prismatic(-infinite, infinite);
    let all = answers(&[[3.0, -3.0, 70.0]]);
    for endless in [CONTINUOUS, revolute(-infinite, infinite)] {
        let limits = [endless, endless, rail];
        assert!(
            all.with_full_turns(&limits)
                .map(|s| s.q)
                .eq([[3.0, -3.0, 70.0]])
        );
        assert_eq!(all.within_limits(&limits), all);
        let far = all.nearest(&[100.0, -100.0, 0.0], &limits).unwrap();
        assert!((far.q[0] - 100.0).abs() <= PI && (far.q[1] + 100.0).abs() <= PI);
    }
    let above = [revolute(10.0, infinite), revolute(-infinite, -10.0), rail];
    let found: Vec<_> = all.with_full_turns(&above).collect();
    assert_eq!(found.len(), 1);
    assert!((found[0].q[0] - (3.0 + 2.0 * TAU)).abs() < 1e-12);
    assert!((found[0].q[1] - (-3.0 - 2.0 * TAU)).abs() < 1e-12);
}

#[test]
fn a_slide_is_inside_or_not() {
    let limits = |lower, upper| [CONTINUOUS, CONTINUOUS, prismatic(lower, upper)];
    let all = answers(&[[0.0, 0.0, 1.0]]);
    assert_eq!(all.with_full_turns(&limits(0.0, 20.0)).count(), 1);
    // A full turn lower there is no other slide.
    assert_eq!(all.with_full_turns(&limits(-20.0, 0.9)).count(), 0);
    assert_eq!(all.with_full_turns(&limits(1.0, 1.0)).count(), 1);
}

/// A seed that is not a number chooses something, and spoils nothing.
#[test]
fn a_seed_that_is_no_number_spoils_no_answer() {
    let all = answers(&[[1.0, -1.0, 0.2], [-2.0, 2.0, 0.1]]);
    let limits = [
        revolute(-TAU, TAU),
        revolute(-4.0, 4.0),
        prismatic(0.0, 1.0),
    ];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let seed = [bad, 0.0, bad];
        let nearest = all.nearest(&seed, &limits).unwrap();
        assert!(
            (0..3).all(|i| inside(&limits[i], nearest.q[i])),
            "{nearest:?}"
        );
        let endless = [CONTINUOUS, CONTINUOUS, prismatic(0.0, 1.0)];
        let nearest = all.nearest(&seed, &endless).unwrap();
        assert!(nearest.q.iter().all(|x| x.is_finite()), "{nearest:?}");
    }
}

/// Solutions have a capacity; their windings are counted one by one and have
/// none.
#[test]
fn sixteen_solutions_wind_without_bound() {
    let full = answers(&[[0.5, -0.5, 0.0]; Solutions::<3>::CAPACITY]);
    assert_eq!(full.len(), 16);
    let five_turns = revolute(-5.0 * TAU, 5.0 * TAU);
    let limits = [five_turns, five_turns, prismatic(-1.0, 1.0)];
    assert_eq!(full.with_full_turns(&limits).count(), 16 * 10 * 10);
    assert_eq!(full.within_limits(&limits).len(), 16);
}
