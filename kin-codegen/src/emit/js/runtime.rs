//! What generated code calls: pieces of JavaScript, of which a file has those that it needs.

const NUMBERS: &str = include_str!("runtime/numbers.js");
const QUARTIC: &str = include_str!("runtime/quartic.js");
const CORRECTION: &str = include_str!("runtime/correction.js");
const LIMITS: &str = include_str!("runtime/limits.js");
const SWIVEL: &str = include_str!("runtime/swivel.js");
const SOLVE: &str = include_str!("runtime/solve.js");
const ARM: &str = include_str!("runtime/arm.js");
const MECHANISM: &str = include_str!("runtime/mechanism.js");

/// Those that code needs, in the order in which they call each other.
pub fn pieces(code: &str) -> String {
    let pieces = [
        (true, NUMBERS),
        (code.contains("$trig_roots("), QUARTIC),
        (true, CORRECTION),
        (true, LIMITS),
        (code.contains("lanes:"), SWIVEL),
        (code.contains("lanes:"), SOLVE),
        (true, ARM),
        (code.contains("$mechanism("), MECHANISM),
    ];
    let pieces = pieces.iter().filter(|(needed, _)| *needed);
    pieces
        .map(|(_, piece)| *piece)
        .collect::<Vec<_>>()
        .join("\n")
}
