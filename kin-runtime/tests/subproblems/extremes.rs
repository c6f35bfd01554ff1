//! Input that means nothing, or hardly anything: no panic, and no solutions that
//! is not a number.

use crate::sampling::*;
use kin_runtime::Twist;
use kin_runtime::subproblems::*;

const NUMBERS: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -0.3,
    1e-3,
    1e3,
    1e-9,
    1e9,
    1e-160,
    1e160,
    f64::INFINITY,
    f64::NAN,
];

fn sound<const N: usize>(solutions: &SolutionSet<[f64; N]>) -> bool {
    match solutions {
        SolutionSet::Exact(roots) => roots.as_flattened().iter().all(|t| t.is_finite()),
        SolutionSet::Any(value) => value.iter().all(|t| t.is_finite()),
        SolutionSet::Closest { .. } | SolutionSet::None => true,
    }
}

#[test]
fn no_input_panics_or_yields_nan() {
    let mut random = stream();
    for i in 0..20_000 {
        // At first without infinities and NaN.
        let choices = if i < 15_000 { 10 } else { 12 };
        let mut number = || {
            let share = 0.5 * (random.next() + 1.0);
            NUMBERS[(share * choices as f64) as usize % choices]
        };
        let p: [Vector; 4] = [0; 4].map(|_| [number(), number(), number()]);
        let d = [number(), number()];
        let mut axis = || AXES[((0.5 * (random.next() + 1.0)) * 6.0) as usize % 6];
        let k: [Vector; 4] = [0; 4].map(|_| axis());
        let h: [Vector; 4] = [0; 4].map(|_| axis());
        let three = subproblem5([k[0], k[1], k[2]], p);
        assert!(sound(&three), "{k:?} {p:?} {three:?}");
        let twist = |k, p| Twist::revolute(k, p);
        for solutions in [
            subproblem6(h, k, p, d),
            subproblem2e(k[0], k[1], p[0], p[1], p[2]),
            two_distances([k[0], k[1]], p[0], [p[1], p[2]], d),
            parallel_pair(&twist(k[0], p[0]), &twist(k[0], p[1]), p[2], p[3]),
        ] {
            assert!(sound(&solutions), "{h:?} {k:?} {p:?} {d:?} {solutions:?}");
        }
    }
}

/// Axes and directions that are no unit vectors break the contract, but nothing
/// else.
#[test]
fn no_axis_panics() {
    let mut random = stream();
    for _ in 0..5000 {
        let mut number = || NUMBERS[(6.0 * (random.next() + 1.0)) as usize % 12];
        let mut vector = || [number(), number(), number()];
        let [h, k, p] = [0; 3].map(|_| [0; 4].map(|_| vector()));
        assert!(sound(&subproblem5([k[0], k[1], k[2]], p)));
        assert!(sound(&subproblem6(h, k, p, [0.1, 0.2])));
        assert!(sound(&subproblem2e(k[0], k[1], p[0], p[1], p[2])));
        assert!(sound(&two_distances(
            [k[0], k[1]],
            p[0],
            [p[1], p[2]],
            [1.0, 1.0]
        )));
    }
}
