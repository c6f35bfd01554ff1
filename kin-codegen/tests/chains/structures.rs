//! A structure becomes two tests: as it stands, and read from tip to base.

/// `name: [how each axis lies to the one before];`
macro_rules! structures {
    ($($name:ident: [$($step:expr),*];)*) => {
        $(mod $name {
            use crate::arm::*;
            use crate::check::Solved;
            use crate::settings::cases;
            use proptest::prelude::*;

            const STEPS: &[Step] = &[$($step),*];

            proptest! {
                #![proptest_config(cases(6))]

                #[test]
                fn as_it_stands(arm in arm(STEPS), q in configuration(STEPS)) {
                    Solved::new(&arm)?.check(&q)?;
                }

                #[test]
                fn read_backwards(arm in arm(STEPS), q in configuration(STEPS)) {
                    Solved::new(&mirrored(&arm))?.check(&q)?;
                }
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
            use crate::settings::cases;
            use proptest::prelude::*;

            const STEPS: &[Step] = &[$($step),*];

            proptest! {
                #![proptest_config(cases(80))]

                #[test]
                fn is_solved(
                    arm in arm(STEPS),
                    q in configuration(STEPS),
                    backwards in any::<bool>(),
                    searched in prop::bool::weighted(0.05),
                ) {
                    let arm = if backwards { mirrored(&arm) } else { arm };
                    let solved = Solved::new(&arm)?;
                    if searched { solved.check(&q)?; } else { solved.check_quickly(&q)?; }
                }
            }
        })*
    };
}
