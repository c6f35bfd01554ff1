//! A mechanism of a URDF with a loop joint is the one of the YAML file.

use super::{CLOSED, FourBar, same};

kinematics::kinematics!(
    "chapter3/parallel/linkages/four_bar.urdf",
    name = Tree,
    tip = "coupler"
);

#[test]
fn the_tree_with_a_loop_joint_is_the_mechanism_of_two_chains() {
    assert_eq!(
        Tree::JOINT_NAMES,
        ["crank_joint", "crank_pin", "rocker_joint", "rocker_pin"]
    );
    assert_eq!(Tree::ACTUATED, [0]);
    for degrees in (0..360).step_by(5) {
        let crank = [f64::from(degrees).to_radians()];
        let found = Tree.fk(&crank);
        assert_eq!(found.len(), 2);
        for assembly in &found {
            assert!(assembly.residual < CLOSED * Tree::LENGTH);
            // The loop joint leads from coupler to rocker, the YAML's back.
            let [a, b, c, d] = assembly.q;
            let expected = FourBar.fk(&crank);
            assert!(expected.iter().any(|s| same(&s.q, &[a, b, c, -d], 1e-9)));
        }
    }
}
