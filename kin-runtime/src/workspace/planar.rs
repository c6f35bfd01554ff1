//! Arms whose axes are all parallel.
//!
//! The tip's distance from the first axis is extreme where all links lie in one
//! plane, which is where the position map is singular. Between the extremes
//! every distance occurs, because the links move it continuously: it lies in an
//! interval whose ends are sums of the lengths with signs.

use alloc::vec::Vec;

use super::{EXACT, Line};
use crate::Chain;
use crate::generic::chain::is_prismatic;
use crate::linear::vector::{dot, norm, sub};

/// Rounding, relative to the lengths that are computed with.
const ROUNDING: f64 = 1e-12;

/// Revolute joints about parallel axes, and slides along them.
#[derive(Clone, Debug)]
pub(super) struct Planar {
    first: Line,
    /// Where the tip stays along the axes; none if it can slide.
    height: Option<f64>,
    /// From each axis to the next and, last, to the tip.
    lengths: Vec<f64>,
}

impl Planar {
    pub(super) fn of(chain: &Chain) -> Option<Planar> {
        let twists = chain.twists();
        let lines: Vec<Line> = (twists.iter())
            .filter(|twist| !is_prismatic(twist))
            .map(Line::of)
            .collect::<Option<_>>()?;
        let first = *lines.first()?;
        let parallel = lines.iter().all(|line| first.is_parallel(line.direction));
        let mut slides = twists.iter().filter(|twist| is_prismatic(twist));
        let along = slides.clone().all(|twist| first.is_parallel(twist.linear));
        if !parallel || !along {
            return None;
        }
        let tip = chain.home().translation;
        let points = lines.iter().map(|line| line.point).skip(1).chain([tip]);
        let lengths = lines.iter().zip(points);
        let lengths = lengths.map(|(line, next)| norm(line.offset(next)));
        Some(Planar {
            first,
            height: match slides.next() {
                Some(_) => None,
                None => Some(dot(sub(tip, first.point), first.direction)),
            },
            lengths: lengths.collect(),
        })
    }

    /// The least and largest distance that links of some lengths span.
    fn span(lengths: &[f64]) -> [f64; 2] {
        let outer: f64 = lengths.iter().sum();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        [(2.0 * longest - outer).max(0.0), outer]
    }

    pub(super) fn reachable(&self) -> [f64; 2] {
        Self::span(&self.lengths)
    }

    /// The last link points anywhere: its circle lies in the annulus of the
    /// links that carry it.
    pub(super) fn dextrous(&self) -> Option<[f64; 2]> {
        let (last, carrying) = self.lengths.split_last()?;
        let [inner, outer] = Self::span(carrying);
        let found = [last + inner, outer - last];
        (found[0] <= found[1]).then_some(found)
    }

    fn distance(&self, point: [f64; 3]) -> Option<f64> {
        let above = dot(sub(point, self.first.point), self.first.direction);
        let off = EXACT * self.lengths.iter().sum::<f64>() + ROUNDING * self.size(point);
        let in_plane = |height: f64| (above - height).abs() <= off;
        let is_there = self.height.is_none_or(in_plane);
        is_there.then(|| norm(self.first.offset(point)))
    }

    /// The arm's size, and how far a point is from its first axis and that from the base: links may
    /// all be zero.
    fn size(&self, point: [f64; 3]) -> f64 {
        let arm: f64 = self.lengths.iter().sum();
        arm + norm(sub(point, self.first.point)) + norm(self.first.point)
    }

    pub(super) fn is_reachable(&self, point: [f64; 3]) -> bool {
        let [inner, outer] = self.reachable();
        let rounding = ROUNDING * self.size(point);
        let within = |r: f64| r >= inner - rounding && r <= outer + rounding;
        self.distance(point).is_some_and(within)
    }

    pub(super) fn is_dextrous(&self, point: [f64; 3]) -> bool {
        let (Some(r), Some((last, carrying))) = (self.distance(point), self.lengths.split_last())
        else {
            return false;
        };
        let [inner, outer] = Self::span(carrying);
        let rounding = ROUNDING * self.size(point);
        (r - last).abs() >= inner - rounding && r + last <= outer + rounding
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::vector::scale;
    use crate::{Pose, Twist};

    /// A slide along the axis of the one joint that turns, with the tip on it: all links are zero.
    #[test]
    fn a_slide_on_the_axis_reaches_all_of_it() {
        let axis = scale(1.0 / libm::sqrt(14.0), [1.0, 2.0, 3.0]);
        let foot = [0.3, -0.2, 0.7];
        let at = |along: f64| core::array::from_fn(|i| foot[i] + along * axis[i]);
        let joints = [Twist::revolute(axis, foot), Twist::prismatic(axis)];
        let slide = Planar::of(&Chain::new(
            joints.to_vec(),
            Pose::from_translation(at(0.4)),
        ));
        let slide = slide.unwrap();
        let alone = Planar::of(&Chain::new(
            joints[..1].to_vec(),
            Pose::from_translation(at(0.4)),
        ));
        let alone = alone.unwrap();
        for k in -20..20 {
            let along = 0.173 * f64::from(k);
            let mut point = at(along);
            assert!(slide.is_reachable(point), "{along}");
            assert!(!alone.is_reachable(point), "{along}");
            point[0] += 1e-9;
            assert!(!slide.is_reachable(point), "{along}");
        }
        assert!(alone.is_reachable(at(0.4)));
    }
}
