//! A UR5e as WebAssembly, for a page: numbers in one memory, and functions that take nothing.
//!
//! No `std`, no allocator and no glue. The page finds [`numbers`], writes joint values or a pose
//! there, calls [`fk`] or [`ik`], and reads what they leave; `index.html` does, and
//! `.ci/check-wasm` builds and runs it.
#![cfg_attr(target_family = "wasm", no_std)]

use core::sync::atomic::{AtomicU64, Ordering::Relaxed};
use kinematics::Pose;

kinematics::kinematics!("../../robots/ur5e.urdf");

/// The page is the only one who calls, but a static that changes has to be atomic; the bits are
/// those of doubles.
static NUMBERS: [AtomicU64; LENGTH] = [const { AtomicU64::new(0) }; LENGTH];

/// Where things are among the numbers: six joint values, radians.
const Q: usize = 0;
/// Three rows of [R | p], metres.
const POSE: usize = 6;
/// The origins of the six links, metres.
const LINKS: usize = 18;
/// Of each solution six joint values and the residual.
const SOLUTIONS: usize = 36;
const LENGTH: usize = SOLUTIONS + 7 * 16;

fn number(place: usize) -> f64 {
    f64::from_bits(NUMBERS[place].load(Relaxed))
}

fn leave(place: usize, values: impl IntoIterator<Item = f64>) {
    for (number, value) in NUMBERS[place..].iter().zip(values) {
        number.store(value.to_bits(), Relaxed);
    }
}

/// Where the numbers are in the memory, bytes.
#[unsafe(no_mangle)]
pub extern "C" fn numbers() -> *const AtomicU64 {
    NUMBERS.as_ptr()
}

/// The pose and the links of the joint values.
#[unsafe(no_mangle)]
pub extern "C" fn fk() {
    let q = core::array::from_fn(|i| number(Q + i));
    let pose = Ur5e.fk(&q).to_matrix();
    leave(POSE, pose.into_iter().take(3).flatten());
    let links = Ur5e.fk_links(&q);
    leave(LINKS, links.into_iter().flat_map(|link| link.translation));
}

/// All solutions to the pose; how many they are.
#[unsafe(no_mangle)]
pub extern "C" fn ik() -> usize {
    let row = |i: usize| core::array::from_fn(|j| number(POSE + 4 * i + j));
    let pose = Pose::from_matrix(&[row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]);
    let solutions = Ur5e.ik(&pose);
    let all = solutions.iter().flat_map(|solution| {
        let residual = [solution.residual];
        solution.q.into_iter().chain(residual)
    });
    leave(SOLUTIONS, all);
    solutions.len()
}

#[cfg(target_family = "wasm")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}
