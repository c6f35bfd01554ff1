//! An arm with some of its joints held still.

use super::Model;
use kin_runtime::{Pose, Twist};

impl Model {
    /// The arm that is left when joints, ascending by their place in the chain, are
    /// held at values, radians and metres: a joint fewer for each. By the product of
    /// exponentials, what is behind a joint is displaced by e^(ξ̂ θ) and stands there
    /// at home.
    ///
    /// Of an arm whose joints mimic none; fixed links other than the tip are left out.
    pub fn locked(&self, joints: &[usize], values: &[f64]) -> Model {
        let mut displaced = Pose::IDENTITY;
        let mut left = Vec::new();
        let mut variables = Vec::new();
        for (i, joint) in self.joints.iter().enumerate() {
            let mut moved = joint.clone();
            moved.axis = displaced.rotate(joint.axis);
            moved.point = displaced.transform_point(joint.point);
            moved.frame = displaced * joint.frame;
            if let Some(k) = joints.iter().position(|&locked| locked == i) {
                displaced = exponential(&moved.twist(), values[k]) * displaced;
            } else {
                moved.variable = variables.len();
                variables.push(self.variables[joint.variable].clone());
                left.push(moved);
            }
        }
        Model {
            joints: left,
            variables,
            home: displaced * self.home,
            frames: Vec::new(),
            warnings: Vec::new(),
            ..self.clone()
        }
    }
}

/// e^(ξ̂ θ); exactly 1 where nothing moves.
fn exponential(twist: &Twist, value: f64) -> Pose {
    match value == 0.0 {
        true => Pose::IDENTITY,
        false => Pose::exp(twist, value),
    }
}
