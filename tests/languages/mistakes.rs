//! What the comparison with Rust is worth: mistakes that are put into the C and the JavaScript of a
//! robot, one by one, signs and bounds, and each of which it has to find.

use super::*;
use kin_codegen::Options;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// So many of the differences that the C of the robot's expressions computes become sums.
const SIGNS: usize = 8;

/// Of what is the same for every robot, and what stands there instead.
const BOUNDS: [[&str; 2]; 5] = [
    ["beyond <= 1e-9;", "beyond <= 1e-1;"],
    ["motion < least", "motion > least"],
    ["return value < ", "return value > "],
    ["missing[3 + i] = z[i] - ", "missing[3 + i] = z[i] + "],
    ["counts && !(", "counts && ("],
];

/// The same of the search for the roots of a polynomial in one joint. A wrong pivot is not of them:
/// the noise tells, and reflections make up for it. Nor are miscounted signs next to coefficients without
/// one: such an interval is taken for several roots, of which all are found.
const OF_SEARCH: [[&str; 2]; 17] = [
    ["- 2.0 * (across + ", "+ 2.0 * (across + "],
    [
        "im[2][k] = re[1][k] - re[0][k]",
        "im[2][k] = re[1][k] + re[0][k]",
    ],
    ["odd = values[j] - mirrored", "odd = values[j] + mirrored"],
    [
        "of_cosines[arc] - of_sines[arc]",
        "of_cosines[arc] + of_sines[arc]",
    ],
    ["changes == 1 ?", "changes == 2 ?"],
    ["(a - b) * (a + b)", "(a - b) * (a - b)"],
    ["line[3 + i][k] - of->", "line[3 + i][k] + of->"],
    ["b * cosine[k] - a * sine[k]", "b * cosine[k] + a * sine[k]"],
    ["_EXTRANEOUS 0.05", "_EXTRANEOUS 1e-15"],
    ["0.3 / longest[k]", "-0.3 / longest[k]"],
    ["_REACHED 1e-13", "_REACHED 1e-3"],
    ["_SAME 1e-6", "_SAME 1.0"],
    ["_SINGULAR 1e-5", "_SINGULAR 1e-2"],
    ["found->gap <= 1e-9", "found->gap <= 1e-1"],
    ["turned += 2.0 * step", "turned += step"],
    ["count != candidate->zeros.count", "count < 0"],
    ["out[n][k] -= power", "out[n][k] += power"],
];

/// The same of what moves branches to the arm as given.
const OF_REFINEMENT: [[&str; 2]; 3] = [
    ["invalid[k] <= 0.0 || ", "invalid[k] > 0.0 || "],
    [
        "if (!clear) {\n        mistaken_ask_in",
        "if (clear) {\n        mistaken_ask_in",
    ],
    ["return solution->branch", "return -solution->branch"],
];

/// The same of the correction of the branches of a design: none of them is taken as it is, and the
/// angle tells a joint.
const OF_CORRECTION: [[&str; 2]; 6] = [
    [
        "residual > MISTAKEN_TAKEN && ",
        "residual > MISTAKEN_TOLERANCE && ",
    ],
    ["<= MISTAKEN_TAKEN)", "<= MISTAKEN_TOLERANCE)"],
    ["return -off;", "return off;"],
    ["cosine * beside - sine", "cosine * beside + sine"],
    ["row[k] += normal[i]", "row[k] -= normal[i]"],
    [">= -MISTAKEN_TOLERANCE", "<= -MISTAKEN_TOLERANCE"],
];

const OF_CORRECTION_IN_JS: [[&str; 2]; 4] = [
    ["residual <= form.taken", "residual <= form.tolerance"],
    ["error, -off /", "error, off /"],
    ["cosine * x - sine", "cosine * x + sine"],
    [">= -form.tolerance", "<= -form.tolerance"],
];

