//! The chain between base and tip: unit twists at the home configuration, the
//! home pose, limits and names (MLS section 3.2).

mod chain;
mod configurations;
mod frames;
mod limits;
mod locked;
mod mimic;
mod rounded;
mod tip;
mod tool;

use crate::scalar::Scalar;
use crate::spec::{self, ArmSpec, Collector, Diagnostic, Diagnostics, JointType, Limits, Rating};
use crate::vector::norm;
use kin_runtime::{Chain, JointLimit, Pose, Twist};
use std::f64::consts::{PI, TAU};

pub(crate) use configurations::{RANDOM, anywhere, configurations, place, spread};

/// A serial chain at its home configuration (all joint values 0), in the
/// coordinates of the base link; metres and radians.
#[derive(Clone, Debug)]
pub struct Model {
    /// The robot's name, from the file.
    pub name: String,
    /// The link that the chain begins at, in whose frame everything here is given.
    pub base: String,
    /// The link that the chain ends at.
    pub tip: String,
    /// The frame of a tool in that of the tip, x, y and z in metres, then roll, pitch and yaw in
    /// radians; without it the tip is what poses are of.
    pub tool: Option<[f64; 6]>,
    /// The moving joints from base to tip. Fixed joints are folded.
    pub joints: Vec<Joint>,
    /// One per coordinate of the configuration q, in the order of the chain.
    /// Shorter than `joints` when some joints mimic others.
    pub variables: Vec<Variable>,
    /// g_st(0).
    pub home: Pose,
    /// The links that do not move against the base or a link that a joint of the
    /// chain moves, other than the base and the links of coordinates; in the
    /// order of the file.
    pub frames: Vec<Frame>,
    /// What the file has that is odd, and changes nothing that is here.
    pub warnings: Vec<Diagnostic>,
    /// What it is computed in.
    pub scalar: Scalar,
}

/// A moving joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// From the file.
    pub name: String,
    /// Revolute or prismatic; continuous joints are revolute without limits.
    pub kind: JointKind,
    /// Unit direction of the axis at home, base coordinates.
    pub axis: [f64; 3],
    /// A point on the axis: where the file puts the joint's frame; base
    /// coordinates.
    pub point: [f64; 3],
    /// The link that it moves, from the file.
    pub link: String,
    /// The frame of that link at home, base coordinates.
    pub frame: Pose,
    /// Which coordinate of q moves this joint.
    pub variable: usize,
    /// The joint's value is `multiplier * q[variable] + offset`; 1 and 0
    /// unless it mimics another joint.
    pub multiplier: f64,
    /// See `multiplier`.
    pub offset: f64,
    /// How far a slide goes for each metre of its value: 1, but of
    /// [several that are one](crate::geometry::by_coordinates).
    pub gear: f64,
}

impl Joint {
    /// Whether it turns.
    pub fn is_revolute(&self) -> bool {
        self.kind == JointKind::Revolute
    }
}

/// A link that does not move against another one.
#[derive(Clone, Debug)]
pub struct Frame {
    /// From the file.
    pub name: String,
    /// The joint of the chain, from 0, whose link carries it; none for the base.
    pub joint: Option<usize>,
    /// Its frame in that of the link that carries it.
    pub pose: Pose,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis; radians.
    Revolute,
    /// Slides along its axis; metres.
    Prismatic,
}

/// A coordinate of the configuration.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name of the joint that it is.
    pub name: String,
    /// Lower and upper bound in radians or metres; `None` for a continuous
    /// joint.
    pub limits: Option<[f64; 2]>,
    /// How fast and how strong its drive may be, as far as the file says. A
    /// coordinate that moves several joints is as fast as all of them can
    /// follow; its effort is that of the joint that it is.
    pub rating: Rating,
}

impl Variable {
    /// How far a slide goes, metres; none where nothing stops it, as limits like ±1e9 say too, and
    /// none where the limits leave it no way.
    pub fn travel(&self) -> Option<[f64; 2]> {
        let usable = |&[lower, upper]: &[f64; 2]| {
            lower < upper && lower.abs().max(upper.abs()) <= limits::FARTHEST
        };
        self.limits.filter(usable)
    }
}

impl Joint {
    /// Whether this joint is a coordinate of q itself, and mimics no other.
    pub fn is_coordinate(&self, variable: usize) -> bool {
        self.variable == variable && self.multiplier == 1.0 && self.offset == 0.0
    }

