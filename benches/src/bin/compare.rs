//! Forward kinematics, Jacobians and inverse kinematics beside other crates.

use kin_codegen::{Options, Source, compile};
use kinematics::{Chain, JointLimit, Kinematics, Pose, RedundantKinematics, Solutions};
use kinematics_benches::contest::Contest;
use kinematics_benches::inputs::{configurations, targets};
use kinematics_benches::peers::{self, ByHand, InK};
use kinematics_benches::redundant::{Given, of_six, seven};
use rs_opw_kinematics::kinematic_traits::Kinematics as _;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");
kinematics::kinematics!("../robots/irb6640.yaml");
kinematics::kinematics!("../robots/xarm6.yaml");
kinematics::kinematics!("../robots/panda.yaml");
kinematics::kinematics!("../robots/iiwa14.yaml");
kinematics::kinematics!("../robots/sawyer.yaml", free = "right_j6");

const UR5E: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../robots/ur5e.urdf");

fn main() {
    forward_ur5e();
    forward_kr6();
    jacobian_ur5e();
    inverse_ur5e();
    inverse_kr6();
    nearest("UR5e", &Ur5e);
    nearest("KR 6 R900", &Kr6R900);
    nearest("IRB 6640", &Irb6640);
    inverse_xarm6();
    inverse_redundant();
}

fn forward_ur5e() {
    let inputs = configurations();
    let (chain, by_hand) = (generic(UR5E), ByHand::ur5e());
    let in_k = InK::new(UR5E, "wrist_3_tool0");
    agree("chain", &inputs, |q| chain.fk(q), |q| Ur5e.fk(q));
    agree("by hand", &inputs, |q| by_hand.fk(q).into(), |q| Ur5e.fk(q));
    agree("k", &inputs, |q| peers::from_k(&in_k.fk(q)), |q| Ur5e.fk(q));
    let contest = Contest::new("UR5e, forward", &inputs)
        .with("generated", |q| Ur5e.fk(q), |p| p.translation[0])
        .with("nalgebra by hand", |q| by_hand.fk(q), |p| p.translation.x)
        .with("kinematics::Chain", |q| chain.fk(q), |p| p.translation[0])
        .with("k", |q| in_k.fk(q), |p| p.translation.x);
    #[cfg(feature = "ik-geo")]
    let geo = peers::InGeo::ur5e(&Ur5e.fk(&[0.0; 6]));
    #[cfg(feature = "ik-geo")]
    let contest = {
        agree("ik-geo", &inputs, |q| geo.pose(q), |q| Ur5e.fk(q));
        contest.with("ik-geo", |q| geo.fk(q), |p| p.1.x)
    };
    contest.run();
}

fn forward_kr6() {
    let inputs = configurations();
    let opw = peers::kr6_in_opw();
    let in_opw = |q: &[f64; 6]| peers::from_opw(&opw.forward(q));
    agree("rs-opw-kinematics", &inputs, in_opw, |q| Kr6R900.fk(q));
    Contest::new("KR 6 R900, forward", &inputs)
        .with("generated", |q| Kr6R900.fk(q), |p| p.translation[0])
        .with("rs-opw-kinematics", |q| opw.forward(q), |p| p.translation.x)
        .run();
}

fn jacobian_ur5e() {
    let inputs = configurations();
    let in_k = InK::new(UR5E, "wrist_3_tool0");
    for q in &inputs {
        let (theirs, ours) = (in_k.jacobian(q), Ur5e.geometric_jacobian(q));
        let same = |i: usize, j: usize| (theirs[(i, j)] - ours.rows[i][j]).abs() < 1e-9;
        assert!(
            (0..6).all(|i| (0..6).all(|j| same(i, j))),
            "k differs at {q:?}"
        );
    }
    Contest::new("UR5e, forward with Jacobian", &inputs)
        .with(
            "generated, spatial",
            |q| Ur5e.fk_jacobian(q),
            |(_, j)| j.rows[0][4],
        )
        .with(
            "generated, geometric",
            |q| (Ur5e.fk(q), Ur5e.geometric_jacobian(q)),
            |(_, j)| j.rows[0][4],
        )
        .with("k, geometric", |q| in_k.jacobian(q), |j| j[(0, 4)])
        .run();
}

