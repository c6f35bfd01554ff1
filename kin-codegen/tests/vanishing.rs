//! Plans where what they divide by vanishes: the denominators of a plan's expressions, and
//! the vectors that tell its angles, are driven to zero, and nothing regular is lost there.

use kin_codegen::certificate::recovered;
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::expr::{Expr, Node};
use kin_codegen::geometry::{Linkage, conditioning, natural_target, size};
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use kin_runtime::{Chain, Pose, Target};
use std::f64::consts::{PI, TAU};

/// How far from where something vanishes it is tried.
const OFF: [f64; 9] = [0.0, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];
/// Below this share of its usual value a quantity has vanished.
const VANISHED: f64 = 1e-6;
/// Below this it need not be driven any further.
const NOTHING: f64 = 1e-24;
/// How often each quantity is driven.
const STARTS: usize = 4;
/// Places of a joint that are looked at.
const PLACES: usize = 24;

fn model(text: &str) -> Model {
    let source = Source {
        path: "arm.yaml".into(),
        text: text.into(),
    };
    Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap()
}

struct Attack {
    model: Model,
    chain: Chain,
    form: ClosedForm,
}

/// A denominator, or a sine and a cosine of some length.
type Quantity = (Expr, Option<Expr>);

impl Attack {
    fn on(text: &str) -> Self {
        let model = model(text);
        Self::of(&model, natural_target(&model)).unwrap().0
    }

    /// With how many configurations the certificate says are lost; none if the arm is refused, or
    /// has no plan.
    fn of(model: &Model, target: Target) -> Option<(Self, usize)> {
        let found = solve(model, &Linkage::new(model), target).ok()?;
        let attack = Attack {
            model: model.clone(),
            chain: model.chain(),
            form: found.form,
        };
        let has_plan = attack.form.expressions().is_some();
        has_plan.then_some((attack, found.certificate.lost))
    }

    fn quantities(&self) -> Vec<Quantity> {
        let inverse = self.form.expressions().unwrap();
        let graph = &inverse.graph;
        let needed = graph.reachable(&inverse.outputs());
        let nodes = graph.nodes().iter().zip(needed);
        let divided = nodes
            .filter(|(_, needed)| *needed)
            .filter_map(|(node, _)| match *node {
                Node::Div(_, by) if graph.value(by).is_none() => Some((by, None)),
                Node::Atan2(sine, cosine) => Some((sine, Some(cosine))),
                _ => None,
            });
        divided.collect()
    }

    /// The value of a quantity for the target of a configuration, on its own branch.
    fn value(&self, (a, b): Quantity, q: &[f64]) -> f64 {
        let inverse = self.form.expressions().unwrap();
        let target = self.chain.fk(q);
        let mut inputs: Vec<f64> = target.rotation.iter().flatten().copied().collect();
        inputs.extend(target.translation);
        inputs.resize(inputs.len() + q.len(), 0.0);
        inputs.push(1e-24);
        let branches = 0..self.form.plan.branches() as u32;
        let values = branches.clone().map(|branch| {
            let mut values = Vec::new();
            inverse.graph.evaluate(&inputs, branch, &mut values);
            values
        });
        let values: Vec<Vec<f64>> = values.collect();
        let at = |e: Expr, branch: u32| values[branch as usize][e.index()];
        let apart = |branch: u32| {
            let turn = |i: usize| {
                let d = (at(inverse.q[i], branch) - q[i]).abs() % TAU;
                d.min(TAU - d)
            };
            (0..q.len()).map(turn).sum::<f64>()
        };
        let own = branches
            .min_by(|&x, &y| apart(x).total_cmp(&apart(y)))
            .unwrap();
        let value = at(a, own);
        b.map_or(value, |b| value.hypot(at(b, own)))
    }

