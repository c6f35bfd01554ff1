//! Vectors seen from an axis.

use super::ON_AXIS;
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;

/// A vector split into its parts along and across an axis.
pub(super) struct Radial {
    /// The part across the axis.
    pub across: [f64; 3],
    /// The component along the axis.
    pub height: f64,
    /// The length of `across`.
    pub length: f64,
}

impl Radial {
    pub fn new(k: [f64; 3], p: [f64; 3]) -> Radial {
        let height = dot(k, p);
        let across = sub(p, scale(height, k));
        Radial {
            across,
            height,
            length: norm(across),
        }
    }

    /// The vector turned by t is `height` k + cos t `across` + sin t `ahead`.
    pub fn ahead(&self, k: [f64; 3]) -> [f64; 3] {
        cross(k, self.across)
    }

    pub fn norm(&self) -> f64 {
        math::sqrt(self.height * self.height + self.length * self.length)
    }

    pub fn on_axis(&self) -> bool {
        self.length <= ON_AXIS * self.norm()
    }

    /// The rotation about the axis `k` that takes this direction to the other.
    pub fn angle_to(&self, other: &Radial, k: [f64; 3]) -> f64 {
        let sine = dot(k, cross(self.across, other.across));
        math::wrap(math::atan2(sine, dot(self.across, other.across)))
    }
}

/// R(k, t) p.
pub(super) fn turned(k: [f64; 3], t: f64, p: [f64; 3]) -> [f64; 3] {
    let (sine, cosine) = math::sin_cos(t);
    let part = Radial::new(k, p);
    let side = add(scale(cosine, part.across), scale(sine, part.ahead(k)));
    add(scale(part.height, k), side)
}

/// The rotation about k that brings p closest to q; 0 for one on the axis.
pub(super) fn toward(k: [f64; 3], p: [f64; 3], q: [f64; 3]) -> f64 {
    Radial::new(k, p).angle_to(&Radial::new(k, q), k)
}
