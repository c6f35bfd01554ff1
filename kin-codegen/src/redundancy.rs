//! Arms with more joints than their targets have coordinates: which joints are given
//! with the target, so that the others have isolated solutions.

mod choices;
mod named;
mod weighed;

use crate::geometry::{
    Linkage, Swivel, by_coordinates, coupled_rank, rank, uncoupled, uncoupled_behind,
};
use crate::model::Model;
use crate::plan::Target;
use crate::solver::{Certified, Coupled, NoClosedForm, alike, solve, solve_uncoupled};
use choices::{all, choices};
use kin_runtime::__private::Completion;
pub use named::{SWIVEL, named};
use weighed::weigh;
pub use weighed::{Weighed, carriers, costs_as_much};

/// Of so many singular targets one may be without a solution where the swivel angle is given: one at which
/// the elbow is off the line of shoulder and wrist by no more than their axes are off meeting.
const SELDOM: usize = 100;
/// Choices that are solved in search of one that has a solution at every singular target.
const SOLVED: usize = 8;

/// What the option `free` asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asked {
    /// Joints, by the coordinates that they are, ascending.
    pub joints: Vec<usize>,
    /// The swivel, if its angle is to be given.
    pub swivel: Option<Swivel>,
}

impl Asked {
    /// How many numbers are given by it.
    pub(crate) fn count(&self) -> usize {
        self.joints.len() + usize::from(self.swivel.is_some())
    }
}

/// The joints that stay free, and why these.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundancy {
    /// The coordinates that they are, ascending; one parameter for each.
    pub joints: Vec<usize>,
    /// The swivel, if its angle is a parameter, behind those.
    pub swivel: Option<Swivel>,
    /// Whether the turn of the tool about the tip's z axis is a parameter, behind those.
    /// The closed form is then one for whole poses.
    pub turn: bool,
    /// What of targets counts.
    pub target: Target,
    /// What they were chosen from, the best first; empty where they were asked for.
    pub weighed: Vec<Weighed>,
}

impl Redundancy {
    /// How many numbers are given beside a target.
    pub fn parameters(&self) -> usize {
        self.joints.len() + usize::from(self.swivel.is_some()) + usize::from(self.turn)
    }
}

/// How many coordinates of its targets an arm can choose at once: as many as there are independent
/// ways in which the joints change them. One at least: joints that change nothing are refused for
/// that, and not given one and all.
fn coordinates(model: &Model, target: Target) -> usize {
    let all = target.coordinates();
    if !model.is_coupled() {
        return rank(model, target).clamp(1, all);
    }
    if let Some(own) = by_coordinates(model) {
        return coordinates(&own, target);
    }
    let uncoupled = uncoupled(model).ok();
    let rank = uncoupled.and_then(|(model, linkage)| {
        let coupling = linkage.coupling?;
        Some(coupled_rank(&model, &coupling, target))
    });
    rank.unwrap_or(all).clamp(1, all)
}

/// Whether joints are given beside a target: because they are asked for, or because fewer can choose
/// as much. Two neighbours that turn about one line are rather a slip in the file, and not passed
/// over unless they have to be.
pub fn is_redundant(model: &Model, target: Target, asked: &Asked) -> bool {
    if model.is_coupled()
        && let Some(model) = by_coordinates(model)
    {
        return is_redundant(&model, target, asked);
    }
    let n = model.variables.len();
    let turns_twice = || !model.is_coupled() && alike(model).any(|i| model.joints[i].is_revolute());
    asked.count() > 0
        || n > target.coordinates()
        || n > coordinates(model, target) && !turns_twice()
}

