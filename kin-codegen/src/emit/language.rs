//! What a language has to say so that expressions can be written in it.

use crate::expr::RootPart;

/// A language of generated code. [`Writer`](super::straight::Writer) decides what is
/// written in which order and under which names, for all languages alike.
pub trait Language {
    /// A piece of source.
    type Text: Clone;

    /// A variable.
    fn name(name: &str) -> Self::Text;
    /// A finite number that is not negative.
    fn number(x: f64) -> Self::Text;
    /// −a.
    fn minus(a: Self::Text) -> Self::Text;
    /// (a).
    fn parenthesized(a: Self::Text) -> Self::Text;
    /// An operation on two numbers.
    fn infix(a: Self::Text, operator: Operator, b: Self::Text) -> Self::Text;
    /// A call of a function of the runtime.
    fn call(function: Function, arguments: Vec<Self::Text>) -> Self::Text;
    /// A number of a root of the quartic that was solved under this name.
    fn root(quartic: &str, part: RootPart) -> Self::Text;
    /// The sign of a choice, by its name, in the lane at hand.
    fn sign(name: &str) -> Self::Text;
    /// An entry of the target at hand.
    fn of_target(entry: &str) -> Self::Text;
    /// A value that has outlived its loop, by its name there: that of the target at hand, and
    /// of the branch at hand where it depends on that.
    fn kept(value: &str, of_branch: bool) -> Self::Text;
    /// The statement that gives a value its name.
    fn definition(name: &str, value: Self::Text) -> Self::Text;
    /// The statement that solves a quartic and gives its roots a name.
    fn roots(name: &str, coefficients: [Self::Text; 5]) -> Self::Text;
    /// A comment, where a statement can stand.
    fn comment(text: &str) -> Self::Text;
}

/// How a language writes a b + c as one operation, of a, b and c.
pub type MulAdd<Text> = fn(Text, Text, Text) -> Text;

/// An operation that is written between its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

/// A function of the runtime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    Sqrt,
    /// The angle of (x, y) in (−π, π], of y and x.
    Angle,
    /// The same in a loop over lanes, by other polynomials.
    AngleInLanes,
    Wrap,
    Max,
    /// Of a, b, x and y: x where a < b, else y.
    SelectLess,
}
