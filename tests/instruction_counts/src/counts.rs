//! Counts of calls, and the file that has what they may be.

use crate::calls::ELIMINATED;
use std::fmt;
use std::path::{Path, PathBuf};

/// Instructions of calls of one kind.
#[derive(PartialEq)]
pub struct Counts {
    pub robot: String,
    pub kind: String,
    pub least: u64,
    pub median: u64,
    pub most: u64,
}

/// Those of all kinds.
pub struct Table(pub Vec<Counts>);

/// How many times as many instructions as in the file are too many: another compiler may need
/// one or two per cent more.
const MARGIN: f64 = 1.02;
/// The same where an elimination takes part, which copies what another C library may copy in other
/// pieces, and of the most: a joint that is free runs a plan again by calls, and what the compiler puts
/// in line there is another in another folder (6 %).
const MARGIN_OF_CALLS: f64 = 1.1;

impl Counts {
    pub fn of(robot: &str, kind: &str, calls: &[u64]) -> Self {
        let mut sorted = calls.to_vec();
        sorted.sort_unstable();
        Counts {
            robot: robot.to_owned(),
            kind: kind.to_owned(),
            least: sorted[0],
            median: sorted[sorted.len() / 2],
            most: sorted[sorted.len() - 1],
        }
    }

    fn parse(line: &str) -> Option<Self> {
        let mut cells = line.split('\t');
        let mut word = || cells.next().map(str::to_owned);
        let (robot, kind) = (word()?, word()?);
        let mut number = || word()?.parse().ok();
        Some(Counts {
            robot,
            kind,
            least: number()?,
            median: number()?,
            most: number()?,
        })
    }
}

impl Table {
    pub fn row(&self, robot: &str, kind: &str) -> Option<&Counts> {
        let is = |row: &&Counts| row.robot == robot && row.kind == kind;
        self.0.iter().find(is)
    }

    /// What the file has.
    pub fn read() -> Self {
        let text = std::fs::read_to_string(path()).expect("counts.tsv is there");
        let rows = text.lines().skip(1).map(|line| {
            Counts::parse(line).unwrap_or_else(|| panic!("no row of counts.tsv: {line}"))
        });
        Table(rows.collect())
    }

    pub fn write(&self) {
        std::fs::write(path(), self.to_string()).expect("counts.tsv can be written");
    }

    /// Where counts are more than `bounds` allow, or have none.
    pub fn beyond(&self, bounds: &Table) -> Vec<String> {
        let faults = self.0.iter().filter_map(|row| {
            let Counts { robot, kind, .. } = row;
            let Some(bound) = bounds.row(robot, kind) else {
                return Some(format!("counts.tsv has no {kind} of {robot}: BLESS=1"));
            };
            let margin = match ELIMINATED.contains(&robot.as_str()) {
                true => MARGIN_OF_CALLS,
                false => MARGIN,
            };
            let runs_again = row.most > row.median;
            let margin_of_most = if runs_again { MARGIN_OF_CALLS } else { margin };
            [
                (row.median, bound.median, margin),
                (row.most, bound.most, margin_of_most),
            ]
            .iter()
            .find(|(count, bound, margin)| *count as f64 > margin * *bound as f64)
            .map(|(count, bound, _)| {
                format!("{kind} of {robot} takes {count} instructions, {bound} before")
            })
        });
        faults.collect()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "robot\tcall\tleast\tmedian\tmost")?;
        for row in &self.0 {
            let Counts {
                robot,
                kind,
                least,
                median,
                most,
            } = row;
            writeln!(f, "{robot}\t{kind}\t{least}\t{median}\t{most}")?;
        }
        Ok(())
    }
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("counts.tsv")
}
