//! Parallel mechanisms: several chains from one base to one platform (MLS
//! section 3.5).
//!
//! Every chain is a product of exponentials that ends at the platform, and all
//! of them are at home together. That they end at the same pose is the
//! *structure equation*
//!
//! ```text
//! g = e^(ξ̂₁₁ θ₁₁) ⋯ e^(ξ̂₁ₙ θ₁ₙ) g(0) = e^(ξ̂₂₁ θ₂₁) ⋯ e^(ξ̂₂ₘ θ₂ₘ) g(0) = …
//! ```
//!
//! and its derivative V = J₁ θ̇₁ = J₂ θ̇₂ = … . The configuration q lists the
//! joints of the first chain, then those of the second, and so on. Some joints
//! are actuated; the loops make the others follow.
//!
//! All that is asked of velocities is answered one chain at a time, by what its
//! joints *cannot* do: the wrenches w that are reciprocal to all passive joints
//! of a chain give w · V = Σ (w · ξ′ₐ) θ̇ₐ over its actuated joints a, so six
//! unknowns hold the whole platform, however many joints there are. Redundant
//! constraints (a planar linkage in space) and idle freedoms (a leg that spins
//! about itself) need no special care.
//!
//! | module | what it knows |
//! |---|---|
//! | `posture` | one configuration: gaps, rates, Jacobians, measures of singularity |
//! | `newton` | from a seed to the configuration with given actuated joints |
//! | `postures` | the solutions of inverse kinematics, chain by chain |
//! | `kinematics`, `methods` | [`ParallelKinematics`], what generated mechanisms can do |
//! | `inherent` | the same without an import |
//! | `spheres` | where three spheres meet, which is a Delta's forward kinematics |

mod inherent;
mod kinematics;
mod methods;
pub(crate) mod newton;
pub(crate) mod posture;
mod postures;
mod spheres;

pub use kinematics::ParallelKinematics;
pub(crate) use kinematics::define_parallel_kinematics;
pub use postures::Postures;
pub use spheres::three_spheres;
