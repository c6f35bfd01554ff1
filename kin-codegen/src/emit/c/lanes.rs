//! The branches of a target as C: loops over lanes, which a compiler turns into vector
//! instructions.

use super::language::C;
use crate::closed_form::ClosedForm;
use crate::emit::curly::indented;
use crate::emit::curly::lanes::body;
use crate::expr::inverse::InverseGraph;

/// The struct of all lanes, and the function that computes them.
pub fn function(solver: &ClosedForm, inverse: &InverseGraph) -> String {
    let found = body::<C>(solver, inverse);
    let width = found.width;
    let unread = found.unread.iter().rev();
    let unread: String = unread.map(|name| format!("(void){name};\n")).collect();
    let free_joints = match found.free_joints {
        0 => String::new(),
        _ => format!(
            "    /* What the roots behind joints that may be free say: their level, and positive \
             where they\n     * are none. */\n    double level[KIN_FREE][{width}];\n    \
             double no_root[KIN_FREE][{width}];\n"
        ),
    };
    format!(
        "/* All branches of the plan: lane k is the branch whose i-th choice is + where bit i of \
         k is\n * clear. */\ntypedef struct kin_lanes {{\n    double q[KIN_SOLVED][{width}];\n    \
         double residual[{width}];\n    /* Positive where the branch does not exist or repeats \
         another. */\n    double invalid[{width}];\n    /* Positive where a root is double or a \
         joint is free. */\n    double singular[{width}];\n{free_joints}}} kin_lanes;\n\n\
         KIN_INLINE void kin_lanes_of(\n    const double target[12], const double seed[KIN_SOLVED], \
         const double *given, double free_below,\n    kin_lanes *lanes)\n{{\n{}}}\n",
        indented(&(unread + &found.statements))
    )
}
