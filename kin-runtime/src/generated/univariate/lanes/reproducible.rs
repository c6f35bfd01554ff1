//! What comes out the same on every machine.

#[cfg(feature = "std")]
use core::sync::atomic::{AtomicUsize, Ordering};

/// How many ask for it.
#[cfg(feature = "std")]
static WANTED: AtomicUsize = AtomicUsize::new(0);

/// Works without fused multiplications and additions, whatever the processor has: what a
/// compiler chooses must not depend on its machine. Meanwhile other threads do so too.
#[cfg(feature = "std")]
pub fn reproducibly<R>(work: impl FnOnce() -> R) -> R {
    struct Asking;
    impl Drop for Asking {
        fn drop(&mut self) {
            WANTED.fetch_sub(1, Ordering::Relaxed);
        }
    }
    WANTED.fetch_add(1, Ordering::Relaxed);
    let _asking = Asking;
    work()
}

/// Whether somebody asks for it.
#[inline(always)]
pub(in super::super) fn wanted() -> bool {
    #[cfg(feature = "std")]
    {
        WANTED.load(Ordering::Relaxed) > 0
    }
    #[cfg(not(feature = "std"))]
    {
        false
    }
}
