//! Whether the branches of an idealized arm tell the solutions of the given one.
//!
//! A solution of the given arm is a solution of the idealized one at a target that is off by no
//! more than the two tips are apart. So the branches are all there are, and each leads to one
//! solution, unless a root of the plan changes its sign between the target and one so near, or a
//! vector that tells an angle vanishes there: the derivatives by the target tell whether it may.

use super::Writer;
use crate::expr::linear::{Motion, Trig};
use crate::expr::{Expr, Graph, Tangent};
use crate::geometry::Linkage;
use kin_runtime::Pose;

/// Derivatives are taken at the target and speak for one that is off by this many times what
/// the arms differ: at half of that the argument of a root has half of its value left, and what is
/// behind the root changes no more than √2 times as fast.
const BEYOND: f64 = 2.0;

/// How far an idealized arm is from the given one.
#[derive(Clone, Debug)]
pub(super) struct Deviation {
    /// So far may targets be off, radians, or metres by the arm's size.
    reach: f64,
    /// The arm's size, metres.
    size: f64,
    /// By what targets change as the tip is pushed, along the axes of the base.
    pushed: Vec<Tangent>,
    /// By what they change as it turns, and the swivel.
    pub turned: Vec<Tangent>,
}

impl Deviation {
    /// The tip is pushed along the axes of the base, and turned about its own ones through the
    /// last joint's frame, by which a wrist does not move.
    pub fn new(g: &mut Graph, linkage: &Linkage, target: &Motion, shift: f64) -> Self {
        // As a point of the last link is brought to the tip.
        let after = linkage
            .links
            .last()
            .map_or(Pose::IDENTITY, |link| link.after);
        let after = g.motion(&after);
        let wrist = after.translation.map(|x| g.neg(x));
        let wrist = g.rotate_back(&after.rotation, wrist);
        let one = g.one();
        let pushed = target.translation.map(|p| Tangent::new([(p, one)]));
        let turned = [0, 1, 2].map(|k| {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let minus = g.neg(wrist[a]);
            let mut changes = Vec::new();
            for (row, p) in target.rotation.iter().zip(target.translation) {
                let minus_a = g.neg(row[a]);
                changes.extend([(row[a], row[b]), (row[b], minus_a)]);
                // −R (eₖ × c).
                let parts = [g.mul(wrist[b], row[a]), g.mul(minus, row[b])];
                changes.push((p, g.add(parts[0], parts[1])));
            }
            Tangent::new(changes)
        });
        Self {
            reach: BEYOND * shift,
            size: linkage.size,
            pushed: pushed.into(),
            turned: turned.into(),
        }
    }

    fn directions(&mut self) -> impl Iterator<Item = &mut Tangent> {
        self.pushed.iter_mut().chain(&mut self.turned)
    }
}

impl Writer<'_> {
    /// Out of domain a branch is refused or flagged: what was moved into it changes by the target
    /// as if it had not been.
    pub(super) fn follow(&mut self, moved: Expr, value: Expr) {
        for direction in self.deviation.iter_mut().flat_map(Deviation::directions) {
            direction.follow(&mut self.g, moved, value);
        }
    }

    /// By how many radians an angle turns in each direction, which is less to compute than by what its
    /// sine and its cosine change.
    pub(super) fn turns(&mut self, angle: Trig, rate: impl Fn(&mut Graph, &mut Tangent) -> Expr) {
        for direction in self.deviation.iter_mut().flat_map(Deviation::directions) {
            let rate = rate(&mut self.g, direction);
            direction.turn(&mut self.g, [angle.sin, angle.cos], rate);
        }
    }

    /// On an idealized arm, flags branches in which a value may vanish at a target that is as
    /// far off as the arms differ, or is below a number; whether it did. `unit` is what the value
    /// changes by to second order.
    pub(super) fn doubt(&mut self, value: Expr, unit: Expr, least: Expr) -> bool {
        if self.g.is(self.branch.singular, 1.0) {
            return self.deviation.is_some();
        }
        let Some(change) = self.change_of(value, unit, least) else {
            return false;
        };
        let size = self.g.square(value);
        let [zero, one] = [self.g.zero(), self.g.one()];
        // Also where one of them is not a number.
        let doubtful = self.g.select_less(change, size, zero, one);
        self.flag(doubtful);
        true
    }

    /// The square of how much a value may change between a target and one that is as far off as the
    /// arms differ, more than a number; none on an exact arm.
    pub(super) fn change_of(&mut self, value: Expr, unit: Expr, least: Expr) -> Option<Expr> {
        let deviation = self.deviation.as_mut()?;
        let Deviation { reach, size, .. } = *deviation;
        let mut square = self.g.zero();
        for (directions, by) in [(&mut deviation.pushed, size), (&mut deviation.turned, 1.0)] {
            let mut squares = self.g.zero();
            for direction in directions {
                let change = direction.of(&mut self.g, value);
                let change = self.g.square(change);
                squares = self.g.add(squares, change);
            }
            let most = self.g.constant((reach * by).powi(2));
            let squares = self.g.mul(most, squares);
            square = self.g.add(square, squares);
        }
        let bent = self.scaled(reach * reach, unit);
        let floor = self.g.max(bent, least);
        let floor = self.g.square(floor);
        Some(self.g.add(square, floor))
    }
}
