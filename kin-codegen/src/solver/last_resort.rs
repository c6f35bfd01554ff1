//! Arms without a plan.

use super::{CHOICES, Certified, Lack, NoClosedForm, better};
use crate::certificate::{Failure, Trials, certify};
use crate::closed_form::ClosedForm;
use crate::plan::Target;
use crate::scalar::Scalar;
use crate::univariate;

/// A polynomial in one joint, for an arm that the subproblems do not solve.
pub(super) fn last_resort(
    trials: &Trials,
    target: Target,
    refusal: NoClosedForm,
) -> Result<Certified, NoClosedForm> {
    let linkage = trials.linkage();
    if linkage.scalar == Scalar::F32 {
        return Err(match refusal {
            NoClosedForm::NoPlan(_) => NoClosedForm::OnlyInDouble(Lack::Polynomial),
            NoClosedForm::Uncertified {
                failure: Failure::Lost(_),
                ..
            } => NoClosedForm::OnlyInDouble(Lack::Digits),
            other => other,
        });
    }
    let arm = univariate::Arm::of_targets(trials.model(), linkage, target);
    let Some(arm) = arm else {
        return Err(refusal);
    };
    let eliminating = |arm| ClosedForm::eliminating(trials.model(), linkage, target, arm);
    let mut refusal = refusal;
    let mut best: Option<Certified> = None;
    let mut asked: Vec<univariate::Arm> = Vec::new();
    let mut next = arm;
    // What some lose others may find.
    while !asked.contains(&next) && asked.len() < CHOICES {
        asked.push(next.clone());
        let form = eliminating(next.clone());
        match certify(trials, &form, usize::MAX) {
            Ok(certificate) => {
                let done = certificate.lost == 0;
                best = better(best, Certified { form, certificate });
                if done {
                    break;
                }
            }
            Err(failure) => {
                let plan = form.plan.to_string();
                refusal = NoClosedForm::Uncertified { plan, failure };
            }
        }
        let alone = next.alone();
        let lost = alone.map(|arm| trials.lost_again(&eliminating(arm)));
        next = next.losing_fewest(&lost.collect::<Vec<_>>());
    }
    best.ok_or(refusal)
}