/// Finds and verifies a closed form of an arm with more joints than its targets have
/// coordinates. Of the joints that may stay free, those are taken that leave joints which sweep much
/// of the space of targets, of an arm off its design first those at the ends of the chain, and of these
/// those whose plan needs the fewest operations, and the last; where no others have a plan,
/// those at an end that leave the best polynomial between them.
///
/// # Errors
///
/// Why there is none.
pub fn solve_redundant(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    asked: &Asked,
) -> Result<(Certified, Redundancy), NoClosedForm> {
    if model.is_coupled() {
        let Some(model) = by_coordinates(model) else {
            return solve_carried(model, target, asked);
        };
        let linkage = Linkage::new(&model);
        let asked = with_geared(&model, target, asked)?;
        return solve_redundant(&model, &linkage, target, &asked);
    }
    let wanted = Wanted::new(model, target, asked);
    match wanted.by_swivel(model, linkage, asked) {
        Some(found) => found,
        None => wanted.by_joints(model, linkage, &asked.joints),
    }
}

/// The same of an arm whose joints mimic others, as many in front as are to spare: these are given.
fn solve_carried(
    model: &Model,
    target: Target,
    asked: &Asked,
) -> Result<(Certified, Redundancy), NoClosedForm> {
    let refused = NoClosedForm::Mimic(Coupled::Redundant);
    let count = model.variables.len() - coordinates(model, target);
    let is_in_front = |i: &usize| *i < count;
    if count > carrying(model) || asked.swivel.is_some() || !asked.joints.iter().all(is_in_front) {
        return Err(refused);
    }
    let uncoupled = uncoupled_behind(model, count);
    let (model, linkage) = uncoupled.map_err(|reason| NoClosedForm::Mimic(reason.into()))?;
    let certified = solve_uncoupled(&model, &linkage, target)?;
    let redundancy = Redundancy {
        joints: (0..count).collect(),
        swivel: None,
        turn: false,
        target,
        weighed: Vec::new(),
    };
    Ok((certified, redundancy))
}

/// How many joints in front mimic none and are mimicked by none.
fn carrying(model: &Model) -> usize {
    let is_alone = |i: &usize| {
        let others = model.joints.iter().filter(|it| it.variable == *i);
        model.joints[*i].is_coordinate(*i) && others.count() == 1
    };
    (0..model.joints.len()).take_while(is_alone).count()
}

/// What is asked for, and slides that are never solved for.
fn with_geared(model: &Model, target: Target, asked: &Asked) -> Result<Asked, NoClosedForm> {
    let mut all = asked.clone();
    let most = Wanted::new(model, target, asked).count;
    for (i, joint) in model.joints.iter().enumerate() {
        if joint.gear != 1.0 && !asked.joints.contains(&i) {
            if all.count() == most {
                return Err(NoClosedForm::Mimic(Coupled::Geared(joint.name.clone())));
            }
            all.joints.push(i);
        }
    }
    all.joints.sort_unstable();
    Ok(all)
}

/// What is given beside a target, and what is left to be solved.
struct Wanted {
    /// What of targets counts.
    aim: Target,
    /// Whether the turn of the tool is given.
    turn: bool,
    /// What counts of what is left.
    target: Target,
    /// How many joints are given, or the swivel.
    count: usize,
}

impl Wanted {
    fn new(model: &Model, aim: Target, asked: &Asked) -> Self {
        let excess = model.joints.len() - coordinates(model, aim);
        // Of a target that leaves the turn of the tool free, that is a parameter before any
        // joint is, if the joints turn it, and what is left to be solved are whole poses.
        let turn = aim == Target::PositionAxis
            && asked.count() < excess
            && coordinates(model, Target::Pose) > coordinates(model, aim);
        Self {
            aim,
            turn,
            target: if turn { Target::Pose } else { aim },
            count: excess - usize::from(turn),
        }
    }

    fn redundancy(&self, joints: Vec<usize>, swivel: Option<Swivel>) -> Redundancy {
        Redundancy {
            joints,
            swivel,
            turn: self.turn,
            target: self.aim,
            weighed: Vec::new(),
        }
    }

