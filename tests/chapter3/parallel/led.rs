//! A chain that leads to several places of the platform, of which the others reach few.

use super::{Led, generic};

/// Also where the chains have more solutions for all places together than there is room for.
#[test]
fn every_place_that_all_chains_reach_has_its_solutions() {
    let generic = generic("robots/led.yaml");
    let mut q = [0.0; 14];
    let mut checked = 0;
    for step in 0..40 {
        let actuated = [0.01 * f64::from(step), -0.002 * f64::from(step)];
        let Some(next) = Led.fk_near(&actuated, &q) else {
            break;
        };
        q = next.q;
        let found = Led.ik(&Led.platform(&q));
        // Of each chain those for the platform as it is, and they combine.
        assert!(found.len() >= 32, "{actuated:?}: {}", found.len());
        let same = |other: &[f64; 14]| (0..14).all(|i| (other[i] - q[i]).abs() < 1e-7);
        assert!(found.iter().any(|other| same(&other)), "{actuated:?}");
        for other in found.iter() {
            assert!(generic.gap(&other) < 1e-8 * Led::LENGTH);
        }
        checked += 1;
    }
    assert!(checked > 10, "{checked}");
}
