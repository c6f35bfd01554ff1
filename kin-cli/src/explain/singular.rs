//! The singular configurations of an arm, and what its determinant takes.

use kin_codegen::expr::Operations;
use kin_codegen::expr::determinant::Rows;
use kin_codegen::geometry::Condition;
use kin_codegen::model::Model;
use kin_codegen::singularity::{self, Locus, Singular};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// The singular configurations.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Singularities {
    /// Which rows the determinant is of.
    pub determinant_of: String,
    /// What it takes.
    pub determinant: Operations,
    /// The largest difference to the determinant of the generic Jacobian on
    /// random configurations, relative to the largest value there; null if that
    /// Jacobian is not square.
    pub difference: Option<f64>,
    /// By how much the axes of the file are off the arm whose singularities
    /// these are, radians, and relative to its size; null if they are the
    /// file's own.
    pub idealized: Option<f64>,
    /// Each factor of the determinant.
    pub factors: Vec<Singularity>,
}

/// A factor of the determinant: where the arm is singular.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Singularity {
    /// Its name, as the generated function has it.
    pub name: String,
    /// What it is.
    pub meaning: &'static str,
    /// The coordinates that decide, from 1.
    pub coordinates: Vec<usize>,
    /// Radians or metres, if a single coordinate decides.
    pub values: Vec<f64>,
    /// Which of these are within the joint's limits.
    pub within_limits: Vec<bool>,
    /// A configuration, if several coordinates decide; null if none was seen.
    pub example: Option<Vec<f64>>,
    /// The conditions on the axes that hold throughout.
    pub conditions: Vec<AxesCondition>,
    /// What the values of the generated function are.
    pub unit: String,
    /// How often it is a factor of the determinant.
    pub power: usize,
}

/// A condition under which axes depend on each other, whatever the rest of the
/// arm is like.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxesCondition {
    /// What kind.
    pub kind: ConditionKind,
    /// Their numbers.
    pub joints: Vec<usize>,
    /// In words.
    pub text: String,
}

/// The conditions of Murray, Li and Sastry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ConditionKind {
    /// Two revolute axes on one line.
    Collinear,
    /// Three parallel revolute axes in one plane.
    ParallelCoplanar,
    /// Three revolute axes through one point and in one plane.
    Pencil,
    /// Four or more revolute axes through one point.
    Concurrent,
    /// Four or more revolute axes in one plane.
    Coplanar,
    /// A joint that slides square to the plane of two parallel revolute axes.
    SlideAcross,
    /// All axes meet one line.
    AllMeetALine,
}

impl AxesCondition {
    fn of(condition: &Condition) -> Self {
        let (kind, joints) = match condition {
            Condition::Collinear(joints) => (ConditionKind::Collinear, joints.to_vec()),
            Condition::ParallelCoplanar(joints) => {
                (ConditionKind::ParallelCoplanar, joints.to_vec())
            }
            Condition::Pencil(joints) => (ConditionKind::Pencil, joints.to_vec()),
            Condition::Concurrent(joints) => (ConditionKind::Concurrent, joints.to_vec()),
            Condition::Coplanar(joints) => (ConditionKind::Coplanar, joints.to_vec()),
            Condition::SlideAcross { parallel, slide } => {
                let joints = [&parallel[..], &[*slide]].concat();
                (ConditionKind::SlideAcross, joints)
            }
            Condition::AllMeetALine => (ConditionKind::AllMeetALine, (0..6).collect()),
        };
        Self {
            kind,
            joints: joints.into_iter().map(|i| i + 1).collect(),
            text: condition.to_string(),
        }
    }
}

impl Singularities {
    pub(super) fn of(model: &Model, singular: &Singular) -> Self {
        Self {
            determinant_of: match singular.determinant.rows {
                Rows::All => "the Jacobian".into(),
                Rows::Moving => "the rows of the Jacobian that are not zero everywhere".into(),
                Rows::Counting(target) => format!("the Jacobian's rows for {}", target.phrase()),
            },
            determinant: singular.cost(),
            difference: singular.difference,
            idealized: singular.idealized,
            factors: singular
                .singularities
                .iter()
                .map(|singularity| Singularity::of(model, singularity))
                .collect(),
        }
    }
}

