//! Configurations in which a step of a plan degenerates, since what it divides by vanishes.

use super::alignment;
use super::held::{Held, Made, Trial};
use super::trials::Trials;
use super::vanishing::{Driven, OnBranch, Quantity};
use crate::closed_form::ClosedForm;
use crate::expr::inverse::{InverseGraph, Turn};
use crate::geometry::SINGULAR;
use crate::model::{anywhere, spread};
use crate::random::Random;
use kin_runtime::Pose;
use std::collections::BTreeSet;
use std::rc::Rc;

/// Starts from which what a plan divides by is driven to zero; one less for each value of the locked
/// joints.
const STARTS: usize = 3;
/// Where a step degenerates and the arm is singular, so many configurations of its other joints are
/// tried: a joint that is free may leave later steps a root for some of them alone.
const SINGULAR_ONES: usize = 12;

impl Trials<'_> {
    /// Configurations in which what a plan divides by vanishes, and next to these; where the arm is
    /// singular there, with the joints elsewhere that do not matter for it.
    pub(super) fn vanishing(&self, form: &ClosedForm) -> Vec<(usize, Rc<Trial>)> {
        let mut random = Random(0x1b87_3593_cc9e_2d51);
        let quantities = form.expressions().map(InverseGraph::divisors);
        let quantities = quantities.unwrap_or_default();
        let mut all = Vec::new();
        for (number, held) in self.held.iter().enumerate() {
            let trial = |q| held.trial(self.linkage, self.target, q, Made::Aligned);
            let (mut exact, mut singular) = (Vec::new(), Vec::new());
            for Driven { q, is_moved } in self.driven(form, held, &quantities, &mut random) {
                if trial(q.clone()).conditioning < SINGULAR {
                    let elsewhere = |_| {
                        let other = anywhere(&held.model, &mut random);
                        let other = self.linkage.coordinates_at(other).into_iter();
                        let each = other.zip(&q).zip(&is_moved);
                        each.map(|((other, &q), is_moved)| if *is_moved { q } else { other })
                            .collect()
                    };
                    singular.extend((0..SINGULAR_ONES).map(elsewhere).map(trial));
                }
                exact.push(q);
            }
            let beside = alignment::neighbours(&exact);
            let trials = exact.into_iter().chain(beside).map(trial);
            for trial in trials.filter(|trial| trial.conditioning > SINGULAR) {
                all.push((number, trial.rounded(&mut random)));
                all.push((number, trial));
            }
            all.extend(singular.into_iter().map(|trial| (number, trial)));
        }
        all
    }

    /// Of the joints that may be free those that matter: what their steps divide by vanishes where
    /// the arm is singular, and a later root depends on them there.
    pub fn turns_that_matter(&self, form: &ClosedForm) -> Vec<Turn> {
        let Some(graph) = form.expressions() else {
            return Vec::new();
        };
        let turns: Vec<Turn> = graph.free_joints.iter().map(|it| it.turn).collect();
        let steps: BTreeSet<usize> = turns.iter().map(|turn| turn.step).collect();
        let mut matter = BTreeSet::new();
        for step in steps {
            let of_step = |&i: &usize| turns[i].step == step;
            let mut unseen: Vec<usize> = (0..turns.len()).filter(of_step).collect();
            for (target, parameters) in self.singular_targets(form, &graph.divisors_of(step)) {
                let depends = |&mut i: &mut usize| form.depends_on(i, &target, &parameters);
                matter.extend(unseen.extract_if(.., depends));
                if unseen.is_empty() {
                    break;
                }
            }
        }
        matter.into_iter().map(|i| turns[i]).collect()
    }

    /// Targets, and what comes with them, of singular configurations in which what a plan divides by
    /// vanishes.
    fn singular_targets(
        &self,
        form: &ClosedForm,
        quantities: &[Quantity],
    ) -> impl Iterator<Item = (Pose, Vec<f64>)> {
        let linkage = self.linkage;
        let mut random = Random(0x5851_f42d_4c95_7f2d);
        self.held.iter().flat_map(move |held| {
            let driven = self.driven(form, held, quantities, &mut random).into_iter();
            let is_singular =
                |q: &Vec<f64>| linkage.conditioning(&held.chain, q, self.target) < SINGULAR;
            let singular = driven.map(|driven| driven.q).filter(is_singular);
            let asked = |q: Vec<f64>| (held.fk(linkage, &q), held.parameters(linkage, &q));
            singular.map(asked).collect::<Vec<_>>()
        })
    }

    /// Configurations to which what a plan divides by is driven to zero.
    fn driven(
        &self,
        form: &ClosedForm,
        held: &Held,
        quantities: &[Quantity],
        random: &mut Random,
    ) -> Vec<Driven> {
        let starts = STARTS - usize::from(!self.linkage.locked.is_empty());
        let starts = spread(&held.model, starts, random).into_iter();
        let starts = starts.map(|joints| self.linkage.coordinates_at(joints));
        let on = OnBranch {
            form,
            model: &held.model,
            // Differences of a target in single precision would be its rounding.
            asked: |q: &[f64]| (held.fk(self.linkage, q), held.parameters(self.linkage, q)),
        };
        on.vanishing(quantities, &starts.collect::<Vec<_>>())
    }
}
