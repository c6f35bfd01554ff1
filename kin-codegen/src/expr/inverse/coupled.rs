//! From the values of joints to the coordinates of q that they depend on.

use super::Writer;
use crate::expr::Expr;
use crate::expr::forward;
use crate::geometry::Coupling;

impl Writer<'_> {
    /// The coordinates from the values of the joints; angles in (−π, π], or about the middle of
    /// their limits where they do not repeat.
    pub(super) fn coordinates(&mut self, coupling: &Coupling) -> Vec<Expr> {
        let mut q = vec![self.g.zero(); coupling.limits.len()];
        for inverse in &coupling.inverse {
            let (row, coordinate) = (&coupling.rows[inverse.joint], inverse.coordinate);
            let value = self.joint_value(coupling.given + inverse.joint);
            // Those that are not known yet have no weight.
            let about = self.g.constant(inverse.about.unwrap_or(0.0));
            q[coordinate] = about;
            let there = forward::combination(&mut self.g, row, &q);
            let beside = self.g.sub(value, there);
            // Of one that turns backwards, too, in (−π, π].
            let weight = row.weights[coordinate];
            let forwards = if weight < 0.0 {
                self.g.neg(beside)
            } else {
                beside
            };
            let within = match inverse.about {
                Some(_) => self.g.wrap(forwards),
                None => forwards,
            };
            let beside = self.scaled(1.0 / weight.abs(), within);
            let own = self.g.add(about, beside);
            q[coordinate] = self
                .g
                .named(own, format!("q{}", coupling.given + coordinate + 1));
        }
        q
    }

    /// How far dependent joints are from where the coordinates have them, by how far
    /// that moves the tip at most, with orientation as a length.
    pub(super) fn disagreement(&mut self) -> Expr {
        let linkage = self.linkage;
        let mut sum = self.g.zero();
        let Some(coupling) = &linkage.coupling else {
            return sum;
        };
        let joints = 0..coupling.rows.len();
        let dependent: Vec<usize> = joints.filter(|&it| !coupling.is_independent(it)).collect();
        if dependent.is_empty() {
            return sum;
        }
        let q = self.coordinates(coupling);
        for joint in dependent {
            let found = self.joint_value(coupling.given + joint);
            let wanted = forward::combination(&mut self.g, &coupling.rows[joint], &q);
            let mut apart = self.g.sub(found, wanted);
            if linkage.is_revolute(coupling.given + joint) {
                apart = self.g.wrap(apart);
                apart = self.scaled(2.0 * linkage.size, apart);
            }
            let minus = self.g.neg(apart);
            let apart = self.g.max(apart, minus);
            sum = self.g.add(sum, apart);
        }
        sum
    }
}
