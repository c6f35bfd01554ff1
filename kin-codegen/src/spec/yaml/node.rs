//! A YAML document as a tree whose nodes know where they stand.
//!
//! serde tells the place of an error and of nothing else. So nodes are
//! numbered in the order of the text, and a node's place is found by reading
//! the text again and failing at that number. Places are asked for when there
//! is something to report, and once for every joint; robot files are
//! short.

use crate::spec::Location;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess, Visitor};
use std::cell::Cell;
use std::fmt;

/// A place in the document.
#[derive(Debug)]
pub(super) struct Node {
    /// Number in the order of the text, keys included.
    pub id: u32,
    pub value: Value,
}

/// What stands there.
#[derive(Debug)]
pub(super) enum Value {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    /// In the order of the text; keys can be doubled and of any type.
    Map(Vec<(Node, Node)>),
}

/// Reads a document.
pub(super) fn parse(text: &str) -> Result<Node, serde_yaml::Error> {
    read(text, u32::MAX)
}

/// The place of a node of this text.
pub(super) fn locate(text: &str, id: u32) -> Location {
    let here = read(text, id).err().and_then(|error| place(&error));
    here.unwrap_or(Location { line: 1, column: 1 })
}

/// The place of an error, if it has one.
pub(super) fn place(error: &serde_yaml::Error) -> Option<Location> {
    let location = error.location()?;
    Some(Location {
        line: location.line() as u32,
        column: location.column() as u32,
    })
}

fn read(text: &str, fail_at: u32) -> Result<Node, serde_yaml::Error> {
    let seen = Cell::new(0);
    Reading {
        seen: &seen,
        fail_at,
    }
    .deserialize(serde_yaml::Deserializer::from_str(text))
}

#[derive(Clone, Copy)]
struct Reading<'c> {
    seen: &'c Cell<u32>,
    fail_at: u32,
}

impl Reading<'_> {
    /// Numbers a node. Called by the visitor, so that an error gets this
    /// node's place and not its parent's.
    fn arrive<E: Error>(self) -> Result<u32, E> {
        let id = self.seen.get();
        self.seen.set(id + 1);
        if id == self.fail_at {
            Err(E::custom("here"))
        } else {
            Ok(id)
        }
    }

    fn leaf<E: Error>(self, value: Value) -> Result<Node, E> {
        Ok(Node {
            id: self.arrive()?,
            value,
        })
    }
}

impl<'de> DeserializeSeed<'de> for Reading<'_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reading<'_> {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number, a text, a list or a mapping")
    }

    fn visit_unit<E: Error>(self) -> Result<Node, E> {
        self.leaf(Value::Null)
    }

    fn visit_none<E: Error>(self) -> Result<Node, E> {
        self.leaf(Value::Null)
    }

    fn visit_bool<E: Error>(self, truth: bool) -> Result<Node, E> {
        self.leaf(Value::Bool(truth))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Node, E> {
        self.leaf(Value::Number(number as f64))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Node, E> {
        self.leaf(Value::Number(number as f64))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Node, E> {
        self.leaf(Value::Number(number))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Node, E> {
        self.leaf(Value::Text(text.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Node, A::Error> {
        let id = self.arrive()?;
        let mut nodes = Vec::new();
        while let Some(node) = list.next_element_seed(self)? {
            nodes.push(node);
        }
        Ok(Node {
            id,
            value: Value::List(nodes),
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Node, A::Error> {
        let id = self.arrive()?;
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry_seed(self, self)? {
            entries.push(entry);
        }
        Ok(Node {
            id,
            value: Value::Map(entries),
        })
    }

    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<Node, A::Error> {
        Err(A::Error::custom("tags (`!word`) have no meaning here"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_is_found_again() {
        let text = "a: [1, pi/2]\nb:\n  - {c: true}\n  - ~\n";
        let places: Vec<_> = (0..10)
            .map(|id| locate(text, id))
            .map(|at| (at.line, at.column))
            .collect();
        let expected = [
            (1, 1),
            (1, 1),
            (1, 4),
            (1, 5),
            (1, 8),
            (2, 1),
            (3, 3),
            (3, 5),
            (3, 6),
            (3, 9),
        ];
        assert_eq!(places, expected);
    }

    #[test]
    fn columns_count_characters() {
        let at = locate("{ä: 1, ö: 2}", 4);
        assert_eq!((at.line, at.column), (1, 11));
    }
}
