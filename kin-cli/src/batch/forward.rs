//! The poses of joint values, row by row.

use super::pose::{Written, list};
use super::task::{Tally, Task};
use crate::table::{Column, Fault, Header, Kind, Values, number_for_name};
use kin_codegen::spec::one_line;
use kinematics::{JointLimit, Robot};
use std::f64::consts::TAU;
use std::path::Path;

/// Forward kinematics.
pub struct Forward<'a> {
    robot: &'a Robot,
    written: Written,
    /// What inverse kinematics is given beside a pose, written behind it.
    given: Vec<&'a str>,
}

impl<'a> Forward<'a> {
    /// Of this robot, with poses written so, and behind them the robot's parameters, if it has any.
    ///
    /// # Errors
    ///
    /// A parameter's name is that of a column of poses.
    pub fn new(path: &Path, robot: &'a Robot, written: Written) -> Result<Self, Fault> {
        let given = robot.parameter_names();
        let poses = written.columns();
        let clash = given
            .iter()
            .find(|name| poses.iter().any(|it| it.name == **name));
        if let Some(name) = clash {
            let reason = format!("the robot has a joint `{name}`, as the poses have a column");
            let remedy = "write the poses as matrices (`--matrix`), or give the joint another name";
            return Err(Fault::whole(path, reason, remedy));
        }
        Ok(Self {
            robot,
            written,
            given,
        })
    }

    fn joints(&self) -> impl Iterator<Item = (&str, JointLimit)> {
        let limits = self.robot.limits().iter().copied();
        self.robot.joint_names().into_iter().zip(limits)
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

/// What to do about a joint far beyond its stops.
pub const RADIANS: &str = "values are radians and metres, not degrees";

/// The first joint that is more than a turn beyond its stops, which degrees read as radians are, and
/// that it is.
pub fn beyond<'a>(
    joints: impl Iterator<Item = (&'a str, JointLimit)>,
    q: &[f64],
) -> Option<String> {
    let is_beyond = |limit: JointLimit, value: f64| match limit {
        JointLimit::Revolute { lower, upper } => value < lower - TAU || value > upper + TAU,
        JointLimit::Continuous | JointLimit::Prismatic { .. } => false,
    };
    let mut joints = joints.zip(q);
    let ((name, _), value) = joints.find(|((_, limit), value)| is_beyond(*limit, **value))?;
    let name = one_line(name);
    Some(format!(
        "joint `{name}` at {value} is more than a turn beyond its stops"
    ))
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
    // The names of a text stand without the spaces around them.
    let is_wanted = |&place: &usize| names[place].trim() == wanted.trim();
    let mut places = (0..names.len()).filter(is_wanted);
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
        let given = self.given.iter().map(|name| Column {
            name: (*name).into(),
            kind: Kind::Real,
        });
        self.written.columns().into_iter().chain(given).collect()
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
                if tally.first_beyond.is_none()
                    && let Some(joint) = beyond(self.joints(), &q)
                {
                    tally.first_beyond = Some((first + row as u64, joint));
                }
                let pose = self.robot.fk(&q);
                let given = match self.given.is_empty() {
                    true => Vec::new(),
                    false => self.robot.redundancy(&pose, &q),
                };
                let values = self.written.values(&pose).chain(given);
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
