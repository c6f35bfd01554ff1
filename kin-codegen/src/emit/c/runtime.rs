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
/// Branches that rounding keeps from their target.
pub const CORRECTION: &str = include_str!("runtime/correction.c");
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
