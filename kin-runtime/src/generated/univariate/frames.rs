//! An arm of six joints as constant motions with the joints between them.

use crate::linear::vector::norm;
use crate::{Jacobian, Pose, Twist, math};

/// A₀ J₁ A₁ … J₆ A₆, where a joint J turns about z or slides along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// A₀ … A₆; lengths, those of slides included, in units of half the arm's size.
    pub fixed: [Pose; 7],
    /// Bit i is set where joint i slides.
    pub prismatic: u64,
}

/// A joint that is given with the target and stands between those that are solved for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// It moves what is behind so many of these: A₁ … A₅.
    pub behind: u8,
    /// Its twist in the frame in front of that, lengths as in the frames.
    pub twist: Twist,
}

impl Frames {
    /// With these joints, from the base to the tip, at values in radians and metres; it has
    /// them at zero.
    pub fn at(mut self, between: &[Between], values: &[f64]) -> Self {
        for (joint, &value) in between.iter().zip(values).rev() {
            let behind = &mut self.fixed[usize::from(joint.behind % 7)];
            *behind = Pose::exp(&joint.twist, value) * *behind;
        }
        self
    }

    /// Whether a joint, from 0, slides.
    #[inline(always)]
    pub fn slides(&self, joint: usize) -> bool {
        slides(self.prismatic, joint)
    }

    /// Whether no joint is farther from where it is in the other configuration.
    pub fn within(&self, distance: f64, a: &[f64; 6], b: &[f64; 6]) -> bool {
        within(distance, self.prismatic, a, b)
    }

    /// The tip is never farther from the base.
    pub fn reach(&self) -> f64 {
        match self.prismatic {
            0 => self.fixed.iter().map(|it| norm(it.translation)).sum(),
            _ => f64::INFINITY,
        }
    }

    /// The pose of the tip.
    pub fn forward(&self, q: &[f64; 6]) -> Pose {
        (0..6).fold(self.fixed[0], |pose, i| {
            pose * self.motion(i, q[i]) * self.fixed[i + 1]
        })
    }

    /// The pose of the tip, and the spatial Jacobian.
    pub fn fk_jacobian(&self, q: &[f64; 6]) -> (Pose, Jacobian<6>) {
        let mut pose = self.fixed[0];
        let columns = core::array::from_fn(|i| {
            let axis = [0, 1, 2].map(|row| pose.rotation[row][2]);
            let twist = match self.slides(i) {
                true => Twist::prismatic(axis),
                false => Twist::revolute(axis, pose.translation),
            };
            pose = pose * self.motion(i, q[i]) * self.fixed[i + 1];
            twist
        });
        (pose, Jacobian::from_columns(columns))
    }

    /// J of a joint.
    pub(super) fn motion(&self, joint: usize, q: f64) -> Pose {
        match self.slides(joint) {
            true => Pose {
                translation: [0.0, 0.0, q],
                ..Pose::IDENTITY
            },
            false => Pose::from_axis_angle([0.0, 0.0, 1.0], q, [0.0; 3]),
        }
    }
}

#[inline(always)]
pub(super) fn slides(prismatic: u64, joint: usize) -> bool {
    prismatic >> joint & 1 == 1
}

/// Values of joints, angles in (−π, π].
pub(super) fn wrapped(prismatic: u64, q: [f64; 6]) -> [f64; 6] {
    core::array::from_fn(|i| match slides(prismatic, i) {
        true => q[i],
        false => math::wrap(q[i]),
    })
}

/// Whether no joint is farther from where it is in the other configuration.
pub(super) fn within(distance: f64, prismatic: u64, a: &[f64; 6], b: &[f64; 6]) -> bool {
    let apart = core::array::from_fn(|i| a[i] - b[i]);
    let apart = wrapped(prismatic, apart);
    apart.iter().all(|apart| apart.abs() <= distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of motions in all directions, and of those along one line, where the tip is as far away.
    #[test]
    fn the_tip_is_never_farther_than_the_reach() {
        let mut farthest = 0.0_f64;
        for k in 0..2000 {
            // Fractions of multiples of irrational numbers.
            let at = |n: usize, by: f64| ((7 * k + n) as f64 * by).fract() - 0.5;
            let is_straight = k % 4 == 0;
            let fixed = core::array::from_fn(|i| match is_straight {
                true => Pose::from_translation([at(i, 0.618_034) + 0.5, 0.0, 0.0]),
                false => {
                    let axis = [at(i, 0.414_214), at(i, 0.732_051), at(i, 0.236_068)];
                    let shift = [at(i, 0.645_751), at(i, 0.316_625), at(i, 0.605_551)];
                    Pose::from_axis_angle(axis.map(|x| x / norm(axis)), 2.0, shift)
                }
            });
            let frames = Frames {
                fixed,
                prismatic: 0,
            };
            let turn = if is_straight { 0.0 } else { 6.0 };
            let q = core::array::from_fn(|i| turn * at(i, 0.854_102));
            let share = norm(frames.forward(&q).translation) / frames.reach();
            assert!(share < 1.0 + 1e-12, "{share}: {frames:?}");
            farthest = farthest.max(share);
        }
        assert!(farthest > 1.0 - 1e-12);
        let slides = Frames {
            fixed: [Pose::IDENTITY; 7],
            prismatic: 1,
        };
        assert_eq!(slides.reach(), f64::INFINITY);
    }
}
