//! What the branches of a robot are called.

use super::of_joints::{OfJoints, array, with_constant};
use super::{Answer, Robot};
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::emit::postures::Postures;
use kin_runtime::__private::tolerance::SAME;
use kin_runtime::{JointLimit, Kinematics};
use std::fmt;

/// A branch by the words of the field; see [`Posture`](crate::Posture).
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NamedPosture {
    /// The number that answers have in [`Answer::branch`].
    pub branch: u32,
    /// What is told apart: shoulder, elbow, wrist, or a step of the plan that the field has no
    /// word for.
    pub parts: Vec<String>,
    /// What each part is: left or right, up or down, flipped or not flipped, or the sign of the
    /// step's root.
    pub words: Vec<String>,
}

impl NamedPosture {
    /// Whether a part is what a word says; no if the arm has no such part.
    pub fn is(&self, part: &str, word: &str) -> bool {
        let mut both = self.parts.iter().zip(&self.words);
        both.any(|(own, told)| own == part && told == word)
    }

    fn all(form: &ClosedForm) -> Vec<Self> {
        let Some(postures) = Postures::of(form) else {
            return Vec::new();
        };
        let parts: Vec<String> = postures.columns.iter().map(|it| it.name.clone()).collect();
        let named = |branch| NamedPosture {
            branch,
            parts: parts.clone(),
            words: postures.words(branch).map(str::to_owned).collect(),
        };
        (0..form.plan.branches() as u32).map(named).collect()
    }
}

/// `shoulder left, elbow up, wrist flipped`.
impl fmt::Display for NamedPosture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (part, word)) in self.parts.iter().zip(&self.words).enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{part} {word}")?;
        }
        Ok(())
    }
}

impl Robot {
    /// What the branches of [`Robot::ik`] are called, by their numbers; empty where they have no
    /// names, and of a robot with [parameters](Robot::parameters).
    ///
    /// ```
    /// use kinematics::Robot;
    /// let arm = Robot::from_urdf("robots/ur5e.urdf")?;
    /// let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    /// let own = arm.posture(&q).unwrap();
    /// let solutions = arm.ik(&arm.fk(&q));
    /// // The same shoulder, the other elbow.
    /// let other = solutions.iter().find(|answer| {
    ///     let posture = arm.posture_of(answer).unwrap();
    ///     let same = |part| own.words[part] == posture.words[part];
    ///     same(0) && !same(1) && same(2)
    /// });
    /// assert!(other.is_some());
    /// # Ok::<(), kinematics::LoadError>(())
    /// ```
    pub fn postures(&self) -> &[NamedPosture] {
        self.postures.get_or_init(|| match self.arm.form() {
            Some(form) if self.parameters() == 0 => NamedPosture::all(form),
            _ => Vec::new(),
        })
    }

    /// What the branch of an answer is called.
    pub fn posture_of(&self, answer: &Answer) -> Option<&NamedPosture> {
        self.postures().get(answer.branch as usize)
    }

    /// What the branch is called on which a configuration lies: the posture of the answer that it
    /// is for its own pose. None where branches have no names, where two have met,
    /// and of solutions beside the branches, which an arm off its design has.
    pub fn posture(&self, q: &[f64]) -> Option<&NamedPosture> {
        self.check(q);
        let pose = self.fk(q);
        let branch = with_constant!(self.joints(), N => {
            let solutions = OfJoints::<N>::new(self).ik_seeded(&pose, array(q));
            let solution = solutions.nearest(array(q), &[JointLimit::Continuous; N])?;
            let same = (0..N).all(|i| (solution.q[i] - q[i]).abs() < SAME);
            (same && !solution.singular).then_some(solution.branch)?
        })?;
        self.postures().get(branch as usize)
    }
}