    /// Moves one joint to where a quantity changes its sign, or is least.
    fn reduced(&self, quantity: Quantity, mut q: Vec<f64>, joint: usize) -> Vec<f64> {
        let at = |x: f64| {
            let mut moved = q.clone();
            moved[joint] = x;
            self.value(quantity, &moved)
        };
        let width = TAU / PLACES as f64;
        let place = |k: usize| q[joint] - PI + width * k as f64;
        let values: Vec<f64> = (0..=PLACES).map(|k| at(place(k))).collect();
        let crosses = (0..PLACES).find(|&k| values[k] * values[k + 1] < 0.0);
        let least = (0..=PLACES).min_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()));
        let (mut low, mut high) = match crosses {
            Some(k) => (place(k), place(k + 1)),
            None => (place(least.unwrap()) - width, place(least.unwrap()) + width),
        };
        let sign = crosses.map(|k| values[k]);
        for _ in 0..90 {
            let third = (high - low) / 3.0;
            let (a, b) = (low + third, high - third);
            let left = match sign {
                Some(sign) => at(a) * sign < 0.0,
                None => at(a).abs() < at(b).abs(),
            };
            match left {
                true => high = if sign.is_some() { a } else { b },
                false => low = a,
            }
        }
        q[joint] = 0.5 * (low + high);
        q
    }

    /// A configuration where a quantity has vanished, if one is found.
    fn driven(&self, quantity: Quantity, random: &mut Random) -> Option<Vec<f64>> {
        let n = self.model.variables.len();
        let mut anywhere = || -> Vec<f64> { (0..n).map(|_| random.between(-PI, PI)).collect() };
        let mut usual: Vec<f64> = (0..9)
            .map(|_| self.value(quantity, &anywhere()).abs())
            .collect();
        usual.sort_by(f64::total_cmp);
        let mut q = anywhere();
        for _ in 0..6 * n {
            if self.value(quantity, &q).abs() < NOTHING * usual[4] {
                break;
            }
            q = self.reduced(quantity, q, random.below(n as u64));
        }
        (self.value(quantity, &q).abs() < VANISHED * usual[4]).then_some(q)
    }

    /// How many regular targets were tried.
    fn loses_nothing(&self) -> usize {
        let (tried, lost) = self.tried();
        assert_eq!(lost, None, "{}", self.form.plan);
        tried
    }

    /// How many regular targets were tried, and the first configuration that was lost.
    fn tried(&self) -> (usize, Option<Vec<f64>>) {
        let mut random = Random(0xdead);
        let (length, target) = (size(&self.model), self.form.plan.target);
        let mut tried = 0;
        let quantities = self.quantities().into_iter();
        for quantity in quantities.flat_map(|quantity| [quantity; STARTS]) {
            let Some(q) = self.driven(quantity, &mut random) else {
                continue;
            };
            for off in OFF {
                let q: Vec<f64> = q
                    .iter()
                    .map(|x| x + off * random.between(-1.0, 1.0))
                    .collect();
                let conditioning = conditioning(&self.chain, &q, length, target);
                if conditioning < 1e-5 {
                    continue;
                }
                let target = self.chain.fk(&q);
                tried += 1;
                for target in [target, rounded(&target)] {
                    let solutions = self.form.solutions(&target);
                    if recovered(&self.model, &q, &solutions, conditioning).is_err() {
                        return (tried, Some(q));
                    }
                }
            }
        }
        (tried, None)
    }
}

/// By its quaternion.
fn rounded(pose: &Pose) -> Pose {
    Pose::from_quaternion(pose.quaternion(), pose.translation)
}

const DESK: &str = include_str!("../../tests/robots/targets/five_joints.yaml");
const WELDER: &str = include_str!("../../tests/robots/targets/welder.yaml");
const WRIST: &str = include_str!("../../robots/kr6_r900.yaml");

/// Five axes of which the last two meet behind three parallel ones, with an offset at the
/// waist: the point where they meet can come to lie on axis 1.
const HANDLING: &str = "\
robot: handling
units: {angle: deg, length: mm}
joints:
  - {name: waist,    xyz: [0, 0, 0],    axis: [0, 0, 1]}
  - {name: shoulder, xyz: [75, 0, 0],   axis: [0, 1, 0]}
  - {name: elbow,    xyz: [0, 0, 300],  axis: [0, -1, 0]}
  - {name: pitch,    xyz: [330, 0, 75], axis: [0, -1, 0]}
  - {name: roll,     xyz: [0, 0, 0],    axis: [1, 0, 0]}
tip: {link: hand, xyz: [80, 0, 0]}
";

/// Four axes on a lift: at home, and with the forearm straight, the point where the second and the
/// third meet lies on the last one, which so turns it nowhere.
const LIFTED: &str = "\
robot: lifted
units: {angle: rad, length: m}
joints:
  - {name: lift,     xyz: [0, 0, 0],    axis: [0, 0, 1], type: prismatic, limits: [0, 1]}
  - {name: shoulder, xyz: [0.1, 0, 0],  axis: [0, 0, 1]}
  - {name: elbow,    xyz: [0, 0, 0.35], axis: [1, 0, 0]}
  - {name: wrist,    xyz: [0, 0, 0.25], axis: [1, 0, 0]}
  - {name: roll,     xyz: [0, 0, 0.15], axis: [0, 0, 1]}
tip: {link: hand, xyz: [0, 0, 0]}
";

/// There is a plan that divides by nothing where the arm is regular, and it is chosen.
#[test]
fn five_joints_lose_nothing() {
    for arm in [DESK, HANDLING] {
        Attack::on(arm).loses_nothing();
    }
}

#[test]
fn a_plan_that_degenerates_is_completed() {
    let attack = Attack::on(WELDER);
    assert!(attack.form.elimination().is_some());
    assert!(attack.loses_nothing() > 0);
}

