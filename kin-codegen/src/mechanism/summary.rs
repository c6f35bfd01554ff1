//! A few words for the mechanism's documentation and the header of its code.

use super::compiled::CompiledMechanism;
use super::explain::{method, target};
use super::inverse::LegForm;

impl CompiledMechanism {
    /// What the documentation of the type says, in Markdown lines.
    pub(crate) fn documentation(&self) -> Vec<String> {
        let mechanism = &self.mechanism;
        let legs = mechanism
            .legs
            .iter()
            .map(|leg| format!("`{}` ({})", leg.name, leg.structure()));
        let legs: Vec<String> = legs.collect();
        let mut lines = vec![
            format!(
                " The mechanism `{}` from `{}` to `{}`, compiled from `{}`.",
                mechanism.name, mechanism.base, mechanism.platform, self.path
            ),
            String::new(),
            format!(" Chains: {}.", legs.join(", ")),
            format!(" Actuated: {}.", self.actuated().join(", ")),
            format!(
                " Mobility {} by rank, {} by Grübler's formula.",
                self.freedom.mobility, self.freedom.gruebler
            ),
            String::new(),
        ];
        match &self.inverse {
            Some(inverse) => {
                lines.push(format!(" Inverse kinematics: {}.", self.plans()));
                let target = target(self, inverse.aim);
                lines.push(format!(" Targets are {target}."));
            }
            None => lines.push(" Generated without inverse kinematics (`ik = none`).".into()),
        }
        lines.push(String::new());
        let method = method(&self.forward);
        lines.push(format!(" Forward kinematics by {method}."));
        lines
    }

    /// The lines of the header, without comment marks.
    pub(crate) fn header(&self) -> Vec<String> {
        let mechanism = &self.mechanism;
        let mut lines = vec![format!(
            "{} to {}, {} chains, {} joints, {} actuated.",
            mechanism.base,
            mechanism.platform,
            mechanism.legs.len(),
            mechanism.joints(),
            mechanism.actuated().len()
        )];
        if self.inverse.is_some() {
            lines.push(format!("Inverse kinematics: {}.", self.plans()));
        }
        lines.push(format!("Forward kinematics: {}.", method(&self.forward)));
        lines
    }

    fn actuated(&self) -> Vec<String> {
        let legs = self.mechanism.legs.iter();
        let names = legs.flat_map(|leg| leg.actuated_names());
        names.map(|name| format!("`{name}`")).collect()
    }

    /// The plan of every chain.
    fn plans(&self) -> String {
        let plans = self.inverse.iter().flat_map(|inverse| &inverse.legs);
        let legs = self.mechanism.legs.iter().zip(plans.map(LegForm::plan));
        let plans: Vec<String> = legs
            .map(|(leg, plan)| format!("{} by {plan}", leg.name))
            .collect();
        plans.join("; ")
    }
}
