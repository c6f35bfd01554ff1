//! What the pages of `kin view` compute, without a browser: `tests/pages` has those for one.

use crate::js::{JsRobot, NAMES, is_no_markup, named};
use crate::read;
use kin_cli::view::page;
use kin_codegen::{Compiled, Ik, Options, compile};
use kinematics::Target;

/// Where the scripts that need a page begin.
const PAGE: &str = "// The page: what is shown";

/// The script of a robot's page.
fn script(page: &str) -> &str {
    let (_, script) = page.split_once("<script type=\"module\">").unwrap();
    script.split_once("</script>").unwrap().0
}

/// What stands in its place moves the target and the joints of a robot, and says how far its tip
/// is from the target, how far from the end of what is drawn, how many branches there are, and whether
/// it follows by Newton's method.
const ASKED: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = Array.isArray(robot.chains) ? new MechanismView(robot, view) : new ArmView(robot, view);
const tip = () => origin(Array.isArray(robot.chains) ? robot.platform(subject.whole) : robot.fk(subject.q));
const apart = (a, b) => Math.hypot(...add(a, b, -1));
export default { ask() {
    const first = tip();
    const { joints } = subject;
    subject.setJoint(0, subject.q[0] + (joints[0].turns ? 0.1 : 0.01 * view.size));
    const moved = apart(tip(), first);
    const target = subject.target.slice();
    // Inwards, where arms have room.
    [3, 7, 11].forEach((i) => (target[i] *= 0.99));
    subject.setTarget(target);
    const off = apart(tip(), origin(target));
    const drawn = apart(subject.points().at(-1), tip());
    const branches = subject.branches();
    const here = branches === null ? 1 : branches.filter(({ current }) => current).length;
    const measures = subject.measures().every(({ value }) => Number.isFinite(value));
    return [moved, off, drawn, branches ? branches.length : 0, here, measures ? 1 : 0, subject.reached ? 1 : 0,
        /Newton/.test(subject.reach()[0]) ? 1 : 0];
} };
";

#[test]
fn arms_and_mechanisms_follow_their_target() {
    // With how many branches are shown at least, by eliminations as well.
    let robots = [
        ("robots/ur5e.urdf", 2.0),
        ("robots/scara.yaml", 2.0),
        ("robots/panda.yaml", 2.0),
        ("robots/iiwa14.yaml", 2.0),
        ("robots/xarm6.yaml", 4.0),
        ("robots/sawyer.yaml", 2.0),
        ("tests/robots/noisy/calibrated.yaml", 4.0),
        ("robots/delta.yaml", 0.0),
        ("robots/stewart.yaml", 0.0),
    ];
    let by_default = robots.map(|(path, least)| (path, Options::default(), least));
    let without = Options {
        ik: Ik::None,
        ..Options::default()
    };
    let followed = ("robots/ur5e.urdf", without, 0.0);
    for (path, options, least) in by_default.into_iter().chain([followed]) {
        let (page, _) = page(&read(path), &options).unwrap();
        let (before, after) = script(&page).split_once(PAGE).unwrap();
        assert!(after.contains("requestAnimationFrame"));
        let before = before.replace("export default robot;", "");
        let said = JsRobot::new(&format!("{before}{ASKED}")).call("ask_of", "");
        let numbers: Vec<f64> = said.split(' ').map(|x| x.parse().unwrap()).collect();
        let [
            moved,
            off,
            drawn,
            branches,
            here,
            measures,
            reached,
            follows,
        ] = numbers[..]
        else {
            panic!("{said}")
        };
        assert!(moved > 1e-3, "{path}: a joint moved the tip by {moved} m");
        assert!(off < 1e-6, "{path}: the tip is {off} m from its target");
        assert!(drawn < 1e-9, "{path}: drawn {drawn} m from its tip");
        assert!(branches >= least && here == 1.0, "{path}: {said}");
        assert!(measures == 1.0 && reached == 1.0, "{path}: {said}");
        let is_mechanism = page.contains("$mechanism(");
        assert_eq!(follows == 1.0, least == 0.0 && !is_mechanism, "{path}");
    }
}

