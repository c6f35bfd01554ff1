//! From a robot file to a robot.

use super::NamedPosture;
use kin_codegen::arm::{CompiledArm, Forward};
use kin_codegen::closed_form::Domain;
use kin_codegen::expr::forward::Outputs;
use kin_codegen::expr::{Fusing, Tape};
use kin_codegen::spec::{Diagnostic, Diagnostics};
use kin_codegen::{Compiled, Error, Options, Scalar, Source, compile, compile_cached};
use kin_runtime::{Chain, JointLimit};
use std::path::Path;
use std::str::FromStr;
use std::sync::OnceLock;

/// An arm that is known when the program runs: from a URDF or a YAML file as
/// [`kinematics!`](crate::kinematics!) takes it, with the same options, refusals and methods, on
/// slices.
///
/// Reading one compiles it, which takes as long as in a build: in release 4 to 8 ms for a six-axis
/// arm with an exact closed form, 40 ms for one that an elimination solves. What the links' poses, Jacobians and singularities need is built when
/// they are first asked for, in up to some milliseconds more.
///
/// ```
/// use kinematics::Robot;
/// let arm = Robot::from_urdf("robots/ur5e.urdf")?;
/// let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4]; // radians
/// let pose = arm.fk(&q);
/// let solutions = arm.ik(&pose);
/// assert_eq!(solutions.len(), 8);
/// let nearest = arm.ik_nearest(&pose, &q).unwrap();
/// assert!(nearest.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9));
/// # Ok::<(), kinematics::LoadError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Robot {
    pub(super) arm: CompiledArm,
    pub(super) chain: Chain,
    pub(super) limits: Vec<JointLimit>,
    pub(super) tip: Tape,
    links: OnceLock<Tape>,
    jacobians: OnceLock<Jacobians>,
    singular: OnceLock<Option<Tape>>,
    /// Of a robot with parameters.
    pub(super) domain: Option<Domain>,
    /// What its branches are called, as soon as somebody asks.
    pub(super) postures: OnceLock<Vec<NamedPosture>>,
}

/// What is made of Jacobians runs these.
#[derive(Clone, Debug)]
pub(super) struct Jacobians {
    /// The tip, and behind it the spatial Jacobian.
    pub both: Tape,
    /// The spatial Jacobian alone, where it is not taken from these.
    pub spatial: Option<Tape>,
    pub body: Tape,
    pub geometric: Tape,
    /// The time derivative of the spatial Jacobian, of q and its rates, where joints mimic others.
    pub dot: Option<Tape>,
}

impl Jacobians {
    fn of(forward: &Forward) -> Self {
        let plain = |outputs: &dyn Outputs| Tape::new(&forward.graph, &outputs.expressions());
        let of = |outputs: &dyn Outputs| plain(outputs).fusing(Fusing::All);
        Self {
            both: of(&forward.both),
            spatial: forward.spatial_alone().map(|spatial| of(spatial)),
            body: of(&forward.body),
            geometric: of(&forward.geometric),
            dot: forward.dot.as_ref().map(|dot| plain(dot)),
        }
    }
}

impl Robot {
    /// Reads a URDF file. What a file is in is decided as everywhere: by the ending of its name,
    /// and by its first character where that says nothing.
    ///
    /// # Errors
    ///
    /// The file cannot be read, something is wrong with it, or its robot has no closed form.
    pub fn from_urdf(path: impl AsRef<Path>) -> Result<Self, Error> {
        let source = Source::read(&path.as_ref().to_string_lossy(), Path::new(""))?;
        Self::load(&source, &Options::default())
    }

    /// Reads a YAML file.
    ///
    /// # Errors
    ///
    /// As [`Robot::from_urdf`].
    pub fn from_yaml(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::from_urdf(path)
    }

    /// Reads a robot with options: base and tip, `target`, `free`, without inverse kinematics,
    /// and so on.
    ///
    /// ```
    /// use kinematics::{Robot, RobotOptions, RobotSource};
    /// let source = RobotSource::read("robots/panda.yaml", std::path::Path::new("."))?;
    /// let options = RobotOptions { free: vec!["joint1".into()], ..Default::default() };
    /// let panda = Robot::load(&source, &options)?;
    /// let q = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    /// let pose = panda.fk(&q);
    /// let given = panda.redundancy(&pose, &q);
    /// assert_eq!(given, [0.3]);
    /// assert!(panda.ik_at(&pose, &given).iter().any(|s| (s.q[3] + 1.8).abs() < 1e-9));
    /// # Ok::<(), kinematics::LoadError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// What is wrong with the file or the options, or why the robot has no closed form. A
    /// mechanism of several chains is none of these robots.
    pub fn load(source: &Source, options: &Options) -> Result<Self, Error> {
        Self::compiled(source, options, || compile(source, options))
    }

