//! What the unknowns are at the seed, which free ones keep.

use super::Writer;
use crate::expr::Expr;
use crate::expr::forward::{self, JointTrig};
use crate::expr::linear::{Trig, transpose};
use crate::plan::Atom;

/// The square of the sum of cosine and sine of a turn times 1 + cos γ, below which the axis that it is
/// about, off by γ, points the other way.
const TURNED_AWAY: f64 = 1e-24;

impl Writer<'_> {
    /// The angle that the seed has for an unknown.
    pub(super) fn seeded(&mut self, atom: Atom) -> Trig {
        let joints = match atom {
            Atom::Joint(joint) => vec![joint],
            Atom::Sum { run, .. } => self.linkage.revolutes_of(run),
        };
        let (mut angle, mut turns) = (self.g.zero(), false);
        for joint in joints {
            match self.seeded_joint(joint) {
                Some(own) => angle = self.g.add(angle, own),
                None => turns = true,
            }
        }
        let (sin, cos) = self.g.sin_cos(angle);
        match turns {
            true => {
                let turn = self.seeded_turn();
                self.g.angle_sum(Trig { sin, cos }, turn)
            }
            false => Trig { sin, cos },
        }
    }

    /// The angle of the free turn that takes the tip, as the seed has it, nearest to the target's pose.
    fn seeded_turn(&mut self) -> Trig {
        let linkage = self.linkage;
        let [zero, one] = [self.g.zero(), self.g.one()];
        let (mut sums, mut slides) = (Vec::new(), Vec::new());
        for run in &linkage.runs {
            let mut angle = zero;
            for joint in run.joints.clone() {
                let moved = self.seeded_joint(joint).unwrap_or(zero);
                let turns = linkage.is_revolute(joint);
                angle = if turns {
                    self.g.add(angle, moved)
                } else {
                    angle
                };
                let (sin, cos) = self.g.sin_cos(angle);
                sums.push(Trig { sin, cos });
                slides.push(if turns { zero } else { moved });
            }
        }
        let tip = forward::tip_forwards(&mut self.g, linkage, &JointTrig { sums, slides });
        let back = transpose(&tip.rotation);
        let m = self.g.product(&back, &self.pose.rotation);
        let [sin, cos] = [self.g.sub(m[1][0], m[0][1]), self.g.add(m[0][0], m[1][1])];
        let turn = linkage.links.len() - 1;
        let sin = match linkage.links[turn].gain < 0.0 {
            true => self.g.neg(sin),
            false => sin,
        };
        // Where the tip points the other way, every turn is as near.
        let squares = [sin, cos].map(|it| self.g.square(it));
        let square = self.g.add(squares[0], squares[1]);
        let nothing = self.g.constant(TURNED_AWAY);
        let length = self.g.max(square, nothing);
        let length = self.g.sqrt(length);
        let [sin, cos] = [sin, cos].map(|it| self.g.div(it, length));
        Trig {
            sin: self.g.select_less(square, nothing, zero, sin),
            cos: self.g.select_less(square, nothing, one, cos),
        }
    }

    /// How far a joint has moved at the seed; none for the free turn, which has no seed of its own.
    pub(super) fn seeded_joint(&mut self, joint: usize) -> Option<Expr> {
        let linkage = self.linkage;
        let link = &linkage.links[joint];
        let mut locked = linkage.locked.iter();
        let locked = locked.position(|&locked| locked == joint);
        let value = match (linkage.row(joint), linkage.coordinate(joint), locked) {
            (Some(row), _, _) => forward::combination(&mut self.g, row, &self.seed),
            (None, Some(i), _) => self.seed[i],
            (None, None, Some(k)) => return Some(self.parameters[k]),
            (None, None, None) => return None,
        };
        let (gain, offset) = (link.gain, link.offset);
        Some(forward::joint_value(&mut self.g, gain, offset, value))
    }
}