fn inverse_ur5e() {
    let inputs = targets(&Ur5e);
    let contest = Contest::new("UR5e, all solutions", &inputs).with(
        "generated",
        |p| Ur5e.ik(p),
        |s| s[0].q[0],
    );
    #[cfg(feature = "ik-geo")]
    let geo = peers::InGeo::ur5e(&Ur5e.fk(&[0.0; 6]));
    #[cfg(feature = "ik-geo")]
    let contest = {
        solve_alike("ik-geo", &Ur5e, &inputs, |p| geo.ik(p));
        contest.with("ik-geo", |p| geo.ik(p), |s| first(s))
    };
    contest.run();
}

fn inverse_kr6() {
    let inputs = targets(&Kr6R900);
    let opw = peers::kr6_in_opw();
    solve_alike("rs-opw-kinematics", &Kr6R900, &inputs, |p| {
        opw.inverse(&peers::to_opw(p))
    });
    let contest = Contest::new("KR 6 R900, all solutions", &inputs)
        .with("generated", |p| Kr6R900.ik(p), |s| s[0].q[0])
        .with(
            "rs-opw-kinematics",
            |p| opw.inverse(&peers::to_opw(p)),
            |s| first(s),
        );
    #[cfg(feature = "ik-geo")]
    let geo = peers::InGeo::kr6(&Kr6R900.fk(&[0.0; 6]));
    #[cfg(feature = "ik-geo")]
    let contest = {
        solve_alike("ik-geo", &Kr6R900, &inputs, |p| geo.ik(p));
        contest.with("ik-geo", |p| geo.ik(p), |s| first(s))
    };
    contest.run();
}

/// The one solution that a controller asks for, beside the list of all.
fn nearest(name: &str, robot: &(impl Kinematics<6> + Copy)) {
    let inputs = targets(robot);
    let seed = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    for target in &inputs {
        let chosen = robot.ik_nearest(target, &seed);
        let of_all = robot.ik(target).nearest(&seed, &limits(robot));
        assert!(
            chosen.map(|s| s.branch) == of_all.map(|s| s.branch),
            "{target:?}"
        );
    }
    Contest::new(&format!("{name}, one solution of all"), &inputs)
        .with("all", |p| robot.ik(p), |s| s[0].q[0])
        .with(
            "nearest",
            |p| robot.ik_nearest(p, &seed),
            |s| s.map_or(0.0, |s| s.q[0]),
        )
        .run();
}

fn limits<K: Kinematics<6>>(_: &K) -> [JointLimit; 6] {
    K::LIMITS
}

/// Beside the eigenvalues of a matrix as large as that of the usual elimination: what
/// other solvers of such arms take, and about the same for every matrix.
fn inverse_xarm6() {
    let inputs = targets(&Xarm6);
    let random = |i: usize, j: usize| (1.0 + (37 * i + 101 * j * j) as f64).sin();
    let matrix = nalgebra::DMatrix::from_fn(24, 24, random);
    let eigenvalues = |p: &Pose| {
        let mut matrix = matrix.clone();
        for (j, entry) in p.rotation.as_flattened().iter().enumerate() {
            matrix[(0, j)] = *entry;
        }
        matrix.complex_eigenvalues()
    };
    Contest::new("xArm 6, all solutions", &inputs)
        .with("generated", |p| Xarm6.ik(p), |s| s[0].q[0])
        .with("nalgebra, eigenvalues of a 24×24", eigenvalues, |e| {
            e[0].re
        })
        .run();
}

