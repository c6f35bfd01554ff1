//! What a subproblem yields.

/// The solution set of a subproblem whose unknown is a `T`: an angle, a translation,
/// or two or three angles.
///
/// The cases are kept apart so that neither a member of a family nor a best
/// approximation can be mistaken for a solution.
///
/// ```
/// use kin_runtime::subproblems::{SolutionSet, subproblem4};
/// let (z, x) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
/// // x turned about z has the x component 0.5 at ±60 degrees, 2 never, and
/// // the z component 0 always.
/// assert_eq!(subproblem4(x, z, x, 0.5).exact().len(), 2);
/// assert!(matches!(subproblem4(x, z, x, 2.0), SolutionSet::Closest { residual: 1.0, .. }));
/// assert!(matches!(subproblem4(z, z, x, 0.0), SolutionSet::Any(_)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolutionSet<T> {
    /// One to four isolated solutions. A double root is given once.
    Exact(Roots<T>),
    /// Infinitely many solutions, of which this is one. Isolated solutions that
    /// stand beside the family, if there are any, are not given.
    Any(T),
    /// No solution, but a best approximation.
    Closest {
        /// The unknown that comes closest, in the sense of least squares.
        value: T,
        /// What the equation is off by there, in its own unit. Not zero.
        residual: f64,
    },
    /// No solution; what comes closest is not known in closed form.
    None,
}

impl<T> SolutionSet<T> {
    /// The isolated solutions; empty unless the solutions is [`SolutionSet::Exact`].
    pub fn exact(&self) -> &[T] {
        match self {
            SolutionSet::Exact(roots) => roots,
            SolutionSet::Any(_) | SolutionSet::Closest { .. } | SolutionSet::None => &[],
        }
    }
}

/// One to four values; behaves as a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roots<T> {
    /// A single or a double root.
    One([T; 1]),
    /// Two distinct roots.
    Two([T; 2]),
    /// Three distinct roots, one of them double.
    Three([T; 3]),
    /// Four distinct roots.
    Four([T; 4]),
}

impl<T> core::ops::Deref for Roots<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        match self {
            Roots::One(root) => root,
            Roots::Two(roots) => roots,
            Roots::Three(roots) => roots,
            Roots::Four(roots) => roots,
        }
    }
}

impl<T> SolutionSet<T> {
    pub(crate) fn one(root: T) -> Self {
        SolutionSet::Exact(Roots::One([root]))
    }

    pub(crate) fn two(first: T, second: T) -> Self {
        SolutionSet::Exact(Roots::Two([first, second]))
    }

    /// A solution if the residual is within the tolerance, else the closest.
    pub(crate) fn one_or_closest(value: T, residual: f64, tolerance: f64) -> Self {
        if residual <= tolerance {
            SolutionSet::one(value)
        } else {
            SolutionSet::Closest { value, residual }
        }
    }

    /// All values give the same residual: infinitely many solutions if it is
    /// within the tolerance, else none.
    pub(crate) fn whatever(value: T, residual: f64, tolerance: f64) -> Self {
        if residual <= tolerance {
            SolutionSet::Any(value)
        } else {
            SolutionSet::Closest { value, residual }
        }
    }

    pub(crate) fn map<U>(self, f: impl Fn(T) -> U) -> SolutionSet<U> {
        match self {
            SolutionSet::Exact(Roots::One(root)) => SolutionSet::Exact(Roots::One(root.map(f))),
            SolutionSet::Exact(Roots::Two(roots)) => SolutionSet::Exact(Roots::Two(roots.map(f))),
            SolutionSet::Exact(Roots::Three(roots)) => {
                SolutionSet::Exact(Roots::Three(roots.map(f)))
            }
            SolutionSet::Exact(Roots::Four(roots)) => SolutionSet::Exact(Roots::Four(roots.map(f))),
            SolutionSet::Any(value) => SolutionSet::Any(f(value)),
            SolutionSet::Closest { value, residual } => SolutionSet::Closest {
                value: f(value),
                residual,
            },
            SolutionSet::None => SolutionSet::None,
        }
    }

    /// Solutions, a member of a family or what comes closest: values to go on
    /// from.
    pub fn values(&self) -> &[T] {
        match self {
            SolutionSet::Exact(roots) => roots,
            SolutionSet::Any(value) | SolutionSet::Closest { value, .. } => {
                core::slice::from_ref(value)
            }
            SolutionSet::None => &[],
        }
    }
}
