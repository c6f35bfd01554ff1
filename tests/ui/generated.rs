//! What generated code says of itself holds: its table of branches names the postures that
//! forward kinematics shows, and its functions do what their contracts say. `examples.rs` beside
//! this runs its examples.

use kin_codegen::{Options, Source, generate};
use std::path::Path;

kinematics::kinematics!("../../robots/ur5e.urdf");
kinematics::kinematics!("../../robots/kr6_r900.yaml");

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn code(robot: &str, options: &Options) -> String {
    let source = Source::read(robot, Path::new(ROOT)).unwrap();
    generate(&source, options).unwrap().code()
}

/// The lines of the type's documentation.
fn documentation(code: &str) -> Vec<&str> {
    let lines = code.lines().map(str::trim_start);
    lines
        .skip_while(|line| !line.starts_with("///"))
        .take_while(|line| line.starts_with("///"))
        .map(|line| line.trim_start_matches('/').trim())
        .collect()
}

mod branches {
    use super::*;
    use kinematics::{Kinematics, Solution};

    /// By branch, what each posture is called.
    fn table(robot: &str) -> Vec<Vec<(String, String)>> {
        let code = code(robot, &Options::default());
        let lines = documentation(&code);
        let cells = |line: &str| -> Vec<String> {
            let cells = line.trim_matches('|').split('|');
            cells.map(|cell| cell.trim().to_owned()).collect()
        };
        let mut rows = lines
            .iter()
            .skip_while(|line| !line.starts_with("| branch |"))
            .take_while(|line| line.starts_with('|'))
            .map(|line| cells(line));
        let heads: Vec<String> = rows.next().unwrap()[1..]
            .iter()
            .map(|head| head.split(" (").next().unwrap().to_owned())
            .collect();
        rows.skip(1)
            .enumerate()
            .map(|(branch, row)| {
                assert_eq!(row[0], branch.to_string());
                heads
                    .iter()
                    .cloned()
                    .zip(row[1..].iter().cloned())
                    .collect()
            })
            .collect()
    }

    fn word<'a>(row: &'a [(String, String)], posture: &str) -> &'a str {
        let (_, word) = row.iter().find(|(name, _)| name == posture).unwrap();
        word
    }

    /// A configuration, from the golden ratio's multiples.
    fn configuration(k: usize) -> [f64; 6] {
        std::array::from_fn(|i| ((k * 7 + i + 1) as f64 * 1.618_034 * (i as f64 + 1.3)) % 3.1)
    }

    /// Postures by the frames of the links, where they can be told.
    struct Seen {
        shoulder: &'static str,
        elbow: Option<&'static str>,
        wrist: &'static str,
    }

    fn seen(
        robot: &impl Kinematics<6>,
        solution: &Solution<6>,
        hand: usize,
        centre: usize,
        shoulder: impl Fn([f64; 3], [f64; 3], [f64; 3]) -> &'static str,
    ) -> Seen {
        let links = robot.fk_links(&solution.q);
        let [from, over, to, centre] = [1, 2, hand, centre].map(|i| links[i].translation);
        let level = |v: [f64; 3], w: [f64; 3]| v[0] * w[0] + v[1] * w[1];
        let line = [0, 1, 2].map(|i| to[i] - from[i]);
        let upper = [0, 1, 2].map(|i| over[i] - from[i]);
        let length = level(line, line).sqrt();
        let height = upper[2] - line[2] * level(line, upper) / (length * length);
        // Where the line leads away from axis 1.
        let leads_away = level(line, centre) > 1e-3 * length;
        let axis = {
            let column = robot.spatial_jacobian(&solution.q).column(1);
            column.angular
        };
        Seen {
            shoulder: shoulder(axis, from, centre),
            elbow: leads_away.then_some(if height > 0.0 { "up" } else { "down" }),
            wrist: if solution.q[4].sin() > 0.0 {
                "not flipped"
            } else {
                "flipped"
            },
        }
    }

    fn check(
        robot: &impl Kinematics<6>,
        file: &str,
        hand: usize,
        centre: usize,
        shoulder: impl Fn([f64; 3], [f64; 3], [f64; 3]) -> &'static str,
    ) {
        let table = table(file);
        assert_eq!(table.len(), 8);
        let (mut met, mut told) = ([0; 8], 0);
        for k in 0..200 {
            let pose = robot.fk(&configuration(k));
            for solution in robot.ik(&pose).iter().filter(|solution| !solution.singular) {
                let row = &table[solution.branch as usize];
                let seen = seen(robot, solution, hand, centre, &shoulder);
                assert_eq!(word(row, "shoulder"), seen.shoulder, "{solution:?}");
                assert_eq!(word(row, "wrist"), seen.wrist, "{solution:?}");
                if let Some(elbow) = seen.elbow {
                    assert_eq!(word(row, "elbow"), elbow, "{solution:?}");
                    told += 1;
                }
                met[solution.branch as usize] += 1;
            }
        }
        assert!(met.iter().all(|&times| times > 50), "{met:?}");
        assert!(told > 600, "{told}");
        // No two branches have the same words.
        for (i, row) in table.iter().enumerate() {
            assert!(!table[..i].contains(row), "{row:?}");
        }
    }

    /// The plane of the arm passes axis 1 on one side of the way to the wrist.
    fn left_or_right(axis: [f64; 3], _: [f64; 3], centre: [f64; 3]) -> &'static str {
        let aside = centre[0] * axis[0] + centre[1] * axis[1];
        let plane = [aside * axis[0], aside * axis[1]];
        match centre[0] * plane[1] - centre[1] * plane[0] > 0.0 {
            true => "left",
            false => "right",
        }
    }

    /// In front is where axis 2 is.
    fn front_or_back(_: [f64; 3], second: [f64; 3], centre: [f64; 3]) -> &'static str {
        match second[0] * centre[0] + second[1] * centre[1] > 0.0 {
            true => "front",
            false => "back",
        }
    }

    #[test]
    fn a_ur5e_s_are_called_what_they_look_like() {
        check(&Ur5e, "robots/ur5e.urdf", 3, 5, left_or_right);
    }

    #[test]
    fn a_kr_6_s_are_called_what_they_look_like() {
        check(&Kr6R900, "robots/kr6_r900.yaml", 4, 4, front_or_back);
    }

    #[test]
    fn roots_without_a_word_are_called_by_their_step() {
        let table = table("robots/stanford.yaml");
        let names: Vec<&str> = table[0].iter().map(|(name, _)| &name[..]).collect();
        assert_eq!(names, ["wrist", "step 1", "step 2"]);
        assert_eq!(word(&table[2], "step 2"), "−");
    }
}