    /// The twist of the joint at home (MLS section 3.2.2).
    pub fn twist(&self) -> Twist {
        match self.kind {
            JointKind::Revolute => Twist::revolute(self.axis, self.point),
            JointKind::Prismatic => Twist::prismatic(self.axis.map(|x| self.gear * x)),
        }
    }
}

/// A longer arm was written in millimetres: the longest that exist, in space
/// and on concrete pumps, stay below this.
const LONGEST_ARM: f64 = 100.0;

/// A shorter arm was likely written in metres where millimetres were stated, or in other units.
const SHORTEST_ARM: f64 = 0.01;

/// Metres read as millimetres go no farther, and of an arm this long few slides are meant to.
const SHORTEST_TRAVEL: f64 = 0.003;
const LONG: f64 = 0.1;

impl Model {
    /// The arm as a generic product of exponentials of all joints: the reference that closed forms
    /// are held against. Where joints mimic others they are not the coordinates of q.
    pub fn chain(&self) -> Chain {
        let twists = self.joints.iter().map(|joint| joint.twist()).collect();
        let links = self.joints.iter().map(|joint| joint.frame).collect();
        Chain::geared(twists, self.home).with_links(links)
    }

    /// The values of all joints at the coordinates q.
    pub fn joint_values(&self, q: &[f64]) -> Vec<f64> {
        let joints = self.joints.iter();
        let value = |joint: &Joint| joint.multiplier * q[joint.variable] + joint.offset;
        joints.map(value).collect()
    }

    /// Whether some joints mimic others, so that joints and coordinates of q
    /// are not the same.
    pub fn is_coupled(&self) -> bool {
        let own = |joint: &Joint| joint.multiplier == 1.0 && joint.offset == 0.0;
        self.joints.len() != self.variables.len() || !self.joints.iter().all(own)
    }

    /// The joint that a coordinate of q is, whose link stands for it. Where the
    /// leader is off the chain, that is the first joint that follows it.
    pub fn joint_of(&self, variable: usize) -> usize {
        let mut joints = self.joints.iter();
        let own = joints.position(|joint| joint.is_coordinate(variable));
        let moved = |joint: &Joint| joint.variable == variable;
        own.or_else(|| self.joints.iter().position(moved))
            .unwrap_or(0)
    }

    /// Of every joint, whether its link stands for its coordinate: whether it
    /// is [`Model::joint_of`] that.
    pub fn leaders(&self) -> Vec<bool> {
        let mut leaders = vec![None; self.variables.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            let leader = leaders[joint.variable].get_or_insert(j);
            let own = |j: usize| self.joints[j].is_coordinate(joint.variable);
            if own(j) && !own(*leader) {
                *leader = j;
            }
        }
        let mut leads = vec![false; self.joints.len()];
        leaders.into_iter().flatten().for_each(|j| leads[j] = true);
        leads
    }

    /// Whether a coordinate of q is an angle.
    pub fn turns(&self, variable: usize) -> bool {
        let mut joints = self.joints.iter();
        joints.any(|joint| joint.variable == variable && joint.is_revolute())
    }

    /// The difference of two values of a coordinate of q, modulo 2π where it is an angle.
    pub fn joint_distance(&self, variable: usize, a: f64, b: f64) -> f64 {
        let d = (a - b).abs();
        if self.turns(variable) {
            let d = d % TAU;
            if d > PI { TAU - d } else { d }
        } else {
            d
        }
    }

    /// Whether a full turn of a coordinate of q changes nothing: it moves no slide, and turns joints
    /// a whole number of times.
    pub fn repeats(&self, variable: usize) -> bool {
        let mut moved = self.joints.iter().filter(|it| it.variable == variable);
        moved.all(|it| it.is_revolute() && it.multiplier.fract() == 0.0)
    }

    /// The stops of every coordinate of q. One that does not repeat is as a length.
    pub fn limits(&self) -> Vec<JointLimit> {
        let limit = |i: usize| match (self.repeats(i), self.variables[i].limits) {
            (true, None) => JointLimit::Continuous,
            (true, Some([lower, upper])) => JointLimit::revolute(lower, upper),
            (false, limits) => {
                let [lower, upper] = limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                JointLimit::prismatic(lower, upper)
            }
        };
        (0..self.variables.len()).map(limit).collect()
    }

