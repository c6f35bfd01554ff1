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

    fn solutions(&self) -> SolutionSet<[f64; 2]> {
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
        let solutions = elbow.solutions();
        assert!(proper(solutions.exact()));
        assert!(
            solutions.exact().iter().all(|s| elbow.off(s) <= 1e-12),
            "{elbow:?} {solutions:?}"
        );
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{elbow:?} {t:?} {solutions:?}"
        );
        if i < 500
            && let Some(expected) = elbow.scanned()
        {
            assert_eq!(
                solutions.exact().len(),
                expected.len(),
                "{elbow:?} {solutions:?}"
            );
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
                        let solutions = elbow.solutions();
                        match solutions {
                            SolutionSet::Exact(roots) => {
                                kinds[0] += 1;
                                assert!(roots.iter().all(|s| elbow.off(s) <= 1e-12));
                                assert!(
                                    nearest(&roots, &t) < 1e-6,
                                    "{elbow:?} {t:?} {solutions:?}"
                                );
                            }
                            SolutionSet::Any(member) => {
                                kinds[1] += 1;
                                assert!(elbow.off(&member) <= 1e-12);
                                let k = elbow.axes[0].angular;
                                let on = |a: Vector, b: Vector| norm(cross(k, minus(a, b))) < 1e-9;
                                assert!(on(elbow.q, [0.0; 3]) || on(p, foot) || on(foot, [0.0; 3]));
                            }
                            _ => panic!("{elbow:?} {t:?} {solutions:?}"),
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
            let solutions = elbow(0.0).solutions();
            assert_eq!(solutions.exact().len(), 1, "{solutions:?}");
            assert!(
                nearest(solutions.exact(), &[turn, bend]) < 1e-6,
                "{solutions:?}"
            );
            for power in 4..=12 {
                let gap = 10_f64.powi(-power);
                let solutions = elbow(gap).solutions();
                assert!(solutions.exact().iter().all(|s| elbow(gap).off(s) <= 1e-9));
                assert!(
                    nearest(solutions.exact(), &[turn, bend + gap]) < 3e-6,
                    "{solutions:?}"
                );
                assert!(power > 5 || solutions.exact().len() == 2);
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
        let SolutionSet::Closest { value, residual } = elbow.solutions() else {
            panic!("{elbow:?} {:?}", elbow.solutions())
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
    let solutions = parallel_pair(&shoulder, &elbow, times(2.0, X), [0.0; 3]);
    assert!(
        matches!(solutions, SolutionSet::Any([_, t]) if (t.abs() - PI).abs() < 1e-7),
        "{solutions:?}"
    );
    // The hand on the elbow's axis.
    let solutions = parallel_pair(&shoulder, &elbow, X, Y);
    assert!(matches!(solutions, SolutionSet::Any([t, 0.0]) if (t - 0.5 * PI).abs() < 1e-15));
    // One axis.
    let solutions = parallel_pair(&shoulder, &Twist::revolute(Z, Z), X, Y);
    assert!(matches!(solutions, SolutionSet::Any(_)));
    // Not parallel.
    let skew = Twist::revolute(X, Y);
    let solutions = parallel_pair(&shoulder, &skew, [1.0, 2.0, 0.0], [0.2, 0.3, 0.4]);
    assert!(matches!(solutions, SolutionSet::Closest { .. }));
    // Heights that differ.
    let solutions = parallel_pair(&shoulder, &elbow, times(1.5, X), [1.0, 0.0, 0.1]);
    assert!(
        matches!(solutions, SolutionSet::Closest { residual, .. } if (residual - 0.1).abs() < 1e-14)
    );
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
            assert!(nearest(elbow.solutions().exact(), &t) < 1e-6);
        }
    }
}
