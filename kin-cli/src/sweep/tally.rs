//! What a sweep counts.

use super::case::{Case, Outcome};
use super::{Comparison, Draw, Settings};
use serde::Serialize;
use std::collections::BTreeMap;

/// Of every kind of fault so many are kept.
const LISTED: usize = 5;

/// What was outcome of all targets.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// See [`Settings`].
    pub seed: u64,
    /// See [`Settings`].
    pub draw: Draw,
    /// Random targets.
    pub targets: usize,
    /// How many targets had so many solutions.
    pub solutions: BTreeMap<usize, usize>,
    /// The largest distance of a solution from its target by the generic forward
    /// kinematics, metres.
    pub worst_residual: f64,
    /// The configuration that made the target of that solution.
    pub worst_at: Vec<f64>,
    /// Configurations are near singular where their Jacobian's columns are less
    /// independent than this. Wider for an arm that was idealized: what has met
    /// on the exact arm may have left each other on the one of the file.
    pub near_singular_below: f64,
    /// Targets of such configurations.
    pub near_singular: usize,
    /// Of these, without any solution.
    pub unanswered: usize,
    /// Targets whose configuration is not among the solutions.
    pub lost: Split,
    /// The largest conditioning of a configuration that was lost; 0 if none was.
    pub lost_up_to: f64,
    /// Solutions that miss their target by more than 1e-9 of the arm's size.
    pub unsound: usize,
    /// Solutions that repeat another.
    pub doubled: Split,
    /// The comparison with the numerical search, if it was asked for.
    pub oracle: Option<Comparison>,
    /// Of every kind of fault the first few.
    pub faults: Vec<Fault>,
    /// What the sweep took, seconds.
    pub seconds: f64,
    /// What the closed form took in the interpreter for one target, polish
    /// included, microseconds.
    pub microseconds: f64,
}

/// A number of faults, by where they happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Split {
    /// At regular configurations.
    pub regular: usize,
    /// Near singular ones, see [`Tally::near_singular_below`].
    pub near_singular: usize,
}

impl Split {
    /// Counts one.
    pub(super) fn count(&mut self, near_singular: bool) {
        if near_singular {
            self.near_singular += 1;
        } else {
            self.regular += 1;
        }
    }

    pub(super) fn add(&mut self, other: Split) {
        self.regular += other.regular;
        self.near_singular += other.near_singular;
    }
}

/// Something wrong with one target.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// What.
    pub kind: Kind,
    /// Which target of the seed, from 0.
    pub number: usize,
    /// The configuration that made it.
    pub q: Vec<f64>,
    /// Whether the lost, doubled or spurious configuration is near singular.
    pub near_singular: bool,
}

/// What can be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// There is no solution at all.
    Unanswered,
    /// The configuration is not among the solutions.
    Lost,
    /// A solution misses the target.
    Unsound,
    /// A solution came twice.
    Doubled,
    /// A solution of the search is not among the solutions.
    Missing,
    /// A solution that the search knows nothing of, even if it begins there.
    Extra,
}

impl Tally {
    pub(super) fn new(case: &Case, settings: &Settings) -> Self {
        Self {
            seed: settings.seed,
            draw: settings.draw,
            near_singular_below: case.near_singular,
            oracle: (settings.oracle > 0).then(Comparison::default),
            ..Self::default()
        }
    }

    /// Whether nothing is wrong away from singular configurations, and no
    /// solution anywhere misses its target.
    pub fn is_clean(&self) -> bool {
        let regular = [self.lost.regular, self.doubled.regular, self.unsound];
        let compared = self.oracle.as_ref().is_none_or(Comparison::is_clean);
        regular == [0; 3] && compared
    }

    pub(super) fn count(&mut self, case: &Case, outcome: &Outcome, number: usize) {
        let solutions = &outcome.solutions;
        let near_singular = outcome.conditioning < case.near_singular;
        let before = self.targets as f64;
        self.targets += 1;
        self.microseconds +=
            (outcome.took.as_secs_f64() * 1e6 - self.microseconds) / (before + 1.0);
        *self.solutions.entry(solutions.len()).or_default() += 1;
        self.near_singular += usize::from(near_singular);
        self.unanswered += usize::from(near_singular && solutions.is_empty());
        if !case.is_among(&outcome.q, solutions, outcome.conditioning) {
            self.lost.count(near_singular);
            self.lost_up_to = self.lost_up_to.max(outcome.conditioning);
            let kind = match solutions.is_empty() {
                true => Kind::Unanswered,
                false => Kind::Lost,
            };
            self.note(kind, number, &outcome.q, near_singular);
        }
        for (i, &residual) in outcome.residuals.iter().enumerate() {
            if residual > self.worst_residual {
                self.worst_residual = residual;
                self.worst_at.clone_from(&outcome.q);
            }
            if !case.is_sound(residual) {
                self.unsound += 1;
                self.note(Kind::Unsound, number, &outcome.q, near_singular);
            }
            if case.is_doubled(&solutions[..=i]) {
                let near_singular = case.is_near_singular(&solutions[i].q);
                self.doubled.count(near_singular);
                self.note(Kind::Doubled, number, &outcome.q, near_singular);
            }
        }
    }

    pub(super) fn compare(&mut self, case: &Case, outcome: &Outcome, number: usize) {
        let mut comparison = self.oracle.take().unwrap_or_default();
        comparison.compare(case, outcome, |kind, near_singular| {
            self.note(kind, number, &outcome.q, near_singular);
        });
        self.oracle = Some(comparison);
    }

    fn note(&mut self, kind: Kind, number: usize, q: &[f64], near_singular: bool) {
        let same = |fault: &&Fault| (fault.kind, fault.near_singular) == (kind, near_singular);
        let known = self.faults.iter().filter(same);
        // The last one noted is of this target if any is.
        let (count, last) = known.fold((0, None), |(n, _), fault| (n + 1, Some(fault.number)));
        if count < LISTED && last != Some(number) {
            self.faults.push(Fault {
                kind,
                number,
                q: q.to_vec(),
                near_singular,
            });
        }
    }

    /// Puts what another thread has outcome to it.
    pub(super) fn add(&mut self, other: Tally) {
        let all = (self.targets + other.targets).max(1) as f64;
        let share = other.targets as f64 / all;
        self.microseconds += share * (other.microseconds - self.microseconds);
        self.targets += other.targets;
        for (count, targets) in other.solutions {
            *self.solutions.entry(count).or_default() += targets;
        }
        if other.worst_residual > self.worst_residual {
            self.worst_residual = other.worst_residual;
            self.worst_at = other.worst_at;
        }
        self.near_singular += other.near_singular;
        self.unanswered += other.unanswered;
        self.lost.add(other.lost);
        self.lost_up_to = self.lost_up_to.max(other.lost_up_to);
        self.unsound += other.unsound;
        self.doubled.add(other.doubled);
        if let (Some(ours), Some(theirs)) = (&mut self.oracle, &other.oracle) {
            ours.add(theirs);
        }
        let mut faults = std::mem::take(&mut self.faults);
        faults.extend(other.faults);
        faults.sort_by_key(|fault| (fault.near_singular, fault.kind, fault.number));
        for fault in faults {
            self.note(fault.kind, fault.number, &fault.q, fault.near_singular);
        }
    }
}
