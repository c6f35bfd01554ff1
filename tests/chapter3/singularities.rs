//! Singular configurations: the determinant, its factors, and the conditions
//! on the twists.

use super::arms::{
    self, Elbow, InverseElbow, L1, L2, Planar2r, Planar3r, Scara, Seven, Stanford, Ur5e,
};
use super::random::Random;
use kin_cli::explain::{ArmExplanation, ConditionKind, explain};
use kin_codegen::geometry::{Condition, conditions};
use kin_codegen::{Ik, Options, Source};
use kinematics::{Jacobian, Kinematics, Pose, Singularity, Twist, WithBase, WithTool};
use nalgebra::{DMatrix, SMatrix};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

const GOLDEN: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];

fn by_nalgebra(jacobian: &Jacobian<6>) -> f64 {
    SMatrix::<f64, 6, 6>::from_fn(|i, j| jacobian.rows[i][j]).determinant()
}

/// The least singular value.
fn least<const N: usize>(jacobian: &Jacobian<N>) -> f64 {
    let matrix = DMatrix::from_fn(6, N, |i, j| jacobian.rows[i][j]);
    matrix.singular_values().min()
}

fn random<const N: usize>(seed: u64, count: usize) -> Vec<[f64; N]> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect()
}

macro_rules! is_the_determinant {
    ($arm:expr) => {
        for q in arms::configurations(&$arm) {
            let jacobians = [
                $arm.spatial_jacobian(&q),
                $arm.body_jacobian(&q),
                $arm.geometric_jacobian(&q),
            ];
            for jacobian in jacobians {
                let off = $arm.jacobian_determinant(&q) - by_nalgebra(&jacobian);
                assert!(off.abs() < 1e-14, "{off:e} at {q:?}");
                let off = jacobian.determinant() - by_nalgebra(&jacobian);
                assert!(off.abs() < 1e-14, "{off:e} at {q:?}");
            }
        }
    };
}

#[test]
fn determinant_is_that_of_every_jacobian() {
    is_the_determinant!(Elbow);
    is_the_determinant!(InverseElbow);
    is_the_determinant!(Stanford);
    is_the_determinant!(Ur5e);
}

#[test]
fn elbow_determinant() {
    assert!((Elbow.jacobian_determinant(&GOLDEN) - -0.020393770).abs() < 5e-10);
    for q in random::<6>(1, 50) {
        let reach = L1 * q[1].cos() + L2 * (q[1] + q[2]).cos();
        let expected = L1 * L2 * (q[2].sin() * reach * q[4].cos()).abs();
        assert!((Elbow.jacobian_determinant(&q).abs() - expected).abs() < 1e-15);
    }
}

#[test]
fn stanford_determinant() {
    assert!((Stanford.jacobian_determinant(&GOLDEN) - 0.421443776).abs() < 5e-10);
    for q in random::<6>(2, 50) {
        let expected = (L1 + q[2]).powi(2) * q[1].cos() * q[4].cos();
        assert!((Stanford.jacobian_determinant(&q) - expected).abs() < 1e-14 * (4.0 + PI).powi(2));
    }
}

/// Of the rows x, y, z and yaw.
#[test]
fn scara_determinant() {
    for q in random::<4>(3, 50) {
        let geometric = Scara.geometric_jacobian(&q);
        let rows = [0, 1, 2, 5].map(|i| geometric.rows[i]);
        let expected = SMatrix::<f64, 4, 4>::from_fn(|i, j| rows[i][j]).determinant();
        let found = Scara.jacobian_determinant(&q);
        assert!((found.abs() - L1 * L2 * q[1].sin().abs()).abs() < 1e-16);
        assert!((found.abs() - expected.abs()).abs() < 1e-15);
    }
}

#[test]
fn planar_determinants() {
    for [a, b, c] in random::<3>(4, 50) {
        let found = Planar2r.jacobian_determinant(&[a, b]).abs();
        let rows = Planar2r.geometric_jacobian(&[a, b]).rows;
        let expected = (rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]).abs();
        assert!((found - expected).abs() < 1e-15);
        let found = Planar3r.jacobian_determinant(&[a, b, c]).abs();
        assert!((found - 0.5 * 0.3 * b.sin().abs()).abs() < 1e-16);
    }
}

