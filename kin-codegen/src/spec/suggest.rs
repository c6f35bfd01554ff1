//! "Did you mean": the known word nearest to a misspelt one.

use super::bounds::SUGGESTED;

/// The candidate that `word` is most likely a misspelling of: at most a third
/// of its letters wrong, letter case and blanks around it aside. Of many candidates that are about
/// as long as the word, the first [`SUGGESTED`] are looked at.
pub(crate) fn nearest<'c>(
    word: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    let word = letters(word);
    let as_long = |candidate: &&str| {
        let length = candidate.chars().take(LONGEST).count();
        length.abs_diff(word.len()) <= length / 3
    };
    let candidates = candidates.into_iter().filter(as_long).take(SUGGESTED);
    let distance = |candidate: &'c str| (edit_distance(&word, &letters(candidate)), candidate);
    let (distance, candidate) = candidates.map(distance).min_by_key(|d| d.0)?;
    let tolerated = candidate.chars().take(LONGEST).count() / 3;
    (distance <= tolerated).then_some(candidate)
}

/// A remedy that names the nearest candidate, or all of them.
pub(crate) fn did_you_mean(word: &str, candidates: &[&str]) -> String {
    match nearest(word, candidates.iter().copied()) {
        Some(candidate) => format!("did you mean `{candidate}`?"),
        None if candidates.is_empty() => "there is none to choose from".into(),
        None if candidates.len() == 1 => format!("use `{}`", candidates[0]),
        None => format!("use one of {}", list(candidates)),
    }
}

/// Names in backquotes, the first dozen of them.
pub(crate) fn list(names: &[&str]) -> String {
    let shown: Vec<_> = names
        .iter()
        .take(12)
        .map(|name| format!("`{name}`"))
        .collect();
    let more = if names.len() > shown.len() {
        ", ..."
    } else {
        ""
    };
    shown.join(", ") + more
}

/// Words longer than this are no misspellings of a name we know.
const LONGEST: usize = 64;

fn letters(word: &str) -> Vec<char> {
    word.trim()
        .chars()
        .flat_map(char::to_lowercase)
        .take(LONGEST)
        .collect()
}

/// Edits that count one: a letter too many, too few, another one, or two
/// neighbours swapped (optimal string alignment).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let differ = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (above[j] + 1)
                .min(row[j - 1] + 1)
                .min(above[j - 1] + differ);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        (before, above) = (above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_swapped_missing_and_wrong_letters() {
        let known = ["axis", "origin", "limit", "parent"];
        for (word, meant) in [
            ("axsi", "axis"),
            ("orign", "origin"),
            ("Limit", "limit"),
            ("parant", "parent"),
        ] {
            assert_eq!(nearest(word, known), Some(meant));
        }
        assert_eq!(nearest("transmission", known), None);
        assert_eq!(nearest("x", ["a", "d"]), None);
        assert_eq!(nearest("anything", []), None);
    }

    #[test]
    fn a_long_list_is_cut() {
        let names = ["a"; 20];
        assert!(list(&names).ends_with("`a`, ..."));
    }
}
