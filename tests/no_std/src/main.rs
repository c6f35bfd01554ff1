//! Forward and inverse kinematics with nothing but `core`: there is no
//! allocator to call, and a second panic handler, that of std, would not link.
//!
//! Without std panics cannot unwind, so `tests/no_std.rs` builds this program
//! with `-C panic=abort`. Built otherwise, with the rest of the workspace, it
//! is an ordinary one.
#![cfg_attr(panic = "abort", no_std)]
#![cfg_attr(panic = "abort", no_main)]

#[cfg(panic = "abort")]
mod freestanding;

kinematics::kinematics!("../../robots/ur5e.urdf");

#[cfg(not(panic = "abort"))]
fn main() {
    assert!(finds_all_solutions());
}

/// Whether the arm finds its eight solutions, and the one asked for.
fn finds_all_solutions() -> bool {
    let q = core::hint::black_box([0.3, -1.2, 1.5, -0.7, 1.1, 0.4]);
    let target = Ur5e.fk(&q);
    let solutions = Ur5e.ik(&target);
    let met = |q: &[f64; 6]| {
        let reached = Ur5e.fk(q);
        let shift = reached.translation_distance(&target);
        shift + reached.rotation_distance(&target) < 1e-12
    };
    let all_met = solutions.iter().all(|solution| met(&solution.q));
    let inside = solutions.within_limits(&Ur5e::LIMITS);
    let nearest = Ur5e.ik_nearest(&target, &q);
    let recovered = nearest.is_some_and(|nearest| (nearest.q[0] - q[0]).abs() < 1e-12);
    solutions.len() == 8 && all_met && inside.len() == 8 && recovered
}
