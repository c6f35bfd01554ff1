//! Curves of configurations that reach one target, and points of them by Newton's method
//! (E. L. Allgower and K. Georg, *Introduction to Numerical Continuation Methods*, 2003,
//! chapter 3).

use crate::RANK_TOLERANCE;
use crate::linear::span::Span;
use crate::linear::vector::{dot, norm};
use crate::math;
use crate::types::{Jacobian, Pose, Twist};

/// Newton's method from a good prediction takes 3 or 4 steps.
const NEWTON_STEPS: usize = 10;
/// How exactly a target is met, relative to its distance from the base or the arm's; angles
/// to that in metres, or to one. Rounding in forward kinematics is a hundredth of this.
const CONVERGED: f64 = 1e-12;

/// A hyperplane n · (x − p) = 0 that cuts a curve.
pub(crate) struct Cut<const D: usize> {
    pub normal: [f64; D],
    pub point: [f64; D],
}

impl<const D: usize> Cut<D> {
    /// Where a coordinate has a value.
    pub fn at(coordinate: usize, value: f64) -> Self {
        let mut point = [0.0; D];
        point[coordinate] = value;
        Self {
            normal: unit(coordinate),
            point,
        }
    }
}

/// What is to rest at a point, linearized there.
pub(crate) struct Equations<const D: usize, const R: usize> {
    /// Rows of the tip's velocity, three of the translation first, or of angles; some may be zero.
    pub rows: [[f64; D]; R],
    /// How far it is from where it should be, metres and radians.
    pub missing: [f64; R],
    /// How far the target or the arm reaches, metres.
    pub size: f64,
}

impl<const D: usize, const R: usize> Equations<D, R> {
    /// How far a target, the axes of an arm, or what slides on it is from the base: of joint values
    /// with their spatial Jacobian.
    pub fn size<const N: usize>(target: &Pose, spatial: &Jacobian<N>, q: &[f64; N]) -> f64 {
        let far = |(twist, q): (Twist, &f64)| match norm(twist.angular) {
            0.0 => q.abs(),
            // The moment of an axis; a gear makes it no farther away.
            rate => norm(twist.linear) / rate.max(1.0),
        };
        let all = spatial.columns().into_iter().zip(q).map(far);
        all.fold(norm(target.translation), math::max)
    }

    /// Of the rows, of coordinates that rest, and of one row more; what the others leave of a row
    /// is zero below a share of the longest.
    pub fn span(&self, resting: &[usize], more: Option<&[f64; D]>, dependent: f64) -> Span<D> {
        let row = |i: usize| match i.checked_sub(R) {
            None => self.rows[i],
            Some(i) if i < resting.len() => unit(resting[i]),
            Some(_) => more.copied().unwrap_or([0.0; D]),
        };
        let count = R + resting.len() + usize::from(more.is_some());
        Span::of(count, row, dependent)
    }

    fn are_satisfied(&self) -> bool {
        let (missing, met) = (self.missing.iter().enumerate(), self.tolerances());
        missing
            .map(|(i, x)| (x.abs(), met[usize::from(i >= 3)]))
            .all(|(x, met)| x <= met)
    }

    /// How exactly: metres, then radians. A small arm is as exact for its size.
    fn tolerances(&self) -> [f64; 2] {
        [self.size, self.size.max(1.0)].map(|size| CONVERGED * size)
    }
}

/// Where a curve meets a hyperplane; none if Newton's method does not get there.
pub(crate) fn meet<const D: usize, const R: usize>(
    equations: impl Fn(&[f64; D]) -> Equations<D, R>,
    resting: &[usize],
    cut: &Cut<D>,
    guess: [f64; D],
) -> Option<[f64; D]> {
    let mut x = guess;
    for _ in 0..NEWTON_STEPS {
        let equations = equations(&x);
        let off = -dot(cut.normal, along(&x, &cut.point, -1.0));
        if equations.are_satisfied() && off.abs() <= equations.tolerances()[1] {
            return Some(x);
        }
        let span = equations.span(resting, Some(&cut.normal), RANK_TOLERANCE);
        let change = span.least_norm(|i| match i.checked_sub(R) {
            None => equations.missing[i],
            Some(i) if i < resting.len() => 0.0,
            Some(_) => off,
        });
        x = along(&x, &change, 1.0);
    }
    None
}

/// x + t d.
pub(crate) fn along<const D: usize>(x: &[f64; D], d: &[f64; D], t: f64) -> [f64; D] {
    core::array::from_fn(|i| x[i] + t * d[i])
}

/// A unit vector.
pub(crate) fn unit<const D: usize>(i: usize) -> [f64; D] {
    core::array::from_fn(|j| f64::from(u8::from(i == j)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pose;

    #[test]
    fn a_gear_and_the_unit_of_a_prismatic_joint_do_not_count() {
        let at = |x: f64, rate: f64| Twist {
            linear: [0.0, -x * rate, 0.0],
            angular: [0.0, 0.0, rate],
        };
        let prismatic = Twist {
            linear: [0.0, 0.0, 1.0],
            angular: [0.0; 3],
        };
        let size = |columns: [Twist; 2], target: f64, q: [f64; 2]| {
            let target = Pose::from_translation([target, 0.0, 0.0]);
            Equations::<2, 6>::size(&target, &Jacobian::from_columns(columns), &q)
        };
        assert_eq!(size([at(2.0, 1.0), prismatic], 0.1, [9.0, -0.5]), 2.0);
        assert_eq!(size([at(0.0, 1.0), prismatic], 0.1, [9.0, -0.5]), 0.5);
        assert_eq!(size([at(0.2, 50.0), prismatic], 0.1, [9.0, 0.0]), 0.2);
        assert_eq!(size([at(0.2, 1.0), prismatic], 3.0, [9.0, 0.0]), 3.0);
        // Axes that are parallel but for rounding, and turn against each other.
        assert!(size([at(3e5, 1e-8), prismatic], 0.1, [9.0, 0.0]) < 0.2);
    }
}