impl Singularity {
    fn of(model: &Model, singularity: &singularity::Singularity) -> Self {
        let (values, example) = match &singularity.locus {
            Locus::Values(values) => (values.clone(), None),
            Locus::Surface(example) => (Vec::new(), Some(example.clone())),
            Locus::Never => (Vec::new(), None),
        };
        let within = |value: &f64| {
            let limits = singularity
                .coordinates
                .first()
                .and_then(|&i| model.variables[i].limits);
            limits.is_none_or(|[low, high]| {
                let turn = std::f64::consts::TAU;
                let turns = singularity
                    .coordinates
                    .first()
                    .is_some_and(|&i| model.turns(i));
                let full_turns = if turns {
                    vec![-turn, 0.0, turn]
                } else {
                    vec![0.0]
                };
                full_turns
                    .iter()
                    .any(|wound| (low..=high).contains(&(value + wound)))
            })
        };
        Self {
            name: singularity.name.clone(),
            meaning: singularity.phrase(),
            coordinates: singularity.coordinates.iter().map(|i| i + 1).collect(),
            within_limits: values.iter().map(within).collect(),
            values,
            example,
            conditions: singularity
                .conditions
                .iter()
                .map(AxesCondition::of)
                .collect(),
            unit: singularity.unit(),
            power: singularity.power,
        }
    }

    /// Where it is met.
    fn place(&self) -> String {
        let names: Vec<String> = self.coordinates.iter().map(|i| format!("q{i}")).collect();
        let mark = |(value, within): (&f64, &bool)| match within {
            true => format!("{value:.4}"),
            false => format!("{value:.4} (beyond its limits)"),
        };
        let values: Vec<String> = self
            .values
            .iter()
            .zip(&self.within_limits)
            .map(mark)
            .collect();
        match &self.example {
            _ if !values.is_empty() => format!("at {} = {}", names.concat(), values.join(" or ")),
            Some(example) => format!(
                "on a surface of {}, as at q = ({})",
                names.join(", "),
                vector_of(example)
            ),
            None => "nowhere that was looked".into(),
        }
    }
}

impl Display for Singularities {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "  Determinant of {}: {}",
            self.determinant_of, self.determinant
        )?;
        if let Some(idealized) = self.idealized {
            writeln!(
                f,
                "  Below are those of an arm with exact relations; the file's axes are within \
                 {idealized:.1e} of it, and so are its singularities."
            )?;
        }
        for singularity in &self.factors {
            writeln!(
                f,
                "  {}: {}, {}",
                singularity.name,
                singularity.meaning,
                singularity.place()
            )?;
            let conditions: Vec<&str> =
                singularity.conditions.iter().map(|c| &c.text[..]).collect();
            if !conditions.is_empty() {
                writeln!(f, "    {}", conditions.join("; "))?;
            }
        }
        if let Some(difference) = self.difference {
            writeln!(
                f,
                "  The determinant of the generic Jacobian is the product of their powers to \
                 {difference:.1e}; rank was seen to drop at each."
            )?;
        }
        Ok(())
    }
}

/// What is said of an arm whose Jacobian is not square.
pub(super) const NOT_SQUARE: &str = "  The Jacobian is not square: its rank is measured by its \
                                     singular values, or by the root of det(J Jᵀ) or det(Jᵀ J).";

/// What is said of an arm whose square Jacobian is singular everywhere.
pub(super) const DEFICIENT: &str = "  The Jacobian has less than full rank everywhere: where it has \
                                    still less is told by its singular values.";

/// What is said of an arm whose joints mimic each other.
pub(super) const COUPLED: &str = "  They are not looked for where joints mimic others: the rank of \
                                  the Jacobian is measured by its singular values.";

/// `0.3, -1.2`.
fn vector_of(values: &[f64]) -> String {
    let shown: Vec<String> = values.iter().map(|x| format!("{x:.3}")).collect();
    shown.join(", ")
}
