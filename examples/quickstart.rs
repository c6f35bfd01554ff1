//! A UR5e, compiled from its URDF: where the tool is, how it moves, and all
//! the ways to bring it there.

use kinematics::{JointLimit, Solutions};
use std::f64::consts::PI;

kinematics::kinematics!("robots/ur5e.urdf");

fn main() {
    let arm = Ur5e;
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    println!("joints {:?}, radians\n  {}", Ur5e::JOINT_NAMES, row(&q));

    let pose = arm.fk(&q);
    println!("\nfk: {} in {} (rotation | metres)", Ur5e::TIP, Ur5e::BASE);
    for (axes, position) in pose.rotation.iter().zip(pose.translation) {
        println!("  {} |{position:8.4}", row(axes));
    }

    println!("\ngeometric_jacobian: tool velocity (m/s, then rad/s) per rad/s of each joint");
    for rates in arm.geometric_jacobian(&q).rows {
        println!("  {}", row(&rates));
    }

    let solutions = arm.ik(&pose);
    println!("\nik: {} ways to reach that pose", solutions.len());
    for solution in &solutions {
        let residual = solution.residual;
        println!(
            "  branch {}: {}   off by {residual:.0e} m",
            solution.branch,
            row(&solution.q)
        );
    }

    // The joints turn by ±360°, so every solution can be wound in several ways.
    let windings = solutions.with_full_turns(&Ur5e::LIMITS).count();
    println!(
        "\nwithin the joints' travel: {}",
        names(&solutions.within_limits(&Ur5e::LIMITS))
    );
    println!("  ({windings} with all full turns of the joints)");
    let mut on_a_table = Ur5e::LIMITS;
    on_a_table[1] = JointLimit::Revolute {
        lower: -PI,
        upper: 0.0,
    };
    println!(
        "with the upper arm above the table: {}",
        names(&solutions.within_limits(&on_a_table))
    );

    let seed = [0.0, -1.5, 1.5, 0.0, 1.5, 0.0];
    if let Some(nearest) = arm.ik_nearest(&pose, &seed) {
        println!(
            "nearest to {}: branch {}",
            row(&seed).trim(),
            nearest.branch
        );
    }
}

fn names(solutions: &Solutions<6>) -> String {
    let branches: Vec<String> = solutions.iter().map(|s| s.branch.to_string()).collect();
    format!("branches {}", branches.join(", "))
}

fn row(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:8.4}")).collect()
}
