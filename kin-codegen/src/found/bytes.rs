//! What was found as bytes: field by field, numbers to the last bit.

use super::Found;
use crate::certificate::Certificate;
use crate::expr::inverse::{FreeJoints, Turn};
use crate::geometry::Swivel;
use crate::plan::{Atom, Dependence, Invariant, Kind, Plan, Relation, Step, Subproblem};
use crate::redundancy::{Redundancy, Weighed};
use crate::univariate::{Arm, Kept};
use kin_runtime::__private::univariate::{Between, Elimination, Frames};
use kin_runtime::{Pose, Target, Twist};
use std::ops::Range;

/// Something that can be read back.
pub trait Bytes: Sized {
    /// Appends it.
    fn write(&self, to: &mut Vec<u8>);
    /// Takes it off the front; none if it is not there.
    fn read(from: &mut &[u8]) -> Option<Self>;
    /// Appends the names and types of what is written, which tell it from what another version of
    /// the type writes.
    fn layout(to: &mut String);
}

/// The layout of a field.
fn field<S, T: Bytes>(name: &str, _: fn(&S) -> &T, to: &mut String) {
    to.push_str(name);
    to.push(':');
    T::layout(to);
    to.push(',');
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Bytes for $number {
            fn write(&self, to: &mut Vec<u8>) {
                to.extend(self.to_le_bytes());
            }

            fn read(from: &mut &[u8]) -> Option<Self> {
                let (bytes, rest) = from.split_first_chunk()?;
                *from = rest;
                Some(Self::from_le_bytes(*bytes))
            }

            fn layout(to: &mut String) {
                to.push_str(stringify!($number));
            }
        }
    )*};
}
numbers!(u8, u32, u64, f64);

/// All fields of a type, in order.
macro_rules! fields {
    ($($name:ident { $($field:ident),* })*) => {$(
        impl Bytes for $name {
            fn write(&self, to: &mut Vec<u8>) {
                let Self { $($field),* } = self;
                $($field.write(to);)*
            }

            fn read(from: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Bytes::read(from)?),* })
            }

            fn layout(to: &mut String) {
                let name = concat!(stringify!($name), "{");
                // A relation has another one in it.
                let is_known = to.contains(name);
                to.push_str(name);
                if !is_known {
                    $(field(stringify!($field), |it: &Self| &it.$field, to);)*
                }
                to.push('}');
            }
        }
    )*};
}
fields! {
    Found { plan, free, tolerance, elimination, certificate, redundancy, expressions }
    Plan { steps, target }
    Turn { step, coordinate, root }
    Step { subproblem, unknowns, relations, complement }
    Relation { from, to, depends, with, is_swivel }
    Invariant { kind, joints, point, direction }
    Dependence { atom, weakest, steady, inner, weak_at, derivatives }
    Certificate {
        configurations, singular, excused, excused_share, unanswered, lost, lost_anywhere,
        solutions, worst_residual, most_solutions
    }
    Redundancy { joints, swivel, turn, target, weighed }
    Swivel { shoulder, elbow, wrist, reference }
    Weighed { joints, weight }
    Arm { frames, between, size, counts, kept, others }
    Frames { fixed, prismatic }
    Between { behind, twist }
    Twist { linear, angular }
    Pose { rotation, translation }
    Kept { elimination, lost, wrong, unsure, unclear, noise }
    Elimination {
        joints, backwards, degree, moved, functionals, half, third, fold, powers, rows, columns
    }
}

/// A type of so many words, by their number.
macro_rules! words {
    ($($name:ident { $($word:ident),* })*) => {$(
        impl Bytes for $name {
            fn write(&self, to: &mut Vec<u8>) {
                match self {
                    $(Self::$word)|* => (*self as u8).write(to),
                }
            }

            fn read(from: &mut &[u8]) -> Option<Self> {
                let number = u8::read(from)?;
                [$(Self::$word),*].into_iter().find(|word| *word as u8 == number)
            }

            fn layout(to: &mut String) {
                to.push_str(concat!(stringify!($name), "(", $(stringify!($word), ","),*, ")"));
            }
        }
    )*};
}
words! {
    Target { Pose, Position, PositionAxis, PositionYaw, Planar, Direction, Orientation }
    Kind { Point, Direction, Plane }
    Subproblem {
        Sum, Sp1, Sp2, Sp3, Sp4, Sp6, Slide, T1, T2, Univariate, Slides, Lines, Hyperboloid
    }
}

impl Bytes for Atom {
    fn write(&self, to: &mut Vec<u8>) {
        match *self {
            Atom::Joint(joint) => (None::<usize>, [joint; 2]).write(to),
            Atom::Sum { run, first, last } => (Some(run), [first, last]).write(to),
        }
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        let (run, [first, last]) = <(Option<usize>, [usize; 2])>::read(from)?;
        Some(match run {
            None => Atom::Joint(first),
            Some(run) => Atom::Sum { run, first, last },
        })
    }

