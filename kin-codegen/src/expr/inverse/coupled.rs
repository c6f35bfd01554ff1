//! From the values of joints to the coordinates of q that they depend on.

use super::Writer;
use crate::expr::Expr;
use crate::expr::forward;
use crate::expr::linear::Trig;
use crate::geometry::Coupling;
use crate::model::JointKind;

/// A joint that was found farther than this from where the coordinates have it, as a square, is on
/// another branch.
const ELSEWHERE: f64 = 1e-4;

impl Writer<'_> {
    /// The coordinates that the joints tell; angles in (−π, π], or about the middle of their limits
    /// where they do not repeat.
    pub(super) fn told(&mut self, coupling: &Coupling) -> Vec<Expr> {
        let mut q = vec![self.g.zero(); coupling.limits.len()];
        for told in &coupling.told {
            let (row, coordinate) = (&coupling.rows[told.joint], told.coordinate);
            let value = self.joint_value(told.joint);
            // Those that are not known yet have no weight.
            let about = self.g.constant(told.about.unwrap_or(0.0));
            q[coordinate] = about;
            let there = forward::combination(&mut self.g, row, &q);
            let mut beside = self.g.sub(value, there);
            if told.about.is_some() {
                beside = self.g.wrap(beside);
            }
            let share = self.g.constant(1.0 / row.weights[coordinate]);
            let beside = self.g.mul(share, beside);
            let own = self.g.add(about, beside);
            q[coordinate] = self.g.named(own, format!("q{}", coordinate + 1));
        }
        q
    }

    /// Joints that tell no coordinate are where the coordinates have them, also in the residual. A
    /// branch that found one elsewhere repeats another, unless its angle was free.
    pub(super) fn agree(&mut self) {
        let linkage = self.linkage;
        let Some(coupling) = &linkage.coupling else {
            return;
        };
        let silent = (0..coupling.rows.len()).filter(|&joint| !coupling.tells(joint));
        let silent: Vec<usize> = silent.collect();
        if silent.is_empty() {
            return;
        }
        let q = self.told(coupling);
        for joint in silent {
            let link = &linkage.links[joint];
            let value = forward::combination(&mut self.g, &coupling.rows[joint], &q);
            let moved = forward::joint_value(&mut self.g, link.gain, link.offset, value);
            let apart = match link.kind {
                JointKind::Prismatic => {
                    let found = self.slide[joint].replace(moved).unwrap_or(moved);
                    let apart = self.g.sub(found, moved);
                    vec![self.scaled(linkage.size.recip(), apart)]
                }
                JointKind::Revolute => {
                    let (sin, cos) = self.g.sin_cos(moved);
                    let trig = Trig { sin, cos };
                    let found = self.trig[joint].replace(trig).unwrap_or(trig);
                    self.sum_first[linkage.run_of(joint)] = false;
                    vec![self.g.sub(found.sin, sin), self.g.sub(found.cos, cos)]
                }
            };
            let [zero, one] = [self.g.zero(), self.g.one()];
            let squares = apart.into_iter().map(|x| self.g.square(x));
            let squares: Vec<Expr> = squares.collect();
            let square = squares.into_iter().fold(zero, |a, b| self.g.add(a, b));
            let elsewhere = self.g.constant(ELSEWHERE);
            let repeats = self.g.select_less(elsewhere, square, one, zero);
            let repeats = self.g.select_less(zero, self.singular, zero, repeats);
            self.refuse(repeats);
        }
    }
}
