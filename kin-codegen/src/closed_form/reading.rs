//! An arm with relations read into its axes, and the closed forms of the plans for it.

use super::{ClosedForm, Inverse, Refinement};
use crate::expr::inverse::{FreeJoints, TipShift, inverse};
use crate::geometry::{Idealized, Linkage, Swivel, size};
use crate::model::{Model, configurations, place};
use crate::plan::{Plan, Target};
use crate::scalar::Scalar;
use crate::single;
use kin_runtime::__private::Projection;
use std::f64::consts::PI;

/// Axes of an idealized arm meet to this, in radians and of its size.
const EXACT: f64 = 1e-11;

/// An idealized arm beside the given one.
pub struct Reading {
    idealized: Idealized,
    /// Its frames.
    pub linkage: Linkage,
    /// The frames of the arm as given.
    given: Linkage,
    /// How far apart the tips of the two are, metres.
    tip_shift: f64,
    target: Target,
    single: Option<single::Forward>,
}

impl Reading {
    /// None if the swivel angle comes with the target, and the idealized arm has none.
    pub fn new(
        model: &Model,
        given: &Linkage,
        idealized: Idealized,
        target: Target,
    ) -> Option<Self> {
        let swivel = match given.swivel {
            Some(_) => Some(Swivel::of(&idealized.model, EXACT)?),
            None => None,
        };
        let linkage = Linkage::for_target(&idealized.model, target)
            .with_locked(&given.locked)
            .with_swivel(swivel)
            .with_coupling(given.coupling.clone());
        let single = (linkage.scalar == Scalar::F32).then(|| match &given.coupling {
            Some(coupling) => single::Forward::new(&coupling.whole, given.variables()),
            None => single::Forward::new(given, model.variables.len()),
        });
        Some(Self {
            tip_shift: tip_shift(model, &idealized.model, &given.projection(target)),
            idealized,
            linkage,
            given: given.clone(),
            target,
            single,
        })
    }

    /// The idealized arm.
    pub fn model(&self) -> &Model {
        &self.idealized.model
    }

    /// Whether the arm as given has the relations exactly.
    pub fn is_exact(&self) -> bool {
        self.tip_shift < self.linkage.unmoved(self.target)
    }

    /// The closed form by a plan.
    pub fn form(&self, plan: &Plan, free: FreeJoints) -> ClosedForm {
        let shift = TipShift {
            relative: self.tip_shift / self.linkage.size,
            is_refined: !self.is_exact(),
        };
        let inverse = inverse(&self.linkage, plan, shift, &free);
        ClosedForm {
            idealized: self.idealized.clone(),
            linkage: self.linkage.clone(),
            given: self.given.clone(),
            plan: plan.clone(),
            free,
            inverse: Inverse::Expressions(Box::new(inverse)),
            tip_shift: self.tip_shift,
            refinement: Refinement::Correction,
            single: self.single.clone(),
        }
    }
}

/// A slide that nothing stops goes so many times the arm's size for each metre that it is tried at.
const FAR: f64 = 20.0;

/// How often all joints are taken to where the tips are farthest apart, out of so many places.
const ROUNDS: usize = 3;
const PLACES: usize = 16;

/// How far apart the tips of two arms get as targets see them, with orientation as a length at
/// the distance of the arm's size; metres. From the worst of many configurations one joint after the
/// other is taken to where they are farthest apart.
pub(crate) fn tip_shift(given: &Model, idealized: &Model, seen: &Projection) -> f64 {
    let (a, b) = (given.chain(), idealized.chain());
    let size = size(given);
    let is_unstopped = |i: &usize| !given.turns(*i) && given.variables[*i].travel().is_none();
    let unstopped: Vec<usize> = (0..given.variables.len()).filter(is_unstopped).collect();
    let apart = |q: &[f64]| {
        let mut q = q.to_vec();
        unstopped.iter().for_each(|&i| q[i] *= FAR * size);
        let [a, b] = [&a, &b].map(|chain| seen.pose(&chain.fk(&q)));
        seen.counts.distance(&a, &b, size)
    };
    let mut worst = (0.0, Vec::new());
    let farther = |q: &[f64], worst: &mut (f64, Vec<f64>)| {
        let shift = apart(q);
        if shift > worst.0 {
            *worst = (shift, q.to_vec());
        }
    };
    for q in configurations(given) {
        farther(&q, &mut worst);
    }
    for _ in 0..ROUNDS {
        for i in 0..worst.1.len() {
            let mut q = worst.1.clone();
            for k in 0..PLACES {
                q[i] = place(given, i, PI * (2.0 * k as f64 / PLACES as f64 - 1.0));
                farther(&q, &mut worst);
            }
        }
    }
    worst.0
}