/// The same of how projected targets see the tip of an arm off its design. Of the motions some are
/// not of them: where these are wrong by as little as the arm is off, Levenberg's method arrives all
/// the same.
const OF_PROJECTION: [[&str; 2]; 6] = [
    ["m[b][a] - m[a][b]", "m[b][a] + m[a][b]"],
    ["cosine -= mistaken_axis", "cosine += mistaken_axis"],
    ["+ (1.0 - cosine) * along", "- (1.0 - cosine) * along"],
    ["tip[4 * i + 3] + rise *", "tip[4 * i + 3] - rise *"],
    [
        "joints(solved, given, tip, jacobian);\n    mistaken_project(tip, pose)",
        "joints(solved, given, pose, jacobian);\n    mistaken_project(pose, tip)",
    ],
    ["by->rotation ? sqrt(square)", "by->axis ? sqrt(square)"],
];

const OF_PROJECTION_IN_JS: [[&str; 2]; 5] = [
    ["m(b, a) - m(a, b)", "m(b, a) + m(a, b)"],
    ["cosine -= axis", "cosine += axis"],
    ["+ (1.0 - cosine) * along", "- (1.0 - cosine) * along"],
    ["tip[4 * i + 3] + rise *", "tip[4 * i + 3] - rise *"],
    ["form.projection.see(tip(q))", "tip(q)"],
];

/// The same of what tells that a step of an exact arm's plan degenerates.
const OF_COMPLETION: [[&str; 2]; 1] = [[
    "(lanes->singular[k] > 0.0 ||",
    "(lanes->singular[k] > 2.0 ||",
]];

/// The same of what tells that no branch reaches a target.
const OF_UNANSWERED: [[&str; 2]; 1] = [["count == 0 && incomplete", "count != 0 && incomplete"]];

/// The same of what leads to a singular solution that the seed is beside.
const OF_REST: [[&str; 2]; 1] = [["residual[0] < 1e-2", "residual[0] < 1e-20"]];

/// The same in JavaScript.
const OF_REST_IN_JS: [[&str; 2]; 1] = [["residual < 1e-2", "residual < 1e-20"]];

/// The same of what is next to where singularities meet: a free joint has to turn,
const OF_LEADING: [[&str; 2]; 1] = [["{0.65, 1.9}", "{0.0, 0.0}"]];

/// or to stay where it is told.
const OF_TELLING: [[&str; 2]; 1] = [[
    "if (moves) {\n        count =",
    "if (moves < 0) {\n        count =",
]];

/// The same in JavaScript.
const OF_LEADING_IN_JS: [[&str; 2]; 1] = [["[0.65, 1.9]", "[0.0, 0.0]"]];
const OF_TELLING_IN_JS: [[&str; 2]; 1] =
    [["if (moves) {\n        add", "if (!moves) {\n        add"]];

/// The same of what stays at the seed where two singularities meet.
const OF_STAYING: [[&str; 2]; 6] = [
    ["<= 1e-13 * MISTAKEN_SIZE", "<= -1.0 * MISTAKEN_SIZE"],
    ["&& there.singular", "&& !there.singular"],
    [
        "solutions[k].singular && apart",
        "!solutions[k].singular && apart",
    ],
    ["(missed <= 2e-2 *", "(missed <= 0.0 *"],
    [
        "mistaken_corrected(seed, 40,",
        "mistaken_corrected(seed, 1,",
    ],
    ["1e-6 + 100.0 /", "1e6 + 100.0 /"],
];

/// The same in JavaScript.
const OF_STAYING_IN_JS: [[&str; 2]; 6] = [
    ["missed <= 1e-13 *", "missed <= -1.0 *"],
    ["&& found.singular && known", "&& !found.singular && known"],
    [
        "solutions.filter(({ singular }) => singular)",
        "solutions.filter(({ singular }) => !singular)",
    ],
    ["(missed <= 2e-2)", "(missed <= 0.0)"],
    ["lead(40)", "lead(1)"],
    ["1e-6 + 100.0 * missed", "1e6 + 100.0 * missed"],
];

/// The same of joints that are given, some of them between those that are solved for.
const OF_GIVEN: [[&str; 2]; 4] = [
    ["-given[1 + i]", "given[1 + i]"],
    ["-given[1 + i]", "-given[i]"],
    [
        "motion, fixed[behind[i]], moved",
        "fixed[behind[i]], motion, moved",
    ],
    ["i < 1 ? i : i + 1", "i"],
];

