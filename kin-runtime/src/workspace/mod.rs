//! Where an arm can go: reachable and dextrous workspace.
//!
//! The boundary of a workspace consists of points at which the position map is
//! singular. Where these are circles that a few lengths give, the questions
//! are answered by them: for planar arms, and for the shoulders with a
//! spherical wrist that nearly all industrial arms have. Other arms are asked
//! numerically.

mod planar;
mod sampled;
mod wrist;

use alloc::vec::Vec;

use crate::linear::vector::{cross, dot, norm, scale, sub};
use crate::{Chain, Kinematics, Pose, Twist};
pub use sampled::scattered_rotations;

use planar::Planar;
use wrist::Shoulder;

/// The workspace of a chain: which positions its tip can reach (in MLS section
/// 3.2.4 the *reachable* workspace), and which with every orientation (the
/// *dextrous* one). The *complete* workspace, the poses, is asked by
/// [`Kinematics::is_reachable_pose`]. Joint limits are not applied. Points are
/// in base coordinates, metres.
///
/// ```
/// use kin_runtime::{Chain, Pose, Twist, Workspace};
/// let z = [0.0, 0.0, 1.0];
/// let planar = Workspace::new(Chain::new(
///     vec![
///         Twist::revolute(z, [0.0; 3]),
///         Twist::revolute(z, [0.5, 0.0, 0.0]),
///         Twist::revolute(z, [0.8, 0.0, 0.0]),
///     ],
///     Pose::from_translation([0.9, 0.0, 0.0]),
/// ));
/// assert!(planar.is_reachable([0.0, 0.89, 0.0]) && !planar.is_reachable([0.0, 0.91, 0.0]));
/// assert!(planar.is_dextrous([0.0, 0.69, 0.0]) && !planar.is_dextrous([0.0, 0.71, 0.0]));
/// ```
#[derive(Clone, Debug)]
pub struct Workspace {
    chain: Chain,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Planar(Planar),
    Shoulder(Shoulder),
    Sampled,
}

/// How a [`Workspace`] answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkspaceMethod {
    /// All axes are parallel, and slides along them: two radii, exact to
    /// rounding. *Every orientation* is every turn about the axes, which is all
    /// that such an arm can choose.
    Annulus,
    /// Two parallel joints on a first one square to them, with an orthogonal
    /// spherical wrist or with nothing behind: the boundary circles of the
    /// wrist's centre, searched to 1e-9 of the arm's size.
    WristCentre,
    /// Anything else: descents towards the point, and towards 60 evenly
    /// scattered orientations there. A point that is found reachable is; a
    /// reachable point within 1e-6 or so of the boundary may be missed, and a
    /// point may be called dextrous of which less than a sixtieth of the
    /// orientations is missing.
    Sampled,
}

/// Angles below this, and lengths relative to the arm's size, are 0.
const EXACT: f64 = 1e-9;

impl Workspace {
    /// Looks at the axes of the chain.
    pub fn new(chain: Chain) -> Workspace {
        let kind = (Planar::of(&chain).map(Kind::Planar))
            .or_else(|| Shoulder::of(&chain).map(Kind::Shoulder))
            .unwrap_or(Kind::Sampled);
        Workspace { chain, kind }
    }

    /// The workspace of a generated robot. None if joints mimic others, so that
    /// its joint values do not make a chain.
    pub fn of<const N: usize>(robot: &impl Kinematics<N>) -> Option<Workspace> {
        let (home, jacobian) = robot.fk_jacobian(&[0.0; N]);
        let twists: Vec<Twist> = jacobian.columns().to_vec();
        let unit = |twist: &Twist| match norm(twist.angular) {
            0.0 => norm(twist.linear),
            turning => turning,
        };
        if twists.iter().any(|twist| (unit(twist) - 1.0).abs() > EXACT) {
            return None;
        }
        let chain = Chain::new(twists, home);
        let probe: [f64; N] = core::array::from_fn(|i| 0.7 + 0.4 * i as f64);
        let [a, b]: [Pose; 2] = [chain.fk(&probe), robot.fk(&probe)];
        let same = norm(sub(a.translation, b.translation)) < 1e-9 * (1.0 + norm(a.translation));
        same.then(|| Workspace::new(chain))
    }

    /// How the questions are answered.
    pub fn method(&self) -> WorkspaceMethod {
        match &self.kind {
            Kind::Planar(_) => WorkspaceMethod::Annulus,
            Kind::Shoulder(_) => WorkspaceMethod::WristCentre,
            Kind::Sampled => WorkspaceMethod::Sampled,
        }
    }

    /// Whether the tip reaches a point, with some orientation.
    pub fn is_reachable(&self, point: [f64; 3]) -> bool {
        if point.iter().any(|x| !x.is_finite()) {
            return false;
        }
        match &self.kind {
            Kind::Planar(planar) => planar.is_reachable(point),
            Kind::Shoulder(shoulder) => shoulder.is_reachable(point),
            Kind::Sampled => sampled::is_reachable(&self.chain, point),
        }
    }

    /// Whether the tip reaches a point with every orientation. False for all
    /// points if the arm has fewer than six joints and is not planar.
    pub fn is_dextrous(&self, point: [f64; 3]) -> bool {
        if point.iter().any(|x| !x.is_finite()) {
            return false;
        }
        match &self.kind {
            Kind::Planar(planar) => planar.is_dextrous(point),
            Kind::Shoulder(shoulder) => shoulder.is_dextrous(point),
            Kind::Sampled => sampled::is_dextrous(&self.chain, point),
        }
    }

    /// The least and largest distance from the first axis that a planar arm
    /// reaches; none for other arms.
    pub fn reachable_annulus(&self) -> Option<[f64; 2]> {
        match &self.kind {
            Kind::Planar(planar) => Some(planar.reachable()),
            _ => None,
        }
    }

    /// The least and largest distance from the first axis between which a
    /// planar arm reaches every point at every turn; none for other arms, and
    /// if there is no such distance. A last link that is longer than the inner
    /// radius of what carries it adds a disc about the axis, which only
    /// [`Workspace::is_dextrous`] tells.
    pub fn dextrous_annulus(&self) -> Option<[f64; 2]> {
        match &self.kind {
            Kind::Planar(planar) => planar.dextrous(),
            _ => None,
        }
    }
}

/// A directed line.
#[derive(Clone, Copy, Debug)]
struct Line {
    direction: [f64; 3],
    point: [f64; 3],
}

impl Line {
    /// The axis of a unit twist; none if it slides, or also advances.
    fn of(twist: &Twist) -> Option<Line> {
        let turns = norm(twist.angular) > 0.5;
        let pitch = dot(twist.angular, twist.linear);
        (turns && pitch.abs() < EXACT).then(|| Line {
            direction: twist.angular,
            point: cross(twist.angular, twist.linear),
        })
    }

    /// From the line to a point, square to the line.
    fn offset(&self, point: [f64; 3]) -> [f64; 3] {
        let d = sub(point, self.point);
        sub(d, scale(dot(d, self.direction), self.direction))
    }

    fn is_parallel(&self, other: [f64; 3]) -> bool {
        norm(cross(self.direction, other)) < EXACT
    }
}
