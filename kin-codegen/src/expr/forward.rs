//! Forward kinematics as expressions.
//!
//! T = C₀ J₁ C₁ … Jₙ Cₙ is gathered by runs of parallel joints: a run turns by
//! the sum of its angles and travels by a vector of its own frame. Orientation
//! multiplies up from the base, or two of its columns come in from the tip and
//! their cross product is the third, which a chain without structure prefers.
//! The position has a choice: the first runs by Horner's rule (innermost vector
//! first, turned outwards), the rest forwards with the columns of the
//! orientation; what is cheaper is counted, not guessed.

use super::linear::{Motion, Trig, Vector, transpose};
use super::{Expr, Graph};
use crate::geometry::{Axis, Combination, Linkage, Run, Vec3};
use crate::model::JointKind;
use kin_runtime::Pose;

/// Joint trigonometry: what the joints of a linkage do, as expressions.
#[derive(Clone, Debug)]
pub struct JointTrig {
    /// For every joint the sine and cosine of the sum of the angles of its
    /// run, from the run's first joint to itself.
    pub sums: Vec<Trig>,
    /// How far each joint slides; zero for revolute joints.
    pub slides: Vec<Expr>,
}

impl JointTrig {
    /// For given joint values.
    pub fn at(g: &mut Graph, linkage: &Linkage, q: &[Expr]) -> Self {
        let mut sums = Vec::with_capacity(linkage.links.len());
        let mut slides = Vec::with_capacity(linkage.links.len());
        for run in &linkage.runs {
            let mut angle = g.zero();
            let mut turned = Vec::new();
            for link in &linkage.links[run.joints.clone()] {
                let moved = joint_value(g, link.gain, link.offset, q[link.variable]);
                let slide = match link.kind {
                    JointKind::Revolute => {
                        angle = g.add(angle, moved);
                        turned.push(link.variable);
                        g.zero()
                    }
                    JointKind::Prismatic => moved,
                };
                sums.push(trig_of(g, angle, &turned));
                slides.push(slide);
            }
        }
        Self { sums, slides }
    }
}

/// The sine and cosine of the sum of some joints' angles, or of its negative.
fn trig_of(g: &mut Graph, angle: Expr, variables: &[usize]) -> Trig {
    let mut variables = variables.to_vec();
    variables.sort_unstable();
    let symbol: String = variables.into_iter().map(subscript).collect();
    let (sin, cos) = g.sin_cos(angle);
    // The sine of a negative angle is that of the angle, negated.
    let plain = g.negated(sin).unwrap_or(sin);
    g.named(plain, format!("s{symbol}"));
    g.named(cos, format!("c{symbol}"));
    Trig { sin, cos }
}

/// The index of a joint as it stands behind a symbol: s1, c23, and q10
/// apart from q1 q0.
pub fn subscript(variable: usize) -> String {
    if variable < 9 {
        format!("{}", variable + 1)
    } else {
        format!("_{}", variable + 1)
    }
}

/// The value of a joint that depends on several coordinates.
pub(super) fn combination(g: &mut Graph, row: &Combination, q: &[Expr]) -> Expr {
    let mut sum = g.zero();
    for (&weight, &x) in row.weights.iter().zip(q) {
        let weight = g.constant(weight);
        let part = g.mul(weight, x);
        sum = g.add(sum, part);
    }
    let offset = g.constant(row.offset);
    g.add(sum, offset)
}

pub(super) fn joint_value(g: &mut Graph, gain: f64, offset: f64, q: Expr) -> Expr {
    let gain = g.constant(gain);
    let offset = g.constant(offset);
    let scaled = g.mul(gain, q);
    g.add(scaled, offset)
}

/// A run of parallel joints as one motion: x ↦ v + Rz(σ) C x.
pub(super) struct Stage {
    /// Rz(σ); none when no joint of the run turns.
    pub turn: Option<Trig>,
    /// v, without the translation of C.
    pub travel: Vector,
    /// C, the constant motion behind the run.
    pub after: Pose,
    /// The translation of C in the axes behind it.
    pub advance: Vec3,
    /// The axes of the run's joints, in the frame before the run.
    axes: Vec<Axis<Vector>>,
}