/// What stands in the page's place turns the last joint around in steps of 0.1 rad, and says the farthest
/// that a joint of solutions with one number has moved in a step, and how many were compared.
const TURNED: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = new ArmView(robot, view);
export default { ask() {
    let [farthest, compared] = [0, 0];
    for (let k = 0; k <= 63; ++k) {
        const before = subject.solutions;
        subject.setJoint(5, -3.15 + 0.1 * k);
        for (const { branch, q } of subject.solutions) {
            const same = before.find((it) => it.branch === branch);
            if (same && k > 0) {
                farthest = Math.max(farthest, subject.apart(q, same.q));
                ++compared;
            }
        }
    }
    return [farthest, compared];
} };
";

#[test]
fn solutions_keep_their_numbers_as_the_target_moves() {
    // The roots of the first are numbered by the last joint; the others' have postures.
    for path in ["robots/xarm6.yaml", "tests/robots/noisy/calibrated.yaml"] {
        let (page, _) = page(&read(path), &Options::default()).unwrap();
        let (before, _) = script(&page).split_once(PAGE).unwrap();
        let before = before.replace("export default robot;", "");
        let said = JsRobot::new(&format!("{before}{TURNED}")).call("ask_of", "");
        let numbers: Vec<f64> = said.split(' ').map(|x| x.parse().unwrap()).collect();
        let [farthest, compared] = numbers[..] else {
            panic!("{said}")
        };
        assert!(compared >= 4.0 * 63.0, "{path}: {compared} compared");
        assert!(
            (farthest - 0.1).abs() < 1e-6,
            "{path}: {farthest} rad in a step"
        );
    }
}

/// What stands in the page's place moves the target off the plane of an arm with two joints, and
/// says how far the tip is from the target, how far it is off the plane, and how far it has moved.
const OFF_THE_PLANE: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = new ArmView(robot, view);
export default { ask() {
    const before = origin(subject.target);
    const moved = subject.target.slice();
    moved[3] -= 0.1;
    moved[11] += 0.05;
    subject.setTarget(moved);
    subject.released();
    const [tip, target] = [origin(robot.fk(subject.q)), origin(subject.target)];
    const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
    return [apart(tip, target), Math.abs(target[2] - before[2]), apart(target, before), subject.reached ? 1 : 0];
} };
";

#[test]
fn a_short_arm_takes_its_target_along() {
    let (page, _) = page(&read("robots/planar_3r.yaml"), &Options::default()).unwrap();
    let (before, _) = script(&page).split_once(PAGE).unwrap();
    let before = before.replace("export default robot;", "");
    let said = JsRobot::new(&format!("{before}{OFF_THE_PLANE}")).call("ask_of", "");
    let numbers: Vec<f64> = said.split(' ').map(|x| x.parse().unwrap()).collect();
    let [off, height, moved, reached] = numbers[..] else {
        panic!("{said}")
    };
    assert!(off < 1e-9 && height < 1e-9 && reached == 1.0, "{said}");
    assert!(moved > 0.02, "{said}");
}

/// What stands in the page's place moves the target twice as far as the arm is long, and says what is told
/// of it before and behind.
const OUT_OF_REACH: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = new ArmView(robot, view);
export default { ask() {
    const before = subject.reach()[0];
    const moved = subject.target.slice();
    moved[3] += 2 * view.size;
    subject.setTarget(moved);
    return [[before, subject.reach()[0]].join('|')];
} };
";

#[test]
fn an_arm_with_joints_enough_for_what_counts_is_out_of_reach() {
    for (path, target) in [
        ("robots/scara.yaml", Target::PositionYaw),
        ("robots/planar_3r.yaml", Target::Planar),
    ] {
        let options = Options {
            target: Some(target),
            ..Options::default()
        };
        let (page, _) = page(&read(path), &options).unwrap();
        let (before, _) = script(&page).split_once(PAGE).unwrap();
        let before = before.replace("export default robot;", "");
        let said = JsRobot::new(&format!("{before}{OUT_OF_REACH}")).call("ask_of", "");
        assert_eq!(said, "|No solution: out of reach.", "{path}");
    }
}

