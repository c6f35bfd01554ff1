//! Robots as lines between their axes, in views along the base's axes.

use super::canvas::{Drawn, LINK, line, px};
use crate::view::Skeleton;
use kin_codegen::mechanism::Mechanism;
use kin_codegen::model::Model;
use kin_runtime::Pose;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// Points nearer to each other, relative to the figure, are one.
const ONE_POINT: f64 = 1e-6;
/// Actuated joints of a mechanism.
const ACTUATED: RGBColor = RGBColor(230, 120, 0);
/// What stands back.
pub const GHOST: RGBColor = RGBColor(150, 156, 166);

/// Where figures are drawn: two of the base's axes, metres.
pub type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A robot in one configuration; base coordinates, metres.
pub struct Figure {
    /// Links: corners of lines.
    links: Vec<Vec<[f64; 3]>>,
    /// Of a mechanism, what its chains begin and end at: points whose hull the base and the
    /// platform are.
    bodies: Vec<Vec<[f64; 3]>>,
    joints: Vec<([f64; 3], Kind)>,
    /// The platform or the tip.
    tip: [f64; 3],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Of a serial arm.
    Serial,
    Actuated,
    Passive,
}

/// How a figure is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// With bodies filled.
    Full,
    /// On colours that say something, and stay as they are.
    Outline,
    /// Standing back.
    Ghost,
}

impl Figure {
    /// An arm with its base at the origin.
    pub fn arm(model: &Model, q: &[f64]) -> Self {
        let (skeleton, poses) = (Skeleton::new(model), poses(model, q));
        let bones = skeleton.bones.iter().zip(&poses);
        let corners =
            bones.flat_map(|(bone, pose)| bone.iter().map(|it| pose.transform_point(*it)));
        let corners: Vec<[f64; 3]> = corners.collect();
        let axes = skeleton.axes.iter().zip(&poses[1..]);
        let joints = axes.map(|(axis, pose)| (pose.transform_point(axis.at), Kind::Serial));
        Self {
            joints: joints.collect(),
            bodies: vec![vec![[0.0; 3]]],
            tip: corners.last().copied().unwrap_or_default(),
            links: vec![corners],
        }
    }

    /// A mechanism: its chains between the base and the platform, which are bodies.
    pub fn mechanism(mechanism: &Mechanism, q: &[f64]) -> Self {
        let (mut links, mut joints) = (Vec::new(), Vec::new());
        let mut bodies = vec![Vec::new(), Vec::new()];
        let mut tip = [0.0; 3];
        for (leg, [first, end]) in mechanism.legs.iter().zip(mechanism.ranges()) {
            let q = &q[first..end];
            let (skeleton, poses) = (Skeleton::new(&leg.model), poses(&leg.model, q));
            let n = q.len();
            let seen = |link: usize, corner: usize| {
                poses[link].transform_point(skeleton.bones[link][corner])
            };
            // From where the first axis is left to where the last one is met: along the axes
            // between these and the base's or the platform's origin there is no link.
            let begin = seen(1, usize::from(n > 1));
            let mut corners = vec![begin];
            for link in 1..n {
                corners.extend([seen(link, 1), seen(link, 2)]);
            }
            bodies[0].push(begin);
            bodies[1].extend(corners.last());
            joints.push((begin, leg.actuated.contains(&0)));
            for link in 2..=n {
                joints.push((seen(link, 0), leg.actuated.contains(&(link - 1))));
            }
            tip = leg.chain().fk(q).translation;
            links.push(corners);
        }
        let kind = |is_actuated| match is_actuated {
            true => Kind::Actuated,
            false => Kind::Passive,
        };
        Self {
            links,
            bodies,
            joints: joints.into_iter().map(|(at, is)| (at, kind(is))).collect(),
            tip,
        }
    }

