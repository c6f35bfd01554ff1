//! What a program without std needs on Linux.

use core::ffi::c_int;

/// Called by the C runtime, which takes 0 for success.
#[unsafe(no_mangle)]
extern "C" fn main() -> c_int {
    c_int::from(!crate::finds_all_solutions())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}

/// `core` comes compiled for unwinding and asks for this, even though nothing
/// unwinds.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

/// As above.
#[unsafe(no_mangle)]
extern "C" fn _Unwind_Resume() {}

#[link(name = "c")]
unsafe extern "C" {}
