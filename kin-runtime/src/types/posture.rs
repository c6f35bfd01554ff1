//! What the branches of an arm are called.

use super::super::{Solution, Solutions};
use core::fmt;

/// A branch of an arm's inverse kinematics by the words of the field: what
/// controllers call the arm's configuration, FANUC's `NUT` and KUKA's status
/// bits. Robots list theirs in [`Kinematics::POSTURES`](crate::Kinematics).
///
/// ```
/// use kin_runtime::Posture;
/// const PARTS: &[&str] = &["shoulder", "elbow"];
/// let posture = Posture::new(1, PARTS, &["left", "up"]);
/// assert!(posture.is("elbow", "up") && !posture.is("elbow", "down"));
/// assert_eq!(posture.to_string(), "shoulder left, elbow up");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Posture {
    /// The number that solutions have in [`Solution::branch`].
    pub branch: u32,
    /// What is told apart: shoulder, elbow, wrist, or a step of the plan that
    /// the field has no word for.
    pub parts: &'static [&'static str],
    /// What each part is: left or right, up or down, flipped or not flipped, or
    /// the sign of the step's root.
    pub words: &'static [&'static str],
}

impl Posture {
    /// A branch with what its parts are.
    pub const fn new(
        branch: u32,
        parts: &'static [&'static str],
        words: &'static [&'static str],
    ) -> Self {
        Self {
            branch,
            parts,
            words,
        }
    }

    /// Whether a part is what a word says; no if the arm has no such part.
    pub fn is(&self, part: &str, word: &str) -> bool {
        let mut both = self.parts.iter().zip(self.words);
        both.any(|both| both == (&part, &word))
    }
}

impl fmt::Display for Posture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (part, word)) in self.parts.iter().zip(self.words).enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{part} {word}")?;
        }
        Ok(())
    }
}

impl<const N: usize> Solutions<N> {
    /// The solution in a posture of the robot that they are of; none if the
    /// target is not reached so.
    pub fn in_posture(&self, posture: &Posture) -> Option<&Solution<N>> {
        self.iter()
            .find(|solution| solution.branch == posture.branch)
    }
}
