//! The sets of joints of which one may stay free.

/// Sets of joints that are compared: all of one joint, or of two of eight. Of more those are
/// that leave a row of joints; see [`rows`].
const CHOICES: usize = 64;

/// Sets of `count` of `n` joints that have those asked for among them, by rows, the first choice
/// first: one of all, or where these are too many to compare the [`rows`] of joints.
pub(super) fn choices(n: usize, count: usize, asked: &[usize]) -> Vec<Vec<Vec<usize>>> {
    if let Some(all) = all(n, count, asked) {
        return vec![all];
    }
    let others: Vec<usize> = (0..n).filter(|joint| !asked.contains(joint)).collect();
    let mut rows = rows(&others, n - count);
    for set in rows.iter_mut().flatten() {
        set.extend(asked);
        set.sort_unstable();
    }
    rows
}

/// All sets of `count` of `n` joints that have those asked for among them; none if they are more
/// than are compared.
pub(super) fn all(n: usize, count: usize, asked: &[usize]) -> Option<Vec<Vec<usize>>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for joint in 0..n {
        let asked_behind = asked.iter().filter(|&&other| other > joint).count();
        // What is kept can be completed: of so many sets begun there are as many in the end.
        let complete = |set: &Vec<usize>| {
            let fits = (set.len() + asked_behind..set.len() + n - joint).contains(&count);
            fits && (!asked.contains(&joint) || set.contains(&joint))
        };
        let longer = |set: &Vec<usize>| [&set[..], &[joint]].concat();
        let longer: Vec<Vec<usize>> = all.iter().map(longer).collect();
        all.extend(longer);
        all.retain(complete);
        if all.len() > CHOICES {
            return None;
        }
    }
    all.sort_by(|a, b| a.iter().rev().cmp(b.iter().rev()));
    Some(all)
}

/// By rows of `left` joints and one more, the sets that leave all but one of a row: an arm is
/// solved as if it were alone, and what carries it is given (a platform, a trunk), or what it
/// carries. The row at the tip comes first, and no more sets are compared than elsewhere.
fn rows(joints: &[usize], left: usize) -> Vec<Vec<Vec<usize>>> {
    let leaving = |row: &[usize], given: usize| {
        let is_given = |joint: &usize| *joint == given || !row.contains(joint);
        joints.iter().copied().filter(is_given).collect()
    };
    let rows = joints.windows(left + 1).rev().take(CHOICES / (left + 1));
    rows.map(|row| row.iter().map(|&given| leaving(row, given)).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_all_sets_and_never_more_than_are_compared() {
        let pairs = all(4, 2, &[]).unwrap();
        assert_eq!(pairs, [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]]);
        assert_eq!(all(4, 2, &[1]).unwrap(), [[0, 1], [1, 2], [1, 3]]);
        assert_eq!(all(8, 1, &[5]).unwrap(), [[5]]);
        assert_eq!(all(8, 7, &[]).unwrap().len(), 8);
        // Of all sets of 34 of 40 joints, or of their beginnings, no memory holds a list.
        assert_eq!(all(40, 34, &[]), None);
        let asked: Vec<usize> = (0..33).collect();
        assert_eq!(all(40, 34, &asked).unwrap().len(), 7);
    }

    #[test]
    fn of_too_many_sets_those_are_compared_that_leave_a_row() {
        let rows = choices(10, 4, &[]);
        assert_eq!(rows.len(), 4);
        let tip: Vec<Vec<usize>> = (3..10).map(|given| vec![0, 1, 2, given]).collect();
        assert_eq!(rows[0], tip);
        assert_eq!(rows[3][0], [0, 7, 8, 9]);
        // A joint that is asked for is passed over.
        assert_eq!(choices(10, 5, &[6])[0][0], [0, 1, 2, 3, 6]);
        assert!(choices(64, 58, &[]).iter().flatten().count() <= CHOICES);
    }
}
