//! A serial chain whose joints are known only at run time.

use alloc::vec::Vec;
use core::ops::Range;

use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::{Pose, Twist};

/// A serial chain of revolute, helical and prismatic joints by its product of
/// exponentials g(q) = e^(ξ̂₁ q₁) ⋯ e^(ξ̂ₙ qₙ) g(0) (MLS section 3.2), for any
/// number of joints.
///
/// This is the plain reading of the book, kept free of everything that makes
/// generated robots fast, so that it can check them: exponentials by
/// Rodrigues' formula, sines and cosines from `libm`. Joint values are radians,
/// metres for prismatic joints; all poses are in the base frame.
///
/// ```
/// use kin_runtime::{Chain, Pose, Twist};
/// let z = [0.0, 0.0, 1.0];
/// let planar = Chain::new(
///     vec![Twist::revolute(z, [0.0; 3]), Twist::revolute(z, [0.5, 0.0, 0.0])],
///     Pose::from_translation([0.9, 0.0, 0.0]),
/// );
/// let folded = planar.fk(&[0.0, core::f64::consts::PI]);
/// assert!((folded.translation[0] - 0.1).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    twists: Vec<Twist>,
    links: Vec<Pose>,
    home: Pose,
}

impl Chain {
    /// From the unit twists of the joints and the tip's pose, all at q = 0.
    ///
    /// # Panics
    /// If a twist is not a unit twist: ω is a unit vector, or ω is zero and v
    /// is one.
    pub fn new(twists: Vec<Twist>, home: Pose) -> Chain {
        for (i, twist) in twists.iter().enumerate() {
            let unit = if is_prismatic(twist) {
                twist.linear
            } else {
                twist.angular
            };
            assert!(is_unit(unit), "joint {i} has no unit twist: {twist:?}");
        }
        Chain::geared(twists, home)
    }

    /// The same whose slides go farther than their values, or less far: their twists are as long as
    /// they go for each metre, as those of a column of two stages that move together.
    ///
    /// ```
    /// use kin_runtime::{Chain, Pose, Twist};
    /// let column = Chain::geared(vec![Twist::prismatic([0.0, 0.0, 2.0])], Pose::IDENTITY);
    /// assert_eq!(column.fk(&[0.3]).translation, [0.0, 0.0, 0.6]);
    /// ```
    ///
    /// # Panics
    /// If a joint turns about an axis whose ω is no unit vector.
    pub fn geared(twists: Vec<Twist>, home: Pose) -> Chain {
        for (i, twist) in twists.iter().enumerate() {
            let is_sound = is_prismatic(twist) || is_unit(twist.angular);
            assert!(is_sound, "joint {i} has no unit twist: {twist:?}");
        }
        let links = twists.iter().map(|_| Pose::IDENTITY).collect();
        Chain {
            twists,
            links,
            home,
        }
    }

    /// The same chain with frames on its links: `links[i]` is the frame that
    /// joint i moves, where it is at q = 0. Without this it is the base frame,
    /// so that [`Chain::fk_links`] gives bare displacements.
    ///
    /// # Panics
    /// If there is not one frame for each joint.
    pub fn with_links(self, links: Vec<Pose>) -> Chain {
        assert_eq!(links.len(), self.twists.len(), "one frame for each joint");
        Chain { links, ..self }
    }

    /// The chain that is left when a joint is held at a value: a joint less, and what is
    /// behind it where that has moved it. [`SearchOptions::given`](crate::SearchOptions::given)
    /// holds joints for a search.
    ///
    /// ```
    /// use kin_runtime::{Chain, Pose, Twist};
    /// let z = [0.0, 0.0, 1.0];
    /// let joint = |x| Twist::revolute(z, [x, 0.0, 0.0]);
    /// let home = Pose::from_translation([3.0, 0.0, 0.0]);
    /// let planar = Chain::new(vec![joint(0.0), joint(1.0), joint(2.0)], home);
    /// let held = planar.locked(1, 0.7);
    /// let tip = planar.fk(&[0.2, 0.7, -0.4]);
    /// assert!(held.fk(&[0.2, -0.4]).translation_distance(&tip) < 1e-15);
    /// ```
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn locked(&self, joint: usize, value: f64) -> Chain {
        let moved = exponential(&self.twists[joint], value);
        let others = || (0..self.twists.len()).filter(|&i| i != joint);
        let twist = |i: usize| match i < joint {
            true => self.twists[i],
            false => moved.adjoint(&self.twists[i]),
        };
        let link = |i: usize| match i < joint {
            true => self.links[i],
            false => moved * self.links[i],
        };
        Chain {
            twists: others().map(twist).collect(),
            links: others().map(link).collect(),
            home: moved * self.home,
        }
    }

    /// The unit twists of the joints at q = 0.
    pub fn twists(&self) -> &[Twist] {
        &self.twists
    }

    /// The frames of [`Chain::with_links`].
    pub(crate) fn links(&self) -> &[Pose] {
        &self.links
    }

    /// The tip's pose at q = 0.
    pub fn home(&self) -> &Pose {
        &self.home
    }

    /// The tip's pose.
    ///
    /// # Panics
    /// If `q` has not one value for each joint; so do all the functions below.
    pub fn fk(&self, q: &[f64]) -> Pose {
        self.displacements(q).last().unwrap_or_default() * self.home
    }