    /// With the swivel given, if it is asked for, or none is and it solves the arm at best; none
    /// otherwise.
    fn by_swivel(
        &self,
        model: &Model,
        linkage: &Linkage,
        asked: &Asked,
    ) -> Option<Result<(Certified, Redundancy), NoClosedForm>> {
        let may_be = asked.joints.is_empty() && self.count == 1 && self.target == Target::Pose;
        let swivel = asked.swivel.or_else(|| {
            // Off its design an arm is solved faster, and loses less, with a joint at an end given.
            let unmoved = linkage.scalar.tolerances().unmoved;
            may_be.then(|| Swivel::of(model, unmoved)).flatten()
        })?;
        let linkage = linkage.clone().with_swivel(Some(swivel));
        let is_asked = asked.swivel.is_some();
        let is_good = |found: &Certified| {
            let certificate = &found.certificate;
            found.form.is_exact()
                && certificate.lost == 0
                && SELDOM * certificate.unanswered <= certificate.singular
        };
        match solve(model, &linkage, self.target) {
            Ok(found) if is_asked || is_good(&found) => {
                Some(Ok((found, self.redundancy(Vec::new(), Some(swivel)))))
            }
            Err(reason) if is_asked => Some(Err(NoClosedForm::Free {
                joints: vec![SWIVEL.into()],
                reason: Box::new(reason),
            })),
            _ => None,
        }
    }

    /// With the joints given that are asked for, and the best of those that may be beside them.
    fn by_joints(
        &self,
        model: &Model,
        linkage: &Linkage,
        asked: &[usize],
    ) -> Result<(Certified, Redundancy), NoClosedForm> {
        let given = with_repeated(model, asked, self.count);
        let n = model.joints.len();
        let choices = choices(n, self.count, &given);
        let weighed = match choices.iter().flatten().collect::<Vec<_>>()[..] {
            [only] => vec![Weighed {
                joints: only.clone(),
                weight: None,
            }],
            _ => weigh(model, linkage, self.target, choices),
        };
        let mut found = Vec::new();
        let mut refusal = None;
        let chosen = weighed.iter().map(|choice| &choice.joints);
        // Where none of these is solved, the rest may be.
        let rest = all(n, self.count, asked).unwrap_or_default();
        let rest = rest
            .iter()
            .filter(|joints| chosen.clone().all(|it| it != *joints));
        for (joints, is_rest) in chosen
            .clone()
            .map(|it| (it, false))
            .chain(rest.map(|it| (it, true)))
        {
            if is_rest && !found.is_empty() {
                break;
            }
            match solve(model, &linkage.clone().with_locked(joints), self.target) {
                Ok(certified) => {
                    let Certified { form, certificate } = &certified;
                    let is_good = match form.completion() {
                        Completion::Unanswered => false,
                        _ => certificate.is_complete(),
                    };
                    // An elimination looks for solutions of each infinite family, if it is asked.
                    let may_be_better = !form.asks_elimination() && found.len() + 1 < SOLVED;
                    let is_last = certificate.lost == 0 && (is_good || !may_be_better);
                    found.push((certified, joints.clone()));
                    if is_last {
                        break;
                    }
                }
                Err(reason) => {
                    let name = |&joint: &usize| model.joints[joint].name.clone();
                    refusal.get_or_insert(match joints[..] {
                        [] => reason,
                        _ => NoClosedForm::Free {
                            joints: joints.iter().map(name).collect(),
                            reason: Box::new(reason),
                        },
                    });
                }
            }
        }
        let quality = |it: &Certified| {
            let is_completed = it.form.completion() == Completion::Unanswered;
            (it.certificate.missing(), is_completed)
        };
        let best = found.into_iter().min_by_key(|(it, _)| quality(it));
        let Some((found, joints)) = best else {
            return Err(refusal.unwrap_or(NoClosedForm::Redundant(self.target)));
        };
        let mut redundancy = self.redundancy(joints, None);
        if asked.len() != self.count {
            redundancy.weighed = weighed;
        }
        Ok((found, redundancy))
    }
}

