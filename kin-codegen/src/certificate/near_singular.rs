//! Configurations next to singular ones, of idealized arms, and what is lost there: it chooses the
//! eliminations that are asked beside the branches.

use super::Trials;
use crate::closed_form::ClosedForm;
use crate::geometry::{self, SINGULAR};
use crate::random::Random;

/// Configurations near singular ones, for each value of the locked joints.
const NEAR: usize = 240;
/// Of these, those on which an elimination is tried.
const TRIED: usize = 30;

/// A configuration near a singular one.
pub struct NearSingular {
    /// At which values of the locked joints.
    held: usize,
    /// Radians and metres.
    pub q: Vec<f64>,
    /// How far from singular.
    pub conditioning: f64,
    /// How the tip moves least, by joint and of length 1.
    pub motion: [f64; 6],
}

impl Trials<'_> {
    /// Configurations that are nearer to singular than some conditioning, though not
    /// singular: next to singular ones there are some at every distance. Of arms that are solved
    /// for six joints, by whole poses.
    pub fn near_singular(&self, least_conditioning: f64) -> Vec<NearSingular> {
        let mut random = Random(0x94d0_49bb_1331_11eb);
        let mut nearby = |q: &[f64]| -> Vec<f64> {
            let off = least_conditioning * random.between(0.0, 4.0);
            let shifted = q.iter().map(|x| x + off * random.between(-1.0, 1.0));
            shifted.collect()
        };
        let size = self.linkage.size;
        let mut all = Vec::new();
        for (number, held) in self.held.iter().enumerate() {
            let starts = held.all.iter().cycle().take(16 * held.all.len());
            let near = starts.filter_map(|trial| {
                let q = nearby(&trial.q);
                let conditioning = geometry::conditioning(&held.chain, &q, size, self.target);
                let is_near = (0.01 * SINGULAR..least_conditioning).contains(&conditioning);
                let motion = is_near.then(|| geometry::weak_motion(&held.chain, &q, size))??;
                Some(NearSingular {
                    held: number,
                    q,
                    conditioning,
                    motion,
                })
            });
            all.extend(near.take(NEAR));
        }
        all
    }

    /// Which of some configurations near singular ones a closed form loses.
    pub fn lost_near(&self, form: &ClosedForm, near: &[NearSingular]) -> Vec<bool> {
        let tried = near
            .iter()
            .step_by(near.len().div_ceil(TRIED * self.held.len()).max(1));
        let lost = tried.map(|near| {
            let held = &self.held[near.held];
            let solutions = form.solutions_at(&held.chain.fk(&near.q), &held.parameters);
            held.recovered(self.linkage, &near.q, &solutions, near.conditioning)
                .is_err()
        });
        lost.collect()
    }
}
