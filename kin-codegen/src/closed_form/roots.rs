//! Of an arm with a parameter, what tells where its branches exist.

use super::ClosedForm;
use super::branches::inputs;
use crate::expr::Tape;
use crate::expr::inverse::InverseGraph;
use kin_runtime::__private::Eliminant;
use kin_runtime::Pose;

/// Where the branches of an arm with a parameter exist, by functions of the parameter.
#[derive(Clone, Debug)]
pub struct Domain {
    /// What the roots of an exact arm's plan are the roots of.
    arguments: Option<Arguments>,
    /// Of other plans, how far they are from having no root.
    margin: Option<Tape>,
}

#[derive(Clone, Debug)]
struct Arguments {
    tape: Tape,
    /// By root, whether it can be out of domain; outputs of the tape are those of these.
    roots: Vec<bool>,
}

/// All lanes of a tape: no plan of an arm with a parameter has more branches.
const LANES: usize = 16;

impl Domain {
    /// Of an arm with a parameter.
    pub fn of(form: &ClosedForm) -> Self {
        let exact = form.expressions().filter(|_| form.is_exact());
        let arguments = exact.and_then(InverseGraph::of_arguments);
        let arguments = arguments.map(|(inverse, roots)| Arguments {
            tape: Tape::new(&inverse.graph, &inverse.q),
            roots: roots.iter().map(Option::is_some).collect(),
        });
        let margin = match arguments {
            Some(_) => None,
            None => form.expressions().and_then(InverseGraph::of_margin),
        };
        let margin = margin.map(|inverse| Tape::new(&inverse.graph, &[inverse.residual]));
        Self { arguments, margin }
    }

    /// How many roots there are that have arguments.
    pub fn roots(&self) -> usize {
        self.arguments.as_ref().map_or(0, |it| it.roots.len())
    }

    /// See [`root_arguments`](kin_runtime::RedundantKinematics::root_arguments).
    pub fn arguments(
        &self,
        form: &ClosedForm,
        target: &Pose,
        parameters: &[f64],
    ) -> [[f64; 16]; 4] {
        let mut all = [[f64::INFINITY; 16]; 4];
        if let Some(arguments) = &self.arguments {
            let inputs = form.inputs(target, parameters);
            let values = arguments.tape.run::<LANES>(&inputs, 0);
            let own = all.iter_mut().zip(&arguments.roots);
            for (number, (to, _)) in own.filter(|(_, is_own)| **is_own).enumerate() {
                *to = *values.output(number);
            }
        }
        all
    }

    /// See [`margins_at`](kin_runtime::RedundantKinematics::margins_at).
    pub fn margins(
        &self,
        form: &ClosedForm,
        target: &Pose,
        parameters: &[f64],
    ) -> Option<[f64; 16]> {
        let tape = self.margin.as_ref()?;
        let values = tape.run::<LANES>(&form.inputs(target, parameters), 0);
        let mut margins = *values.output(0);
        margins[form.plan.branches()..].fill(0.0);
        Some(margins)
    }
}

impl ClosedForm {
    /// What an elimination leaves of a target, if one solves it, or tells what branches do not.
    pub fn eliminant(&self, target: &Pose, parameters: &[f64], which: usize) -> Option<Eliminant> {
        let arm = self
            .elimination()
            .filter(|_| self.is_told_by_elimination())?;
        let (carried, between) = self.carried(target, parameters);
        arm.at(between).eliminant(&carried, which)
    }

    /// What its expressions are computed from, with free joints at 0.
    fn inputs(&self, target: &Pose, parameters: &[f64]) -> Vec<f64> {
        let seed = vec![0.0; self.given.variables()];
        inputs(target, &seed, parameters, self.tolerances().free_below)
    }
}