    /// All its points.
    pub fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        let all = self.links.iter().chain(&self.bodies).flatten().copied();
        all.chain([self.tip])
    }

    /// Draws it, seen so that these base axes are to the right and up.
    pub fn draw<B: DrawingBackend>(
        &self,
        chart: &mut Chart<'_, B>,
        [right, up]: [usize; 2],
        weight: Weight,
    ) -> Drawn<B> {
        let ink = match weight {
            Weight::Full | Weight::Outline => LINK,
            Weight::Ghost => GHOST,
        };
        let seen = |point: &[f64; 3]| (point[right], point[up]);
        let extent = self.points().map(|it| seen(&it));
        let size = extent.fold(0.0, |size: f64, it| size.max(it.0.hypot(it.1)));
        let apart = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1) > ONE_POINT * size;
        for body in &self.bodies {
            let mut hull = hull(body.iter().map(seen).collect());
            if hull.len() > 2 && weight == Weight::Full {
                chart.draw_series([Polygon::new(hull.clone(), ink.mix(0.16))])?;
            }
            hull.extend(hull.first().copied());
            for (colour, width) in [(WHITE, 5), (ink, 2)] {
                let sides = hull.windows(2).filter(|side| apart(side[0], side[1]));
                let sides = sides.map(|side| PathElement::new(side.to_vec(), line(colour, width)));
                chart.draw_series(sides.collect::<Vec<_>>())?;
            }
        }
        for (colour, width) in [(WHITE, 6), (ink, 3)] {
            // One by one: a corner of a thick line at a link seen from its end would be a spike.
            for ends in self.links.iter().flat_map(|link| link.windows(2)) {
                let [from, to] = [seen(&ends[0]), seen(&ends[1])];
                if apart(from, to) {
                    chart.draw_series([PathElement::new([from, to], line(colour, width))])?;
                }
            }
        }
        for (at, kind) in &self.joints {
            let dot =
                |size: u32, colour: RGBColor| Circle::new(seen(at), px(size), colour.filled());
            let inner = match (kind, weight) {
                (_, Weight::Ghost) | (Kind::Serial, _) => ink,
                (Kind::Actuated, _) => ACTUATED,
                (Kind::Passive, _) => WHITE,
            };
            let size = match kind {
                Kind::Actuated => [5, 4],
                Kind::Serial | Kind::Passive => [3, 2],
            };
            chart.draw_series([dot(size[0], ink), dot(size[1], inner)])?;
        }
        match &self.bodies[..] {
            [base] => {
                let at = base.first().map(seen).unwrap_or_default();
                let mark = |(size, colour): (u32, RGBColor)| {
                    TriangleMarker::new(at, px(size) as i32, colour.filled())
                };
                chart.draw_series([(8, WHITE), (5, ink)].map(mark))?;
            }
            _ => {
                let tip = Cross::new(seen(&self.tip), px(4) as i32, line(ink, 1));
                chart.draw_series([tip])?;
            }
        }
        Ok(())
    }
}

/// The frames of the links that carry the bones of a [`Skeleton`], the base's first.
fn poses(model: &Model, q: &[f64]) -> Vec<Pose> {
    let values = model.joints.iter();
    let values = values.map(|it| it.multiplier * q[it.variable] + it.offset);
    let links = model.chain().fk_links(&values.collect::<Vec<_>>());
    [Pose::IDENTITY].into_iter().chain(links).collect()
}

/// The convex hull of points, counter-clockwise (A. M. Andrew, Information Processing Letters 9,
/// 1979).
fn hull(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let size = points
        .iter()
        .fold(0.0, |size: f64, it| size.max(it.0.hypot(it.1)));
    let turns_left = |a: (f64, f64), b: (f64, f64), c: (f64, f64)| {
        (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) > ONE_POINT * size * size
    };
    let half = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        let mut chain: Vec<(f64, f64)> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && !turns_left(a, b, point)
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let lower = half(&mut points.iter().copied());
    let upper = half(&mut points.iter().rev().copied());
    [lower, upper].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_codegen::{Compiled, Ik, Options, Source, compile};

    fn compiled(file: &str) -> Compiled {
        let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let options = Options {
            ik: Ik::None,
            ..Options::default()
        };
        compile(&Source::read(file, root).unwrap(), &options).unwrap()
    }

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    #[test]
    fn a_hull_has_the_corners_alone() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let points = [&square[..], &[(0.5, 0.5), (0.5, 0.0), (1.0, 1.0)]].concat();
        assert_eq!(hull(points), square);
        assert_eq!(hull(vec![(1.0, 0.0), (0.0, 0.0), (1.0, 0.0)]).len(), 2);
        assert_eq!(hull(vec![(1.0, 0.0), (0.5, 1e-16), (0.0, 0.0)]).len(), 2);
    }

    #[test]
    fn links_of_a_delta_keep_their_lengths() {
        let Compiled::Mechanism(delta) = compiled("robots/delta.yaml") else {
            panic!()
        };
        let generic = delta.mechanism.generic();
        let q = generic.fk_near(&[0.4, 0.1, -0.2], &[0.0; 15]).unwrap();
        let figure = Figure::mechanism(&delta.mechanism, &q);
        let length =
            |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        for link in &figure.links {
            let sides: Vec<f64> = link.windows(2).map(|it| length(it[0], it[1])).collect();
            let sides: Vec<f64> = sides.into_iter().filter(|it| *it > 1e-9).collect();
            assert_eq!(sides.len(), 2, "{sides:?}");
            assert!((sides[0] - 0.112).abs() < 1e-9 && (sides[1] - 0.232).abs() < 1e-9);
        }
        // Motors on the base's circle, the rods' ends on the platform's, about its frame.
        for (body, radius, centre) in [
            (&figure.bodies[0], 0.132011139050208, [0.0; 3]),
            (&figure.bodies[1], 0.0331976404784035, figure.tip),
        ] {
            assert_eq!(body.len(), 3);
            assert!(
                body.iter()
                    .all(|it| (length(*it, centre) - radius).abs() < 1e-9)
            );
        }
        let actuated = figure.joints.iter().filter(|it| it.1 == Kind::Actuated);
        assert_eq!(actuated.count(), 3);
    }

    #[test]
    fn an_arm_ends_at_its_tip() {
        let Compiled::Arm(arm) = compiled("robots/puma560.yaml") else {
            panic!()
        };
        let q = [0.2, -1.0, 0.9, 0.4, 0.7, -0.3];
        let figure = Figure::arm(&arm.model, &q);
        assert!(near(figure.tip, arm.model.chain().fk(&q).translation));
        assert_eq!(figure.joints.len(), 6);
    }
}
