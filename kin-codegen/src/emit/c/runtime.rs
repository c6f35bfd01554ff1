//! What generated code calls: pieces of C, of which a file has those that it needs.

/// The functions by which pieces are called, what they are of, and their source; one that is
/// called stands in front of those that call it.
const PIECES: [(&str, &str); 9] = [
    ("kin_select(", include_str!("runtime/select.c")),
    ("kin_round(", include_str!("runtime/round.c")),
    ("kin_max(", include_str!("runtime/max.c")),
    ("kin_sin_cos(", include_str!("runtime/sin_cos.c")),
    ("kin_wrap(", include_str!("runtime/wrap.c")),
    ("kin_atan2(", include_str!("runtime/atan2.c")),
    ("kin_angle(", include_str!("runtime/angle.c")),
    ("kin_trig_roots(", include_str!("runtime/quartic.c")),
    ("kin_roomiest_turn(", include_str!("runtime/free_angle.c")),
];

/// The lanes, by the instructions at hand.
pub const DISPATCH: &str = include_str!("runtime/dispatch.c");
/// From the lanes to solutions: why there are none.
pub const SOLUTIONS: &str = include_str!("runtime/solutions.c");
/// One branch that rounding keeps from its target, corrected; it calls what [`SEEN`] or
/// [`AT_SWIVEL`] defines.
pub const CORRECTION: &str = include_str!("runtime/correction.c");
/// The joints that are solved for, as a target sees them.
pub const SEEN: &str = include_str!("runtime/seen.c");
/// All such branches, behind both of these.
pub const CORRECTED: &str = include_str!("runtime/corrected.c");
/// The swivel angle.
pub const SWIVEL: &str = include_str!("runtime/swivel.c");
/// The joints at a swivel angle, as a target sees them.
pub const AT_SWIVEL: &str = include_str!("runtime/at_swivel.c");
/// A branch at a swivel angle that rounding keeps from its target, behind these.
pub const SWIVELLED: &str = include_str!("runtime/swivelled.c");
/// One elimination of an arm that is solved by a polynomial in one joint, as data.
pub const ELIMINATION: &str = include_str!("runtime/univariate/elimination.c");
/// Behind the eliminations of an arm, the search for what solves a target: the same algorithms,
/// thresholds and bounds as in the files of `generated/univariate` of the runtime that are named
/// behind them. Who changes the one changes the other.
pub const SEARCH: [&str; 18] = [
    include_str!("runtime/univariate/lanes.c"),     // lanes.rs
    include_str!("runtime/univariate/poses.c"),     // `Pose`
    include_str!("runtime/univariate/line.c"),      // line.rs
    include_str!("runtime/univariate/places.c"),    // matrix.rs
    include_str!("runtime/univariate/equations.c"), // elimination.rs
    include_str!("runtime/univariate/matrix.c"),    // matrix.rs
    include_str!("runtime/univariate/factors.c"),   // determinant.rs
    include_str!("runtime/univariate/triangle.c"),  // determinant.rs
    include_str!("runtime/univariate/harmonics.c"), // harmonics.rs
    include_str!("runtime/univariate/polynomial.c"), // polynomial.rs
    include_str!("runtime/univariate/bernstein.c"), // bernstein.rs
    include_str!("runtime/univariate/roots.c"),     // roots.rs
    include_str!("runtime/univariate/sharing.c"),   // sharing.rs
    include_str!("runtime/univariate/recover.c"),   // recover.rs
    include_str!("runtime/univariate/polish.c"),    // polish.rs
    include_str!("runtime/univariate/split.c"),     // polish.rs
    include_str!("runtime/univariate/found.c"),     // found.rs
    include_str!("runtime/univariate/search.c"),    // search.rs
];
/// All eliminations in turn, as in `search.rs`.
pub const SOLVE: &str = include_str!("runtime/univariate/solve.c");
/// Solutions of six joints, as in `short.rs`.
pub const WHOLE: &str = include_str!("runtime/univariate/whole.c");
/// Solutions of fewer, as there, behind [`SEEN`] and [`CORRECTION`].
pub const SHORT: &str = include_str!("runtime/univariate/short.c");
/// From branches of an idealized arm to solutions of the arm as given, as in `search.rs`.
pub const REFINE: &str = include_str!("runtime/univariate/refine.c");
/// A target moved by joints that are given.
pub const CARRY: &str = include_str!("runtime/univariate/carry.c");
/// Values inside the limits.
pub const LIMITS: &str = include_str!("runtime/limits.c");
/// The solution that moves the joints least.
pub const NEAREST: &str = include_str!("runtime/nearest.c");

/// Twists and motions, poses, and of a mechanism which joints are actuated, what chains span, and
/// triangles.
pub const MECHANISM: [&str; 7] = [
    include_str!("runtime/mechanism/motions.c"), // exponential.rs
    include_str!("runtime/univariate/poses.c"),
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

/// Whether a name of this beginning, behind `kin_` or `KIN_`, is that of a piece, or of what stands
/// in front of all.
pub fn is_shared(name: &str) -> bool {
    let pieces = PIECES.iter();
    let mut names = pieces.filter_map(|(function, _)| function.strip_prefix("kin_"));
    name.starts_with("INLINE ")
        || name.starts_with("root ")
        || names.any(|function| name.starts_with(function))
}

/// The pieces that code needs, in front of it.
pub fn with_pieces(code: &str) -> String {
    let mut out = code.to_owned();
    for (function, source) in PIECES.iter().rev() {
        if out.contains(function) {
            out = format!("{source}\n{out}");
        }
    }
    out
}