/// The chain from the base's constant motion to behind joint `upto − 1`, run
/// by run.
pub(super) fn stages(
    g: &mut Graph,
    linkage: &Linkage,
    trig: &JointTrig,
    upto: usize,
) -> Vec<Stage> {
    let mut stages = Vec::new();
    for run in linkage.runs.iter().filter(|run| run.joints.start < upto) {
        let travel = g.vector([0.0; 3]);
        let mut stage = Stage {
            turn: None,
            travel,
            after: Pose::IDENTITY,
            advance: [0.0; 3],
            axes: Vec::new(),
        };
        for i in run.joints.clone().take_while(|&i| i < upto) {
            stage.append(g, linkage, trig, i);
        }
        stages.push(stage);
    }
    stages
}

impl Stage {
    fn append(&mut self, g: &mut Graph, linkage: &Linkage, trig: &JointTrig, joint: usize) {
        let link = &linkage.links[joint];
        let shift = g.vector(self.after.translation);
        let shift = turned(g, self.turn, shift);
        self.travel = g.plus(self.travel, shift);
        let direction = g.vector(link.direction);
        match link.kind {
            JointKind::Revolute => {
                self.axes.push(Axis::Revolute {
                    direction,
                    point: self.travel,
                });
                self.turn = Some(trig.sums[joint]);
            }
            JointKind::Prismatic => {
                let direction = turned(g, self.turn, direction);
                self.axes.push(Axis::Prismatic { direction });
                let shift = g.scale(trig.slides[joint], direction);
                self.travel = g.plus(self.travel, shift);
            }
        }
        self.after = link.after;
        self.advance = link.advance;
    }

    /// The axes of the run's joints, from the frame before the run.
    pub(super) fn axes_from(&self, g: &mut Graph, frame: Motion) -> Vec<Axis<Vector>> {
        let axes = self.axes.iter().map(|axis| match *axis {
            Axis::Revolute { direction, point } => {
                let point = g.rotate(&frame.rotation, point);
                Axis::Revolute {
                    direction: g.rotate(&frame.rotation, direction),
                    point: g.plus(frame.translation, point),
                }
            }
            Axis::Prismatic { direction } => Axis::Prismatic {
                direction: g.rotate(&frame.rotation, direction),
            },
        });
        axes.collect()
    }

    /// The frame behind the turn, without the travel.
    pub(super) fn spin(&self, g: &mut Graph, mut frame: Motion) -> Motion {
        if let Some(turn) = self.turn {
            let turn = g.rotation_z(turn);
            frame.rotation = g.product(&frame.rotation, &turn);
        }
        frame
    }

    /// Ends at another motion than the chain has there.
    fn end_at(&mut self, pose: Pose) {
        self.after = pose;
        self.advance = pose.rotate_back(pose.translation);
    }

    /// Whether to translate behind the rotation of C, where the vector has
    /// more zeros.
    fn turns_first(&self) -> bool {
        let entries = |v: &Vec3| v.iter().filter(|x| **x != 0.0).count();
        entries(&self.advance) < entries(&self.after.translation)
    }

    /// The frame behind C, from the frame before it.
    pub(super) fn leave(&self, g: &mut Graph, frame: Motion) -> Motion {
        let rotation = onwards(g, &frame.rotation, &self.after.rotation);
        let shift = if self.turns_first() {
            let advance = g.vector(self.advance);
            g.rotate(&rotation, advance)
        } else {
            let shift = g.vector(self.after.translation);
            g.rotate(&frame.rotation, shift)
        };
        Motion {
            rotation,
            translation: g.plus(frame.translation, shift),
        }
    }

    /// The frame before C, from the frame behind it.
    pub(super) fn enter(&self, g: &mut Graph, frame: Motion) -> Motion {
        let back = self.after.inverse();
        let rotation = onwards(g, &frame.rotation, &back.rotation);
        let shift = if self.turns_first() {
            let advance = g.vector(self.advance);
            g.rotate(&frame.rotation, advance)
        } else {
            let shift = g.vector(self.after.translation);
            g.rotate(&rotation, shift)
        };
        Motion {
            rotation,
            translation: g.minus(frame.translation, shift),
        }
    }

    /// A direction before the run, from the same direction behind it.
    fn direction(&self, g: &mut Graph, v: Vector) -> Vector {
        let constant = g.rotation(&self.after.rotation);
        let v = g.rotate(&constant, v);
        turned(g, self.turn, v)
    }

