//! What generated code calls: pieces of JavaScript, of which a file has those that it needs.

use super::univariate;

const NUMBERS: &str = include_str!("runtime/numbers.js");
const QUARTIC: &str = include_str!("runtime/quartic.js");
const POSES: &str = include_str!("runtime/poses.js");
const CORRECTION: &str = include_str!("runtime/correction.js");
const PROJECTION: &str = include_str!("runtime/projection.js");
const LIMITS: &str = include_str!("runtime/limits.js");
const SWIVEL: &str = include_str!("runtime/swivel.js");
const SOLVE: &str = include_str!("runtime/solve.js");
/// The search for the solutions of an arm by eliminations: the same algorithms, thresholds and bounds
/// as in the files of `generated/univariate` of the runtime that are named behind them, for one
/// configuration at a time. Who changes the one changes the other.
const SEARCH: [&str; 9] = [
    include_str!("runtime/univariate/loop.js"), // line.rs, elimination.rs, matrix.rs
    include_str!("runtime/univariate/functionals.js"), // vanishing.rs
    include_str!("runtime/univariate/determinant.js"), // determinant.rs, polynomial.rs
    include_str!("runtime/univariate/harmonics.js"), // harmonics.rs
    include_str!("runtime/univariate/roots.js"), // bernstein.rs, roots.rs
    include_str!("runtime/univariate/zeros.js"), // zeros.rs
    include_str!("runtime/univariate/recover.js"), // sharing.rs, recover.rs
    include_str!("runtime/univariate/polish.js"), // polish.rs
    include_str!("runtime/univariate/search.js"), // candidates.rs, found.rs, search.rs, short.rs
];
/// From branches of an idealized arm to solutions of the arm as given, as in `search.rs`.
const REFINE: &str = include_str!("runtime/univariate/refine.js");
const ARGUMENTS: &str = include_str!("runtime/arguments.js");
const ARM: &str = include_str!("runtime/arm.js");
const MECHANISM: &str = include_str!("runtime/mechanism.js");

/// Those that code needs, in the order in which they call each other.
pub fn pieces(code: &str) -> String {
    let refines = code.contains("$solve_refining");
    let has_lanes = code.contains("$solve,") || refines;
    let searches = code.contains("$solve_by_roots") || refines;
    let tables = match searches {
        true => univariate::tables(code),
        false => String::new(),
    };
    let search = SEARCH.join("\n");
    let pieces = [
        (true, NUMBERS),
        (code.contains("$trig_roots("), QUARTIC),
        (true, POSES),
        (true, CORRECTION),
        (code.contains("$projection("), PROJECTION),
        (true, LIMITS),
        (has_lanes, SWIVEL),
        (has_lanes || searches, SOLVE),
        (searches, &tables),
        (searches, &search),
        (refines, REFINE),
        (true, ARGUMENTS),
        (true, ARM),
        (code.contains("$mechanism("), MECHANISM),
    ];
    let pieces = pieces.iter().filter(|(needed, _)| *needed);
    pieces
        .map(|(_, piece)| *piece)
        .collect::<Vec<_>>()
        .join("\n")
}