/// Arms of seven joints with the last one given, beside one with a wrist and beside a
/// general one of six joints.
fn inverse_redundant() {
    let inputs: Vec<Given<5>> = (seven().iter())
        .map(|(q, parameter)| Given {
            targets: [
                of_six(&Kr6R900, q),
                Panda.fk(q),
                Iiwa14.fk(q),
                of_six(&Xarm6, q),
                Sawyer.fk(q),
            ],
            parameter: *parameter,
        })
        .collect();
    let angle = |solutions: &Solutions<7>| solutions.first().map_or(0.0, |s| s.q[0]);
    Contest::new("Seven joints, one of them given", &inputs)
        .with("KR 6 R900", |i| Kr6R900.ik(&i.targets[0]), |s| s[0].q[0])
        .with("Panda", |i| Panda.ik_at(&i.targets[1], i.parameter), angle)
        .with(
            "iiwa 14",
            |i| Iiwa14.ik_at(&i.targets[2], i.parameter),
            angle,
        )
        .with("xArm 6", |i| Xarm6.ik(&i.targets[3]), |s| s[0].q[0])
        .with(
            "Sawyer",
            |i| Sawyer.ik_at(&i.targets[4], i.parameter),
            angle,
        )
        .with(
            "iiwa 14, 16 values",
            |i| {
                Iiwa14
                    .ik_sweep(&i.targets[2], 16)
                    .map(|s| s.len())
                    .sum::<usize>()
            },
            |n| *n as f64,
        )
        .with(
            "Panda, feasible",
            |i| Panda.feasible(&i.targets[1]),
            |found| found.len() as f64,
        )
        .run();
}

/// A first joint angle, or 0 where a peer finds nothing.
fn first(solutions: &[[f64; 6]]) -> f64 {
    solutions.first().map_or(0.0, |q| q[0])
}

/// The product of exponentials for any chain, of the same file.
fn generic(path: &str) -> Chain {
    let text = std::fs::read_to_string(path).expect("the robot file is there");
    let path = path.to_owned();
    let compiled = compile(&Source { path, text }, &Options::default());
    let compiled = compiled.expect("the robot compiles");
    compiled.arm().expect("an arm").model.chain()
}

/// Stops if two implementations of forward kinematics differ.
fn agree(
    name: &str,
    inputs: &[[f64; 6]],
    theirs: impl Fn(&[f64; 6]) -> Pose,
    ours: impl Fn(&[f64; 6]) -> Pose,
) {
    for q in inputs {
        let (theirs, ours) = (theirs(q), ours(q));
        let far = theirs.translation_distance(&ours) > 1e-9;
        assert!(
            !far && theirs.rotation_distance(&ours) < 1e-7,
            "{name} at {q:?}: {theirs:?} for {ours:?}"
        );
    }
}

/// Says for how many targets a peer finds the same set of solutions, each of
/// which reaches the target; and how many solutions the two find in all.
fn solve_alike(
    name: &str,
    robot: &impl Kinematics<6>,
    targets: &[Pose],
    theirs: impl Fn(&Pose) -> Vec<[f64; 6]>,
) {
    let mut same = 0;
    let (mut found, mut ours_found) = (0, 0);
    for target in targets {
        let ours = robot.ik(target);
        let theirs = theirs(target);
        let reaches = |q: &[f64; 6]| robot.fk(q).translation_distance(target) < 1e-6;
        assert!(ours.iter().all(|solution| reaches(&solution.q)));
        let here = |q: &[f64; 6]| theirs.iter().any(|other| near(q, other));
        let all_here = ours.iter().all(|solution| here(&solution.q));
        same += usize::from(all_here && theirs.len() == ours.len() && theirs.iter().all(reaches));
        found += theirs.len();
        ours_found += ours.len();
    }
    let count = targets.len();
    println!(
        "\n{name}: the same solutions for {same} of {count} targets; {found} solutions in all, \
         generated {ours_found}"
    );
}

fn near(a: &[f64; 6], b: &[f64; 6]) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| kinematics::__private::math::wrap(a - b).abs() < 1e-5)
}
