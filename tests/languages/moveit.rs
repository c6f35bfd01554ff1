//! The example of a MoveIt plugin, as far as it needs no MoveIt: what it asks of generated C.

use crate::program::{Compiler, Program, generated};
use kin_codegen::Options;

const MAIN: &str = r#"
#include "solver.hpp"
#include <cstdio>

int main()
{
    const solver::Joints seed = {{0.3, -1.2, 1.5, -0.7, 1.1, 0.4}};
    solver::Pose pose, link;
    if (!solver::pose_of_link("tool0", seed, pose) || !solver::pose_of_link("forearm_link", seed, link)
        || solver::pose_of_link("nowhere", seed, link)) {
        return 1;
    }
    const auto q = solver::quaternion_of(pose);
    const auto back = solver::pose_of(q[0], q[1], q[2], q[3], pose[3], pose[7], pose[11]);
    const auto found = solver::solutions(back, seed);
    std::printf("%zu %d\n", found.size(), solver::distance(found.at(0), seed) < 1e-9);
    solver::Joints turned = seed;
    for (double &x : turned) {
        solver::Pose other;
        x -= 2.5;
        solver::pose_of_link("tool0", turned, pose);
        const auto p = solver::quaternion_of(pose);
        other = solver::pose_of(p[0], p[1], p[2], p[3], pose[3], pose[7], pose[11]);
        for (int i = 0; i < 12; ++i) {
            if (std::abs(other[i] - pose[i]) > 1e-12) {
                return 2;
            }
        }
    }
    return 0;
}
"#;

#[test]
fn the_plugin_finds_all_solutions() {
    if !Compiler::Cpp.is_there() {
        return;
    }
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/moveit");
    let ur5e = generated("robots/ur5e.urdf", "ur5e", &Options::default());
    let program = Program::with_main("c_moveit", &ur5e, MAIN);
    let built = program.build(Compiler::Cpp, &["-O0", "-I", example], "in_cpp");
    assert_eq!(built.run(""), "8 1\n");
}