    /// A point before the run, from the same point behind it.
    fn point(&self, g: &mut Graph, x: Vector) -> Vector {
        let constant = g.rotation(&self.after.rotation);
        let x = if self.turns_first() {
            let advance = g.vector(self.advance);
            let x = g.plus(advance, x);
            g.rotate(&constant, x)
        } else {
            let shift = g.vector(self.after.translation);
            let x = g.rotate(&constant, x);
            g.plus(shift, x)
        };
        let x = turned(g, self.turn, x);
        g.plus(self.travel, x)
    }
}

/// R C with a constant C. Where a column of C has no zero, the cross product
/// of the other two is cheaper.
fn onwards(g: &mut Graph, rotation: &[Vector; 3], constant: &[Vec3; 3]) -> [Vector; 3] {
    let full = (0..3).find(|&j| constant.iter().all(|row| row[j] != 0.0));
    let mut columns = [0, 1, 2].map(|j| {
        if Some(j) == full {
            return g.vector([0.0; 3]);
        }
        let column = g.vector(constant.map(|row| row[j]));
        g.rotate(rotation, column)
    });
    if let Some(j) = full {
        columns[j] = g.cross(columns[(j + 1) % 3], columns[(j + 2) % 3]);
    }
    transpose(&columns)
}

pub(super) fn turned(g: &mut Graph, turn: Option<Trig>, v: Vector) -> Vector {
    turn.map_or(v, |turn| g.turn(turn, v))
}

/// The pose of the tip (in base coordinates), by the cheapest of the ways to
/// accumulate the position that are tried.
pub fn tip(g: &mut Graph, linkage: &Linkage, trig: &JointTrig) -> Motion {
    behind(g, linkage, trig, linkage.links.len(), None, &[])[0]
}

/// The frames of the links that some joints move, in base coordinates, each by what the ones before
/// it leave cheapest, or from the one before it; what is cheaper is counted.
pub fn link_frames(
    g: &mut Graph,
    linkage: &Linkage,
    trig: &JointTrig,
    joints: &[usize],
) -> Vec<Motion> {
    cheapest(g, 2, |g, variant| {
        let mut frames: Vec<Motion> = Vec::new();
        for (i, &joint) in joints.iter().enumerate() {
            let before = i.checked_sub(1).filter(|_| variant == 1);
            let before = before.map(|before| (joints[before], frames[before]));
            let next = before.and_then(|before| behind_link(g, linkage, trig, before, joint));
            match next {
                Some(frame) => frames.push(frame),
                None => {
                    let body = linkage.links[joint].body;
                    frames = behind(g, linkage, trig, joint + 1, Some(body), &frames);
                }
            }
        }
        frames
    })
}

/// The frame of a link from that of the one before it, where the two joints are not of one run.
fn behind_link(
    g: &mut Graph,
    linkage: &Linkage,
    trig: &JointTrig,
    (before, frame): (usize, Motion),
    joint: usize,
) -> Option<Motion> {
    let begins = |run: &Run| run.joints.start == joint;
    if before + 1 != joint || !linkage.runs.iter().any(begins) {
        return None;
    }
    let (link, travel) = (&linkage.links[before], g.vector([0.0; 3]));
    let mut between = Stage {
        turn: None,
        travel,
        after: Pose::IDENTITY,
        advance: [0.0; 3],
        axes: Vec::new(),
    };
    between.end_at(link.body.inverse() * link.after);
    let mut stage = stages(g, linkage, trig, joint + 1).pop()?;
    stage.end_at(linkage.links[joint].body);
    let mut frame = between.leave(g, frame);
    let travel = g.rotate(&frame.rotation, stage.travel);
    frame.translation = g.plus(frame.translation, travel);
    let behind = stage.spin(g, frame);
    Some(stage.leave(g, behind))
}

/// The motion from the base to behind joint `upto − 1` and on by its constant
/// motion, or by `last` in place of it; added to `known` motions.
fn behind(
    g: &mut Graph,
    linkage: &Linkage,
    trig: &JointTrig,
    upto: usize,
    last: Option<Pose>,
    known: &[Motion],
) -> Vec<Motion> {
    let mut stages = stages(g, linkage, trig, upto);
    if let (Some(stage), Some(pose)) = (stages.last_mut(), last) {
        stage.end_at(pose);
    }
    let base = g.motion(&linkage.base);
    let splits = compared(stages.len() + 1);
    let forwards = splits.len();
    cheapest(g, forwards + 3, |g, variant| {
        let motion = if variant < forwards {
            position_split(g, base, &stages, splits[variant])
        } else {
            from_the_tip(g, base, &stages, variant - forwards)
        };
        [known, &[motion]].concat()
    })
}

