//! The book's SCARA: the numbers of Murray, Li and Sastry, chapter 3, by
//! formula and by generated code.

kinematics::kinematics!("robots/scara.yaml");

fn main() {
    let (l0, l1, l2) = (0.5, 0.4, 0.3);
    let theta = [0.3, -0.5, 0.7, 0.1];
    let (s1, c1) = f64::sin_cos(theta[0]);
    let (s12, c12) = f64::sin_cos(theta[0] + theta[1]);

    let by_hand = [-l1 * s1 - l2 * s12, l1 * c1 + l2 * c12, l0 + theta[3]];
    let generated = Scara.fk(&theta).translation;
    println!("p by hand    {by_hand:.9?}\np generated  {generated:.9?}");

    // Column 3 is (l1 c1 + l2 c12, l1 s1 + l2 s12, 0, 0, 0, 1).
    let column = Scara.spatial_jacobian(&theta).column(2);
    println!("third twist  {:.9?}", column.to_array());

    println!("inverse kinematics, elbow to the one side and to the other:");
    for solution in &Scara.ik(&Scara.fk(&theta)) {
        println!("  {:.6?}", solution.q);
    }
}
