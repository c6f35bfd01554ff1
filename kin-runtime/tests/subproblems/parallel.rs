//! The parallel pair.

use crate::sampling::*;
use core::f64::consts::PI;
use kin_runtime::subproblems::*;
use kin_runtime::{Pose, Twist};

/// One instance: two axes and a point to bring to another.
#[derive(Clone, Copy, Debug)]
struct Elbow {
    axes: [Twist; 2],
    p: Vector,
    q: Vector,
}

impl Elbow {
    fn solved_by(k: Vector, sense: f64, feet: [Vector; 2], p: Vector, t: &[f64; 2]) -> Elbow {
        let axes = [
            Twist::revolute(k, feet[0]),
            Twist::revolute(times(sense, k), feet[1]),
        ];
        let q = moved(&axes, p, t);
        Elbow { axes, p, q }
    }

    fn off(&self, t: &[f64; 2]) -> f64 {
        norm(minus(moved(&self.axes, self.p, t), self.q))
    }

    fn answer(&self) -> Answer<[f64; 2]> {
        parallel_pair(&self.axes[0], &self.axes[1], self.p, self.q)
    }

    /// A point on the first axis.
    fn shoulder(&self) -> Vector {
        cross(self.axes[0].angular, self.axes[0].linear)
    }

    /// The angles t₂ that bring p to the distance of q from the first axis.
    fn scanned(&self) -> Option<Vec<f64>> {
        let k = self.axes[0].angular;
        let off_axis = |p: Vector| norm(cross(k, minus(p, self.shoulder())));
        let wanted = off_axis(self.q);
        roots_on_circle(|t| off_axis(Pose::exp(&self.axes[1], t).transform_point(self.p)) - wanted)
    }
}

fn moved(axes: &[Twist; 2], p: Vector, t: &[f64; 2]) -> Vector {
    (Pose::exp(&axes[0], t[0]) * Pose::exp(&axes[1], t[1])).transform_point(p)
}

#[test]
fn parallel_pair_is_sound_complete_and_recovers_the_pair() {
    let mut random = stream();
    for i in 0..10_000 {
        let sense = if i % 2 == 0 { 1.0 } else { -1.0 };
        let feet = [random.vector(), random.vector()];
        let t = [random.angle(), random.angle()];
        let elbow = Elbow::solved_by(random.unit(), sense, feet, random.vector(), &t);
        let answer = elbow.answer();
        assert!(proper(answer.exact()));
        assert!(
            answer.exact().iter().all(|s| elbow.off(s) <= 1e-12),
            "{elbow:?} {answer:?}"
        );
        assert!(
            nearest(answer.exact(), &t) < 1e-6,
            "{elbow:?} {t:?} {answer:?}"
        );
        if i < 500
            && let Some(expected) = elbow.scanned()
        {
            assert_eq!(answer.exact().len(), expected.len(), "{elbow:?} {answer:?}");
        }
    }
}

#[test]
fn parallel_pair_of_special_arms() {
    let mut kinds = [0; 2];
    for k in AXES {
        for p in [X, Y, Z, [1.0, 0.0, 1.0], [2.0, -0.5, 0.2]] {
            for foot in [X, Y, Z, [0.3, 0.4, 0.0]] {
                for t in ANGLES
                    .iter()
                    .flat_map(|a| ANGLES.iter().map(move |b| [*a, *b]))
                {
                    for sense in [1.0, -1.0] {
                        let elbow = Elbow::solved_by(k, sense, [[0.0; 3], foot], p, &t);
                        let answer = elbow.answer();
                        match answer {
                            Answer::Exact(roots) => {
                                kinds[0] += 1;
                                assert!(roots.iter().all(|s| elbow.off(s) <= 1e-12));
                                assert!(nearest(&roots, &t) < 1e-6, "{elbow:?} {t:?} {answer:?}");
                            }
                            Answer::Any(member) => {
                                kinds[1] += 1;
                                assert!(elbow.off(&member) <= 1e-12);
                                let k = elbow.axes[0].angular;
                                let on = |a: Vector, b: Vector| norm(cross(k, minus(a, b))) < 1e-9;
                                assert!(on(elbow.q, [0.0; 3]) || on(p, foot) || on(foot, [0.0; 3]));
                            }
                            _ => panic!("{elbow:?} {t:?} {answer:?}"),
                        }
                    }
                }
            }
        }
    }
    assert!(kinds.iter().all(|n| *n > 300), "{kinds:?}");
}

