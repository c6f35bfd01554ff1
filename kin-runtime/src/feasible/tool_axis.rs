//! Arms whose last joint turns the tool about its own axis: all that a turn of the tool changes
//! is the value of that joint.

use super::arcs::Arc;
use super::task::Task;
use crate::linear::vector::norm;
use crate::{Parameter, RedundantKinematics};
use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, PI};

/// How far the joint's axis may be from the tool's, metres and radians: what rounding leaves.
const SAME: f64 = 1e-12;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The arcs of all branches, which go round; none of an arm whose last joint does more than
    /// turn the tool, or rests.
    pub fn turned_arcs(&self) -> Option<Vec<Arc>> {
        let sense = self.sense()?;
        let solutions = self.solutions(-PI);
        let arc = |q: &[f64; N]| {
            let point = |quarters: u8| {
                let turn = FRAC_PI_2 * f64::from(quarters);
                let mut x = self.point(q, turn - PI);
                x[self.coordinate(N - 1)] += sense * turn;
                x
            };
            Arc {
                points: (0..=4).map(point).collect(),
                is_closed: true,
            }
        };
        Some(solutions.iter().map(|found| arc(&found.q)).collect())
    }

    /// Whether the last joint turns the tool with the target, 1, or against it, −1.
    fn sense(&self) -> Option<f64> {
        let is_free = self.robot.held()[N - 1].is_none() && self.swivel.is_none();
        let (pose, spatial) = self.robot.fk_jacobian(&[0.0; N]);
        let twist = spatial.column(N - 1).spatial_to_body(&pose);
        let [x, y, z] = twist.angular;
        let off = norm(twist.linear) + norm([x, y, z.abs() - 1.0]);
        (self.of == Parameter::Turn && is_free && off <= SAME).then_some(z)
    }
}
