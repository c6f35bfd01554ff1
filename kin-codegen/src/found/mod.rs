//! What a search has found: all of an arm's inverse kinematics that does not follow from the arm.
//! The idealized arm, the expressions and their tape are built from it again without a search or a
//! certificate, and are the same to the last bit.

mod bytes;
mod cache;

pub(crate) use cache::Entry;

use crate::certificate::Certificate;
use crate::closed_form::{ClosedForm, Reading, Refinement};
use crate::expr::Multiplicative;
use crate::expr::inverse::FreeJoints;
use crate::geometry::{Linkage, idealize, solved_chain};
use crate::model::Model;
use crate::plan::{Plan, Step, Subproblem};
use crate::redundancy::Redundancy;
use crate::solver::Certified;
use crate::univariate;
use bytes::Bytes;
use std::hash::{Hash, Hasher};
use std::sync::OnceLock;

/// What was found for an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Of the relations that pose a step, the one that was written.
    plan: Plan,
    free: FreeJoints,
    /// By which relations were read into the axes.
    tolerance: f64,
    /// What the arm is solved by, or has beside its branches.
    elimination: Option<univariate::Arm>,
    certificate: Certificate,
    redundancy: Option<Redundancy>,
    /// A hash of the expressions that were certified.
    expressions: u64,
}

impl Found {
    /// What is to be kept of a closed form.
    pub fn of(certified: &Certified, redundancy: Option<&Redundancy>) -> Self {
        let Certified { form, certificate } = certified;
        let parts = form.expressions().map(|inverse| &inverse.parts.steps);
        let written = |(i, step): (usize, &Step)| {
            let relation = parts.and_then(|parts| step.relations.get(parts[i].relation?));
            Step {
                relations: relation.cloned().into_iter().collect(),
                ..step.clone()
            }
        };
        Self {
            plan: Plan {
                steps: form.plan.steps.iter().enumerate().map(written).collect(),
                target: form.plan.target,
            },
            free: form.free.clone(),
            tolerance: form.idealized.tolerance,
            elimination: form.elimination().cloned(),
            certificate: *certificate,
            redundancy: redundancy.cloned(),
            expressions: hash(form),
        }
    }

    /// The closed form of the arm that this was found for; none if this crate writes it as other
    /// expressions than were certified, because it was changed since.
    pub fn built(&self, model: &Model, linkage: &Linkage) -> Option<Certified> {
        if model.is_coupled() {
            let given = self.redundancy.as_ref().map(|it| it.joints.len());
            let (model, linkage) = solved_chain(model, given)?;
            return self.built(&model, &linkage);
        }
        let given = match &self.redundancy {
            Some(redundancy) => linkage
                .clone()
                .with_locked(&redundancy.joints)
                .with_swivel(redundancy.swivel),
            None => linkage.clone(),
        };
        let Plan { steps, target } = &self.plan;
        let is_eliminated = |step: &Step| step.subproblem == Subproblem::Univariate;
        let elimination = self.elimination.clone();
        let form = match elimination {
            Some(arm) if steps.iter().any(is_eliminated) => {
                ClosedForm::eliminating(model, &given, *target, arm)
            }
            elimination => {
                let idealized = idealize(model, self.tolerance);
                let reading = Reading::new(model, &given, idealized, *target)?;
                let form = reading.form(&self.plan, self.free.clone());
                let refinement = match elimination {
                    Some(arm) => Refinement::Univariate(Box::new(arm)),
                    None => form.refinement,
                };
                ClosedForm { refinement, ..form }
            }
        };
        let is_certified = hash(&form) == self.expressions;
        is_certified.then_some(Certified {
            form,
            certificate: self.certificate,
        })
    }

    /// What the arm takes beside a target.
    pub fn redundancy(&self) -> Option<&Redundancy> {
        self.redundancy.as_ref()
    }

    /// What its bytes are: names and types, which tell them from those of other versions.
    fn layout() -> &'static str {
        static LAYOUT: OnceLock<String> = OnceLock::new();
        LAYOUT.get_or_init(|| {
            let mut layout = String::new();
            <Self as Bytes>::layout(&mut layout);
            layout
        })
    }

    /// As bytes, which whoever has the same layout reads.
    fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.write(&mut bytes);
        bytes
    }

    /// From all of some bytes; none if they are none of these.
    fn from_bytes(mut bytes: &[u8]) -> Option<Self> {
        let found = Self::read(&mut bytes)?;
        bytes.is_empty().then_some(found)
    }
}

/// Of the expressions of a closed form, node by node.
fn hash(form: &ClosedForm) -> u64 {
    let mut hasher = Multiplicative::default();
    if let Some(inverse) = form.expressions() {
        inverse.graph.nodes().hash(&mut hasher);
        inverse.outputs().hash(&mut hasher);
    }
    hasher.finish()
}
