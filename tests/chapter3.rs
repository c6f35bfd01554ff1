//! The items of Murray, Li and Sastry, chapter 3, one test each and named
//! after it: formulas and values of the book's arms, and properties of all.

mod chapter3 {
    mod arms;
    mod differences;
    #[path = "../random.rs"]
    mod random;

    mod any_joints;
    mod long_arms;
    mod manipulability;
    mod parallel;
    mod redundancy;
    mod self_motion;
    mod singularities;
    mod statics;
    mod velocities;
    mod workspace;
}