/// The same in JavaScript.
const OF_GIVEN_IN_JS: [[&str; 2]; 3] = [
    ["-given[front.length + i]", "given[front.length + i]"],
    [
        "$undo(twist, -given[front.length + i]), fixed[behind]",
        "$undo(twist, -given[i]), fixed[behind]",
    ],
    ["front.length + between.length", "front.length"],
];

/// The same of what turns angles that are free. Where more is tried than needed, as much is found.
const OF_TURNING: [[&str; 2]; 5] = [
    ["== mistaken_free[joint]", "!= mistaken_free[joint]"],
    [
        "(has != *has_roots ? has :",
        "(has != *has_roots ? *has_roots :",
    ],
    ["halving < 5", "halving < 0"],
    ["const double from = best;", "const double from = 0.0;"],
    ["<= 1e-9 * scale", "<= 1e9 * scale"],
];

/// The same of what moves slides that are free.
const OF_SLIDES: [[&str; 2]; 5] = [
    [
        "? mistaken_free_slides[joint] : 1.0)",
        "? 1.0 : mistaken_free_slides[joint])",
    ],
    [
        "0.5 * (levels[2] - levels[0]) - 2.0",
        "0.5 * (levels[2] - levels[0]) + 2.0",
    ],
    ["4.0 * a * c", "2.0 * a * c"],
    ["double over = -b", "double over = b"],
    [
        "b + (b < 0.0 ? -root : root)",
        "b + (b < 0.0 ? root : -root)",
    ],
];

/// The same in JavaScript.
const OF_SLIDES_IN_JS: [[&str; 2]; 5] = [
    ["(slide ?? 1.0) * turn", "(slide === null ? turn : 0.0)"],
    [
        "0.5 * (half - here) - 2.0 * bend",
        "0.5 * (half - here) + 2.0 * bend",
    ],
    ["4.0 * a * c", "2.0 * a * c"],
    ["let [over, below] = [-b", "let [over, below] = [b"],
    [
        "b + (b < 0.0 ? -root : root)",
        "b + (b < 0.0 ? root : -root)",
    ],
];

/// The same where only one turn leaves a root, in either language.
const OF_PARABOLAS: [[&str; 2]; 1] = [["bend > 0.0", "bend < 0.0"]];

/// The same in JavaScript.
const OF_TURNING_IN_JS: [[&str; 2]; 4] = [
    [
        "coordinate === form.free_joints[joint]",
        "coordinate !== form.free_joints[joint]",
    ],
    [
        "            : has_roots(at));",
        "            : has_roots(than));",
    ],
    ["halving < 5", "halving < 0"],
    ["<= 1e-9 * scale", "<= 1e9 * scale"],
];

/// The same of the search in JavaScript.
const OF_SEARCH_IN_JS: [[&str; 2]; 20] = [
    ["- 2.0 * (across + ", "+ 2.0 * (across + "],
    [
        "im[2][k] = re[1][k] - re[0][k]",
        "im[2][k] = re[1][k] + re[0][k]",
    ],
    ["odd = values[j] - mirrored", "odd = values[j] + mirrored"],
    ["= of_cosines - of_sines", "= of_cosines + of_sines"],
    ["here.value * rises > 0.0", "here.value * rises < 0.0"],
    ["(a - b) * (a + b)", "(a - b) * (a - b)"],
    ["line[3 + i] - behind[0]", "line[3 + i] + behind[0]"],
    ["p[0] * far_p[1] - p[1]", "p[0] * far_p[1] + p[1]"],
    ["$turn(-functions[next]", "$turn(functions[next]"],
    ["b * cosine - a * sine", "b * cosine + a * sine"],
    ["const $EXTRANEOUS = 0.05", "const $EXTRANEOUS = 1e-15"],
    ["(0.3 / longest)", "(-0.3 / longest)"],
    ["const $REACHED = 1e-13", "const $REACHED = 1e-17"],
    ["solution.q[i]) < $SAME", "solution.q[i]) < 1.0"],
    ["const $SINGULAR = 1e-5", "const $SINGULAR = 1e-2"],
    ["search.gap <= 1e-9", "search.gap <= 1e-1"],
    ["return unclear.map((", "return [].map(("],
    ["sum + 2.0 * step", "sum + step"],
    ["count === zeros.count", "count >= 0"],
    ["sum + row[i], 0.0) * (-1.0", "sum + row[i], 0.0) * (1.0"],
];