/// The pose of the tip, its orientation from the base onwards.
pub(super) fn tip_by_splitting(g: &mut Graph, linkage: &Linkage, trig: &JointTrig) -> Motion {
    let stages = stages(g, linkage, trig, linkage.links.len());
    let base = g.motion(&linkage.base);
    let splits = compared(stages.len() + 1);
    cheapest(g, splits.len(), |g, variant| {
        position_split(g, base, &stages, splits[variant])
    })
}

/// The pose of the tip with every frame on the way, which Jacobians share.
pub(super) fn tip_forwards(g: &mut Graph, linkage: &Linkage, trig: &JointTrig) -> Motion {
    let stages = stages(g, linkage, trig, linkage.links.len());
    let base = g.motion(&linkage.base);
    position_split(g, base, &stages, 0)
}

/// Places in a chain that are compared: all of an arm of nine joints, and about as many of a
/// longer one, evenly, because what each of them takes grows with the chain as well.
pub(super) fn compared(places: usize) -> Vec<usize> {
    const MOST: usize = 32;
    (0..places).step_by(places.div_ceil(MOST)).collect()
}

/// Builds every variant, counts what it costs, and keeps the cheapest.
pub fn cheapest<T: Outputs>(
    g: &mut Graph,
    variants: usize,
    build: impl Fn(&mut Graph, usize) -> T,
) -> T {
    let before = g.mark();
    let mut best = (usize::MAX, 0);
    for variant in 0..variants {
        let outputs = build(g, variant);
        let cost = g.operations(&outputs.expressions()).weight();
        best = best.min((cost, variant));
        g.back(before);
    }
    build(g, best.1)
}

/// Something whose cost can be counted.
pub trait Outputs {
    /// The expressions it is made of.
    fn expressions(&self) -> Vec<Expr>;
}

impl Outputs for Motion {
    fn expressions(&self) -> Vec<Expr> {
        self.rotation
            .iter()
            .flatten()
            .chain(&self.translation)
            .copied()
            .collect()
    }
}

impl Outputs for Vec<Motion> {
    fn expressions(&self) -> Vec<Expr> {
        self.iter().flat_map(Outputs::expressions).collect()
    }
}

/// The first `horner` stages by Horner's rule, the rest forwards.
fn position_split(g: &mut Graph, base: Motion, stages: &[Stage], horner: usize) -> Motion {
    let (inner, outer) = stages.split_at(horner);
    let mut frame = base;
    frame.translation = horners_rule(g, &base, inner);
    for stage in inner {
        let after = stage.spin(g, frame);
        frame.rotation = onwards(g, &after.rotation, &stage.after.rotation);
    }
    for stage in outer {
        let travel = g.rotate(&frame.rotation, stage.travel);
        frame.translation = g.plus(frame.translation, travel);
        let behind = stage.spin(g, frame);
        frame = stage.leave(g, behind);
    }
    frame
}

/// Everything from the tip inwards: the position, and the orientation without
/// its column `left_out`, which the other two make.
fn from_the_tip(g: &mut Graph, base: Motion, stages: &[Stage], left_out: usize) -> Motion {
    let mut columns = [0, 1, 2].map(|j| g.vector([0, 1, 2].map(|i| f64::from(i == j))));
    for j in (0..3).filter(|&j| j != left_out) {
        for stage in stages.iter().rev() {
            columns[j] = stage.direction(g, columns[j]);
        }
        columns[j] = g.rotate(&base.rotation, columns[j]);
    }
    columns[left_out] = g.cross(columns[(left_out + 1) % 3], columns[(left_out + 2) % 3]);
    Motion {
        rotation: transpose(&columns),
        translation: horners_rule(g, &base, stages),
    }
}

/// Where the origin behind the stages is, innermost vector first.
fn horners_rule(g: &mut Graph, base: &Motion, stages: &[Stage]) -> Vector {
    let mut x = g.vector([0.0; 3]);
    for stage in stages.iter().rev() {
        x = stage.point(g, x);
    }
    let x = g.rotate(&base.rotation, x);
    g.plus(base.translation, x)
}
