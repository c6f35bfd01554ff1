//! How a mechanism is solved, in words.

use super::compiled::CompiledMechanism;
use super::forward::ForwardMethod;
use super::inverse::{Aim, LegForm};

impl ForwardMethod {
    /// How forward kinematics is found, in words.
    pub fn method(&self) -> String {
        match self {
            ForwardMethod::Loop(found) => format!(
                "closed form: the passive joints around the loop are a serial chain between ends \
                 that the actuated ones place, solved by {}",
                found
                    .passive
                    .form()
                    .map_or_else(String::new, |form| form.plan.to_string())
            ),
            ForwardMethod::Spheres(rods) => format!(
                "closed form: the platform translates at {} from points that the actuators place, \
                 so its position is where three spheres meet (assembly modes with the platform \
                 turned, in another mode of its joints, are left out)",
                rods.iter()
                    .map(|rod| format!("{:.4} m", rod.length))
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
            ForwardMethod::Newton => {
                "Newton's method on the structure equation, from a seed, in at most 60 steps".into()
            }
        }
    }
}

impl CompiledMechanism {
    /// What of a target inverse kinematics reads, in words; none without
    /// inverse kinematics. `quoted` writes the name of a chain.
    pub fn targets(&self, quoted: impl Fn(&str) -> String) -> Option<String> {
        Some(match self.inverse.as_ref()?.aim {
            Aim::Pose => "whole poses of the platform".into(),
            Aim::Translation => "positions of the platform, which does not turn: the rotation of \
                                 a target is not read"
                .into(),
            Aim::Lead(leg) => format!(
                "positions of the platform, which fix the chain {}: the rotation of a target is \
                 not read, and comes of it",
                quoted(&self.mechanism.legs[leg].name)
            ),
        })
    }

    /// The plan of every chain.
    pub fn plans(&self) -> String {
        let plans = self.inverse.iter().flat_map(|inverse| &inverse.legs);
        let legs = self.mechanism.legs.iter().zip(plans.map(LegForm::plan));
        let plans: Vec<String> = legs
            .map(|(leg, plan)| format!("{} by {plan}", leg.name))
            .collect();
        plans.join("; ")
    }
}