/// Joints that are asked for, and those that have to be given in any case: of neighbours that do the
/// same all but one.
fn with_repeated(model: &Model, asked: &[usize], count: usize) -> Vec<usize> {
    let mut given = asked.to_vec();
    let alike: Vec<usize> = alike(model).collect();
    for run in alike.chunk_by(|a, b| a + 1 == *b) {
        let run = run[0]..run[0] + run.len() + 1;
        let mut left: Vec<usize> = run.filter(|joint| !asked.contains(joint)).collect();
        left.pop();
        given.extend(left);
    }
    given.truncate(count);
    given
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::spec::{ArmSpec, Source};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Angles of six digits, and of four.
    const RAIL: &str = "\
robot: arm
units: {angle: rad, length: m}
joints:
  - {name: rail, axis: [0, 1, 0], type: prismatic, limits: [0, 0.9]}
  - {name: pan, xyz: [0, 0, 0.2807], rpy: [0, 0, 1.5708], axis: [0, 0, 1]}
  - {name: lift, rpy: [1.570796, 0, 0], axis: [0, 0, 1]}
  - {name: elbow, xyz: [-0.6127, 0, 0], axis: [0, 0, 1]}
  - {name: wrist_1, xyz: [-0.57155, 0, 0.17415], axis: [0, 0, 1]}
  - {name: wrist_2, xyz: [0, -0.11985, 0], rpy: [1.570796, 0, 0], axis: [0, 0, 1]}
  - {name: wrist_3, xyz: [0, 0.11655, 0], rpy: [1.570796, 3.141593, 3.141593], axis: [0, 0, 1]}
tip: tool0
";

    /// A turntable under an arm, with noise of 1e-8.
    const TABLE: &str = "\
robot: arm
units: {angle: rad, length: m}
dh:
  - {name: table, a: 0.400000004, alpha: 1.570796328, d: 0.199999993, theta: 0.000000023}
  - {name: q1, a: 0.149999996, alpha: -1.570796334, d: 0.524999986, theta: 0.000000008}
  - {name: q2, a: 0.789999995, alpha: 3.141592651, d: -0.000000008, theta: -1.570796338}
  - {name: q3, a: 0.249999995, alpha: -1.570796359, d: 0.000000004, theta: -0.000000009}
  - {name: q4, a: -0.000000007, alpha: 1.570796329, d: -0.835000004, theta: 0.000000012}
  - {name: q5, a: -0.000000009, alpha: -1.570796325, d: 0.000000001, theta: 0.000000002}
  - {name: q6, a: -0.000000013, alpha: 3.141592652, d: -0.099999986, theta: -0.000000015}
";

    /// Where it stands is given, though another joint would leave a plan of axes that are told to more
    /// digits, or the only plan.
    #[test]
    fn what_an_arm_stands_on_is_given() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let read = |file: &str| std::fs::read_to_string(root.join(file)).unwrap();
        let column = "mdh:\n  - {name: column, link: carriage, alpha: 0, a: 0, theta: 0, d: 0, \
                      type: prismatic, limits: [0, 1000]}\n";
        let lifted = read("robots/xarm6.yaml").replace("mdh:\n", column);
        for text in [RAIL.to_owned(), TABLE.to_owned(), lifted] {
            assert_eq!(solved(text.clone()).joints, [0], "{text}");
        }
    }

    /// Where two axes are aligned, the cheap plans of these arms lose solutions, whatever their
    /// telescopes are given: only plans made for the configurations that were lost stand.
    #[test]
    fn a_telescope_is_given_where_cheap_plans_degenerate() {
        let turn = |axis: &str, point: &str| format!("axis: [{axis}], point: [{point}]");
        let slide = |axis: &str| format!("axis: [{axis}], type: prismatic");
        let [x, y, z] = ["1, 0, 0", "0, 1, 0", "0, 0, 1"];
        let upright = [
            turn(y, "0, 0, 0"),
            turn(z, "0, 0, 0"),
            slide(z),
            slide(z),
            turn(z, "0, 0.75, 0"),
            turn(y, "0, 0.75, 0.1"),
        ];
        let level = [
            turn(y, "0.1, 0, 0"),
            turn(x, "0.1, 0, 0.1"),
            turn(y, "0.1, 0, 0.4"),
            slide(y),
            slide(y),
            turn(y, "0.55, 0.3, 0.4"),
        ];
        for (joints, telescope) in [(upright, 2..4), (level, 3..5)] {
            let joints = joints.iter().enumerate();
            let joints = joints.map(|(i, joint)| format!("  - {{name: q{i}, {joint}}}\n"));
            let joints: String = joints.collect();
            let found = solved(format!(
                "robot: arm\nunits: {{angle: rad, length: m}}\nscrews:\n{joints}\
                 home: {{xyz: [0.5, 0.8, 0.3]}}\n"
            ));
            assert!(matches!(found.joints[..], [joint] if telescope.contains(&joint)));
        }
    }

    /// A spherical wrist behind a shoulder that is none, as a Fetch has. At a pose its elbow hardly
    /// moves: few of its values have solutions.
    #[test]
    fn an_elbow_is_not_given() {
        let joint = |name: &str, x: f64, z: f64, axis: &str| {
            format!("  - {{name: {name}, xyz: [{x}, 0, {z}], axis: [{axis}]}}\n")
        };
        let (roll, flex) = ("1, 0, 0", "0, 1, 0");
        let arm = [
            joint("pan", 0.119525, 0.34858, "0, 0, 1"),
            joint("lift", 0.117, 0.06, flex),
            joint("upperarm_roll", 0.219, 0.0, roll),
            joint("elbow", 0.133, 0.0, flex),
            joint("forearm_roll", 0.197, 0.0, roll),
            joint("wrist_flex", 0.1245, 0.0, flex),
            joint("wrist_roll", 0.1385, 0.0, roll),
        ];
        let torso = "  - {name: torso, axis: [0, 0, 1], type: prismatic, limits: [0, 0.4]}\n";
        for (carrier, given) in [("", vec![0]), (torso, vec![0, 1])] {
            let found = solved(format!(
                "robot: arm\nunits: {{angle: rad, length: m}}\njoints:\n{carrier}{}tip: tool0\n",
                arm.concat()
            ));
            assert_eq!(found.joints, given);
        }
    }

    const IIWA: [[f64; 6]; 7] = [
        [0.0, 0.0, 0.15, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.19, FRAC_PI_2, 0.0, PI],
        [0.0, 0.21, 0.0, FRAC_PI_2, 0.0, PI],
        [0.0, 0.0, 0.19, FRAC_PI_2, 0.0, 0.0],
        [0.0, 0.21, 0.0, -FRAC_PI_2, PI, 0.0],
        [0.0, 0.0607, 0.19, FRAC_PI_2, 0.0, 0.0],
        [0.0, 0.081, 0.0607, -FRAC_PI_2, PI, 0.0],
    ];

    /// Whatever tool it has. Where the arm is folded, at which the samples are few, the swivel has no
    /// angle: that once decided whether an iiwa 7 was given it.
    #[test]
    fn the_swivel_angle_is_given_whatever_the_tool() {
        for tool in [0.0, 0.045, 0.05, 0.09, 0.3] {
            let found = solved(iiwa(tool, |angle| format!("{angle:?}")));
            assert!(found.swivel.is_some(), "{tool}: {found:?}");
        }
    }

    /// However many digits its right angles have, as long as axes meet to a tenth of a nanometre: what
    /// is given beside a pose is the meaning of a number. Its links are of one length, which that of
    /// others is not to the last digit.
    #[test]
    fn the_swivel_angle_is_given_whatever_the_digits() {
        for digits in 10..14 {
            let found = solved(iiwa(0.045, |angle| format!("{angle:.digits$}")));
            assert!(found.swivel.is_some(), "{digits}: {found:?}");
        }
        for digits in 4..14 {
            for forearm in [0.4, 0.45] {
                let row = |(i, d): (usize, f64)| {
                    let turn = [-1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 0.0][i] * FRAC_PI_2;
                    format!("  - {{name: q{i}, a: 0, alpha: {turn:.digits$}, d: {d}, theta: 0}}\n")
                };
                let lengths = [0.34, 0.0, 0.4, 0.0, forearm, 0.0, 0.126];
                let rows: String = lengths.into_iter().enumerate().map(row).collect();
                let head = "robot: iiwa\nunits: {angle: rad, length: m}\ndh:\n";
                let found = solved(format!("{head}{rows}"));
                assert!(found.swivel.is_some(), "{digits}, {forearm}: {found:?}");
            }
        }
    }

    /// An iiwa 7 with a tool of this length, its angles written so.
    fn iiwa(tool: f64, written: impl Fn(f64) -> String) -> String {
        let joints = IIWA.iter().enumerate();
        let joints = joints.map(|(i, [x, y, z, roll, pitch, yaw])| {
            let [roll, pitch, yaw] = [roll, pitch, yaw].map(|&angle| written(angle));
            format!(
                "  - {{name: q{i}, xyz: [{x}, {y}, {z}], rpy: [{roll}, {pitch}, {yaw}], \
                 axis: [0, 0, 1]}}\n"
            )
        });
        let joints: String = joints.collect();
        format!(
            "robot: iiwa\nunits: {{angle: rad, length: m}}\njoints:\n{joints}  \
             - {{name: tool, type: fixed, xyz: [0, 0, {tool}]}}\n"
        )
    }

    /// Where the digits of a file take axes off each other by 1e-11, roots are double and angles are
    /// free to that: no elbow is straight, no shoulder singular, to the last digit.
    #[test]
    fn twelve_digits_hide_no_singular_arm() {
        // Folded, it does not have its wrist in its shoulder.
        let text = iiwa(0.05, |angle| format!("{angle:.11}"));
        let model = model(text.replace("[0, 0.21, 0], rpy: [-", "[0, 0.2, 0], rpy: [-"));
        let linkage = Linkage::new(&model);
        let (solved, found) =
            solve_redundant(&model, &linkage, Target::Pose, &Asked::default()).unwrap();
        assert!(solved.form.is_exact() && solved.form.tip_shift > 1e-13);
        let swivel = found.swivel.unwrap();
        let (chain, mut random) = (model.chain(), Random(29));
        for k in 0..200 {
            let mut q: [f64; 7] = std::array::from_fn(|_| random.between(-2.0, 2.0));
            q[if k % 2 == 0 { 3 } else { 1 }] = 0.0;
            let pose = chain.fk(&q);
            let angle = swivel.angle(&chain, &q);
            let angle = if angle.is_nan() { 0.4 } else { angle };
            let found = solved.form.solutions_at(&pose, &[angle]);
            assert!(!found.is_empty(), "{k}: {q:?}");
            for (i, solution) in found.iter().enumerate() {
                assert!(solution.singular, "{q:?}: {solution:?}");
                for other in &found[..i] {
                    let apart = solution.q.iter().zip(&other.q);
                    let apart = apart.map(|(a, b)| (0.5 * (a - b)).sin().abs());
                    assert!(apart.fold(0.0, f64::max) > 1e-6, "{q:?}: {found:?}");
                }
            }
        }
    }

    fn model(text: String) -> Model {
        let source = Source {
            path: "arm.yaml".into(),
            text,
        };
        Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap()
    }

    /// What is given beside a pose to the arm of a file.
    fn solved(text: String) -> Redundancy {
        let model = model(text);
        let linkage = Linkage::new(&model);
        let (_, found) =
            solve_redundant(&model, &linkage, Target::Pose, &Asked::default()).unwrap();
        found
    }

    /// Whatever the wrist is given, the joints before it reach most positions; a wrist alone reaches
    /// few, though its plan takes no more.
    #[test]
    fn a_position_is_reached_by_the_joints_before_the_wrist() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
        let six = ["ur5e.urdf", "kr6_r900.yaml", "xarm6.yaml", "stanford.yaml"];
        let six = six.map(|file| (file, vec![3, 4, 5]));
        // The first joint would make the cheapest plan.
        for (file, wrist) in six.into_iter().chain([("planar_3r.yaml", vec![2])]) {
            let source = Source::read(file, &root).unwrap();
            let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
            let linkage = Linkage::for_target(&model, Target::Position);
            let asked = Asked::default();
            let found = solve_redundant(&model, &linkage, Target::Position, &asked);
            assert_eq!(found.unwrap().1.joints, wrist, "{file}");
        }
    }
}
