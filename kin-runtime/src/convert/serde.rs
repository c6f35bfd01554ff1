//! Serialization, behind the feature `serde`, without an allocator, in the form that the
//! documentation of the crate tells.

use super::super::scalar::Real;
use super::super::{JointLimit, Solutions};
use core::fmt;
use core::marker::PhantomData;
use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Numbers of which there are N: serde knows arrays of lengths by number alone.
struct Array<T, const N: usize>([T; N]);

impl<T: Serialize, const N: usize> Serialize for Array<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(N)?;
        self.0
            .iter()
            .try_for_each(|value| tuple.serialize_element(value))?;
        tuple.end()
    }
}

impl<'de, T: Copy + Default + Deserialize<'de>, const N: usize> Deserialize<'de> for Array<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(N, Numbers::<T, N>(PhantomData))
    }
}

/// What reads these.
struct Numbers<T, const N: usize>(PhantomData<T>);

impl<'de, T: Copy + Default + Deserialize<'de>, const N: usize> Visitor<'de> for Numbers<T, N> {
    type Value = Array<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{N} numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Self::Value, A::Error> {
        let mut values = [T::default(); N];
        for (i, value) in values.iter_mut().enumerate() {
            let next = numbers.next_element()?;
            *value = next.ok_or_else(|| A::Error::invalid_length(i, &self))?;
        }
        match numbers.next_element::<T>()? {
            None => Ok(Array(values)),
            Some(_) => Err(A::Error::invalid_length(N + 1, &self)),
        }
    }
}

/// For `q` of a solution.
pub(crate) mod array {
    use super::*;

    pub(crate) fn serialize<S: Serializer, T: Copy + Serialize, const N: usize>(
        values: &[T; N],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        Array(*values).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D, T, const N: usize>(
        deserializer: D,
    ) -> Result<[T; N], D::Error>
    where
        D: Deserializer<'de>,
        T: Copy + Default + Deserialize<'de>,
    {
        Array::deserialize(deserializer).map(|Array(values)| values)
    }
}

/// For the rows of a Jacobian.
pub(crate) mod rows {
    use super::*;

    pub(crate) fn serialize<S: Serializer, T: Copy + Serialize, const N: usize>(
        rows: &[[T; N]; 6],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        rows.map(Array).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D, T, const N: usize>(
        deserializer: D,
    ) -> Result<[[T; N]; 6], D::Error>
    where
        D: Deserializer<'de>,
        T: Copy + Default + Deserialize<'de>,
    {
        let rows = <[Array<T, N>; 6]>::deserialize(deserializer)?;
        Ok(rows.map(|Array(row)| row))
    }
}

impl<const N: usize> Serialize for Solutions<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

/// A [`JointLimit`] with none in place of infinity, which JSON has no number for. Both stops have to be
/// there: a word that is misspelt must not be a joint without stops.
#[derive(Serialize, Deserialize)]
#[serde(rename = "JointLimit", rename_all = "snake_case", deny_unknown_fields)]
enum Stops {
    Revolute {
        #[serde(deserialize_with = "Option::deserialize")]
        lower: Option<Real>,
        #[serde(deserialize_with = "Option::deserialize")]
        upper: Option<Real>,
    },
    Continuous,
    Prismatic {
        #[serde(deserialize_with = "Option::deserialize")]
        lower: Option<Real>,
        #[serde(deserialize_with = "Option::deserialize")]
        upper: Option<Real>,
    },
}

/// What of two stops no value is between.
fn refused(lower: Real, upper: Real) -> Option<&'static str> {
    if lower.is_nan() || upper.is_nan() {
        Some("a stop of a joint is a number, or null where there is none, and not NaN")
    } else if lower > upper || lower == Real::INFINITY || upper == Real::NEG_INFINITY {
        Some("the lower stop of a joint is not above the upper one")
    } else {
        None
    }
}

impl Serialize for JointLimit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if let Some(why) = refused(self.lower(), self.upper()) {
            return Err(serde::ser::Error::custom(why));
        }
        let finite = |stop: Real| Some(stop).filter(|stop| stop.is_finite());
        let (lower, upper) = (finite(self.lower()), finite(self.upper()));
        let stops = match self {
            JointLimit::Revolute { .. } => Stops::Revolute { lower, upper },
            JointLimit::Continuous => Stops::Continuous,
            JointLimit::Prismatic { .. } => Stops::Prismatic { lower, upper },
        };
        stops.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for JointLimit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (lower, upper, of): (_, _, fn(Real, Real) -> Self) =
            match Stops::deserialize(deserializer)? {
                Stops::Continuous => return Ok(JointLimit::Continuous),
                Stops::Revolute { lower, upper } => (lower, upper, JointLimit::revolute),
                Stops::Prismatic { lower, upper } => (lower, upper, JointLimit::prismatic),
            };
        let lower = lower.unwrap_or(Real::NEG_INFINITY);
        let upper = upper.unwrap_or(Real::INFINITY);
        match refused(lower, upper) {
            Some(why) => Err(D::Error::custom(why)),
            None => Ok(of(lower, upper)),
        }
    }
}
