//! What generated code calls: pieces of C, of which a file has what it calls.

use super::called::{called, defined};

/// What is the same for all arms; what is called stands in front of what calls it.
const PIECES: [&str; 15] = [
    include_str!("runtime/select.c"),
    include_str!("runtime/round.c"),
    include_str!("runtime/max.c"),
    include_str!("runtime/norm.c"),
    include_str!("runtime/sin_cos.c"),
    include_str!("runtime/wrap.c"),
    include_str!("runtime/atan2.c"),
    include_str!("runtime/angle.c"),
    include_str!("runtime/quartic.c"),
    include_str!("runtime/free_joint.c"),
    include_str!("runtime/poses.c"),            // `Pose`
    include_str!("runtime/univariate/lanes.c"), // lanes.rs
    include_str!("runtime/travel.c"),
    include_str!("runtime/metric.c"),
    include_str!("runtime/correction.c"),
];

/// The lanes, by the instructions at hand.
pub const DISPATCH: &str = include_str!("runtime/dispatch.c");
/// The lanes with free joints moved, behind this; as in `generated/free_joint.rs`.
pub const MOVING: &str = include_str!("runtime/moving.c");
/// The joints that are solved for, as a target sees them.
pub const SEEN: &str = include_str!("runtime/seen.c");
/// The same, of an arm off its design with projected targets.
pub const PROJECTION: &str = include_str!("runtime/projection.c");
/// A solution among others.
pub const INSERT: &str = include_str!("runtime/insert.c");
/// A branch that rounding keeps from its target, behind these.
pub const CORRECTED: &str = include_str!("runtime/corrected.c");
/// All of them, behind this or [`SWIVELLED`].
pub const ADD_CORRECTED: &str = include_str!("runtime/add_corrected.c");
/// The solutions, behind the branches that reach the target; as in `generated/inverse.rs`.
pub const LED_TO: &str = include_str!("runtime/led_to.c");
/// The swivel angle.
pub const SWIVEL: &str = include_str!("runtime/swivel.c");
/// The half plane in which a swivel angle has the elbow.
pub const AT_SWIVEL: &str = include_str!("runtime/at_swivel.c");
/// A branch at a swivel angle that rounding keeps from its target, behind these.
pub const SWIVELLED: &str = include_str!("runtime/swivelled.c");
/// One elimination of an arm that is solved by a polynomial in one joint, as data.
pub const ELIMINATION: &str = include_str!("runtime/univariate/elimination.c");
/// Behind the eliminations of an arm, lines, as in `line.rs`.
pub const LINE: &str = include_str!("runtime/univariate/line.c");
/// What vanishes on them, as the eliminations have it;
pub const OWN_FUNCTIONALS: &str = include_str!("runtime/univariate/own_functionals.c");
/// so in the frame of the kept joint,
pub const FUNCTIONALS: &str = include_str!("runtime/univariate/functionals.c");
/// or as a joint that is given moves it, as in `vanishing.rs`.
pub const MOVED_FUNCTIONALS: &str = include_str!("runtime/univariate/moved_functionals.c");
/// Behind these, the search for what solves a target: the same algorithms,
/// thresholds and bounds as in the files of `generated/univariate` of the runtime that are named
/// behind them. Who changes the one changes the other.
pub const SEARCH: [&str; 16] = [
    include_str!("runtime/univariate/places.c"), // matrix.rs
    include_str!("runtime/univariate/equations.c"), // elimination.rs
    include_str!("runtime/univariate/matrix.c"), // matrix.rs
    include_str!("runtime/univariate/factors.c"), // determinant.rs
    include_str!("runtime/univariate/triangle.c"), // determinant.rs
    include_str!("runtime/univariate/harmonics.c"), // harmonics.rs
    include_str!("runtime/univariate/polynomial.c"), // polynomial.rs
    include_str!("runtime/univariate/bernstein.c"), // bernstein.rs
    include_str!("runtime/univariate/roots.c"),  // roots.rs
    include_str!("runtime/univariate/zeros.c"),  // zeros.rs
    include_str!("runtime/univariate/sharing.c"), // sharing.rs
    include_str!("runtime/univariate/recover.c"), // recover.rs
    include_str!("runtime/univariate/polish.c"), // polish.rs
    include_str!("runtime/univariate/split.c"),  // split.rs
    include_str!("runtime/univariate/found.c"),  // found.rs
    include_str!("runtime/univariate/search.c"), // candidates.rs, search.rs
];
/// All eliminations in turn, as in `search.rs`.
pub const SOLVE: &str = include_str!("runtime/univariate/solve.c");
/// Where Levenberg's method leads from what was found, as in `short.rs`, behind [`SEEN`] and [`INSERT`].
pub const ARRIVE: &str = include_str!("runtime/univariate/arrive.c");
/// Solutions of six joints, as there, behind this.
pub const WHOLE: &str = include_str!("runtime/univariate/whole.c");
/// Solutions of fewer, as there.
pub const SHORT: &str = include_str!("runtime/univariate/short.c");
/// From branches of an idealized arm to solutions of the arm as given, as in `search.rs`.
pub const REFINE: &str = include_str!("runtime/univariate/refine.c");
/// The motion back of a joint that is given.
pub const UNDO: &str = include_str!("runtime/univariate/undo.c");
/// Values inside the limits.
pub const LIMITS: &str = include_str!("runtime/limits.c");
/// The solution that moves the joints least.
pub const NEAREST: &str = include_str!("runtime/nearest.c");

/// Twists and motions, and of a mechanism which joints are actuated, what chains span, and
/// triangles.
pub const MECHANISM: [&str; 6] = [
    include_str!("runtime/mechanism/motions.c"), // exponential.rs
    include_str!("runtime/mechanism/actuated.c"),
    include_str!("runtime/mechanism/span.c"),   // span.rs
    include_str!("runtime/mechanism/linear.c"), // givens.rs, singular_values.rs
    include_str!("runtime/mechanism/rates.c"),  // posture.rs
    include_str!("runtime/mechanism/newton.c"), // newton.rs
];
/// The answers of a mechanism's inverse kinematics, as in `postures.rs`.
pub const POSTURES: &str = include_str!("runtime/mechanism/postures.c");
/// Where three spheres meet, as in `spheres.rs`.
pub const SPHERES: &str = include_str!("runtime/mechanism/spheres.c");

/// Whether a name is that of a piece, or of what stands in front of all.
pub fn is_shared(name: &str) -> bool {
    let mut names = PIECES.iter().flat_map(|piece| defined(piece));
    name == "KIN_INLINE" || names.any(|it| it == name)
}

/// Code and the pieces that it needs, without what nobody calls.
pub fn with_pieces(code: &str) -> String {
    called(&[&PIECES.join("\n"), code].join("\n"))
}