/// What stands in the page's place turns the first joint by more than half a turn, and says how far
/// it turns when the target moves a little.
const WOUND: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = new ArmView(robot, view);
export default { ask() {
    subject.setJoint(0, 3.5);
    const moved = subject.target.slice();
    moved[11] += 1e-4;
    subject.setTarget(moved);
    return [subject.q[0] - 3.5];
} };
";

#[test]
fn joints_keep_their_full_turns_as_the_target_moves() {
    let (page, _) = page(&read("robots/ur5e.urdf"), &Options::default()).unwrap();
    let (before, _) = script(&page).split_once(PAGE).unwrap();
    let before = before.replace("export default robot;", "");
    let said = JsRobot::new(&format!("{before}{WOUND}")).call("ask_of", "");
    assert!(said.parse::<f64>().unwrap().abs() < 0.01, "{said}");
}

#[test]
fn a_refusal_has_its_lines() {
    let (page, _) = page(&read("tests/ui/robots/singular.yaml"), &Options::default()).unwrap();
    assert!(page.contains("\\nhelp: "), "no help in the page");
}

/// What stands in the page's place moves the driven joints, and says the two measures and all joint
/// values.
const MEASURED: &str = "
globalThis.matchMedia = () => ({ matches: false });
const subject = new MechanismView(robot, view);
export default { ask() {
    return [0.05, -0.11, 0.17].flatMap((by, k) => {
        subject.setJoint(k % subject.joints.length, subject.q[k % subject.joints.length]
            + by * (subject.joints[0].turns ? 1 : view.size));
        const measure = (name) => subject.measures().find((it) => it.name === name).value;
        return [measure('actuator singularity'), measure('kinematic singularity'), ...subject.whole];
    });
} };
";

#[test]
fn mechanisms_tell_their_singularities() {
    for path in [
        "robots/delta.yaml",
        "robots/stewart.yaml",
        "robots/five_bar.yaml",
    ] {
        let source = read(path);
        let compiled = compile(&source, &Options::default()).unwrap();
        let Compiled::Mechanism(mechanism) = &compiled else {
            panic!("{path} is a mechanism")
        };
        let generic = mechanism.mechanism.generic();
        let (page, _) = page(&source, &Options::default()).unwrap();
        let (before, _) = script(&page).split_once(PAGE).unwrap();
        let before = before.replace("export default robot;", "");
        let said = JsRobot::new(&format!("{before}{MEASURED}")).call("ask_of", "");
        let numbers: Vec<f64> = said.split(' ').map(|x| x.parse().unwrap()).collect();
        let each = numbers.chunks(2 + generic.joints());
        assert_eq!(each.len(), 3, "{path}: {said}");
        for told in each {
            let (measures, q) = told.split_at(2);
            let known = [
                generic.actuator_singularity(q),
                generic.kinematic_singularity(q, mechanism.freedom.mobility),
            ];
            assert!(
                known.into_iter().all(|x| x > 1e-4),
                "{path}: {known:?} tell little"
            );
            // Square roots of sums of squares, near zero of rounding.
            for (told, known) in measures.iter().zip(known) {
                assert!(
                    (told - known).abs() < 1e-7,
                    "{path}: {measures:?} {known:?}"
                );
            }
        }
    }
}

#[test]
fn names_stay_in_their_place() {
    for name in NAMES {
        let (page, _) = page(&named(name), &Options::default()).unwrap();
        assert_eq!(page.matches("<script").count(), 1, "{name:?}");
        assert_eq!(page.matches("</script").count(), 1, "{name:?}");
        let robots_own = script(&page).split_once(PAGE).unwrap().0;
        let (robots_own, _) = robots_own
            .split_once("// Poses are twelve numbers")
            .unwrap();
        assert!(is_no_markup(robots_own), "{name:?}");
        assert!(
            !page.split("<script").next().unwrap().contains(name),
            "{name:?}"
        );
    }
}

#[test]
fn nothing_is_fetched() {
    let (page, _) = page(&read("robots/ur5e.urdf"), &Options::default()).unwrap();
    assert!(page.contains("default-src 'none'"));
    for way in [
        "http:", "https:", "//cdn", "src=", "href=", "@import", "url(", "fetch(", "import(",
    ] {
        assert!(!page.contains(way), "{way}");
    }
}
