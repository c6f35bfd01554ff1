//! What of a target pose counts.

use super::super::linear::vector::{add, cross, dot, scale, sub};
use super::super::scalar::Real;
use super::super::{Jacobian, Pose, Twist, math};

/// What of a target pose counts.
///
/// Of [`Target::PositionYaw`] and [`Target::Planar`], for arms all of whose joints that turn do so
/// about parallel axes, a target stands for one whole pose, [`Target::stands_for`], and all of
/// that counts. Where the axes are parallel but for the noise of a robot file, the tip stands for
/// a pose in the same way: by how little it is tilted, or lifted, is not read. The first axis is
/// that of the first joint that turns.
///
/// ```
/// use kin_runtime::{Pose, Target};
/// let spun = Pose::from_axis_angle([0.0, 0.0, 1.0], 0.3, [0.0; 3]);
/// assert!(Target::PositionAxis.distance(&spun, &Pose::IDENTITY, 1.0) < 1e-15);
/// assert!(Target::Pose.distance(&spun, &Pose::IDENTITY, 1.0) > 0.29);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Target {
    /// All of it: six coordinates.
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

    /// What they are called in the compiler's options, in the order of
    /// [`Target::ALL`].
    pub const WORDS: [&'static str; 7] = {
        let mut words = [""; 7];
        let mut i = 0;
        while i < 7 {
            words[i] = Target::ALL[i].word();
            i += 1;
        }
        words
    };

    /// What it is called in the compiler's options.
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

    /// The one that is called `word` in the compiler's options.
    pub fn from_word(word: &str) -> Option<Target> {
        Target::ALL.into_iter().find(|target| target.word() == word)
    }

    /// How a person would say it, in the plural: "positions of the tip".
    pub const fn phrase(self) -> &'static str {
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

    /// How many coordinates count, and so how many joints reach it in isolated
    /// configurations.
    pub const fn coordinates(self) -> usize {
        match self {
            Target::Pose => 6,
            Target::PositionAxis => 5,
            Target::PositionYaw => 4,
            Target::Position | Target::Planar | Target::Orientation => 3,
            Target::Direction => 2,
        }
    }

    /// Whether some motion of the tip keeps all that counts.
    pub const fn is_free(self) -> bool {
        !matches!(self, Target::Pose) && !self.is_projected()
    }

    /// Whether the motions that keep what counts are rotations about the tip's origin.
    pub const fn fixes_point(self) -> bool {
        matches!(self, Target::Position | Target::PositionAxis)
    }

    /// Whether all motions that keep what counts keep the direction of the
    /// tip's z axis, and of no other.
    pub const fn fixes_axis(self) -> bool {
        matches!(self, Target::PositionAxis | Target::Direction)
    }

    /// Whether a target of a tool, which lies at `tool` in the tip's frame, is one of the tip as
    /// well: what does not count must not move the tip. Of a position, the tool is where the tip is;
    /// of a position with the tip's z axis, on that axis, to 1e-9 of metres and radians.
    pub fn allows_tool(self, tool: &Pose) -> bool {
        let [x, y, z] = tool.translation;
        let is_small = |values: &[Real]| values.iter().all(|x| x.abs() <= 1e-9);
        let turns_about_z = || is_small(&[tool.rotation[0][2], tool.rotation[1][2]]);
        match self {
            Target::Position => is_small(&[x, y, z]),
            Target::PositionAxis => is_small(&[x, y]) && turns_about_z(),
            Target::Direction => turns_about_z(),
            Target::Pose | Target::Orientation | Target::PositionYaw | Target::Planar => true,
        }
    }

    /// Whether a target first has to be replaced by the pose that it
    /// [stands for](Target::stands_for).
    pub const fn is_projected(self) -> bool {
        matches!(self, Target::PositionYaw | Target::Planar)
    }

    /// The pose that `target`, or a tip, stands for on an arm whose joints all turn about
    /// axes parallel to the unit vector `axis` and whose tip is at `home` at q = 0;
    /// all in the base frame. The orientation is that of home, turned about the
    /// axis to come nearest to the target's; the height along the axis of a
    /// [`Target::Planar`] is that of home. All others stand for themselves.
    pub fn stands_for(self, target: &Pose, axis: [Real; 3], home: &Pose) -> Pose {
        if !self.is_projected() {
            return *target;
        }
        let [sine, cosine] = turn_about(axis, &home.rotation, &target.rotation);
        let columns = [0, 1, 2].map(|j| {
            let v = home.rotation.map(|row| row[j]);
            let (side, along) = (cross(axis, v), dot(axis, v));
            [0, 1, 2].map(|i| cosine * v[i] + sine * side[i] + (1.0 - cosine) * along * axis[i])
        });
        let rise = match self {
            Target::Planar => dot(axis, sub(home.translation, target.translation)),
            _ => 0.0,
        };
        Pose {
            rotation: [0, 1, 2].map(|i| columns.map(|column| column[i])),
            translation: add(target.translation, scale(rise, axis)),
        }
    }

    /// How far a pose is from a target, as far as the target counts, metres:
    /// the root of the squares of the distance of the origins and of `size`
    /// times the chord of the angle between the orientations, or between the z
    /// axes. The chord 2 sin θ/2 is θ where it is small. `size`, metres, is the
    /// distance at which angles count as lengths: the arm's size.
    #[inline]
    pub fn distance(self, pose: &Pose, target: &Pose, size: Real) -> Real {
        let (r, t) = (&pose.rotation, &target.rotation);
        let square = |a: Real, b: Real| (a - b) * (a - b);
        let shift: Real = (0..3)
            .map(|i| square(pose.translation[i], target.translation[i]))
            .sum();
        let column = |j: usize| (0..3).map(|i| square(r[i][j], t[i][j])).sum::<Real>();
        let turn = if self.fixes_axis() {
            column(2)
        } else if self.has_rotation() {
            // Three columns, each of which misses the part along the axis.
            0.5 * (column(0) + column(1) + column(2))
        } else {
            0.0
        };
        let shift = if self.has_translation() { shift } else { 0.0 };
        math::sqrt(shift + size * size * turn)
    }

    /// Whether all entries of a target that count are finite.
    pub(crate) fn is_finite(self, target: &Pose) -> bool {
        let shift = target.translation.iter().all(|x| x.is_finite());
        let turn = target.rotation.as_flattened().iter().all(|x| x.is_finite());
        (shift || !self.has_translation()) && (turn || !self.has_rotation())
    }

    /// How far the rotation of a target is from one, as far as it counts: the
    /// length of the z axis from 1 where only that does, 0 where none does.
    pub(crate) fn rotation_error(self, target: &Pose) -> Real {
        let z = [0, 1, 2].map(|i| target.rotation[i][2]);
        if self.fixes_axis() {
            (math::sqrt(dot(z, z)) - 1.0).abs()
        } else if self.has_rotation() {
            target.rotation_error()
        } else {
            0.0
        }
    }

    /// What is missing from a pose to a target: the translation, metres, and
    /// the axis times the sine of the angle between the orientations or the z
    /// axes, both in base axes; zero where the target does not count.
    #[inline]
    pub(crate) fn missing(self, pose: &Pose, target: &Pose) -> Twist {
        let column = |pose: &Pose, j: usize| [0, 1, 2].map(|i| pose.rotation[i][j]);
        let sine = |j: usize| cross(column(pose, j), column(target, j));
        let linear = if self.has_translation() {
            sub(target.translation, pose.translation)
        } else {
            [0.0; 3]
        };
        let angular = if self.fixes_axis() {
            sine(2)
        } else if self.has_rotation() {
            scale(0.5, add(add(sine(0), sine(1)), sine(2)))
        } else {
            [0.0; 3]
        };
        Twist { linear, angular }
    }

    /// What counts of a velocity, given by that of the tip's origin and the
    /// angular velocity in base axes: the rate at which it makes up for what is
    /// [missing](Target::missing).
    #[inline]
    pub(crate) fn counting(self, pose: &Pose, velocity: &Twist) -> Twist {
        let (v, w) = (velocity.linear, velocity.angular);
        let linear = if self.has_translation() { v } else { [0.0; 3] };
        let angular = if self.fixes_axis() {
            let z = [0, 1, 2].map(|i| pose.rotation[i][2]);
            sub(w, scale(dot(z, w), z))
        } else if self.has_rotation() {
            w
        } else {
            [0.0; 3]
        };
        Twist { linear, angular }
    }

    /// [`Target::counting`] of every column of a geometric Jacobian.
    #[inline]
    pub(crate) fn counting_rows<const N: usize>(
        self,
        pose: &Pose,
        geometric: &Jacobian<N>,
    ) -> Jacobian<N> {
        let columns = geometric.columns();
        Jacobian::from_columns(columns.map(|column| self.counting(pose, &column)))
    }

    /// Whether its position counts, or some of it.
    pub const fn has_translation(self) -> bool {
        !matches!(self, Target::Direction | Target::Orientation)
    }

    /// Whether its orientation counts, or some of it.
    pub const fn has_rotation(self) -> bool {
        !matches!(self, Target::Position)
    }
}

/// Sine and cosine of the turn about `n` that brings one orientation nearest to
/// another: with M = to · fromᵀ, cos ~ tr M − nᵀ M n and sin ~ n · (axial vector
/// of M). Where every turn comes as near, none.
fn turn_about(n: [Real; 3], from: &[[Real; 3]; 3], to: &[[Real; 3]; 3]) -> [Real; 2] {
    let m = |i: usize, j: usize| dot(to[i], from[j]);
    let (mut sine, mut cosine) = (0.0, 0.0);
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        sine += n[i] * (m(b, a) - m(a, b));
        cosine += m(i, i);
        for j in 0..3 {
            cosine -= n[i] * m(i, j) * n[j];
        }
    }
    let length = math::sqrt(sine * sine + cosine * cosine);
    match length == 0.0 {
        true => [0.0, 1.0],
        false => [sine / length, cosine / length],
    }
}