#[test]
fn parallel_pair_stretched_and_folded() {
    let mut random = stream();
    for _ in 0..2000 {
        let turn = random.angle();
        for (bend, links) in [(0.0, [1.0, 0.7]), (PI, [1.0, 0.7]), (PI, [0.4, 1.0])] {
            let elbow = |gap: f64| {
                let p = [links[0] + links[1], 0.0, 0.3];
                let foot = [links[0], 0.0, 0.0];
                Elbow::solved_by(Z, 1.0, [[0.0; 3], foot], p, &[turn, bend + gap])
            };
            let answer = elbow(0.0).answer();
            assert_eq!(answer.exact().len(), 1, "{answer:?}");
            assert!(nearest(answer.exact(), &[turn, bend]) < 1e-6, "{answer:?}");
            for power in 4..=12 {
                let gap = 10_f64.powi(-power);
                let answer = elbow(gap).answer();
                assert!(answer.exact().iter().all(|s| elbow(gap).off(s) <= 1e-9));
                assert!(
                    nearest(answer.exact(), &[turn, bend + gap]) < 3e-6,
                    "{answer:?}"
                );
                assert!(power > 5 || answer.exact().len() == 2);
            }
        }
    }
}

#[test]
fn parallel_pair_out_of_reach_comes_closest() {
    let mut random = stream();
    for _ in 0..40 {
        let [p, q, foot] = [0; 3].map(|_| random.vector());
        let axes = [
            Twist::revolute(Z, [0.0; 3]),
            Twist::revolute(Z, times(0.1, foot)),
        ];
        let elbow = Elbow {
            axes,
            p: times(0.3, p),
            q: plus(q, times(2.0, X)),
        };
        let Answer::Closest { value, residual } = elbow.answer() else {
            panic!("{elbow:?} {:?}", elbow.answer())
        };
        assert!((elbow.off(&value) - residual).abs() < 1e-14);
        let steps = || (0..72).map(|i| f64::from(5 * i).to_radians());
        assert!(steps().all(|a| steps().all(|b| elbow.off(&[a, b]) >= residual - 1e-13)));
    }
}

#[test]
fn parallel_pair_names_its_families() {
    let (shoulder, elbow) = (Twist::revolute(Z, [0.0; 3]), Twist::revolute(Z, X));
    // Equal links folded onto the shoulder.
    let answer = parallel_pair(&shoulder, &elbow, times(2.0, X), [0.0; 3]);
    assert!(
        matches!(answer, Answer::Any([_, t]) if (t.abs() - PI).abs() < 1e-7),
        "{answer:?}"
    );
    // The hand on the elbow's axis.
    let answer = parallel_pair(&shoulder, &elbow, X, Y);
    assert!(matches!(answer, Answer::Any([t, 0.0]) if (t - 0.5 * PI).abs() < 1e-15));
    // One axis.
    let answer = parallel_pair(&shoulder, &Twist::revolute(Z, Z), X, Y);
    assert!(matches!(answer, Answer::Any(_)));
    // Not parallel.
    let skew = Twist::revolute(X, Y);
    let answer = parallel_pair(&shoulder, &skew, [1.0, 2.0, 0.0], [0.2, 0.3, 0.4]);
    assert!(matches!(answer, Answer::Closest { .. }));
    // Heights that differ.
    let answer = parallel_pair(&shoulder, &elbow, times(1.5, X), [1.0, 0.0, 0.1]);
    assert!(matches!(answer, Answer::Closest { residual, .. } if (residual - 0.1).abs() < 1e-14));
}

#[test]
fn parallel_pair_of_any_size() {
    let mut random = stream();
    for _ in 0..1000 {
        let (k, feet, p) = (
            random.unit(),
            [random.vector(), random.vector()],
            random.vector(),
        );
        let t = [random.angle(), random.angle()];
        for scale in [1e-3, 1.0, 1e3] {
            let feet = feet.map(|r| times(scale, r));
            let elbow = Elbow::solved_by(k, 1.0, feet, times(scale, p), &t);
            assert!(nearest(elbow.answer().exact(), &t) < 1e-6);
        }
    }
}