/// Every factor at 0, all other joints anywhere: the rank drops. And nowhere
/// else: the determinant is a constant times the factors.
#[test]
fn each_singularity_costs_rank() {
    fn check<const N: usize>(
        jacobian: impl Fn(&[f64; 6]) -> Jacobian<6>,
        determinant: impl Fn(&[f64; 6]) -> f64,
        singularities: impl Fn(&[f64; 6]) -> [Singularity; N],
        powers: [i32; N],
    ) {
        let constant = |q: &[f64; 6]| {
            let factors = singularities(q).into_iter().zip(powers);
            determinant(q)
                / factors
                    .map(|(s, power)| s.value.powi(power))
                    .product::<f64>()
        };
        let expected = constant(&GOLDEN);
        for q in random::<6>(5, 40) {
            assert!((constant(&q) / expected - 1.0).abs() < 1e-11);
            for way in 0..N {
                for joint in 0..6 {
                    for zero in zeros(|x| singularities(&with(&q, joint, x))[way].value) {
                        assert!(least(&jacobian(&with(&q, joint, zero))) < 1e-12);
                    }
                }
            }
        }
    }
    let of = Ur5e;
    check(
        |q| of.spatial_jacobian(q),
        |q| of.jacobian_determinant(q),
        |q| of.singularities(q),
        [1, 1, 1],
    );
    let of = Elbow;
    check(
        |q| of.spatial_jacobian(q),
        |q| of.jacobian_determinant(q),
        |q| of.singularities(q),
        [1, 1, 1],
    );
    let of = Stanford;
    check(
        |q| of.spatial_jacobian(q),
        |q| of.jacobian_determinant(q),
        |q| of.singularities(q),
        [1, 2, 1],
    );
}

fn with(q: &[f64; 6], joint: usize, x: f64) -> [f64; 6] {
    let mut q = *q;
    q[joint] = x;
    q
}

/// By bisection, where a function changes its sign.
fn zeros(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let places: Vec<f64> = (0..=20).map(|k| -PI + 0.1 + 0.3 * f64::from(k)).collect();
    let mut found = Vec::new();
    for pair in places.windows(2) {
        let (mut a, mut b) = (pair[0], pair[1]);
        if f(a).signum() == f(b).signum() {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if f(middle).signum() == f(a).signum() {
                a = middle;
            } else {
                b = middle;
            }
        }
        found.push(a);
    }
    found
}

#[test]
fn shoulder_elbow_and_wrist_are_told_apart() {
    let names = |ways: &[Singularity]| ways.iter().map(|way| way.name).collect::<Vec<_>>();
    let all = ["shoulder", "elbow", "wrist"];
    assert_eq!(names(&Elbow.singularities(&GOLDEN)), all);
    assert_eq!(names(&Stanford.singularities(&GOLDEN)), all);
    assert_eq!(names(&Ur5e.singularities(&GOLDEN)), all);
    let [_, elbow, wrist] = Ur5e.singularities(&[0.3, -1.2, 0.0, 0.4, FRAC_PI_2, 0.1]);
    assert_eq!(elbow.value, 0.0);
    assert_eq!(wrist.value.abs(), 1.0);
}

fn explained(path: &str, ik: Ik) -> ArmExplanation {
    let source = Source::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let options = Options {
        ik,
        ..Options::default()
    };
    explain(&source, &options).unwrap().arm().unwrap()
}

/// What `kin explain` says of a way: where it is and which axes depend.
fn way(explanation: &ArmExplanation, name: &str) -> (Vec<f64>, Vec<(ConditionKind, Vec<usize>)>) {
    let ways = &explanation.singularities.as_ref().unwrap().factors;
    let way = ways.iter().find(|way| way.name == name).unwrap();
    let conditions = way.conditions.iter();
    let conditions = conditions.map(|c| (c.kind, c.joints.clone())).collect();
    (way.values.clone(), conditions)
}