/// The same of what moves branches to the arm as given.
const OF_REFINEMENT_IN_JS: [[&str; 2]; 3] = [
    [
        "if (!$begins(form, lanes, k))",
        "if ($begins(form, lanes, k))",
    ],
    [
        "if (!is_clear) {\n        $ask_in",
        "if (is_clear) {\n        $ask_in",
    ],
    ["a.branch - b.branch", "b.branch - a.branch"],
];

/// The same of what tells that a step of an exact arm's plan degenerates.
const OF_COMPLETION_IN_JS: [[&str; 2]; 1] =
    [["(lanes.singular[k] > 0.0 ||", "(lanes.singular[k] > 2.0 ||"]];

/// The same of what tells that no branch reaches a target.
const OF_UNANSWERED_IN_JS: [[&str; 2]; 1] = [["|| told.length > 0", "|| told.length === 0"]];

/// The text with one of its lines changed.
fn with_line(text: &str, number: usize, change: impl Fn(&str) -> String) -> String {
    let line = |(i, line): (usize, &str)| match i == number {
        true => change(line),
        false => line.to_owned(),
    };
    let lines: Vec<String> = text.lines().enumerate().map(line).collect();
    lines.join("\n") + "\n"
}

/// Lines with a difference in what is written of expressions: forward kinematics and Jacobians,
/// and the lanes of the branches.
fn differences(text: &str) -> Vec<usize> {
    let place = |words: &str| text.lines().position(|it| it.contains(words)).unwrap();
    let forward = place("void mistaken_fk(")..place("int mistaken_fk_frame(");
    let inverse = place("mistaken_whole(")..place("mistaken_compute_lanes(");
    let lines = text.lines().enumerate();
    let differs = |(i, line): &(usize, &str)| {
        line.contains(" - ") && (forward.contains(i) || inverse.contains(i))
    };
    let all: Vec<usize> = lines.filter(differs).map(|(i, _)| i).collect();
    let every = all.len() / SIGNS;
    all.into_iter().skip(every / 2).step_by(every).collect()
}

#[test]
fn mistakes_are_found() {
    let asked = Asked::of("robots/kr6_r900.yaml", Options::default());
    let right = generated(asked.path, "mistaken", &asked.options);
    let text = &right.source;
    let differences = differences(text).into_iter();
    let signs = differences.map(|line| with_line(text, line, |it| it.replacen(" - ", " + ", 1)));
    let all: Vec<String> = signs.chain(replaced(text, &BOUNDS)).collect();
    assert!(all.len() >= SIGNS + BOUNDS.len());
    each_is_found("mistakes", &asked, &right, &all);
}

#[test]
fn mistakes_of_the_search_are_found() {
    let asked = Asked {
        eliminates: true,
        ..Asked::of("robots/xarm6.yaml", Options::default())
    };
    each_of_is_found("mistakes_of_search", &asked, &OF_SEARCH);
}

/// Branches with an elimination beside.
fn refined(path: &'static str, options: Options) -> Asked {
    Asked {
        eliminates: true,
        refines: true,
        ..Asked::of(path, options)
    }
}

fn of_refinement() -> Asked {
    refined("tests/robots/noisy/calibrated.yaml", Options::default())
}

#[test]
fn mistakes_of_the_refinement_are_found() {
    each_of_is_found("mistakes_of_refinement", &of_refinement(), &OF_REFINEMENT);
}

/// At a swivel angle, without one.
fn of_design() -> Asked {
    let options = Options {
        free: vec!["swivel".into()],
        ..Options::default()
    };
    refined("tests/robots/redundant/stray_iiwa.yaml", options)
}

