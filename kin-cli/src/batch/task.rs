//! What is computed of rows.

use crate::table::{Column, Values};
use serde::{Deserialize, Serialize};

/// A function of rows that needs no others.
pub trait Task: Sync {
    /// The columns of its answers.
    fn columns(&self) -> Vec<Column>;

    /// The answers to some rows of the columns it asked for, the first of which has a number in
    /// its file.
    fn run(&self, first: u64, columns: &[Vec<f64>]) -> (Vec<Values>, Tally);
}

/// What became of some rows.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Rows that were read.
    pub rows: u64,
    /// Targets without a solution.
    pub unsolved: u64,
    /// Rows that say nothing: a value is missing, or a rotation is none.
    pub faulty: u64,
    /// The number of the first of these, and what is wrong with it.
    pub first_fault: Option<(u64, String)>,
    /// The number of the first row in which a joint is more than a turn beyond its stops, and what is
    /// said of it.
    #[serde(default)]
    pub first_beyond: Option<(u64, String)>,
}

impl Tally {
    /// Counts a row that says nothing.
    pub fn fault(&mut self, row: u64, reason: &str) {
        self.faulty += 1;
        self.first_fault
            .get_or_insert_with(|| (row, reason.to_owned()));
    }

    /// These rows, and others behind them.
    pub fn add(&mut self, other: &Tally) {
        self.rows += other.rows;
        self.unsolved += other.unsolved;
        self.faulty += other.faulty;
        if self.first_fault.is_none() {
            self.first_fault.clone_from(&other.first_fault);
        }
        if self.first_beyond.is_none() {
            self.first_beyond.clone_from(&other.first_beyond);
        }
    }
}
