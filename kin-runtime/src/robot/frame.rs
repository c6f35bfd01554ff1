//! Frames that are fixed to a robot's bodies.

use crate::Pose;

/// A link of a robot file that does not move against the body that carries it:
/// a camera, a flange, a tool changer.
///
/// Generated robots list theirs in [`Kinematics::FRAMES`](crate::Kinematics::FRAMES);
/// [`Kinematics::fk_frame`](crate::Kinematics::fk_frame) says where one is.
///
/// ```
/// use kin_runtime::{Body, Frame, Pose};
/// const CAMERA: Frame = Frame::on_link("camera", 5, Pose::from_translation([0.0, 0.05, 0.02]));
/// assert_eq!(CAMERA.body, Body::Link(5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The link's name in the robot file.
    pub name: &'static str,
    /// What carries it.
    pub body: Body,
    /// The frame as seen from that body's frame, metres.
    pub pose: Pose,
}

/// What carries a [`Frame`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The base.
    Base,
    /// The link of this index in [`Kinematics::fk_links`](crate::Kinematics::fk_links).
    Link(usize),
    /// The tip, where the last link is none of these because its joint follows
    /// others.
    Tip,
}

impl Frame {
    /// A frame at `pose` in the base frame.
    pub const fn on_base(name: &'static str, pose: Pose) -> Frame {
        let body = Body::Base;
        Frame { name, body, pose }
    }

    /// A frame at `pose` in that of a link.
    pub const fn on_link(name: &'static str, link: usize, pose: Pose) -> Frame {
        let body = Body::Link(link);
        Frame { name, body, pose }
    }

    /// A frame at `pose` in the tip frame.
    pub const fn on_tip(name: &'static str, pose: Pose) -> Frame {
        let body = Body::Tip;
        Frame { name, body, pose }
    }
}
