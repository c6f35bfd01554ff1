//! Frames that are fixed to a robot's bodies.

use super::super::scalar::Real;
use super::super::{Pose, Twist};

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// The base.
    Base,
    /// The link of this index in [`Kinematics::fk_links`](crate::Kinematics::fk_links).
    Link(usize),
    /// The tip, where the last link is none of these because its joint follows
    /// others.
    Tip,
    /// A link inside the chain whose joint follows others, so that none of
    /// [`Kinematics::fk_links`](crate::Kinematics::fk_links) is its.
    Following {
        /// The last link before it of which there is one; none for the base.
        link: Option<usize>,
        /// The joints from there on, all of which follow coordinates.
        joints: &'static [Following],
    },
}

/// A joint that follows a coordinate of the configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// The joint's unit twist at home, in the frame of the link that
    /// [`Body::Following`] begins at; metres.
    pub twist: Twist,
    /// The coordinate of q that it follows.
    pub coordinate: usize,
    /// Its value is `multiplier * q[coordinate] + offset`; radians or metres.
    pub multiplier: Real,
    /// See `multiplier`.
    pub offset: Real,
}

impl Following {
    /// How such joints move what is behind them, one after the other (MLS
    /// section 3.2.1).
    pub(crate) fn displacement(joints: &[Following], q: &[Real]) -> Pose {
        joints.iter().fold(Pose::IDENTITY, |moved, joint| {
            let value = joint.multiplier * q[joint.coordinate] + joint.offset;
            moved * Pose::exp(&joint.twist, value)
        })
    }
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

    /// A frame on a link whose joint follows others; at `pose` in the frame of
    /// `link`, or of the base, while all of `joints` are at zero.
    pub const fn following(
        name: &'static str,
        link: Option<usize>,
        joints: &'static [Following],
        pose: Pose,
    ) -> Frame {
        let body = Body::Following { link, joints };
        Frame { name, body, pose }
    }
}
