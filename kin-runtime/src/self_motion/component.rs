//! Components of self-motion manifolds.

use super::fixed_tip::FixedTip;
use super::options::{SelfMotionError, SelfMotionOptions, Stop};
use super::trace::{Ending, passes, trace};
use crate::{Kinematics, Pose};
use alloc::vec::Vec;

/// A component of the self-motion manifold of a target: one curve.
#[derive(Clone, Debug)]
pub struct SelfMotion<const N: usize> {
    /// Configurations along the curve, each reaching the target to 1e-12 of its
    /// distance. Angles are continuous and may leave (−π, π]; those at the end
    /// of a closed curve are those at its beginning but for full turns.
    pub path: Vec<[f64; N]>,
    /// What ended the path at its beginning and at its end; none if it is
    /// closed.
    pub stops: Option<[Stop; 2]>,
    target: Pose,
    options: SelfMotionOptions<N>,
}

/// Follows the self-motion through a configuration until it closes or ends, in
/// both directions. The arm has one joint more than the goal asks for, or a
/// task of lower rank; the tip rests where `q` has it.
///
/// ```
/// # use kin_runtime::{Jacobian, JointLimit, Kinematics, Pose, Twist};
/// use kin_runtime::{SelfMotionOptions, Target, self_motion};
///
/// /// Three links of 1 m in a plane.
/// struct Planar;
/// impl Kinematics<3> for Planar {
/// #     const JOINT_NAMES: [&'static str; 3] = ["a", "b", "c"];
/// #     const LIMITS: [JointLimit; 3] = [JointLimit::Continuous; 3];
/// #     const BASE: &'static str = "base";
/// #     const TIP: &'static str = "tip";
/// #     const BRANCHES: usize = 0;
/// #     fn fk(&self, q: &[f64; 3]) -> Pose { self.fk_links(q)[2] * Pose::from_translation([1.0, 0.0, 0.0]) }
/// #     fn fk_links(&self, q: &[f64; 3]) -> [Pose; 3] {
/// #         let z = [0.0, 0.0, 1.0];
/// #         let first = Pose::from_axis_angle(z, q[0], [0.0; 3]);
/// #         let second = first * Pose::from_axis_angle(z, q[1], [1.0, 0.0, 0.0]);
/// #         [first, second, second * Pose::from_axis_angle(z, q[2], [1.0, 0.0, 0.0])]
/// #     }
/// #     fn fk_jacobian(&self, q: &[f64; 3]) -> (Pose, Jacobian<3>) {
/// #         let axes = self.fk_links(q).map(|link| Twist::revolute([0.0, 0.0, 1.0], link.translation));
/// #         (self.fk(q), Jacobian::from_columns(axes))
/// #     }
///     // ...
/// }
///
/// let options = SelfMotionOptions { target: Target::Position, ..Default::default() };
/// let motion = self_motion(&Planar, &[0.3, 1.0, 0.9], &options).unwrap();
/// assert!(motion.is_closed());
/// // The arm can go to any posture on the path with its tip at rest.
/// assert!(motion.contains(&Planar, &motion.path[7]));
/// // An arm that has nothing to spare has no self-motion.
/// assert!(self_motion(&Planar, &[0.3, 1.0, 0.9], &SelfMotionOptions::default()).is_err());
/// ```
///
/// # Errors
/// The arm has none or several internal motions at `q`, or `q` is outside the
/// limits.
pub fn self_motion<K: Kinematics<N>, const N: usize>(
    robot: &K,
    q: &[f64; N],
    options: &SelfMotionOptions<N>,
) -> Result<SelfMotion<N>, SelfMotionError> {
    let target = robot.fk(q);
    let arm = FixedTip {
        robot,
        target,
        options,
    };
    if let Some(joint) = arm.beyond(q) {
        return Err(SelfMotionError::BeyondLimit { joint });
    }
    let internal = arm.internal(q);
    if internal.dimension != 1 {
        return Err(SelfMotionError::Dimension(internal.dimension));
    }
    let tangent = internal.tangent;
    let (forward, ending) = trace(&arm, q, &tangent);
    let (path, stops) = match ending {
        Ending::Closed => (core::iter::once(*q).chain(forward).collect(), None),
        Ending::Stopped(last) => {
            let (mut path, ending) = trace(&arm, q, &tangent.map(|x| -x));
            path.reverse();
            path.push(*q);
            path.extend(forward);
            // A curve that closes one way closes the other.
            let first = match ending {
                Ending::Closed => last,
                Ending::Stopped(first) => first,
            };
            (path, Some([first, last]))
        }
    };
    Ok(SelfMotion {
        path,
        stops,
        target,
        options: options.clone(),
    })
}

impl<const N: usize> SelfMotion<N> {
    /// Whether the motion comes back to where it began.
    pub fn is_closed(&self) -> bool {
        self.stops.is_none()
    }

    /// Whether a configuration, within 1e-7 of a solution for the same target,
    /// is on this component, so that the arm can go there with the tip at
    /// rest. `robot` is the one whose motion this is.
    pub fn contains<K: Kinematics<N>>(&self, robot: &K, q: &[f64; N]) -> bool {
        let arm = FixedTip {
            robot,
            target: self.target,
            options: &self.options,
        };
        self.path
            .windows(2)
            .any(|ends| passes(&arm, &ends[0], &ends[1], q).is_some())
    }
}

/// Solutions for one target, by components of its self-motion manifold.
#[derive(Clone, Debug)]
pub struct SelfMotions<const N: usize> {
    /// The components that were met.
    pub components: Vec<SelfMotion<N>>,
    /// On which of them each solution lies.
    pub component_of: Vec<usize>,
}

/// Tells the components apart on which some solutions for one target lie: the
/// arm can go from one to another with the tip at rest if they have the same.
///
/// # Errors
/// As [`self_motion`], for the first solution of each component.
pub fn self_motions<K: Kinematics<N>, const N: usize>(
    robot: &K,
    solutions: &[[f64; N]],
    options: &SelfMotionOptions<N>,
) -> Result<SelfMotions<N>, SelfMotionError> {
    let mut found = SelfMotions {
        components: Vec::new(),
        component_of: Vec::with_capacity(solutions.len()),
    };
    for q in solutions {
        let mut components = found.components.iter();
        let index = match components.position(|component| component.contains(robot, q)) {
            Some(index) => index,
            None => {
                found.components.push(self_motion(robot, q, options)?);
                found.components.len() - 1
            }
        };
        found.component_of.push(index);
    }
    Ok(found)
}
