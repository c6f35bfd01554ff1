//! What a controller asks of an arm, without `std`, an allocator or an operation of `f64`.
//!
//! `.ci/check-single` links this for a Cortex-M4F and looks at what was linked; built for other
//! systems it is a program that does the same.
#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

use core::hint::black_box;
use kinematics::single::{Jacobian, Pose, Solution, Solutions};

kinematics::kinematics!("../../robots/ur5e.urdf", scalar = f32);

#[inline(never)]
#[unsafe(no_mangle)]
fn pose(q: &[f32; 6]) -> Pose {
    Ur5e.fk(q)
}

#[inline(never)]
#[unsafe(no_mangle)]
fn pose_and_jacobian(q: &[f32; 6]) -> (Pose, Jacobian<6>) {
    Ur5e.fk_jacobian(q)
}

#[inline(never)]
#[unsafe(no_mangle)]
fn solutions(target: &Pose) -> Solutions<6> {
    Ur5e.ik(target)
}

#[inline(never)]
#[unsafe(no_mangle)]
fn nearest(target: &Pose, seed: &[f32; 6]) -> Option<Solution<6>> {
    Ur5e.ik_nearest(target, seed)
}

/// Whether a pose is reached again.
#[inline(never)]
#[unsafe(no_mangle)]
fn comes_back() -> bool {
    let q = black_box([0.3, -1.2, 1.5, -0.7, 1.1, 0.4]);
    let target = pose(&q);
    let (same, jacobian) = pose_and_jacobian(&q);
    let inside = solutions(&target).within_limits(&Ur5e::LIMITS);
    let met = |near: Solution<6>| (0..6).all(|i| (near.q[i] - q[i]).abs() < 1e-4);
    black_box(jacobian);
    same.translation_distance(&target) < 1e-6
        && inside.len() == 8
        && nearest(&target, &q).is_some_and(met)
}

#[cfg(not(target_os = "none"))]
fn main() {
    assert!(comes_back());
}

/// Where the processor begins.
#[cfg(target_os = "none")]
#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    loop {
        black_box(comes_back());
    }
}

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}
