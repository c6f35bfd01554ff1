//! What makes a branch of a closed form a solution.

use super::super::scalar::Real;

/// What makes a branch a solution.
#[derive(Clone, Copy, Debug)]
pub struct Acceptance {
    /// The arm's size, metres: angles count as lengths at this distance.
    pub size: Real,
    /// Solutions may miss the target by this, metres.
    pub tolerance: Real,
    /// Branches that miss it by no more, metres, are solutions as they are; negative where none
    /// is, because they are those of an idealized arm.
    pub taken: Real,
    /// Branches that miss it by more than this, metres, cannot be corrected.
    pub nearly: Real,
    /// The near-singular threshold: where the Jacobian's least pivot by its
    /// largest is below this, the branches of the idealized arm do not tell
    /// those of the arm as given; 0 if that is the ideal one.
    pub near_singular: Real,
    /// Bit i is set where joint i is prismatic.
    pub prismatic: u64,
}

impl Acceptance {
    /// Whether branches are those of an idealized arm, and none is a solution as it is.
    #[inline]
    pub fn is_of_design(&self) -> bool {
        self.taken < 0.0
    }
}

/// The targets of an exact arm for which an elimination completes what branches tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completion {
    /// None.
    Never,
    /// Those that no branch reaches and one nearly does: singular ones at which a step is
    /// ill-conditioned.
    Unanswered,
    /// Those at which a step degenerates, since the arm need not be singular there.
    Degenerate,
}
