//! Where a swivel angle has the elbow, as an equation for a descent.

use super::chain::at_point;
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::{Chain, Pose, Swivel, Twist};

/// An elbow beyond the edge of its half plane by less than this is on it, metres.
const ON_EDGE: f64 = 1e-9;

/// The half plane in which a target and a swivel angle have the elbow: its edge is the line
/// from shoulder to wrist, and the target alone tells where the wrist is. The height over it is
/// an equation in metres, without the poles of the angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfPlane {
    /// How many of the joints move the elbow, the first ones.
    joints: usize,
    /// The elbow at q = 0.
    elbow: [f64; 3],
    /// A point of the edge.
    shoulder: [f64; 3],
    normal: [f64; 3],
    /// From the edge into the half plane.
    inward: [f64; 3],
}

impl HalfPlane {
    /// At a swivel angle, radians; `links` are the chain's at q = 0. There are no
    /// two half planes where the wrist is on the line of the reference direction.
    pub(super) fn new(swivel: &Swivel, links: &[Pose], target: &Pose, angle: f64) -> HalfPlane {
        let unit = |v| scale(1.0 / norm(v), v);
        let way = unit(sub(target.transform_point(swivel.wrist), swivel.shoulder));
        let across = unit(cross(way, swivel.reference));
        let aside = cross(across, way);
        let (sine, cosine) = libm::sincos(angle);
        let inward = add(scale(cosine, aside), scale(sine, across));
        HalfPlane {
            joints: swivel.link + 1,
            elbow: links[swivel.link].transform_point(swivel.elbow),
            shoulder: swivel.shoulder,
            normal: cross(way, inward),
            inward,
        }
    }

    /// The same when a joint of the chain is held, which moves what is behind it.
    pub(super) fn locked(self, joint: usize, moved: &Pose) -> HalfPlane {
        match joint < self.joints {
            true => HalfPlane {
                joints: self.joints - 1,
                elbow: moved.transform_point(self.elbow),
                ..self
            },
            false => self,
        }
    }

    /// How far the elbow is below the plane, metres, and how a joint lifts it, by its spatial
    /// Jacobian's column.
    pub(super) fn row(&self, chain: &Chain, q: &[f64]) -> (f64, impl Fn(usize, &Twist) -> f64) {
        let elbow = self.elbow_of(chain, q);
        let below = -dot(self.normal, sub(elbow, self.shoulder));
        let lifts = move |joint: usize, column: &Twist| match joint < self.joints {
            true => dot(self.normal, at_point(column, elbow).linear),
            false => 0.0,
        };
        (below, lifts)
    }

    /// Whether the elbow is on the side of the edge on which the half plane is.
    pub(super) fn has(&self, chain: &Chain, q: &[f64]) -> bool {
        let elbow = self.elbow_of(chain, q);
        dot(self.inward, sub(elbow, self.shoulder)) >= -ON_EDGE
    }

    fn elbow_of(&self, chain: &Chain, q: &[f64]) -> [f64; 3] {
        let moved = chain.displacements(q).take(self.joints).last();
        moved.unwrap_or_default().transform_point(self.elbow)
    }
}