#[test]
fn explanations_name_values_and_conditions() {
    use ConditionKind::{AllMeetALine, Collinear, Concurrent, ParallelCoplanar};
    let all = (AllMeetALine, vec![1, 2, 3, 4, 5, 6]);
    let ur = explained("../robots/ur5e.urdf", Ik::ClosedForm);
    assert_eq!(way(&ur, "wrist"), (vec![0.0, PI], vec![all.clone()]));
    let parallel = (ParallelCoplanar, vec![2, 3, 4]);
    assert_eq!(way(&ur, "elbow"), (vec![0.0, PI], vec![parallel]));
    assert_eq!(way(&ur, "shoulder"), (vec![], vec![all.clone()]));
    let puma = explained("../robots/puma560.yaml", Ik::ClosedForm);
    let collinear = (Collinear, vec![4, 6]);
    assert_eq!(
        way(&puma, "wrist"),
        (vec![0.0, PI], vec![collinear.clone()])
    );
    // The elbow is stretched where the offset a3 = 20.3 mm points away from d4.
    let (values, conditions) = way(&puma, "elbow");
    let offset = 20.3_f64.atan2(433.1);
    assert!(
        (values[0] - (offset - FRAC_PI_2)).abs() < 1e-3,
        "{values:?}"
    );
    assert!((values[1] - values[0] - PI).abs() < 1e-12);
    assert_eq!(conditions, std::slice::from_ref(&all));
    let elbow = explained("../robots/elbow.yaml", Ik::ClosedForm);
    let concurrent = (Concurrent, vec![1, 4, 5, 6]);
    assert_eq!(way(&elbow, "shoulder").1, [concurrent.clone(), all.clone()]);
    let stanford = explained("../robots/stanford.yaml", Ik::ClosedForm);
    assert_eq!(
        way(&stanford, "shoulder"),
        (vec![-FRAC_PI_2, FRAC_PI_2], vec![concurrent, all])
    );
    assert_eq!(way(&stanford, "elbow").0, [-L1]);
    let scara = explained("../robots/scara.yaml", Ik::ClosedForm);
    let parallel = (ParallelCoplanar, vec![1, 2, 3]);
    assert_eq!(way(&scara, "elbow"), (vec![0.0, PI], vec![parallel]));
}

#[test]
fn determinants_take_few_operations() {
    let count = |path| {
        let singular = explained(path, Ik::None).singularities.unwrap();
        let cost = singular.determinant;
        assert!(singular.difference.is_none_or(|off| off < 1e-13));
        (cost.multiplications, cost.additions)
    };
    assert_eq!(count("../robots/ur5e.urdf"), (6, 4));
    assert_eq!(count("../robots/puma560.yaml"), (8, 4));
    assert_eq!(count("../robots/elbow.yaml"), (5, 2));
    assert_eq!(count("../robots/stanford.yaml"), (3, 1));
    assert_eq!(count("../robots/scara.yaml"), (1, 0));
}

/// A chain without structure has a determinant all the same, in one piece.
#[test]
fn a_general_arm_has_one_way() {
    let general = explained("ui/robots/general.yaml", Ik::None);
    let singular = general.singularities.unwrap();
    assert_eq!(singular.factors.len(), 1);
    assert_eq!(singular.factors[0].coordinates, [2, 3, 4, 5]);
    assert!(singular.factors[0].example.is_some());
    assert!(singular.difference.unwrap() < 1e-13);
}