    fn layout(to: &mut String) {
        to.push_str("Atom");
        <(Option<usize>, [usize; 2])>::layout(to);
    }
}

impl Bytes for FreeJoints {
    fn write(&self, to: &mut Vec<u8>) {
        let (word, turns) = match self {
            FreeJoints::Seeded => (0_u8, Vec::new()),
            FreeJoints::Flagged => (1, Vec::new()),
            FreeJoints::Moved(turns) => (2, turns.clone()),
        };
        (word, turns).write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        let (word, turns) = <(u8, Vec<Turn>)>::read(from)?;
        Some(match word {
            0 => FreeJoints::Seeded,
            1 => FreeJoints::Flagged,
            2 => FreeJoints::Moved(turns),
            _ => return None,
        })
    }

    fn layout(to: &mut String) {
        to.push_str("FreeJoints");
        <(u8, Vec<Turn>)>::layout(to);
    }
}

impl Bytes for usize {
    fn write(&self, to: &mut Vec<u8>) {
        (*self as u64).write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        u64::read(from)?.try_into().ok()
    }

    fn layout(to: &mut String) {
        to.push_str("usize");
    }
}

impl Bytes for bool {
    fn write(&self, to: &mut Vec<u8>) {
        u8::from(*self).write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        Some(u8::read(from)? != 0)
    }

    fn layout(to: &mut String) {
        to.push_str("bool");
    }
}

impl<A: Bytes, B: Bytes> Bytes for (A, B) {
    fn write(&self, to: &mut Vec<u8>) {
        self.0.write(to);
        self.1.write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        Some((A::read(from)?, B::read(from)?))
    }

    fn layout(to: &mut String) {
        to.push('(');
        A::layout(to);
        to.push(',');
        B::layout(to);
        to.push(')');
    }
}

impl Bytes for Range<usize> {
    fn write(&self, to: &mut Vec<u8>) {
        (self.start, self.end).write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        let (start, end) = Bytes::read(from)?;
        Some(start..end)
    }

    fn layout(to: &mut String) {
        to.push_str("Range");
    }
}

impl<T: Bytes, const N: usize> Bytes for [T; N] {
    fn write(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|one| one.write(to));
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        let all: Option<Vec<T>> = (0..N).map(|_| T::read(from)).collect();
        all?.try_into().ok()
    }

    fn layout(to: &mut String) {
        to.push('[');
        T::layout(to);
        to.push_str(&format!(";{N}]"));
    }
}

impl<T: Bytes> Bytes for Vec<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        self.iter().for_each(|one| one.write(to));
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        let count = usize::read(from)?;
        let mut all = Vec::new();
        for _ in 0..count {
            all.push(T::read(from)?);
        }
        Some(all)
    }

    fn layout(to: &mut String) {
        to.push_str("Vec ");
        T::layout(to);
    }
}

impl<T: Bytes> Bytes for Option<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.is_some().write(to);
        self.iter().for_each(|one| one.write(to));
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        Some(match bool::read(from)? {
            true => Some(T::read(from)?),
            false => None,
        })
    }

    fn layout(to: &mut String) {
        to.push_str("Option ");
        T::layout(to);
    }
}

impl<T: Bytes> Bytes for Box<T> {
    fn write(&self, to: &mut Vec<u8>) {
        (**self).write(to);
    }

    fn read(from: &mut &[u8]) -> Option<Self> {
        T::read(from).map(Box::new)
    }

    fn layout(to: &mut String) {
        T::layout(to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Old {
        first: u32,
        second: f64,
    }
    mod new {
        pub struct Old {
            pub second: f64,
            pub first: u32,
        }
        pub struct Long {
            pub first: [u32; 2],
        }
        pub struct Short {
            pub first: [u32; 3],
        }
    }
    use new::{Long, Short};
    type New = new::Old;
    fields! { Old { first, second } Long { first } Short { first } }
    mod reordered {
        use super::{Bytes, New as Old, field};
        fields! { Old { second, first } }
    }

    fn layout<T: Bytes>() -> String {
        let mut layout = String::new();
        T::layout(&mut layout);
        layout
    }

    #[test]
    fn layouts_tell_types_apart() {
        assert_eq!(layout::<Old>(), "Old{first:u32,second:f64,}");
        assert_eq!(layout::<New>(), "Old{second:f64,first:u32,}");
        assert_eq!(layout::<Long>(), "Long{first:[u32;2],}");
        assert_eq!(layout::<Short>(), "Short{first:[u32;3],}");
        let of_weighed = "Weighed{joints:Vec usize,weight:Option usize,}";
        assert_eq!(layout::<Weighed>(), of_weighed);
        assert_eq!(layout::<Kind>(), "Kind(Point,Direction,Plane,)");
        // All of what is found: fields of fields, and the relation that a relation has in it once.
        let found = layout::<Found>();
        assert!(
            found.starts_with("Found{plan:Plan{steps:Vec Step{"),
            "{found}"
        );
        assert!(found.contains(of_weighed), "{found}");
        assert!(found.contains("with:Option Relation{},"), "{found}");
    }
}