    /// The chain from `base` to `tip`, by the names of links: any two, such as the hands of two
    /// arms or a foot and what it carries; joints on the way up from the base to where the branches
    /// part are passed from their children to their parents, and turn as the file has them. Without
    /// a base it starts at the root of the tree, or at what a floating or planar joint carries, if
    /// that is all of the robot. Without a tip it ends with the last
    /// joint that moves, fingers left out, at the link that the field calls the
    /// tip (`tool0`, `tcp`, `flange`, `ee_link` and so on), the only leaf there,
    /// or the link that the joint moves.
    ///
    /// ```
    /// use kin_codegen::model::Model;
    /// use kin_codegen::spec::{Source, ArmSpec};
    ///
    /// let text = "\
    /// robot: elbow
    /// units: {angle: rad, length: m}
    /// dh:
    ///   - {name: shoulder, theta: 0, d: 0, a: 0.4, alpha: pi/2}
    ///   - {name: elbow, theta: 0, d: 0, a: 0.3, alpha: 0}
    /// ";
    /// let spec = ArmSpec::parse(&Source { path: "elbow.yaml".into(), text: text.into() })?;
    /// let model = Model::new(&spec, None, None)?;
    /// assert_eq!(model.joints[1].axis, [0.0, -1.0, 0.0]);
    /// assert_eq!(model.joints[1].point, [0.4, 0.0, 0.0]);
    /// assert_eq!(model.home.translation, [0.7, 0.0, 0.0]);
    /// # Ok::<(), kin_codegen::spec::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such chain, it is not the only one, nothing in it moves, or
    /// one of its joints cannot be used: it floats, is planar or spherical, has
    /// limits that cannot be meant, or mimics a fixed joint or by no gear.
    pub fn new(
        spec: &ArmSpec,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<Model, Diagnostics> {
        let mut diagnostics = Collector::new(&spec.source);
        let mut model = build(spec, base, tip, &mut diagnostics);
        if let Some(model) = &mut model {
            model.warnings = [&spec.warnings[..], &diagnostics.take_warnings()].concat();
        }
        diagnostics.unless_any(model)
    }
}

fn build(
    spec: &ArmSpec,
    base: Option<&str>,
    tip: Option<&str>,
    diagnostics: &mut Collector,
) -> Option<Model> {
    let spec = &*chain::hung_on_base(spec, base, tip);
    let chain = chain::choose(spec, base, tip, diagnostics)?;
    let mut used = vec![false; spec.joints.len()];
    chain.joints.iter().for_each(|&j| used[j] = true);
    for (joint, used) in spec.joints.iter().zip(used) {
        match used {
            true => diagnostics.put(joint.faults.iter().cloned()),
            false => diagnostics.put_warnings(&joint.faults),
        }
    }
    if !diagnostics.is_empty() {
        return None;
    }
    check_motions(spec, &chain, diagnostics);
    check_size(spec, &chain, diagnostics);
    rounded::check(spec, &chain, diagnostics);
    limits::check(spec, &chain, diagnostics);
    let drives = mimic::resolve(spec, &chain.joints, diagnostics)?;
    let variables = limits::variables(spec, &drives, diagnostics);
    let (joints, home) = compose(spec, &chain, &drives);
    let mut model = Model {
        name: spec.name.clone(),
        base: spec.links[chain.base].name.clone(),
        tip: spec.links[chain.tip].name.clone(),
        tool: None,
        joints,
        variables,
        home,
        frames: Vec::new(),
        warnings: Vec::new(),
        scalar: Scalar::default(),
    };
    model.frames = frames::fixed(spec, &chain, &model.leaders());
    Some(model)
}

/// Every joint is fixed, or moves in one way, and one moves at least.
fn check_motions(spec: &ArmSpec, chain: &chain::Chain, diagnostics: &mut Collector) {
    let joints = || chain.joints.iter().map(|&j| &spec.joints[j]);
    for (place, joint) in joints().enumerate() {
        let motion = match joint.kind {
            JointType::Floating => "floats, which is six coordinates in one joint",
            JointType::Planar => "is planar, which is three coordinates in one joint",
            JointType::Spherical => "is spherical, which is three coordinates in one joint",
            JointType::Fixed | JointType::Revolute | JointType::Prismatic => continue,
        };
        let moves_behind = joints()
            .skip(place + 1)
            .any(|it| it.kind != JointType::Fixed);
        let begin = match moves_behind {
            true => format!(
                "begin the chain behind it (base = \"{}\") or ",
                spec.links[joint.child].name
            ),
            false => String::new(),
        };
        let remedy =
            format!("{begin}end it before (tip), or replace it by revolute and prismatic joints");
        diagnostics.at(joint.at, format!("joint `{}` {motion}", joint.name), remedy);
    }
    if joints().all(|joint| joint.kind == JointType::Fixed) {
        let (base, tip) = (&spec.links[chain.base].name, &spec.links[chain.tip].name);
        let reason =
            format!("nothing moves between `{base}` and `{tip}`: all joints there are fixed");
        diagnostics.whole(reason, "choose another base or tip");
    }
}

fn check_size(spec: &ArmSpec, chain: &chain::Chain, diagnostics: &mut Collector) {
    let length = |&j: &usize| {
        let joint = &spec.joints[j];
        norm(joint.origin.translation) + norm(joint.mount.translation)
    };
    let total: f64 = chain.joints.iter().map(length).sum();
    let longest = chain
        .joints
        .iter()
        .max_by(|a, b| length(a).total_cmp(&length(b)));
    // A slide may be all that has a length.
    let travel = |&j: &usize| match (spec.joints[j].kind, spec.joints[j].limits) {
        (JointType::Prismatic, Limits::Range { lower, upper, .. }) => lower.abs().max(upper.abs()),
        _ => 0.0,
    };
    let reach = total + chain.joints.iter().map(travel).sum::<f64>();
    if total > 0.0 && reach < SHORTEST_ARM {
        let reason = format!("the chain is {:.4} mm long", 1e3 * total);
        let remedy = "check the unit of its lengths: a URDF has metres, YAML what `units` states";
        diagnostics.warn_whole(reason, remedy);
    }
    let farthest = chain.joints.iter().map(travel).fold(0.0, f64::max);
    if farthest > 0.0 && farthest < SHORTEST_TRAVEL && total > LONG {
        let reason = format!(
            "no joint slides farther than {:.4} mm from zero, of an arm {total:.4} m long: this looks \
             like metres, read as millimetres",
            1e3 * farthest
        );
        let remedy = "write limits in the unit of the file: metres in a URDF, in YAML what `units` \
                      states";
        diagnostics.warn_whole(reason, remedy);
    }
    if let Some(&longest) = longest.filter(|_| total > LONGEST_ARM) {
        let joint = &spec.joints[longest];
        // What is fixed may be a link of the file that is no joint there.
        let place = match joint.kind {
            JointType::Fixed => format!("link `{}`", spec.links[joint.child].name),
            _ => format!("joint `{}`", joint.name),
        };
        let reason = format!(
            "the chain is {total:.4} m long, {:.4} m of it at {place}: this looks like millimetres",
            length(&longest)
        );
        diagnostics.at(
            joint.at,
            reason,
            "write metres in a URDF, or state the unit in YAML: `units: {length: mm}`; if that is \
             stated, correct the number",
        );
    }
}

/// Places every moving joint in base coordinates; fixed ones fold into the
/// next. Also the home pose.
fn compose(spec: &ArmSpec, chain: &chain::Chain, drives: &mimic::Drives) -> (Vec<Joint>, Pose) {
    let mut pose = Pose::IDENTITY;
    let mut joints = Vec::new();
    for &j in &chain.joints {
        let spec::Joint {
            name,
            axis,
            origin,
            mount,
            ..
        } = &spec.joints[j];
        let at = pose * *origin;
        pose = at * *mount;
        let Some(drive) = drives.of(j) else { continue };
        joints.push(Joint {
            name: name.clone(),
            kind: match spec.joints[j].kind {
                JointType::Prismatic => JointKind::Prismatic,
                _ => JointKind::Revolute,
            },
            axis: at.rotate(*axis),
            point: at.translation,
            link: spec.links[spec.joints[j].child].name.clone(),
            frame: pose,
            variable: drive.variable,
            multiplier: drive.multiplier,
            offset: drive.offset,
            gear: 1.0,
        });
    }
    (joints, pose)
}
