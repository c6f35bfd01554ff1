//! Operation counts, to be read.

use crate::expr::Operations;
use serde::Serialize;
use std::fmt;

/// Operation counts. Displayed without what does not occur:
/// `40 multiplications, 20 additions, 6 sines with cosines`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// Multiplications.
    pub multiplications: usize,
    /// Additions and subtractions.
    pub additions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Sine and cosine of one angle, counted together.
    pub sincos: usize,
    /// Arctangents.
    pub arctangents: usize,
    /// Comparisons with selection, maxima and absolute values.
    pub selections: usize,
}

impl From<Operations> for Cost {
    fn from(operations: Operations) -> Self {
        Self {
            multiplications: operations.multiplications,
            additions: operations.additions,
            divisions: operations.divisions,
            roots: operations.roots,
            sincos: operations.sincos,
            arctangents: operations.arctangents,
            selections: operations.selections,
        }
    }
}

impl Cost {
    /// Adds what `lanes` times the difference to a smaller cost is.
    pub(super) fn add_difference(&mut self, lanes: usize, more: Self, less: Self) {
        self.multiplications += lanes * (more.multiplications - less.multiplications);
        self.additions += lanes * (more.additions - less.additions);
        self.divisions += lanes * (more.divisions - less.divisions);
        self.roots += lanes * (more.roots - less.roots);
        self.sincos += lanes * (more.sincos - less.sincos);
        self.arctangents += lanes * (more.arctangents - less.arctangents);
        self.selections += lanes * (more.selections - less.selections);
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} multiplications, {} additions",
            self.multiplications, self.additions
        )?;
        let others = [
            (self.divisions, "divisions"),
            (self.roots, "roots"),
            (self.sincos, "sines with cosines"),
            (self.arctangents, "arctangents"),
            (self.selections, "selections"),
        ];
        others
            .iter()
            .filter(|(count, _)| *count > 0)
            .try_for_each(|(count, what)| write!(f, ", {count} {what}"))
    }
}
