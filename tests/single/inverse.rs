//! Solutions, limits, and the one that is nearest.

use crate::subject::{Subject, apart, configurations, target};
use kin_codegen::Scalar;
use kinematics::{JointLimit, Kinematics, single};

/// Every solution of `f64` that is not next to singular is there, to what its conditioning
/// allows, and every solution of `f32` reaches its target.
pub fn loses_nothing<S, D, const N: usize>(subject: &Subject<S, D>)
where
    S: single::Kinematics<N>,
    D: Kinematics<N>,
{
    let Subject { single, double, .. } = subject;
    let to = Scalar::F32.tolerances();
    let turns = D::LIMITS.map(JointLimit::is_revolute);
    let (mut regular, mut found) = (0, 0);
    for q in configurations::<N>() {
        let (exact, rounded) = target(double, &q);
        let wanted = double.ik(&exact);
        let solutions = single.ik(&rounded);
        for solution in &wanted {
            let conditioning = subject.conditioning(&solution.q);
            if conditioning < to.near_singular {
                continue;
            }
            regular += 1;
            let near = (to.recovered / conditioning.powi(2)).clamp(to.same, to.different);
            let is_it = |other: &single::Solution<N>| {
                (0..N).all(|i| apart(other.q[i].into(), solution.q[i], turns[i]) < near)
            };
            assert!(
                solutions.iter().any(is_it),
                "{q:?} lost {solution:?} ({conditioning:.1e}) of {wanted:?}: {solutions:?}"
            );
        }
        for solution in &solutions {
            let reached = double.fk(&solution.q.map(f64::from));
            let distance = D::TARGET.distance(&reached, &exact, subject.size());
            // The target itself was rounded.
            assert!(
                distance < 1.02 * to.solved * subject.size(),
                "{q:?} {distance:.1e}"
            );
            found += 1;
        }
    }
    assert!(regular > 1000 && found >= regular, "{regular} {found}");
    let here = single.fk(&[0.1; N]);
    let [far, nothing] = [100.0, f32::NAN].map(|x| single::Pose {
        translation: [x; 3],
        ..here
    });
    assert!(turns.contains(&false) || single.ik(&far).is_empty());
    assert!(single.ik(&nothing).is_empty());
}

/// The interpreter, which was certified, and generated code give the same bits.
pub fn is_certified<S, D, const N: usize>(subject: &Subject<S, D>)
where
    S: single::Kinematics<N>,
    D: Kinematics<N>,
{
    let form = subject.compiled.form().unwrap();
    for q in configurations::<N>() {
        let (_, target) = target(&subject.double, &q);
        let certified = form.solutions(&target.into());
        let solutions = subject.single.ik(&target);
        assert_eq!(certified.len(), solutions.len(), "{q:?}");
        for (a, b) in certified.iter().zip(&solutions) {
            assert_eq!(a.q, b.q.map(f64::from), "{q:?}");
            assert_eq!(a.residual, f64::from(b.residual));
            assert_eq!((a.branch, a.singular), (b.branch, b.singular));
        }
    }
}

pub fn chooses<S, D, const N: usize>(subject: &Subject<S, D>)
where
    S: single::Kinematics<N>,
    D: Kinematics<N>,
{
    let single = &subject.single;
    let mut inside = 0;
    for q in configurations::<N>() {
        let (_, target) = target(&subject.double, &q);
        let seed = q.map(|x| x as f32 + 0.1);
        let nearest = single::Nearest::new(seed, &S::LIMITS);
        let of_all = single.ik_seeded(&target, &seed).nearest_by(&nearest);
        assert_eq!(single.ik_nearest(&target, &seed), of_all, "{q:?}");
        if let Some(solution) = of_all {
            inside += 1;
            for (value, limit) in solution.q.iter().zip(S::LIMITS) {
                assert!((limit.lower()..=limit.upper()).contains(value));
            }
        }
    }
    assert!(inside > 100, "{inside}");
    let far = single::Pose::from_translation([100.0; 3]);
    let nearest = single::Nearest::new([0.0; N], &S::LIMITS);
    if S::LIMITS.iter().all(|limit| limit.is_revolute()) {
        let reason = single.try_ik_nearest(&far, &nearest).unwrap_err();
        let is_far = matches!(reason, single::NoSolution::OutOfReach { .. });
        assert!(is_far, "{reason:?}");
    }
}

/// The nearest solution to a configuration at rest with its wrist straight, joint 5 at 0 or next to it,
/// is that configuration: joints 4 and 6, which only together move the tip, stay where they are.
pub fn rests<S, D>(subject: &Subject<S, D>)
where
    S: single::Kinematics<6>,
    D: Kinematics<6>,
{
    let anywhere = [single::JointLimit::Continuous; 6];
    let mut asked = 0;
    for (k, mut q) in configurations::<6>().enumerate() {
        // The elbow, next to where it is stretched, is not told to where the wrist is straight, and
        // what makes up for that moves the others.
        q[4] = 1.0;
        let most = match subject.conditioning(&q) {
            ..2e-3 => continue,
            ..2e-2 => 2e-2,
            _ => 2e-3,
        };
        asked += 1;
        q[4] = [0.0, 1e-7, -1e-6, 2e-6][k % 4];
        let seed = q.map(|x| x as f32);
        let target = subject.single.fk(&seed);
        let nearest = single::Nearest::new(seed, &anywhere);
        let solutions = subject.single.ik_seeded(&target, &seed);
        let rest = solutions.nearest_by(&nearest).unwrap();
        let moved = rest.q.iter().zip(seed).map(|(a, b)| (a - b).abs());
        assert!(moved.fold(0.0, f32::max) < most, "{q:?} {rest:?}");
    }
    assert!(asked > 500, "{asked}");
}
