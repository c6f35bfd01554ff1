//! What is solved, or known from the start.

use super::Atom;
use crate::geometry::Linkage;

/// Which joints and which sums of parallel joints are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Solved {
    joints: u128,
    sums: u128,
}

impl Solved {
    pub fn has(&self, atom: Atom) -> bool {
        match atom {
            Atom::Joint(i) => self.joints >> i & 1 == 1,
            Atom::Sum { run, .. } => self.sums >> run & 1 == 1,
        }
    }

    pub fn insert(&mut self, atom: Atom) {
        match atom {
            Atom::Joint(i) => self.joints |= 1 << i,
            Atom::Sum { run, .. } => self.sums |= 1 << run,
        }
    }

    /// How many atoms it lacks of others.
    pub fn lacks(&self, others: Self) -> u32 {
        (others.joints & !self.joints).count_ones() + (others.sums & !self.sums).count_ones()
    }

    pub fn all(&self, n: usize) -> bool {
        self.joints.count_ones() as usize == n
    }

    /// Draws the conclusions from sums: all of a run's joints give the sum, the sum and all but one of
    /// them give that one. The joints that come of it.
    pub fn conclude(&mut self, linkage: &Linkage) -> Vec<usize> {
        let mut concluded = Vec::new();
        for (run, its) in linkage.runs.iter().enumerate() {
            let known = *self;
            let is_missing = |&j: &usize| linkage.is_revolute(j) && !known.has(Atom::Joint(j));
            let mut missing = its.joints.clone().filter(is_missing);
            let sum_known = self.sums >> run & 1 == 1;
            match [missing.next(), missing.next()] {
                [None, _] => self.sums |= 1 << run,
                [Some(joint), None] if sum_known => {
                    self.insert(Atom::Joint(joint));
                    concluded.push(joint);
                }
                _ => {}
            }
        }
        concluded
    }
}
