//! Twists and wrenches, in the coordinates of MLS: linear part first.

/// A twist ξ = (v, ω): the velocity of a rigid body, or the axis of a joint
/// (MLS section 2.3.2). Metres and radians (per second, for a velocity).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// v: for a revolute axis ω through the point r, v = −ω × r.
    pub linear: [f64; 3],
    /// ω: zero for a prismatic joint.
    pub angular: [f64; 3],
}

/// A wrench F = (f, τ): force and moment (MLS section 2.5). Newtons and newton
/// metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// f.
    pub force: [f64; 3],
    /// τ.
    pub moment: [f64; 3],
}
