//! "Did you mean": the known word nearest to a misspelt one.

/// The candidate that `word` is most likely a misspelling of: at most a third
/// of its letters wrong, letter case aside.
pub(crate) fn nearest<'c>(
    word: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    let distance = |candidate: &'c str| (edit_distance(word, candidate), candidate);
    let (distance, candidate) = candidates.into_iter().map(distance).min_by_key(|d| d.0)?;
    let tolerated = candidate.chars().count() / 3;
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

/// Edits that count one: a letter too many, too few, another one, or two
/// neighbours swapped (optimal string alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    // Words longer than this are no misspellings of a name we know.
    let letters = |s: &str| s.to_lowercase().chars().take(64).collect::<Vec<_>>();
    let (a, b) = (letters(a), letters(b));
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let differ = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (rows[i - 1][j] + 1)
                .min(row[j - 1] + 1)
                .min(rows[i - 1][j - 1] + differ);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
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