    /// The frame behind every joint; see [`Chain::with_links`].
    pub fn fk_links(&self, q: &[f64]) -> Vec<Pose> {
        self.displacements(q)
            .zip(&self.links)
            .map(|(moved, link)| moved * *link)
            .collect()
    }

    /// What joints in a row do to what is behind them: e^(ξ̂ᵢ qᵢ) ⋯ e^(ξ̂ₖ qₖ), those in front of
    /// them at home.
    ///
    /// ```
    /// use kin_runtime::{Chain, Pose, Twist};
    /// let z = [0.0, 0.0, 1.0];
    /// let joint = |x| Twist::revolute(z, [x, 0.0, 0.0]);
    /// let planar = Chain::new(vec![joint(0.0), joint(1.0), joint(2.0)], Pose::IDENTITY);
    /// let moved = planar.displacement(1..3, &[0.9, 0.2, -0.2]).transform_point([2.0, 0.0, 0.0]);
    /// assert!((moved[1] - 0.2_f64.sin()).abs() < 1e-15);
    /// ```
    pub fn displacement(&self, joints: Range<usize>, q: &[f64]) -> Pose {
        assert_eq!(q.len(), self.twists.len(), "one value for each joint");
        joints.fold(Pose::IDENTITY, |moved, joint| {
            moved * exponential(&self.twists[joint], q[joint])
        })
    }

    /// The columns of the spatial Jacobian (MLS section 3.4): column i is ξᵢ
    /// displaced by the joints before it, (v, ω) in base coordinates.
    pub fn spatial_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        let before = core::iter::once(Pose::IDENTITY).chain(self.displacements(q));
        before
            .zip(&self.twists)
            .map(|(moved, twist)| moved.adjoint(twist))
            .collect()
    }

    /// The columns of the body Jacobian (MLS section 3.4), (v, ω) in tip
    /// coordinates: the spatial ones seen from the tip.
    pub fn body_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        let tool = self.fk(q);
        self.spatial_jacobian(q)
            .iter()
            .map(|twist| tool.adjoint_inverse(twist))
            .collect()
    }

    /// The columns of the geometric Jacobian: velocity of the tip's origin,
    /// and angular velocity, both in base axes.
    pub fn geometric_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        let mut moved = Pose::IDENTITY;
        let mut columns = Vec::with_capacity(self.twists.len());
        for (twist, next) in self.twists.iter().zip(self.displacements(q)) {
            columns.push(moved.adjoint(twist));
            moved = next;
        }
        let origin = moved.transform_point(self.home.translation);
        for column in &mut columns {
            *column = at_point(column, origin);
        }
        columns
    }

    /// e^(ξ̂₁ q₁) ⋯ e^(ξ̂ᵢ qᵢ) for every i.
    pub(crate) fn displacements(&self, q: &[f64]) -> impl Iterator<Item = Pose> {
        assert_eq!(q.len(), self.twists.len(), "one value for each joint");
        self.twists
            .iter()
            .zip(q)
            .scan(Pose::IDENTITY, |moved, (twist, &value)| {
                *moved = *moved * exponential(twist, value);
                Some(*moved)
            })
    }
}

fn is_unit(v: [f64; 3]) -> bool {
    (norm(v) - 1.0).abs() < 1e-9
}

/// Whether a twist translates without turning.
pub(crate) fn is_prismatic(twist: &Twist) -> bool {
    twist.angular == [0.0; 3]
}

/// A spatial velocity as the velocity of the body's point at `point`.
pub(crate) fn at_point(twist: &Twist, point: [f64; 3]) -> Twist {
    Twist {
        linear: add(twist.linear, cross(twist.angular, point)),
        ..*twist
    }
}

/// e^(ξ̂ θ) of a unit twist. With ω: R = I + ω̂ sin θ + ω̂² (1 − cos θ) and
/// p = (I − R)(ω × v) + ω ωᵀ v θ; without: a translation by v θ.
pub(super) fn exponential(twist: &Twist, theta: f64) -> Pose {
    let (v, w) = (twist.linear, twist.angular);
    if is_prismatic(twist) {
        return Pose::from_translation(scale(theta, v));
    }
    let rotation = rodrigues(w, theta);
    let lever = cross(w, v);
    let around = sub(lever, rotation.rotate(lever));
    let along = scale(dot(w, v) * theta, w);
    Pose {
        translation: add(around, along),
        ..rotation
    }
}

/// The rotation about the unit vector ω: I + ω̂ sin θ + ω̂² (1 − cos θ), entry by entry.
fn rodrigues([x, y, z]: [f64; 3], theta: f64) -> Pose {
    let (sine, cosine) = libm::sincos(theta);
    let rest = 1.0 - cosine;
    let [a, b, c] = [sine * x, sine * y, sine * z];
    let [xy, yz, zx] = [rest * (x * y), rest * (y * z), rest * (z * x)];
    let [xx, yy, zz] = [x * x, y * y, z * z];
    Pose {
        rotation: [
            [1.0 - rest * (yy + zz), xy - c, b + zx],
            [c + xy, 1.0 - rest * (zz + xx), yz - a],
            [zx - b, a + yz, 1.0 - rest * (xx + yy)],
        ],
        translation: [0.0; 3],
    }
}