#[test]
fn a_slide_at_home_loses_nothing() {
    let attack = Attack::on(LIFTED);
    attack.loses_nothing();
    for lift in [0.0, 1e-12, 1e-9, 1e-6, 0.3] {
        let q = [lift, 0.0, -2.0, 0.0, 0.96];
        let solutions = attack.form.solutions(&attack.chain.fk(&q));
        assert_eq!(
            recovered(&attack.model, &q, &solutions, 0.1),
            Ok(()),
            "{lift}"
        );
    }
}

#[test]
fn a_spherical_wrist_loses_nothing() {
    assert!(Attack::on(WRIST).loses_nothing() > 0);
}

/// The elbow of an arm with offsets, between its upper arm and its forearm: folded, the directions
/// of the outer axes are opposite but for the file's rounding, and tell no angle to a rounded target.
#[test]
fn a_folded_elbow_loses_no_rounded_target() {
    let elbow = model(
        "robot: elbow
units: {angle: rad, length: m}
joints:
  - {name: upper_arm, xyz: [0, -0.316, 0], rpy: [1.57079632679, 0, 0], axis: [0, 0, 1]}
  - {name: elbow, xyz: [0.0825, 0, 0], rpy: [1.57079632679, 0, 0], axis: [0, 0, 1]}
  - {name: forearm, xyz: [-0.0825, 0.384, 0], rpy: [-1.57079632679, 0, 0], axis: [0, 0, 1]}
tip: {link: wrist}
",
    );
    let (attack, _) = Attack::of(&elbow, Target::Pose).unwrap();
    let mut random = Random(0xe1b0);
    for _ in 0..100 {
        let [first, last] = [0; 2].map(|_| random.between(-PI, PI));
        for off in [0.0, 1e-12, 1e-9, 1e-6] {
            let q = [first, PI - off, last];
            let solutions = attack.form.solutions(&rounded(&attack.chain.fk(&q)));
            let found = recovered(&attack.model, &q, &solutions, 0.1);
            assert_eq!(found, Ok(()), "{q:?} by {}", attack.form.plan);
        }
    }
}

/// A short arm along the axes, with slides among its joints, in a frame turned anyhow, and what of
/// targets counts.
fn anything(random: &mut Random) -> (String, Target) {
    let round = |x: f64| (x * 100.0).round() / 100.0;
    let (joints, target) = match random.below(5) {
        0 => (2 + random.below(4), Target::Pose),
        1 => (1 + random.below(3), Target::Position),
        2 => (3 + random.below(2), Target::PositionAxis),
        3 => (2 + random.below(2), Target::Orientation),
        _ => (4, Target::PositionAxis),
    };
    let mut text = "robot: anything\nunits: {angle: rad, length: m}\njoints:\n".to_owned();
    for i in 0..joints {
        let axis = ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"][random.below(3)];
        let mut place = |often: usize, to: f64| -> [f64; 3] {
            std::array::from_fn(|_| match random.below(5) {
                k if k < often => round(random.between(-to, to)),
                _ => 0.0,
            })
        };
        let (xyz, rpy) = (place(2, 0.4), place(if i == 0 { 5 } else { 0 }, 3.0));
        let slide = ["", "", "", "", ", type: prismatic, limits: [-1, 1]"][random.below(5)];
        text += &format!("  - {{name: j{i}, xyz: {xyz:?}, rpy: {rpy:?}, axis: {axis}{slide}}}\n");
    }
    (text + "tip: {link: hand, xyz: [0.05, 0, 0.1]}\n", target)
}

/// What a plan would lose eliminations complete, which know nothing of coupled joints: there its
/// certificate says it.
#[test]
fn what_no_elimination_completes_is_told() {
    let rod = "\n  - {name: rod, xyz: [0, 0, 600], axis: [0, 1, 0], mimic: {joint: shoulder, multiplier: -1}}
  - {name: elbow,    ";
    let coupled = WELDER.replace("\n  - {name: elbow,    xyz: [0, 0, 600],  ", rod);
    assert_ne!(coupled, WELDER);
    let welder = model(&coupled);
    let found = solve(&welder, &Linkage::new(&welder), natural_target(&welder)).unwrap();
    assert!(found.form.elimination().is_none());
    assert!(found.certificate.lost > 0);
}

#[test]
fn whatever_the_arm_it_loses_nothing() {
    arms_lose_nothing(Random(0x7e11));
}

#[test]
fn whatever_another_arm_it_loses_nothing() {
    arms_lose_nothing(Random(0x7e12));
}

fn arms_lose_nothing(mut random: Random) {
    let (mut arms, mut completed) = (0, 0);
    while arms < 12 {
        let (text, target) = anything(&mut random);
        let Some((attack, told)) = Attack::of(&model(&text), target) else {
            continue;
        };
        let (_, lost) = attack.tried();
        assert_eq!((lost, told), (None, 0), "{text}{target:?}");
        completed += usize::from(attack.form.elimination().is_some());
        arms += 1;
    }
    assert!(completed > 0);
}
