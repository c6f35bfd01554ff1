//! A mechanism of few digits is the one that it stands for: loops whose axes are parallel, or meet, but
//! for rounding.

use kin_codegen::mechanism::CompiledMechanism;
use kin_codegen::random::Random;
use kin_codegen::{Compiled, Options, Source, compile};
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::fmt::Write as _;

/// A joint in the frame of its leg, which x leads outwards: a point on its axis, and its direction.
struct Axis {
    point: Vector3<f64>,
    direction: Vector3<f64>,
}

/// A platform on equal legs about the z axis, a frame of few digits around it.
struct Machine {
    name: &'static str,
    leg: Vec<Axis>,
    turns: Vec<f64>,
    /// How many legs are driven at their first joint.
    driven: usize,
}

fn axis(point: [f64; 3], direction: [f64; 3]) -> Axis {
    Axis {
        point: point.into(),
        direction: Vector3::from(direction).normalize(),
    }
}

const THIRD: f64 = 2.0 * std::f64::consts::FRAC_PI_3;

/// Three legs of three parallel axes.
fn planar() -> Machine {
    let up = [0.0, 0.0, 1.0];
    Machine {
        name: "planar",
        leg: vec![
            axis([0.9, 0.0, 0.0], up),
            axis([0.62, 0.37, 0.0], up),
            axis([0.27, 0.0, 0.0], up),
        ],
        turns: vec![0.0, THIRD, -THIRD],
        driven: 3,
    }
}

/// Two legs that hold a coupler between them.
fn four_bar() -> Machine {
    let up = [0.0, 0.0, 1.0];
    Machine {
        name: "four_bar",
        leg: vec![axis([0.7, 0.1, 0.0], up), axis([0.4, 0.6, 0.0], up)],
        turns: vec![0.0, 2.2],
        driven: 1,
    }
}

/// Three legs whose axes all meet in the centre.
fn spherical() -> Machine {
    let on = |direction: [f64; 3], far: f64| {
        let unit = Vector3::from(direction).normalize();
        axis((unit * far).into(), direction)
    };
    Machine {
        name: "spherical",
        leg: vec![
            on([0.9, 0.1, -0.4], 0.31),
            on([0.5, 0.6, 0.5], 0.23),
            on([0.3, -0.2, 0.9], 0.17),
        ],
        turns: vec![0.0, THIRD, -THIRD],
        driven: 3,
    }
}

/// Three arms with rods between universal joints: the platform keeps its orientation.
fn delta() -> Machine {
    let rod = [-0.21, 0.0, -0.097];
    let (across, square) = ([0.0, 1.0, 0.0], [0.097, 0.0, -0.21]);
    let foot = [0.244 + rod[0], 0.0, rod[2]];
    Machine {
        name: "delta",
        leg: vec![
            axis([0.132, 0.0, 0.0], across),
            axis([0.244, 0.0, 0.0], across),
            axis([0.244, 0.0, 0.0], square),
            axis(foot, square),
            axis(foot, across),
        ],
        turns: vec![0.0, THIRD, -THIRD],
        driven: 3,
    }
}

/// Roll, pitch and yaw.
fn angles(r: &Matrix3<f64>) -> [f64; 3] {
    let pitch = -r[(2, 0)].asin();
    [
        r[(2, 1)].atan2(r[(2, 2)]),
        pitch,
        r[(1, 0)].atan2(r[(0, 0)]),
    ]
}

impl Machine {
    /// As YAML, all numbers with so many digits behind the point, its frame turned as given.
    fn yaml(&self, frame: &Matrix3<f64>, digits: usize) -> Source {
        self.measured(frame, digits, 0.0)
    }

