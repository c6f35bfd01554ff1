//! Paths that stand in tables.

use super::path::is_place;
use crate::batch::{Inverse, Kept, Task, columns as joint_columns};
use crate::table::{Fault, Format, Header, Reader, Values};
use kinematics::Robot;
use std::collections::BTreeMap;
use std::path::Path;

/// More points are no picture.
pub const MOST: usize = 100_000;

/// All solutions, and targets without any.
const EVERY: Kept = Kept {
    within_limits: false,
    empty: true,
};

/// What the points of such paths are counted by.
pub const TARGETS: &str = "target of the table";
pub const ROWS: &str = "row of the table";

/// A file with a path.
pub struct Table<'a> {
    pub path: &'a Path,
    pub reader: Box<dyn Reader>,
}

/// What it has.
pub enum Rows {
    /// By target: branches and joint values.
    Solutions(BTreeMap<u64, Vec<(usize, Vec<f64>)>>),
    /// By row; none where a value is missing.
    Configurations(Vec<Option<Vec<f64>>>),
}

impl<'a> Table<'a> {
    /// Opens a file, by the format that its name tells.
    ///
    /// # Errors
    ///
    /// It cannot be read, or is no table.
    pub fn open(path: &'a Path) -> Result<Self, Fault> {
        let reader = Format::of(path)?.open(path)?;
        Ok(Self { path, reader })
    }

    /// Whether one of the columns is called so.
    pub fn has(&self, wanted: &str) -> bool {
        match self.reader.header() {
            Header::Names(names) => names.iter().any(|name| name == wanted),
            Header::Width(_) => false,
        }
    }

    /// The values in these columns.
    ///
    /// # Errors
    ///
    /// They cannot be read, or are too many.
    pub fn columns(mut self, places: &[usize]) -> Result<Vec<Vec<f64>>, Fault> {
        self.reader.select(places)?;
        let mut columns = vec![Vec::new(); places.len()];
        while let Some(portion) = self.reader.next(MOST)? {
            for (column, more) in columns.iter_mut().zip(portion.decode()?) {
                column.extend(more);
            }
            if columns.first().map_or(0, Vec::len) > MOST {
                let reason = format!("a picture has no room for more than {MOST} rows");
                let remedy = "plot some of them, or every hundredth";
                return Err(Fault::whole(self.path, reason, remedy));
            }
        }
        match columns.first().map_or(0, Vec::len) {
            0 => {
                let remedy = "give it a row for each point of the path";
                Err(Fault::whole(self.path, "the table has no rows", remedy))
            }
            _ => Ok(columns),
        }
    }

    /// What an arm makes of it: of an array without names whose rows have as many numbers as the
    /// arm joints, these.
    ///
    /// # Errors
    ///
    /// It has neither solutions nor joint values nor poses.
    pub fn rows(self, robot: &Robot) -> Result<Rows, Fault> {
        let joints = robot.joint_names();
        let is_of_joints = match self.reader.header() {
            Header::Names(_) => joints.iter().any(|name| self.has(name)),
            Header::Width(width) => *width == joints.len(),
        };
        let path = self.path;
        if !is_of_joints {
            let (task, columns) = Inverse::new(robot, &[], EVERY, path, self.reader.header())
                .map_err(|fault| or_joints(fault, &joints))?;
            let columns = self.columns(&columns)?;
            let (answers, tally) = task.run(0, &columns);
            if let Some((row, reason)) = tally.first_fault {
                let place = crate::table::Place {
                    row: Some(row),
                    column: None,
                };
                return Err(Fault::at(path, place, reason, "mend such rows"));
            }
            let answers: Vec<Vec<f64>> = answers.into_iter().map(real).collect();
            return Ok(Rows::Solutions(by_target(&answers, joints.len())));
        }
        let places = joint_columns(path, self.reader.header(), &robot.joint_names())?;
        if let Header::Names(names) = self.reader.header()
            && let [Some(target), Some(branch)] =
                ["target", "branch"].map(|wanted| names.iter().position(|it| it == wanted))
        {
            let columns = self.columns(&[&[target, branch], &places[..]].concat())?;
            return Ok(Rows::Solutions(by_target(&columns, joints.len())));
        }
        let columns = self.columns(&places)?;
        Ok(Rows::Configurations(configurations(path, &columns)?))
    }
}

/// Configurations, of which some rows may have no numbers: a gap.
///
/// # Errors
///
/// All rows are gaps.
pub fn configurations(path: &Path, columns: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Fault> {
    let rows = complete(columns);
    if rows.iter().any(Option::is_some) {
        return Ok(rows);
    }
    let reason = "no row has a finite number for every joint";
    Err(Fault::whole(
        path,
        reason,
        "give values of the joints, radians and metres",
    ))
}

/// The rows of columns; none where a value is missing.
fn complete(columns: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
    let count = columns.first().map_or(0, Vec::len);
    let row = |row: usize| -> Vec<f64> { columns.iter().map(|column| column[row]).collect() };
    let rows = (0..count).map(row);
    rows.map(|q| q.iter().copied().all(is_place).then_some(q))
        .collect()
}

/// Rows of a target, a branch and the values of joints, and more behind them. A target whose row
/// has no numbers has no solution, and is there.
fn by_target(columns: &[Vec<f64>], joints: usize) -> BTreeMap<u64, Vec<(usize, Vec<f64>)>> {
    let mut targets: BTreeMap<u64, Vec<_>> = BTreeMap::new();
    let rows = columns[0].iter().zip(&columns[1]);
    let rows = rows.zip(complete(&columns[2..2 + joints]));
    for ((&target, &branch), q) in rows {
        let all = targets.entry(target.max(0.0) as u64).or_default();
        if let (Some(q), true) = (q, branch >= 0.0) {
            all.push((branch as usize, q));
        }
    }
    targets
}

fn real(values: Values) -> Vec<f64> {
    match values {
        Values::Real(values) => values,
        Values::Integer(values) => values.into_iter().map(|x| x as f64).collect(),
        Values::Truth(values) => values.into_iter().map(f64::from).collect(),
    }
}

/// A table that is none of poses may have been meant as one of joints.
pub fn or_joints(fault: Fault, joints: &[&str]) -> Fault {
    let remedy = format!(
        "{}; or after the joints: {}",
        fault.remedy,
        joints.join(", ")
    );
    Fault { remedy, ..fault }
}