#[test]
fn mistakes_of_corrections_are_found() {
    each_of_is_found("mistakes_of_correction", &of_design(), &OF_CORRECTION);
}

fn of_projection() -> Asked {
    let options = Options {
        target: Some(Target::Planar),
        ..Options::default()
    };
    Asked::of("tests/robots/targets/rounded_planar.yaml", options)
}

#[test]
fn mistakes_of_projections_are_found() {
    each_of_is_found("mistakes_of_projection", &of_projection(), &OF_PROJECTION);
}

fn of_completion() -> Asked {
    refined("tests/robots/noisy/truncated_pi.yaml", Options::default())
}

#[test]
fn mistakes_of_completion_are_found() {
    each_of_is_found("mistakes_of_completion", &of_completion(), &OF_COMPLETION);
}

fn of_unanswered() -> Asked {
    refined("tests/languages/parallel_456.yaml", Options::default())
}

#[test]
fn mistakes_of_what_is_unanswered_are_found() {
    each_of_is_found("mistakes_of_unanswered", &of_unanswered(), &OF_UNANSWERED);
}

fn of_rest() -> Asked {
    Asked {
        eliminates: true,
        ..Asked::of("tests/robots/crx10ial.yaml", Options::default())
    }
}

#[test]
fn mistakes_of_rest_are_found() {
    each_of_is_found("mistakes_of_rest", &of_rest(), &OF_REST);
}

fn of_staying() -> Asked {
    let free = vec!["joint_a7".into()];
    let options = Options {
        free,
        ..Options::default()
    };
    Asked::of("robots/iiwa14.yaml", options)
}

#[test]
fn mistakes_of_staying_are_found() {
    each_of_is_found("mistakes_of_staying", &of_staying(), &OF_STAYING);
}

#[test]
fn mistakes_next_to_where_singularities_meet_are_found() {
    let [turning, telling] = next_to_where_singularities_meet();
    each_of_is_found("mistakes_of_leading", &turning, &OF_LEADING);
    each_of_is_found("mistakes_of_telling", &telling, &OF_TELLING);
}

fn next_to_where_singularities_meet() -> [Asked; 2] {
    ["robots/elbow.yaml", "robots/ur5e.urdf"].map(|path| Asked::of(path, Options::default()))
}

#[test]
fn mistakes_of_turning_are_found() {
    let asked = Asked::of(targets::OVER_THE_BASE, Options::default());
    each_of_is_found("mistakes_of_turning", &asked, &OF_TURNING);
}

#[test]
fn mistakes_of_slides_are_found() {
    let asked = Asked::of(targets::ALONG_RAIL, Options::default());
    each_of_is_found("mistakes_of_slides", &asked, &OF_SLIDES);
}

#[test]
fn mistakes_of_parabolas_are_found() {
    let asked = Asked::of(targets::UPRIGHT, Options::default());
    each_of_is_found("mistakes_of_parabolas", &asked, &OF_PARABOLAS);
}

/// With joints given everywhere.
fn of_given() -> Asked {
    let (path, free) = robots::LIFTED;
    let options = Options {
        free: free.iter().map(|&joint| joint.into()).collect(),
        ..Options::default()
    };
    Asked {
        eliminates: true,
        ..Asked::of(path, options)
    }
}

#[test]
fn mistakes_of_what_is_given_are_found() {
    each_of_is_found("mistakes_of_what_is_given", &of_given(), &OF_GIVEN);
}

