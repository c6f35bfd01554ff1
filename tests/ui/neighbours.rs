//! Several robots in one module, and one in a function.

kinematics::kinematics!("robots/planar.yaml");
kinematics::kinematics!("robots/planar.yaml", name = Other, ik = none);

fn main() {
    kinematics::kinematics!("robots/planar.yaml", name = Local);
    let q = [0.3, 0.4];
    assert_eq!(Planar.fk(&q), Other.fk(&q));
    assert_eq!(Planar.ik(&Local.fk(&q)).len(), 2);
}
