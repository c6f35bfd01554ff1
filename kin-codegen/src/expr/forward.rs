//! Forward kinematics as expressions.
//!
//! T = C₀ J₁ C₁ … Jₙ Cₙ is gathered by runs of parallel joints: a run turns by
//! the sum of its angles and travels by a vector of its own frame. Orientation
//! multiplies up from the base. The position has a choice: the first runs by
//! Horner's rule (innermost vector first, turned outwards), the rest forwards
//! with the columns of the orientation; what is cheaper is counted, not
//! guessed.

use super::linear::{Motion, Trig, Vector};
use super::{Expr, Graph};
use crate::geometry::{Linkage, Travel};
use kin_runtime::Pose;

/// What the joints of a linkage do, as expressions.
#[derive(Clone, Debug)]
pub struct Stance {
    /// For every joint the sine and cosine of the sum of the angles of its
    /// run, from the run's first joint to itself.
    pub sums: Vec<Trig>,
    /// How far each joint slides; zero for revolute joints.
    pub slides: Vec<Expr>,
}

impl Stance {
    /// The stance for given joint values.
    pub fn at(g: &mut Graph, linkage: &Linkage, q: &[Expr]) -> Self {
        let mut sums = Vec::with_capacity(linkage.links.len());
        let mut slides = Vec::with_capacity(linkage.links.len());
        for run in &linkage.runs {
            let mut angle = g.zero();
            let mut symbol = String::new();
            for link in &linkage.links[run.joints.clone()] {
                let moved = joint_value(g, link.gain, link.offset, q[link.variable]);
                let slide = match link.travel {
                    Travel::Turn => {
                        angle = g.add(angle, moved);
                        symbol.push_str(&subscript(link.variable));
                        g.zero()
                    }
                    Travel::Slide(_) => moved,
                };
                let (sin, cos) = g.sin_cos(angle);
                sums.push(Trig {
                    sin: g.named(sin, format!("s{symbol}")),
                    cos: g.named(cos, format!("c{symbol}")),
                });
                slides.push(slide);
            }
        }
        Self { sums, slides }
    }
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

fn joint_value(g: &mut Graph, gain: f64, offset: f64, q: Expr) -> Expr {
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
    /// The run's joints.
    pub members: Vec<Member>,
}

/// A joint within its run, seen from the frame before the run.
pub(super) struct Member {
    /// A point of the axis.
    pub point: Vector,
    /// Where the joint slides to; none for a revolute joint, which turns
    /// about z.
    pub slide: Option<Vector>,
}

/// The chain from the base's constant motion to behind joint `upto − 1`, run
/// by run.
pub(super) fn stages(g: &mut Graph, linkage: &Linkage, stance: &Stance, upto: usize) -> Vec<Stage> {
    let mut stages = Vec::new();
    for run in linkage.runs.iter().filter(|run| run.joints.start < upto) {
        let travel = g.vector([0.0; 3]);
        let mut stage = Stage {
            turn: None,
            travel,
            after: Pose::IDENTITY,
            members: Vec::new(),
        };
        for i in run.joints.clone().take_while(|&i| i < upto) {
            stage.append(g, linkage, stance, i);
        }
        stages.push(stage);
    }
    stages
}

impl Stage {
    fn append(&mut self, g: &mut Graph, linkage: &Linkage, stance: &Stance, joint: usize) {
        let link = &linkage.links[joint];
        let shift = g.vector(self.after.translation);
        let shift = turned(g, self.turn, shift);
        self.travel = g.plus(self.travel, shift);
        let point = self.travel;
        let mut slide = None;
        match link.travel {
            Travel::Turn => self.turn = Some(stance.sums[joint]),
            Travel::Slide(v) => {
                let v = g.vector(v);
                let v = turned(g, self.turn, v);
                let way = g.scale(stance.slides[joint], v);
                self.travel = g.plus(self.travel, way);
                slide = Some(v);
            }
        }
        self.after = link.after;
        self.members.push(Member { point, slide });
    }
}

pub(super) fn turned(g: &mut Graph, turn: Option<Trig>, v: Vector) -> Vector {
    turn.map_or(v, |turn| g.turn(turn, v))
}

/// The pose of the tip (in base coordinates), by the cheapest of the ways to
/// accumulate the position that are tried.
pub fn tip(g: &mut Graph, linkage: &Linkage, stance: &Stance) -> Motion {
    behind(g, linkage, stance, linkage.links.len(), None)
}

/// The frame of the link that joint `i` moves, in base coordinates.
pub fn link_frame(g: &mut Graph, linkage: &Linkage, stance: &Stance, i: usize) -> Motion {
    let body = linkage.links[i].body;
    behind(g, linkage, stance, i + 1, Some(body))
}

/// The motion from the base to behind joint `upto − 1` and on by its constant
/// motion, or by `last` in place of it.
fn behind(
    g: &mut Graph,
    linkage: &Linkage,
    stance: &Stance,
    upto: usize,
    last: Option<Pose>,
) -> Motion {
    let mut stages = stages(g, linkage, stance, upto);
    if let (Some(stage), Some(pose)) = (stages.last_mut(), last) {
        stage.after = pose;
    }
    let base = g.motion(&linkage.base);
    cheapest(g, stages.len() + 1, |g, horner| {
        position_split(g, base, &stages, horner)
    })
}

/// Builds every variant in a copy of the graph and keeps the cheapest.
pub fn cheapest<T: Outputs>(
    g: &mut Graph,
    variants: usize,
    build: impl Fn(&mut Graph, usize) -> T,
) -> T {
    let mut best: Option<(usize, Graph, T)> = None;
    for variant in 0..variants {
        let mut trial = g.clone();
        let outputs = build(&mut trial, variant);
        let cost = trial.operations(&outputs.expressions()).weight();
        if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
            best = Some((cost, trial, outputs));
        }
    }
    match best {
        Some((_, graph, outputs)) => {
            *g = graph;
            outputs
        }
        None => build(g, 0),
    }
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

/// The first `horner` stages by Horner's rule, the rest forwards.
fn position_split(g: &mut Graph, base: Motion, stages: &[Stage], horner: usize) -> Motion {
    let mut inner = g.vector([0.0; 3]);
    for stage in stages[..horner].iter().rev() {
        let rotation = g.rotation(&stage.after.rotation);
        let shift = g.vector(stage.after.translation);
        let x = g.rotate(&rotation, inner);
        let x = g.plus(shift, x);
        let x = turned(g, stage.turn, x);
        inner = g.plus(stage.travel, x);
    }
    let shift = g.rotate(&base.rotation, inner);
    let mut translation = g.plus(base.translation, shift);
    let mut rotation = base.rotation;
    for (k, stage) in stages.iter().enumerate() {
        if k >= horner {
            let travel = g.rotate(&rotation, stage.travel);
            translation = g.plus(translation, travel);
        }
        if let Some(turn) = stage.turn {
            let turn = g.rotation_z(turn);
            rotation = g.product(&rotation, &turn);
        }
        if k >= horner {
            let shift = g.vector(stage.after.translation);
            let shift = g.rotate(&rotation, shift);
            translation = g.plus(translation, shift);
        }
        let constant = g.rotation(&stage.after.rotation);
        rotation = g.product(&rotation, &constant);
    }
    Motion {
        rotation,
        translation,
    }
}
