//! A UR5e: forward kinematics, the Jacobian, and all solutions.

kinematics::kinematics!("robots/ur5e.urdf");

fn main() {
    let arm = Ur5e;
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let pose = arm.fk(&q);
    println!("{pose:?}");
    for solution in arm.ik(&pose).iter() {
        println!("{:+.4?} {:.1e}", solution.q, solution.residual);
    }
}
