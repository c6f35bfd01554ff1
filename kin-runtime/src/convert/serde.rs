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

/// A [`JointLimit`] with none in place of infinity, which JSON has no number for.
#[derive(Serialize, Deserialize)]
#[serde(rename = "JointLimit", rename_all = "snake_case")]
enum Stops {
    Revolute {
        #[serde(default)]
        lower: Option<Real>,
        #[serde(default)]
        upper: Option<Real>,
    },
    Continuous,
    Prismatic {
        #[serde(default)]
        lower: Option<Real>,
        #[serde(default)]
        upper: Option<Real>,
    },
}

impl Serialize for JointLimit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
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
        let stops = |lower: Option<Real>, upper: Option<Real>| {
            let lower = lower.unwrap_or(Real::NEG_INFINITY);
            (lower, upper.unwrap_or(Real::INFINITY))
        };
        Ok(match Stops::deserialize(deserializer)? {
            Stops::Continuous => JointLimit::Continuous,
            Stops::Revolute { lower, upper } => {
                let (lower, upper) = stops(lower, upper);
                JointLimit::revolute(lower, upper)
            }
            Stops::Prismatic { lower, upper } => {
                let (lower, upper) = stops(lower, upper);
                JointLimit::prismatic(lower, upper)
            }
        })
    }
}
