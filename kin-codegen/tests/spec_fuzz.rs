//! No text makes the readers panic, and what they accept is sound.

#[path = "../../fuzz/src/mutation.rs"]
mod mutation;
#[path = "../../fuzz/src/readers.rs"]
mod readers;

use kin_codegen::random::Random;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Robot files of both formats: those of the project, and those that the fuzz
/// targets begin with.
fn seeds() -> Vec<(String, String)> {
    let folders = [
        "../robots",
        "../fuzz/corpus/urdf",
        "../fuzz/corpus/yaml",
        "../fuzz/corpus/mechanism",
    ];
    files(&folders)
}

/// Those and every broken file.
fn all_seeds() -> Vec<(String, String)> {
    let broken = files(&["tests/broken", "tests/broken_mechanisms"]);
    let robots = broken
        .into_iter()
        .filter(|(path, _)| !path.ends_with(".txt"));
    seeds().into_iter().chain(robots).collect()
}

/// The files of some folders, in an order that repeats.
fn files(folders: &[&str]) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).unwrap());
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_name()?.to_str()?.to_owned();
        Some((name, fs::read_to_string(path).ok()?))
    };
    paths.into_iter().filter_map(read).collect()
}

/// Words that mean something somewhere.
const WORDS: [&str; 24] = [
    "<",
    ">",
    "\"",
    "'",
    "&",
    "/",
    "<joint",
    "</joint>",
    "<!--",
    "${pi}",
    "nan",
    "1e999",
    "-",
    ":",
    "[",
    "}",
    "\t",
    "\n",
    "é",
    "\u{0}",
    "*a",
    "&a ",
    "!t ",
    "<link name=\"a\"/>",
];

fn read(path: &str, text: String) {
    readers::read(path, &text);
}

/// The nearest character boundary at or below a fraction of the text.
fn boundary(text: &str, fraction: f64) -> usize {
    let mut at = (text.len() as f64 * fraction) as usize;
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cut_files(seed in any::<prop::sample::Index>(), fraction in 0.0..1.0) {
        let seeds = seeds();
        let (path, text) = &seeds[seed.index(seeds.len())];
        read(path, text[..boundary(text, fraction)].to_string());
    }

    #[test]
    fn files_with_a_piece_missing_or_a_word_too_many(
        seed in any::<prop::sample::Index>(),
        edits in prop::collection::vec((0.0..1.0, 0..12_usize, 0..WORDS.len() + 8), 1..4),
    ) {
        let seeds = seeds();
        let (path, text) = &seeds[seed.index(seeds.len())];
        let mut text = text.clone();
        for (fraction, length, word) in edits {
            let start = boundary(&text, fraction);
            let end = boundary(&text, ((start + length) as f64 / text.len().max(1) as f64).min(1.0)).max(start);
            text.replace_range(start..end, WORDS.get(word).unwrap_or(&""));
        }
        read(path, text);
    }

    #[test]
    fn shuffled_lines(seed in any::<prop::sample::Index>(), swaps in prop::collection::vec((0.0..1.0, 0.0..1.0), 1..5)) {
        let seeds = seeds();
        let (path, text) = &seeds[seed.index(seeds.len())];
        let mut lines: Vec<&str> = text.lines().collect();
        for (a, b) in swaps {
            let at = |fraction: f64| (fraction * lines.len() as f64) as usize;
            let (a, b) = (at(a), at(b));
            lines.swap(a, b);
        }
        read(path, lines.join("\n"));
    }

    #[test]
    fn any_numbers(numbers in prop::collection::vec(any::<f64>(), 9)) {
        let [x, y, z, r, p, w, a, b, c] = numbers[..] else { unreachable!() };
        read("n.urdf", format!(
            "<robot name='n'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>\
             <child link='b'/><origin xyz='{x:e} {y:e} {z:e}' rpy='{r:e} {p} {w}'/><axis xyz='{a:e} {b:e} {c}'/></joint></robot>"
        ));
        read("n.yaml", format!(
            "robot: n\nunits: {{angle: deg, length: mm}}\nscrews:\n  - {{name: j, axis: [{a:e}, {b:e}, {c}], point: [{x:e}, {y:e}, {z}]}}\n\
             home: {{rpy: [{r:e}, {p}, {w}]}}\n"
        ));
    }

    #[test]
    fn any_text(text in any::<String>()) {
        for path in ["a.urdf", "a.yaml", "a"] {
            read(path, text.clone());
        }
    }
}

/// How many files the next test reads: `KIN_EXECUTIONS`, or as many as nobody
/// has to wait for.
fn executions() -> u64 {
    let given = std::env::var("KIN_EXECUTIONS").ok();
    given.map_or(5000, |count| {
        count.parse().expect("KIN_EXECUTIONS is a number")
    })
}

#[test]
fn robots_with_a_few_words_and_lines_in_other_places() {
    let seeds = [seeds(), all_seeds()];
    let mut robots = 0;
    let mut spent = BTreeMap::<String, (u64, Duration)>::new();
    for seed in 1..=executions() {
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let mut pick = || {
            let seeds = &seeds[random.below(2)];
            &seeds[random.below(seeds.len() as u64)]
        };
        let ((path, text), (_, other)) = (pick(), pick());
        let text = mutation::mutate(text, other, &mut random);
        let start = Instant::now();
        match catch_unwind(|| readers::read(path, &text)) {
            Ok(robot) => robots += u64::from(robot),
            Err(_) => panic!("{path} of seed {seed}:\n{text}"),
        }
        let format = path.rsplit('.').next().unwrap_or(path).to_owned();
        let (files, time) = spent.entry(format).or_default();
        (*files, *time) = (*files + 1, *time + start.elapsed());
    }
    for (format, (files, time)) in spent {
        println!("{format}: {:.0} files/s", files as f64 / time.as_secs_f64());
    }
    // Neither are all still robots, nor none of them.
    let part = executions() / 20;
    assert!(
        (part..19 * part).contains(&robots),
        "{robots} of {}",
        executions()
    );
}