/// An arm that is off its design by a hundredth of a milliradian.
#[test]
fn a_noisy_arm_has_the_ways_of_the_one_that_was_meant() {
    let text = std::fs::read_to_string("../robots/ur5e.urdf").unwrap();
    let elbow = r#"xyz="-0.425 0 0" rpy="0 0 0""#;
    assert!(text.contains(elbow));
    let text = text.replace(elbow, r#"xyz="-0.425 0 0" rpy="0.00001 0 0""#);
    let path = "noisy.urdf".into();
    let noisy = explain(&Source { path, text }, &Options::default())
        .unwrap()
        .arm()
        .unwrap();
    let singular = noisy.singularities.as_ref().unwrap();
    assert!((5e-6..2e-5).contains(&singular.idealized.unwrap()));
    assert!(singular.difference.unwrap() < 1e-13);
    let names: Vec<&str> = singular.factors.iter().map(|way| &way.name[..]).collect();
    assert_eq!(names, ["shoulder", "elbow", "wrist"]);
}

fn revolute(axis: [f64; 3], point: [f64; 3]) -> Twist {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    Twist::revolute(axis.map(|x| x / length), point)
}

fn rank(twists: &[Twist]) -> usize {
    DMatrix::from_fn(6, twists.len(), |i, j| twists[j].to_array()[i]).rank(1e-9)
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

#[test]
fn two_collinear_revolutes_have_rank_1() {
    let twists = [revolute(Z, [0.3, 0.1, 0.0]), revolute(Z, [0.3, 0.1, 0.7])];
    assert_eq!(rank(&twists), 1);
    assert_eq!(conditions(&twists, 1.0), [Condition::Collinear([0, 1])]);
    let apart = [twists[0], revolute(Z, [0.3, 0.1001, 0.7])];
    assert_eq!((rank(&apart), conditions(&apart, 1.0)), (2, vec![]));
}

#[test]
fn three_parallel_coplanar_revolutes_have_rank_2() {
    let at = |x, y| revolute(Z, [x, y, x]);
    let coplanar = [at(0.0, 0.0), at(0.4, 0.2), at(-0.2, -0.1)];
    assert_eq!(rank(&coplanar), 2);
    assert_eq!(
        conditions(&coplanar, 1.0),
        [Condition::ParallelCoplanar([0, 1, 2])]
    );
    let spread = [at(0.0, 0.0), at(0.4, 0.2), at(-0.2, 0.1)];
    assert_eq!((rank(&spread), conditions(&spread, 1.0)), (3, vec![]));
}

#[test]
fn four_concurrent_revolutes_have_rank_3() {
    let centre = [0.2, -0.3, 0.5];
    let axes = [X, Y, Z, [1.0, 2.0, 3.0]];
    let twists = axes.map(|axis| revolute(axis, centre));
    assert_eq!(rank(&twists), 3);
    assert_eq!(
        conditions(&twists, 1.0),
        [Condition::Concurrent(vec![0, 1, 2, 3])]
    );
    let mut moved = twists;
    moved[3] = revolute(axes[3], [0.2, -0.3, 0.501]);
    assert_eq!((rank(&moved), conditions(&moved, 1.0)), (4, vec![]));
}

#[test]
fn four_coplanar_revolutes_have_rank_3() {
    let twists = [
        revolute(X, [0.0, 0.3, 0.0]),
        revolute(Y, [0.5, 0.0, 0.0]),
        revolute([1.0, 2.0, 0.0], [0.1, -0.4, 0.0]),
        revolute([3.0, -1.0, 0.0], [-0.2, 0.9, 0.0]),
    ];
    assert_eq!(rank(&twists), 3);
    assert_eq!(
        conditions(&twists, 1.0),
        [Condition::Coplanar(vec![0, 1, 2, 3])]
    );
    let mut tilted = twists;
    tilted[3] = revolute([3.0, -1.0, 0.01], [-0.2, 0.9, 0.0]);
    assert_eq!((rank(&tilted), conditions(&tilted, 1.0)), (4, vec![]));
}

#[test]
fn two_parallel_revolutes_and_a_slide_across_have_rank_2() {
    let pair = [revolute(Z, [0.0; 3]), revolute(Z, [0.4, 0.0, 0.0])];
    let across = [pair[0], pair[1], Twist::prismatic(Y)];
    assert_eq!(rank(&across), 2);
    let slides = Condition::SlideAcross {
        parallel: [0, 1],
        slide: 2,
    };
    assert_eq!(conditions(&across, 1.0), [slides]);
    let along = [pair[0], pair[1], Twist::prismatic(X)];
    assert_eq!((rank(&along), conditions(&along, 1.0)), (3, vec![]));
}

#[test]
fn six_revolutes_that_meet_a_line_have_rank_5() {
    // The line is z through (0.3, 0.1); the fifth is parallel to it.
    let on = |height| [0.3, 0.1, height];
    let mut twists = vec![
        revolute(X, on(0.0)),
        revolute([1.0, 1.0, 0.3], on(0.2)),
        revolute([-2.0, 1.0, 0.5], on(0.5)),
        revolute([0.3, -1.0, 1.0], on(-0.4)),
        revolute(Z, [0.9, -0.2, 0.0]),
        revolute([1.0, 3.0, -1.0], on(1.0)),
    ];
    assert_eq!(rank(&twists), 5);
    assert_eq!(conditions(&twists, 1.0), [Condition::AllMeetALine]);
    twists[5] = revolute([1.0, 3.0, -1.0], [0.31, 0.1, 1.0]);
    assert_eq!((rank(&twists), conditions(&twists, 1.0)), (6, vec![]));
}

/// Two joints in a row that do the same.
#[test]
fn chains_singular_everywhere_are_refused() {
    let coaxial = "\
robot: doubled
units: {angle: rad, length: m}
screws:
  - {name: pan, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: tilt, axis: [0, 1, 0], point: [0, 0, 0.3]}
  - {name: roll, axis: [1, 0, 0], point: [0, 0, 0.3]}
  - {name: twist, axis: [1, 0, 0], point: [0.5, 0, 0.3]}
home: {xyz: [0.7, 0, 0.3]}
";
    let telescope = coaxial
        .replace("roll, axis", "roll, type: prismatic, axis")
        .replace("twist, axis", "twist, type: prismatic, axis")
        .replace(
            ", point: [0, 0, 0.3]}\n  - {name: twist",
            "}\n  - {name: twist",
        )
        .replace(", point: [0.5, 0, 0.3]", "");
    // Of a telescope a tube is given, unless another joint is.
    let expected = [
        (
            coaxial,
            &[][..],
            "joints `roll` and `twist` turn about one line",
        ),
        (
            &telescope,
            &["pan"],
            "joints `roll` and `twist` slide along one direction",
        ),
    ];
    for (text, free, alike) in expected {
        let source = Source {
            path: "doubled.yaml".into(),
            text: text.into(),
        };
        let options = Options {
            free: free.iter().map(|&joint: &&str| joint.into()).collect(),
            ..Options::default()
        };
        let told = match kin_codegen::compile(&source, &options) {
            Err(refused) => refused.to_string(),
            Ok(_) => panic!("{text} is solved"),
        };
        assert!(told.contains("singular in every configuration"), "{told}");
        assert!(told.contains(alike), "{told}");
    }
}

/// What a robot knows of its singularities is asked of any arm, and of one with
/// a tool or on another base: by the determinant of the Jacobian that it has.
#[test]
fn any_arm_tells_its_singularities() {
    fn check<K: Kinematics<6> + Copy>(arm: K, names: &[&str]) {
        let placed = Pose::from_rpy([0.3, -0.5, 0.7], [0.2, 0.1, -0.4]);
        let mut random = Random::new(5);
        for _ in 0..20 {
            let q = std::array::from_fn(|_| random.angle());
            let expected = arm.singularities(&q);
            let found: Vec<_> = expected.iter().map(|found| found.name).collect();
            assert_eq!(found, names);
            let with_tool = WithTool {
                robot: arm,
                tool: placed,
            };
            let on_base = WithBase {
                robot: arm,
                base: placed,
            };
            assert_eq!(with_tool.singularities(&q), expected);
            assert_eq!(on_base.singularities(&q), expected);
            for (jacobian, determinant) in [
                (
                    with_tool.geometric_jacobian(&q),
                    with_tool.jacobian_determinant(&q),
                ),
                (
                    on_base.geometric_jacobian(&q),
                    on_base.jacobian_determinant(&q),
                ),
            ] {
                let off = determinant.unwrap() - by_nalgebra(&jacobian);
                assert!(off.abs() < 1e-14, "{q:?}: {off:e}");
            }
        }
    }
    check(Elbow, &["shoulder", "elbow", "wrist"]);
    check(Ur5e, &["shoulder", "elbow", "wrist"]);
    // The rows that count for positions are those of the tip that they are of.
    let tool = Pose::from_translation([0.1, 0.0, 0.0]);
    let longer = WithTool {
        robot: Planar2r,
        tool,
    };
    assert_eq!(Kinematics::jacobian_determinant(&longer, &[0.1, 0.2]), None);
    assert!(longer.singularities(&[0.1, 0.2]).is_empty());
    assert!(Kinematics::jacobian_determinant(&Planar2r, &[0.1, 0.2]).is_some());
    // Seven columns have no determinant.
    assert_eq!(Kinematics::jacobian_determinant(&Seven, &[0.1; 7]), None);
}