    /// Each axis of each leg off by so much, radians and metres.
    fn measured(&self, frame: &Matrix3<f64>, digits: usize, noise: f64) -> Source {
        let mut random = Random(30);
        let mut off = || Vector3::from([0, 1, 2].map(|_| noise * random.between(-1.0, 1.0)));
        let vector = |v: [f64; 3]| {
            let [x, y, z] = v.map(|x| format!("{x:.digits$}"));
            format!("[{x}, {y}, {z}]")
        };
        let mut text = format!(
            "robot: {}\nunits: {{angle: rad, length: m}}\nbase: frame\nmechanism:\n  platform: platform\n  chains:\n",
            self.name
        );
        for (k, turn) in self.turns.iter().enumerate() {
            let leg = frame * Rotation3::from_axis_angle(&Vector3::z_axis(), *turn).matrix();
            let base = vector(angles(&leg));
            writeln!(
                text,
                "    - name: leg{k}\n      base: {{rpy: {base}}}\n      joints:"
            )
            .unwrap();
            let mut here = Vector3::zeros();
            for (i, axis) in self.leg.iter().enumerate() {
                let point = axis.point + off();
                let xyz = vector((point - here).into());
                let direction = vector((axis.direction + off()).into());
                let driven = match i == 0 && k < self.driven {
                    true => ", actuated: true",
                    false => "",
                };
                writeln!(
                    text,
                    "        - {{name: j{k}_{i}, xyz: {xyz}, axis: {direction}{driven}}}"
                )
                .unwrap();
                here = point;
            }
            let back = vector((-here).into());
            let tip = vector(angles(&leg.transpose()));
            writeln!(text, "      tip: {{xyz: {back}, rpy: {tip}}}").unwrap();
        }
        Source {
            path: format!("{}.yaml", self.name),
            text,
        }
    }
}

fn compiled(source: &Source) -> Result<CompiledMechanism, String> {
    match compile(source, &Options::default()) {
        Ok(Compiled::Mechanism(mechanism)) => Ok(*mechanism),
        Ok(_) => Err("no mechanism".into()),
        Err(refusal) => Err(format!("{refusal}\n{}", source.text)),
    }
}

