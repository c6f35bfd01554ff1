//! What of a target pose counts.

use kin_runtime::polish::Aim;

/// What of a target pose counts.
///
/// What does not count is a joint without a name between the tip and the
/// target: it closes the loop freely, and only what it leaves alone can be
/// carried over the target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// All of it.
    #[default]
    Pose,
    /// The translation: three coordinates.
    Position,
    /// The translation and the direction of the tip's z axis: five
    /// coordinates, for welding, milling and spraying.
    PositionAxis,
    /// The translation and the turn about the first axis: four coordinates,
    /// for SCARA arms. How the target is tilted is not read.
    PositionYaw,
    /// The translation across the first axis and the turn about it: three
    /// coordinates, for planar arms. Height and tilt are not read.
    Planar,
    /// The direction of the tip's z axis: two coordinates, for antennas.
    Direction,
    /// The rotation: three coordinates, for wrists and gimbals.
    Orientation,
}

impl Target {
    /// All of them.
    pub const ALL: [Target; 7] = [
        Target::Pose,
        Target::Position,
        Target::PositionAxis,
        Target::PositionYaw,
        Target::Planar,
        Target::Direction,
        Target::Orientation,
    ];

    /// What it is called in options.
    pub const fn word(self) -> &'static str {
        match self {
            Target::Pose => "pose",
            Target::Position => "position",
            Target::PositionAxis => "position_axis",
            Target::PositionYaw => "position_yaw",
            Target::Planar => "planar",
            Target::Direction => "direction",
            Target::Orientation => "orientation",
        }
    }

    /// How many joints reach it in isolated ways.
    pub const fn coordinates(self) -> usize {
        match self {
            Target::Pose => 6,
            Target::PositionAxis => 5,
            Target::PositionYaw => 4,
            Target::Position | Target::Planar | Target::Orientation => 3,
            Target::Direction => 2,
        }
    }

    /// Whether some part of the tip's pose is free.
    pub(crate) fn is_free(self) -> bool {
        self.fixes_point() || self.fixes_axis() || self == Target::Orientation
    }

    /// Whether the free part leaves the tip's origin alone.
    pub(crate) fn fixes_point(self) -> bool {
        matches!(self, Target::Position | Target::PositionAxis)
    }

    /// Whether the free part leaves the tip's z axis alone, and no other.
    pub(crate) fn fixes_axis(self) -> bool {
        matches!(self, Target::PositionAxis | Target::Direction)
    }

    /// Whether the target is first projected to what the arm can choose.
    pub fn is_projected(self) -> bool {
        matches!(self, Target::PositionYaw | Target::Planar)
    }

    /// What a polish has to reach; none if it cannot.
    pub(crate) fn aim(self) -> Option<Aim> {
        match self {
            Target::Pose => Some(Aim::Pose),
            Target::Position => Some(Aim::Position),
            Target::PositionAxis => Some(Aim::PositionAxis),
            Target::Direction => Some(Aim::Direction),
            Target::Orientation => Some(Aim::Orientation),
            Target::PositionYaw | Target::Planar => None,
        }
    }

    /// How a person would say it.
    pub fn phrase(self) -> &'static str {
        match self {
            Target::Pose => "whole poses",
            Target::Position => "positions of the tip",
            Target::PositionAxis => "positions of the tip with the direction of its z axis",
            Target::PositionYaw => "positions of the tip with its turn about the first axis",
            Target::Planar => {
                "positions of the tip across the first axis with its turn about that axis"
            }
            Target::Direction => "directions of the tip's z axis",
            Target::Orientation => "orientations of the tip",
        }
    }
}