    /// The same with a folder that keeps what was found: the next time that a robot is read with
    /// the same options, by the same version of this crate, nothing is searched for or certified,
    /// and the answers are the same to the last bit. Files of changed robots, of other versions and
    /// damaged ones are not used, nor are those of another build of this version that certified
    /// other expressions; several programs may share a folder. One that cannot be
    /// written keeps nothing; whoever can write it decides what robots answer.
    ///
    /// ```
    /// use kinematics::{Robot, RobotOptions, RobotSource};
    /// let folder = std::env::temp_dir().join("robots");
    /// let source = RobotSource::read("robots/ur5e.urdf", std::path::Path::new("."))?;
    /// let first = Robot::load_cached(&source, &RobotOptions::default(), &folder)?;
    /// let again = Robot::load_cached(&source, &RobotOptions::default(), &folder)?;
    /// let pose = first.fk(&[0.3, -1.2, 1.5, -0.7, 1.1, 0.4]);
    /// assert_eq!(first.ik(&pose), again.ik(&pose));
    /// # Ok::<(), kinematics::LoadError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Robot::load`].
    pub fn load_cached(
        source: &Source,
        options: &Options,
        folder: impl AsRef<Path>,
    ) -> Result<Self, Error> {
        let folder = folder.as_ref();
        Self::compiled(source, options, || compile_cached(source, options, folder))
    }

    fn compiled(
        source: &Source,
        options: &Options,
        compile: impl FnOnce() -> Result<Compiled, Error>,
    ) -> Result<Self, Error> {
        if options.scalar != Scalar::default() {
            let reason = "a robot that is read at run time computes in f64 alone";
            let remedy = "leave out `scalar = f32`, or generate its code";
            return Err(Diagnostics::one(&source.path, Diagnostic::whole(reason, remedy)).into());
        }
        let Compiled::Arm(arm) = compile()? else {
            let reason = "the file has a mechanism of several chains, which is no arm";
            let remedy =
                "generate its code with `kinematics!`, in a build script or by `kin generate`";
            return Err(Diagnostics::one(&source.path, Diagnostic::whole(reason, remedy)).into());
        };
        Ok(Self::new(*arm))
    }

    fn new(arm: CompiledArm) -> Self {
        let poses = arm.poses();
        let model = &arm.model;
        Self {
            chain: model.chain(),
            limits: model.limits(),
            tip: Tape::new(&poses.graph, &poses.tip.expressions()).fusing(Fusing::All),
            links: OnceLock::new(),
            jacobians: OnceLock::new(),
            singular: OnceLock::new(),
            domain: arm.redundancy.as_ref().and(arm.form()).map(Domain::of),
            postures: OnceLock::new(),
            arm,
        }
    }

    /// Built when they are first asked for.
    pub(super) fn links(&self) -> &Tape {
        self.links.get_or_init(|| {
            let (poses, links) = self.arm.poses_of_links();
            Tape::new(&poses.graph, &links.expressions()).fusing(Fusing::All)
        })
    }

    /// Built when they are first asked for.
    pub(super) fn jacobians(&self) -> &Jacobians {
        let build = || Jacobians::of(self.arm.forward());
        self.jacobians.get_or_init(build)
    }

    /// The determinant of the Jacobian, and behind it how far singularities are; built when it is
    /// first asked for.
    pub(super) fn singular(&self) -> Option<&Tape> {
        let build = || {
            let singular = self.arm.singular()?;
            let values = singular.values().into_iter();
            let outputs = std::iter::once(singular.determinant.product).chain(values);
            Some(Tape::new(&singular.graph, &outputs.collect::<Vec<_>>()))
        };
        self.singular.get_or_init(build).as_ref()
    }
}

impl FromStr for Robot {
    type Err = Error;

    /// Reads a robot from the text of a file: a URDF if it begins with `<`, otherwise YAML.
    fn from_str(text: &str) -> Result<Self, Error> {
        let is_markup = text
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with('<');
        let path = if is_markup {
            "robot.urdf"
        } else {
            "robot.yaml"
        };
        let source = Source {
            path: path.into(),
            text: text.into(),
        };
        Self::load(&source, &Options::default())
    }
}
