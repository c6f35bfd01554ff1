//! Arms whose last joint that moves turns the tool about its own axis: all that a turn of the tool
//! changes is the value of that joint.

use super::arcs::Arc;
use super::task::{Place, Task, WIDTH};
use crate::linear::vector::norm;
use crate::{Parameter, RedundantKinematics};
use alloc::vec::Vec;
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

/// How far the joint's axis may be from the tool's, metres and radians: what rounding leaves.
const SAME: f64 = 1e-12;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The arcs of all branches, which go round; none of an arm whose last joint does more than
    /// turn the tool.
    pub fn turned_arcs(&self) -> Option<Vec<Arc>> {
        let last = self.moving().len().checked_sub(1)?;
        let sense = self.sense(self.moving()[last])?;
        let solutions = self.solutions(-PI);
        let mut tangent = [0.0; WIDTH];
        (tangent[last], tangent[self.parameter]) = (sense * FRAC_1_SQRT_2, FRAC_1_SQRT_2);
        let arc = |q: &[f64; N]| {
            let place = |quarters: u8| {
                let turn = FRAC_PI_2 * f64::from(quarters);
                let mut x = self.point(q, turn - PI);
                x[last] += sense * turn;
                Place { x, tangent }
            };
            Arc {
                points: (0..=4).map(place).collect(),
                is_closed: true,
            }
        };
        Some(solutions.iter().map(|found| arc(&found.q)).collect())
    }

    /// Whether a joint behind which none moves turns the tool with the target, 1, or against it, −1.
    fn sense(&self, joint: usize) -> Option<f64> {
        let (pose, spatial) = self.robot.fk_jacobian(&self.q(&[0.0; WIDTH]));
        let twist = spatial.column(joint).spatial_to_body(&pose);
        let [x, y, z] = twist.angular;
        let off = norm(twist.linear) + norm([x, y, z.abs() - 1.0]);
        let is_turn = self.of == Parameter::Turn && self.swivel.is_none();
        (is_turn && off <= SAME).then_some(z)
    }
}
