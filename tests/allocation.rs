//! Generated code and what is done with its answers never allocate.

use kinematics::{Follow, JointLimit, Kinematics, Nearest, Pose, RedundantKinematics, Wrench};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/puma560.yaml");
kinematics::kinematics!("../robots/scara.yaml");
kinematics::kinematics!("../robots/delta.yaml");
kinematics::kinematics!("../robots/stewart.yaml");
kinematics::kinematics!("robots/noisy/calibrated.yaml");
kinematics::kinematics!("../robots/panda.yaml");
kinematics::kinematics!("../robots/sawyer.yaml");

/// The system's allocator, counting what the current thread asks for.
struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: hands everything on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: as promised to us.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as promised to us.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = COUNT.get();
    work();
    COUNT.get() - before
}

#[test]
fn allocations_are_counted() {
    assert_eq!(allocations(|| drop(black_box(vec![1]))), 1);
}

#[test]
fn robots_do_not_allocate() {
    assert_eq!(allocations(|| use_everything(&Ur5e)), 0);
    assert_eq!(allocations(|| use_everything(&Puma560)), 0);
    assert_eq!(allocations(|| use_everything(&Scara)), 0);
    // Its branches are polished.
    assert_eq!(allocations(|| use_everything(&Calibrated)), 0);
}

#[test]
fn a_joint_to_spare_does_not_allocate() {
    assert_eq!(allocations(|| follow(&Panda)), 0);
    assert_eq!(allocations(|| follow(&Sawyer)), 0);
}

/// All that a controller of a seven-joint arm calls.
fn follow(arm: &impl RedundantKinematics<7>) {
    let q = black_box([0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6]);
    let target = arm.fk(&q);
    assert!(!arm.ik_at(&target, arm.parameter_of(&target, &q)).is_empty());
    black_box(
        arm.ik_sweep(&target, 16)
            .map(|found| found.len())
            .sum::<usize>(),
    );
    let how = Follow::new(&[JointLimit::Continuous; 7], 1e-3);
    assert!(arm.ik_follow(&target, &q, &how).is_some());
}

#[test]
fn mechanisms_do_not_allocate() {
    let target = Pose::from_translation([0.03, -0.02, -0.17]);
    let delta = || {
        let q = Delta.ik(&target).nearest(&[0.0; 15], &Delta::LIMITS);
        let q = q.expect("in reach");
        black_box(Delta.fk(&Delta.actuated(&q)));
        black_box(Delta.fk_near(&Delta.actuated(&q), &q));
        black_box(Delta.joint_rates(&q, &[1.0; 3]));
    };
    assert_eq!(allocations(delta), 0);
    let stewart = || {
        let q = Stewart.fk_near(&black_box([0.01; 6]), &[0.0; 36]);
        let q = q.expect("in reach").q;
        black_box(Stewart.ik(&Stewart.platform(&q)));
        black_box(Stewart.inverse_jacobian(&q));
        black_box(Stewart.forward_jacobian(&q));
        black_box(Stewart.kinematic_singularity(&q));
        black_box(Stewart.actuator_singularity(&q));
    };
    assert_eq!(allocations(stewart), 0);
}

fn use_everything<K: Kinematics<N>, const N: usize>(arm: &K) {
    let q = black_box([0.4; N]);
    let pose = arm.fk(&q);
    black_box(arm.fk_links(&q));
    black_box(arm.fk_jacobian(&q));
    arm.fk_batch(&[q; 20], &mut [pose; 20]);
    arm.fk_jacobian_batch(&[q; 20], &mut [arm.fk_jacobian(&q); 20]);
    black_box(arm.spatial_jacobian(&q));
    black_box(arm.body_jacobian(&q));
    black_box(arm.geometric_jacobian(&q));
    black_box(arm.body_velocity(&q, &q));
    black_box(arm.geometric_torques(&q, &Wrench::default()));
    black_box(arm.body_jacobian_dot(&q, &q));
    black_box(arm.body_hessian(&q));
    black_box(arm.structural_wrenches(&q));
    black_box(arm.manipulability_gradient(&q));
    black_box(arm.geometric_jacobian(&q).force_ellipsoid());
    black_box(arm.null_space_projection(&q, &q));
    answer(arm, &pose, &q);
    answer(arm, &Pose::from_translation([9.0; 3]), &q);
    answer(arm, &arm.fk(&[0.0; N]), &q);
}

/// Inverse kinematics and what is done with the answers.
fn answer<K: Kinematics<N>, const N: usize>(arm: &K, target: &Pose, seed: &[f64; N]) {
    black_box(arm.ik_seeded(target, seed));
    black_box(arm.ik_approximate(target));
    let solutions = arm.ik(target);
    arm.ik_batch(&[*target; 10], &mut [solutions; 10]);
    black_box(solutions.within_limits(&K::LIMITS));
    black_box(solutions.with_full_turns(&K::LIMITS).count());
    black_box(arm.ik_nearest(target, seed));
    black_box(
        arm.try_ik_nearest(target, &Nearest::new(*seed, &K::LIMITS))
            .ok(),
    );
    black_box(solutions.nearest(seed, &K::LIMITS));
    black_box(solutions.into_iter().count());
}
