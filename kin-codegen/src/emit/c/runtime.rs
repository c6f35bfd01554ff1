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
/// Values inside the limits.
pub const LIMITS: &str = include_str!("runtime/limits.c");
/// The solution that moves the joints least.
pub const NEAREST: &str = include_str!("runtime/nearest.c");

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
