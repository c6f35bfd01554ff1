//! The poses of joint values, row by row.

use super::pose::{Written, list};
use super::task::{Tally, Task};
use crate::table::{Column, Fault, Header, Values, number_for_name};
use kinematics::Robot;
use std::path::Path;

/// Forward kinematics.
pub struct Forward<'a> {
    robot: &'a Robot,
    written: Written,
}

impl<'a> Forward<'a> {
    /// Of this robot, with poses written so.
    pub fn new(robot: &'a Robot, written: Written) -> Self {
        Self { robot, written }
    }

    /// The columns of a file that have the joints' values.
    ///
    /// # Errors
    ///
    /// They are not there.
    pub fn find(&self, path: &Path, header: &Header) -> Result<Vec<usize>, Fault> {
        columns(path, header, &self.robot.joint_names())
    }
}

/// The columns of a file that have the values of these joints.
///
/// # Errors
///
/// They are not there.
pub fn columns(path: &Path, header: &Header, joints: &[&str]) -> Result<Vec<usize>, Fault> {
    match header {
        Header::Names(names) => joints.iter().map(|it| joint(path, names, it)).collect(),
        Header::Width(width) if *width == joints.len() => Ok((0..*width).collect()),
        Header::Width(width) => Err(Fault::whole(
            path,
            format!(
                "rows of {width} numbers, where the robot has {} joints",
                joints.len()
            ),
            format!("let rows have the values of {}", joints.join(", ")),
        )),
    }
}

/// The column of a joint, or of something else with a name.
pub fn joint(path: &Path, names: &[String], wanted: &str) -> Result<usize, Fault> {
    let mut places = (0..names.len()).filter(|&place| names[place] == wanted);
    match (places.next(), places.next()) {
        (Some(place), None) => Ok(place),
        (Some(_), Some(_)) => Err(Fault::whole(
            path,
            format!("two columns are called `{wanted}`"),
            "leave one of them out",
        )),
        (None, _) => Err(number_for_name(path, names).unwrap_or_else(|| {
            Fault::whole(
                path,
                format!("no column `{wanted}`; there are {}", list(names)),
                "name the columns after the joints in the robot file (`kin explain` lists them)",
            )
        })),
    }
}

impl Task for Forward<'_> {
    fn columns(&self) -> Vec<Column> {
        self.written.columns()
    }

    fn run(&self, first: u64, columns: &[Vec<f64>]) -> (Vec<Values>, Tally) {
        let rows = columns.first().map_or(0, Vec::len);
        let mut tally = Tally {
            rows: rows as u64,
            ..Tally::default()
        };
        let mut answers = vec![Vec::with_capacity(rows); self.columns().len()];
        let mut q = vec![0.0; columns.len()];
        for row in 0..rows {
            for (value, column) in q.iter_mut().zip(columns) {
                *value = column[row];
            }
            if q.iter().all(|value| value.is_finite()) {
                let values = self.written.values(&self.robot.fk(&q));
                for (answer, value) in answers.iter_mut().zip(values) {
                    answer.push(value);
                }
            } else {
                tally.fault(
                    first + row as u64,
                    "a value is missing, or no finite number",
                );
                answers.iter_mut().for_each(|answer| answer.push(f64::NAN));
            }
        }
        (answers.into_iter().map(Values::Real).collect(), tally)
    }
}