/// Few digits stand for the exact mechanism, however it is turned.
fn is_the_exact_one(machine: &Machine, seed: u64) {
    let mut random = Random(seed);
    let turns = [0, 1, 2].map(|_| random.between(-3.0, 3.0));
    let frame = Rotation3::new(Vector3::from(turns)).into_inner();
    let exact = compiled(&machine.yaml(&frame, 17)).unwrap();
    let mut failures = Vec::new();
    for digits in 5..=13 {
        let what = format!("{} {seed}, {digits} digits", machine.name);
        match compiled(&machine.yaml(&frame, digits)) {
            Ok(rounded) => failures.extend(compared(&what, &exact, &rounded, digits)),
            Err(refusal) => failures.push(format!("{what}: {refusal}")),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn few_digits_of_mechanisms_with_short_chains() {
    for seed in [20, 21] {
        for machine in [planar(), four_bar(), spherical()] {
            is_the_exact_one(&machine, seed);
        }
    }
}

#[test]
fn few_digits_of_a_delta() {
    is_the_exact_one(&delta(), 22);
}

/// Beside the other one, on two cores.
#[test]
fn few_digits_of_another_delta() {
    is_the_exact_one(&delta(), 23);
}

/// Loop joints of a URDF close with as few digits as chains of a YAML.
#[test]
fn a_four_bar_of_a_urdf_may_have_five_digits() {
    let mut random = Random(40);
    for _ in 0..6 {
        let turns = [0, 1, 2].map(|_| random.between(-3.0, 3.0));
        let frame = Rotation3::new(Vector3::from(turns)).into_inner();
        let spun = Rotation3::from_axis_angle(&Vector3::z_axis(), random.between(-3.0, 3.0));
        let [pin, ground, end] = [[0.3, 0.1, 0.0], [1.0, 0.05, 0.0], [0.8, 0.55, 0.0]];
        let [pin, ground, end] = [pin, ground, end].map(Vector3::from);
        let list = |v: [f64; 3]| format!("{:.5} {:.5} {:.5}", v[0], v[1], v[2]);
        let [first, second] = [frame, frame * spun.matrix()].map(|it| list(angles(&it)));
        let foot = list((frame * ground).into());
        let [coupler, rocker] =
            [end - pin, spun.inverse() * (end - ground)].map(|v| list(v.into()));
        let pin = list(pin.into());
        let joint = |name: &str, parent: &str, child: &str, origin: &str| {
            format!(
                "<joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/>\
                 <child link=\"{child}\"/><origin {origin}/><axis xyz=\"0 0 1\"/></joint>\n"
            )
        };
        let text = format!(
            "<robot name=\"four_bar\">\n<link name=\"frame\"/><link name=\"crank\"/>\
             <link name=\"coupler\"/><link name=\"rocker\"/>\n{}{}{}\
             <loop_joint name=\"end\" type=\"revolute\"><link1 link=\"coupler\" xyz=\"{coupler}\"/>\
             <link2 link=\"rocker\" xyz=\"{rocker}\"/><axis xyz=\"0 0 1\"/></loop_joint>\n\
             <transmission name=\"drive\"><type>transmission_interface/SimpleTransmission</type>\
             <joint name=\"turn\"/></transmission>\n</robot>\n",
            joint("turn", "frame", "crank", &format!("rpy=\"{first}\"")),
            joint("pin", "crank", "coupler", &format!("xyz=\"{pin}\"")),
            joint(
                "foot",
                "frame",
                "rocker",
                &format!("xyz=\"{foot}\" rpy=\"{second}\"")
            ),
        );
        let path = "four_bar.urdf".into();
        let tip = Some("coupler".into());
        let options = Options {
            tip,
            ..Options::default()
        };
        let Ok(Compiled::Mechanism(found)) = compile(
            &Source {
                path,
                text: text.clone(),
            },
            &options,
        ) else {
            panic!("{text}");
        };
        let generic = found.mechanism.generic();
        assert_eq!(found.freedom.platform, 1);
        let near = generic.fk_near(&[0.2], &[0.0; 4]).expect("it closes");
        assert!(generic.gap(&near) < 1e-11, "{text}");
    }
}

/// A Delta whose axes are measured turns its platform, which three motors hold all the same.
#[test]
fn what_is_measured_stays_as_it_is() {
    let frame = Rotation3::new(Vector3::new(0.4, -1.1, 0.7)).into_inner();
    for noise in [3e-4, 1e-3] {
        let found = compiled(&delta().measured(&frame, 17, noise)).unwrap();
        assert!(!found.freedom.translates, "{noise}");
        let told: Vec<&str> = found.warnings.iter().map(|it| &*it.reason).collect();
        assert!(
            matches!(told[..], [one] if one.contains("it is not solved as one that keeps its orientation")),
            "{noise}: {told:?}"
        );
    }
}

fn compared(
    what: &str,
    exact: &CompiledMechanism,
    rounded: &CompiledMechanism,
    digits: usize,
) -> Option<String> {
    let most = 3e2 * 0.1_f64.powi(digits as i32) + 1e-10;
    let mut random = Random(21);
    let (whole, few) = (exact.mechanism.generic(), rounded.mechanism.generic());
    let [mut closed, mut lost, mut unsolved, mut all] = [0; 4];
    let mut worst: f64 = 0.0;
    for _ in 0..20 {
        let motors: Vec<f64> = (0..whole.actuated().len())
            .map(|_| random.between(-0.3, 0.3))
            .collect();
        let home = vec![0.0; whole.joints()];
        let Some(q) = whole.fk_near(&motors, &home) else {
            continue;
        };
        all += 1;
        let Some(near) = few.fk_near(&motors, &home) else {
            lost += 1;
            continue;
        };
        closed += 1;
        let apart = q.iter().zip(&near).map(|(a, b)| (a - b).abs());
        worst = worst.max(apart.fold(0.0, f64::max));
        let pose = few.poses(&near)[0];
        let solved = rounded.solutions(&pose);
        let is_met = |q: &[f64], of: &[f64]| q.iter().zip(of).all(|(a, b)| (a - b).abs() < 1e-6);
        let met = solved.iter().any(|placed| {
            let mut first = 0;
            placed.solutions.iter().all(|leg| {
                let end = first + leg[0].len();
                let own = &near[first..end];
                first = end;
                leg.iter().any(|q| is_met(q, own))
            })
        });
        unsolved += usize::from(!met);
    }
    let translates = exact.freedom.translates != rounded.freedom.translates;
    let bad = lost > 0 || unsolved > 0 || worst > most || translates || all < 10;
    let told = || {
        format!(
            "{what}: {closed} of {all} closed, {unsolved} not solved, off by {worst:.1e}, {}",
            match translates {
                true => "no translation",
                false => "",
            }
        )
    };
    bad.then(told)
}