mod contracts {
    use super::*;
    use kinematics::{Kinematics, Pose, WithBase, WithTool};

    const Q: [f64; 6] = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];

    fn with(i: usize, value: f64) -> [f64; 6] {
        let mut q = Q;
        q[i] = value;
        q
    }

    #[test]
    fn ratings_and_links_are_those_of_the_file() {
        use std::f64::consts::PI;
        assert_eq!(Ur5e::VELOCITY_LIMITS, [PI; 6]);
        assert_eq!(Ur5e::EFFORT_LIMITS, [150.0, 150.0, 150.0, 28.0, 28.0, 28.0]);
        assert_eq!(
            Ur5e::LINK_NAMES[3..],
            ["wrist_1_link", "wrist_2_link", "wrist_3_link"]
        );
        // That file says nothing of either.
        assert_eq!(Kr6R900::VELOCITY_LIMITS, [f64::INFINITY; 6]);
        assert_eq!(Kr6R900::EFFORT_LIMITS, [f64::INFINITY; 6]);

        fn seen<const N: usize, K: Kinematics<N>>(_: K) -> ([f64; N], [f64; N], [&'static str; N]) {
            (K::VELOCITY_LIMITS, K::EFFORT_LIMITS, K::LINK_NAMES)
        }
        let own = (Ur5e::VELOCITY_LIMITS, Ur5e::EFFORT_LIMITS, Ur5e::LINK_NAMES);
        let (robot, tool, base) = (Ur5e, Pose::IDENTITY, Pose::IDENTITY);
        assert_eq!(seen(robot), own);
        assert_eq!(seen(WithTool { robot, tool }), own);
        assert_eq!(seen(WithBase { robot, base }), own);
    }

    #[test]
    fn joint_values_that_are_not_finite_give_entries_that_are_not_numbers() {
        for i in 0..6 {
            for value in [f64::NAN, f64::INFINITY] {
                let q = with(i, value);
                assert!(Ur5e.fk(&q).rotation.iter().flatten().any(|x| x.is_nan()));
                let (_, jacobian) = Ur5e.fk_jacobian(&q);
                let depends = i < 5;
                let rows = jacobian.rows.iter().flatten();
                assert!(!depends || rows.clone().any(|x| x.is_nan()), "q{}", i + 1);
                assert!(rows.clone().all(|x| !x.is_infinite()));
            }
        }
    }

    #[test]
    fn a_seed_that_is_not_finite_leaves_regular_targets_alone() {
        let pose = Ur5e.fk(&Q);
        let expected = Ur5e.ik(&pose);
        for i in 0..6 {
            let found = Ur5e.ik_seeded(&pose, &with(i, f64::NAN));
            assert_eq!(found.len(), expected.len(), "q{}", i + 1);
        }
    }
}
