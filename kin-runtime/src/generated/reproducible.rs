//! What comes out the same on every machine.

#[cfg(feature = "std")]
use core::cell::Cell;

#[cfg(feature = "std")]
std::thread_local! {
    static WANTED: Cell<bool> = const { Cell::new(false) };
}

/// Works without fused multiplications and additions in this thread, whatever the processor
/// has: what a compiler chooses must not depend on its machine.
#[cfg(feature = "std")]
pub fn reproducibly<R>(work: impl FnOnce() -> R) -> R {
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            WANTED.set(self.0);
        }
    }
    let _before = Before(WANTED.replace(true));
    work()
}

/// Whether this thread works so.
#[inline(always)]
pub fn wanted() -> bool {
    #[cfg(feature = "std")]
    {
        WANTED.get()
    }
    #[cfg(not(feature = "std"))]
    {
        false
    }
}
