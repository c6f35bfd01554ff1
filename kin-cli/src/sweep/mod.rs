//! Sweeps: a closed form on many random targets.
//!
//! The certificate runs every plan on some hundred configurations, each time that
//! a robot is compiled. A [`sweep`] asks the same of as many as one has patience
//! for, counts what went wrong instead of stopping at the first, and holds some
//! of the targets against the numerical search, which shares no code with the
//! closed form. [`Replay`] shows a single configuration in full.
//!
//! ```
//! use kin_cli::sweep::{Settings, sweep};
//! use kin_codegen::{Options, Source, compile};
//! let text = "
//! robot: planar
//! units: {angle: rad, length: m}
//! screws:
//!   - {name: shoulder, axis: [0, 0, 1], point: [0, 0, 0]}
//!   - {name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}
//! home: {xyz: [0.9, 0, 0]}
//! ";
//! let source = Source { path: "planar.yaml".into(), text: text.into() };
//! let compiled = compile(&source, &Options::default())?;
//! let settings = Settings { targets: 100, oracle: 10, ..Settings::default() };
//! let arm = compiled.arm().unwrap();
//! let form = arm.form().unwrap();
//! let tally = sweep(&arm.model, form, &settings, &|_| {});
//! assert!(tally.is_clean());
//! assert_eq!(tally.solutions[&2], 100);
//! # Ok::<(), kin_codegen::Error>(())
//! ```

mod case;
mod draw;
mod oracle;
mod replay;
mod tally;
mod text;

pub use draw::Draw;
pub use oracle::Comparison;
pub use replay::{FormSolution, Found, Replay};
pub use tally::{Fault, Kind, Split, Tally};

use case::Case;
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::model::Model;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

/// Targets that a thread takes at once.
const PORTION: usize = 64;

/// How far a sweep goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// Random targets.
    pub targets: usize,
    /// How many of them, evenly spread, are held against the numerical search.
    pub oracle: usize,
    /// Which targets. The same seed draws the same ones on any number of
    /// processors.
    pub seed: u64,
    /// Where they are drawn from.
    pub draw: Draw,
}

impl Settings {
    /// Whether the target of a number is held against the search.
    fn is_compared(&self, number: usize) -> bool {
        let oracle = self.oracle.min(self.targets) as u128;
        let before = |n: usize| n as u128 * oracle / self.targets as u128;
        before(number + 1) > before(number)
    }
}

/// Runs a closed form of an arm on the targets of random configurations, on all
/// processors. Angles are drawn from (−π, π], whatever the limits; slides, and angles of which
/// a full turn changes the pose, within their limits, or slides to the arm's size both ways.
///
/// `progress` is told how many targets are done since it was told last; from
/// several threads.
pub fn sweep(
    model: &Model,
    form: &ClosedForm,
    settings: &Settings,
    progress: &(dyn Fn(usize) + Sync),
) -> Tally {
    let start = Instant::now();
    let case = Case::new(model, form);
    let next = AtomicUsize::new(0);
    let total = Mutex::new(Tally::new(&case, settings));
    let work = || {
        let mut tally = Tally::new(&case, settings);
        loop {
            let from = next.fetch_add(PORTION, Ordering::Relaxed);
            let portion = from..settings.targets.min(from + PORTION);
            if portion.is_empty() {
                break;
            }
            let count = portion.len();
            examine(&case, settings, portion, &mut tally);
            progress(count);
        }
        if let Ok(mut total) = total.lock() {
            total.add(tally);
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads.min(settings.targets.div_ceil(PORTION)) {
            scope.spawn(work);
        }
    });
    let mut tally = total
        .into_inner()
        .unwrap_or_else(|poison| poison.into_inner());
    tally.seconds = start.elapsed().as_secs_f64();
    tally
}

fn examine(case: &Case, settings: &Settings, numbers: Range<usize>, tally: &mut Tally) {
    for number in numbers {
        let q = case.draw(settings, number);
        let outcome = case.run(q);
        tally.count(case, &outcome, number);
        if settings.is_compared(number) {
            tally.compare(case, &outcome, number);
        }
    }
}
