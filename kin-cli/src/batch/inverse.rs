//! All solutions to poses, row by row.

use super::forward::joint;
use super::pose::PoseColumns;
use super::task::{Tally, Task};
use crate::table::{Column, Fault, Header, Kind, Values};
use kinematics::{Answer, Robot};
use std::f64::consts::TAU;
use std::path::Path;

/// Which solutions are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    /// Those within the joints' limits alone.
    pub within_limits: bool,
    /// A row for each target without a solution, too.
    pub empty: bool,
}

/// Inverse kinematics.
pub struct Inverse<'a> {
    robot: &'a Robot,
    /// What is given beside all targets; if nothing is, columns have it.
    at: &'a [f64],
    kept: Kept,
    poses: PoseColumns,
}

/// What columns of answers are called beside the joints'.
const TARGET: &str = "target";
const BRANCH: &str = "branch";
const OTHERS: [&str; 3] = ["residual", "within_limits", "singular"];

/// The branch of a row that stands for no solution.
const NONE: i64 = -1;

impl<'a> Inverse<'a> {
    /// For poses in the columns of a file.
    ///
    /// # Errors
    ///
    /// They are not there, or a joint's name is that of another column of the answers.
    pub fn new(
        robot: &'a Robot,
        at: &'a [f64],
        kept: Kept,
        path: &Path,
        header: &Header,
    ) -> Result<(Self, Vec<usize>), Fault> {
        let joints = robot.joint_names();
        let is_taken = |name: &&str| OTHERS.contains(name) || [TARGET, BRANCH].contains(name);
        if let Some(name) = joints.into_iter().find(is_taken) {
            let reason = format!("the robot has a joint `{name}`, as the answers have a column");
            return Err(Fault::whole(path, reason, "give the joint another name"));
        }
        let given = if at.is_empty() {
            robot.parameter_names()
        } else {
            Vec::new()
        };
        let poses = PoseColumns::find(path, header, robot.target(), &given)?;
        let mut selected = poses.selected.clone();
        match header {
            Header::Names(names) => {
                for name in given {
                    let place = joint(path, names, name).map_err(|fault| Fault {
                        remedy: format!(
                            "let a column `{name}` have what is given beside each target, or give \
                             it for all by `--at`"
                        ),
                        ..fault
                    })?;
                    selected.push(place);
                }
            }
            Header::Width(width) => selected.extend(width - given.len()..*width),
        }
        let inverse = Self {
            robot,
            at,
            kept,
            poses,
        };
        Ok((inverse, selected))
    }

    /// The joint values of a solution, turned by whole turns into the limits where these lead
    /// there, and whether they are inside. What rests on a stop but for rounding stays as it was
    /// found, for which its residual is.
    fn inside(&self, q: &[f64], wound: &mut Vec<f64>) -> bool {
        wound.clear();
        let limits = self.robot.limits().iter();
        wound.extend(limits.zip(q).map_while(|(limit, &value)| {
            let turns = (limit.nearest(value, value)? - value) / TAU;
            Some(value + TAU * turns.round())
        }));
        let is_inside = wound.len() == q.len();
        if !is_inside {
            wound.clear();
            wound.extend(q);
        }
        is_inside
    }
}

/// Columns that fill.
#[derive(Default)]
struct Answers {
    target: Vec<i64>,
    branch: Vec<i64>,
    joints: Vec<Vec<f64>>,
    residual: Vec<f64>,
    within_limits: Vec<bool>,
    singular: Vec<bool>,
}

impl Answers {
    fn push(&mut self, target: u64, q: &[f64], answer: &Answer, is_inside: bool) {
        self.target.push(target as i64);
        self.branch.push(i64::from(answer.branch));
        for (column, value) in self.joints.iter_mut().zip(q) {
            column.push(*value);
        }
        self.residual.push(answer.residual);
        self.within_limits.push(is_inside);
        self.singular.push(answer.singular);
    }

    fn push_none(&mut self, target: u64) {
        self.target.push(target as i64);
        self.branch.push(NONE);
        self.joints
            .iter_mut()
            .for_each(|column| column.push(f64::NAN));
        self.residual.push(f64::NAN);
        self.within_limits.push(false);
        self.singular.push(false);
    }

    fn columns(self) -> Vec<Values> {
        let ends = [Values::Integer(self.target), Values::Integer(self.branch)];
        let joints = self.joints.into_iter().map(Values::Real);
        let others = [
            Values::Real(self.residual),
            Values::Truth(self.within_limits),
            Values::Truth(self.singular),
        ];
        ends.into_iter().chain(joints).chain(others).collect()
    }
}

impl Task for Inverse<'_> {
    fn columns(&self) -> Vec<Column> {
        let column = |name: &str, kind| Column {
            name: name.into(),
            kind,
        };
        let ends = [TARGET, BRANCH].map(|name| column(name, Kind::Integer));
        let joints = self.robot.joint_names().into_iter();
        let joints = joints.map(|name| column(name, Kind::Real));
        let others = OTHERS
            .into_iter()
            .zip([Kind::Real, Kind::Truth, Kind::Truth]);
        let others = others.map(|(name, kind)| column(name, kind));
        ends.into_iter().chain(joints).chain(others).collect()
    }

    fn run(&self, first: u64, columns: &[Vec<f64>]) -> (Vec<Values>, Tally) {
        let rows = columns.first().map_or(0, Vec::len);
        let given = &columns[self.poses.selected.len()..];
        let mut tally = Tally {
            rows: rows as u64,
            ..Tally::default()
        };
        let mut answers = Answers {
            joints: vec![Vec::new(); self.robot.joints()],
            ..Answers::default()
        };
        let mut wound = Vec::new();
        let mut parameters = self.at.to_vec();
        for row in 0..rows {
            let target = first + row as u64;
            if self.at.is_empty() {
                parameters.clear();
                parameters.extend(given.iter().map(|column| column[row]));
            }
            let is_given = parameters.iter().all(|value| value.is_finite());
            let before = answers.target.len();
            match self.poses.pose(columns, row) {
                Ok(pose) if is_given => {
                    for answer in self.robot.ik_at(&pose, &parameters).iter() {
                        let is_inside = self.inside(answer.q, &mut wound);
                        if is_inside || !self.kept.within_limits {
                            answers.push(target, &wound, &answer, is_inside);
                        }
                    }
                    tally.unsolved += u64::from(answers.target.len() == before);
                }
                Ok(_) => tally.fault(target, "what is given beside the target is missing"),
                Err(reason) => tally.fault(target, reason),
            }
            if self.kept.empty && answers.target.len() == before {
                answers.push_none(target);
            }
        }
        (answers.columns(), tally)
    }
}
