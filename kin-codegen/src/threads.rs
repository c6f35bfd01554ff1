//! Work that is divided between threads: where a macro runs it, unoptimized, a search takes seconds.

use kin_runtime::__private::reproducible::{reproducibly, wanted};
use std::iter;
use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, Builder};
use std::time::{Duration, Instant};

/// Several times what it takes to start a thread.
const ALONE: Duration = Duration::from_micros(200);

/// As many as the processor runs at once, which the system says by files.
pub fn count() -> usize {
    static COUNT: OnceLock<usize> = OnceLock::new();
    *COUNT.get_or_init(|| thread::available_parallelism().map_or(1, NonZero::get))
}

/// What comes of each, in their order, as if this thread had done all, as it does where no other can be
/// started. Some may take many times as long as others: whoever is free takes the next.
pub fn each<T: Sync, R: Send>(all: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let workers = count().min(all.len());
    if workers < 2 {
        return all.iter().map(work).collect();
    }
    // Alone, while there is not much to do.
    let begun = Instant::now();
    let mut first = Vec::new();
    while first.len() < all.len() && begun.elapsed() < ALONE {
        first.push(work(&all[first.len()]));
    }
    if first.len() == all.len() {
        return first;
    }
    let workers = workers.min(all.len() - first.len());
    let next = AtomicUsize::new(first.len());
    let take = || {
        let place = next.fetch_add(1, Ordering::Relaxed);
        Some((place, work(all.get(place)?)))
    };
    let take_all = || iter::from_fn(take).collect::<Vec<_>>();
    let is_reproducible = wanted();
    let worker = || match is_reproducible {
        true => reproducibly(take_all),
        false => take_all(),
    };
    let mut done: Vec<(usize, R)> = thread::scope(|scope| {
        let helper = |_| Builder::new().spawn_scoped(scope, worker).ok();
        let helpers: Vec<_> = (1..workers).filter_map(helper).collect();
        let mut done = take_all();
        for helper in helpers {
            done.extend(helper.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        done
    });
    done.sort_unstable_by_key(|(place, _)| *place);
    first.extend(done.into_iter().map(|(_, result)| result));
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_done_in_order_and_as_this_thread_does_it() {
        let all: Vec<usize> = (0..1000).collect();
        let work = |i: &usize| (*i, wanted());
        let expected = |is: bool| all.iter().map(|i| (*i, is)).collect::<Vec<_>>();
        assert_eq!(each(&all, work), expected(false));
        assert_eq!(reproducibly(|| each(&all, work)), expected(true));
        assert_eq!(each(&[], work), []);
    }

    #[test]
    #[should_panic(expected = "of a worker")]
    fn a_panic_is_this_threads() {
        each(&[1, 2, 3], |i| assert!(*i != 2, "of a worker"));
    }
}
