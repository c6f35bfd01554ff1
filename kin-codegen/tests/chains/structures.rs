//! A structure becomes two tests: as it stands, and read from tip to base.

/// `name: [how each axis lies to the one before];`
macro_rules! structures {
    ($($name:ident: [$($step:expr),*];)*) => {
        $(mod $name {
            use crate::arm::*;
            use crate::check::Solved;
            use crate::settings::in_cases;

            const STEPS: &[Step] = &[$($step),*];

            #[test]
            fn as_it_stands() {
                in_cases(6, placed(arm(STEPS), STEPS), &|(arm, q)| Solved::new(&arm)?.check(&q));
            }

            #[test]
            fn read_backwards() {
                in_cases(6, placed(arm(STEPS), STEPS), &|(arm, q)| {
                    Solved::new(&mirrored(&arm))?.check(&q)
                });
            }
        })*
    };
}

/// A row of the table becomes one test of many arms, half of them read from
/// tip to base; some are held against the numerical search.
macro_rules! table {
    ($($name:ident: [$($step:expr),*];)*) => {
        $(mod $name {
            use crate::arm::*;
            use crate::check::Solved;
            use crate::settings::in_cases;

            const STEPS: &[Step] = &[$($step),*];

            #[test]
            fn is_solved() {
                in_cases(80, either_way(STEPS), &|(arm, q, searched)| {
                    let solved = Solved::new(&arm)?;
                    if searched { solved.check(&q) } else { solved.check_quickly(&q) }
                });
            }
        })*
    };
}