#[test]
fn mistakes_in_javascript_are_found() {
    let of_turning = Asked::of(targets::OVER_THE_BASE, Options::default());
    let of_parabolas = Asked::of(targets::UPRIGHT, Options::default());
    let of_slides = Asked::of(targets::ALONG_RAIL, Options::default());
    let of_search = Asked {
        eliminates: true,
        ..Asked::of("robots/xarm6.yaml", Options::default())
    };
    let [leading, telling] = next_to_where_singularities_meet();
    let each = [
        (leading, &OF_LEADING_IN_JS[..]),
        (telling, &OF_TELLING_IN_JS[..]),
        (of_given(), &OF_GIVEN_IN_JS[..]),
        (of_completion(), &OF_COMPLETION_IN_JS[..]),
        (of_unanswered(), &OF_UNANSWERED_IN_JS[..]),
        (of_rest(), &OF_REST_IN_JS[..]),
        (of_staying(), &OF_STAYING_IN_JS[..]),
        (of_turning, &OF_TURNING_IN_JS[..]),
        (of_parabolas, &OF_PARABOLAS[..]),
        (of_slides, &OF_SLIDES_IN_JS[..]),
        (of_search, &OF_SEARCH_IN_JS[..]),
        (of_refinement(), &OF_REFINEMENT_IN_JS[..]),
        (of_design(), &OF_CORRECTION_IN_JS[..]),
        (of_projection(), &OF_PROJECTION_IN_JS[..]),
    ];
    for (asked, mistakes) in each {
        let c = generated(asked.path, "mistaken", &asked.options);
        let source = read(asked.path);
        let right = GeneratedJs::of(c.robot.clone(), &source, &asked.options).source;
        let rust = loaded(asked.path, &asked.options);
        let mut subject = Subject::new(&asked, &c, String::new(), rust);
        subject.configurations.clear();
        let targets = std::mem::take(&mut subject.targets);
        let mut is_right = |text: &str, targets: &[(Pose, Vec<f64>)]| {
            subject.js = text.to_owned();
            subject.targets = targets.to_vec();
            catch_unwind(AssertUnwindSafe(|| compare_js(&subject, 3))).is_ok()
        };
        // A few at a time, until it is found; by targets that what is right passes.
        let few: Vec<_> = targets.chunks(12).collect();
        let mut telling = BTreeSet::new();
        for (text, mistake) in replaced(&right, mistakes).zip(mistakes) {
            let found = few.iter().position(|some| !is_right(&text, some));
            telling.insert(found.unwrap_or_else(|| panic!("{mistake:?}")));
        }
        assert!(telling.iter().all(|&i| is_right(&right, few[i])));
    }
}

/// A text with one passage replaced, for each of them.
fn replaced<'t>(text: &'t str, all: &'t [[&str; 2]]) -> impl Iterator<Item = String> + 't {
    all.iter().map(move |[there, instead]| {
        assert!(text.contains(there), "{there}");
        text.replacen(there, instead, 1)
    })
}

/// Whether the comparison passes what is right, and nothing else.
fn each_is_found(name: &str, asked: &Asked, right: &GeneratedC, wrong: &[String]) {
    if !Compiler::C.is_there() {
        return;
    }
    let rust = loaded(asked.path, &asked.options);
    let subject = Subject::new(asked, right, String::new(), rust);
    let text = &right.source;
    let all: Vec<&String> = [text].into_iter().chain(wrong).collect();
    let mut program = Program::new(name);
    for (number, source) in all.iter().enumerate() {
        let name = format!("wrong{number}");
        program.add(&GeneratedC {
            header: renamed(&right.header, &name),
            source: renamed(source, &name),
            name,
            ..right.clone()
        });
    }
    let built = program.build(Compiler::C, &["-O0"], name);
    let told = built.run(&subject.input.repeat(all.len()));
    for (source, told) in all.iter().zip(told.split_inclusive(program::END)) {
        let run = || compare(std::slice::from_ref(&subject), told);
        let is_right = catch_unwind(AssertUnwindSafe(run)).is_ok();
        let changed = text.lines().zip(source.lines()).find(|(a, b)| a != b);
        assert_eq!(is_right, changed.is_none(), "{changed:?}");
    }
}

/// The same of passages that are replaced.
fn each_of_is_found(name: &str, asked: &Asked, mistakes: &[[&str; 2]]) {
    let right = generated(asked.path, "mistaken", &asked.options);
    let all: Vec<String> = replaced(&right.source, mistakes).collect();
    each_is_found(name, asked, &right, &all);
}

/// The same under another name.
fn renamed(text: &str, name: &str) -> String {
    let upper = name.to_ascii_uppercase();
    text.replace("mistaken", name).replace("MISTAKEN", &upper)
}
