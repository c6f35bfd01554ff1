//! Reading nodes as what they have to be, with complaints.

use super::node::{self, Node, Value};
use super::{Complaints, Name, Source, did_you_mean, expression};
use crate::spec::Location;

/// The text, for places, and what was wrong with it so far.
pub(super) struct Reader<'s> {
    text: &'s str,
    pub complaints: Complaints<'s>,
}

/// A mapping whose keys are all known.
pub(super) struct Fields<'n> {
    /// The mapping's own node.
    pub id: u32,
    entries: Vec<(&'n str, &'n Node)>,
}

impl<'n> Fields<'n> {
    pub(super) fn get(&self, key: &str) -> Option<&'n Node> {
        self.entries
            .iter()
            .find(|entry| entry.0 == key)
            .map(|entry| entry.1)
    }

    pub(super) fn required(&self, key: &str, reader: &mut Reader) -> Option<&'n Node> {
        let found = self.get(key);
        if found.is_none() {
            reader.at(
                self.id,
                format!("`{key}` is missing"),
                format!("add `{key}: ...`"),
            );
        }
        found
    }
}

impl<'s> Reader<'s> {
    pub(super) fn new(source: &'s Source) -> Self {
        Reader {
            text: &source.text,
            complaints: Complaints::new(source),
        }
    }

    /// Where a node stands.
    pub(super) fn place(&self, id: u32) -> Location {
        node::locate(self.text, id)
    }

    /// Complains about a node.
    pub(super) fn at(&mut self, id: u32, reason: impl Into<String>, remedy: impl Into<String>) {
        let at = self.place(id);
        self.complaints.at(at, reason, remedy);
    }

    /// The text is no YAML at all.
    pub(super) fn explain_syntax(&mut self, error: &serde_yaml::Error) {
        let message = error.to_string();
        // Ours starts with the place that theirs ends with.
        let message = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(message, _)| message);
        let remedy = "correct the YAML; docs of this format: kin_codegen::spec::yaml";
        match node::place(error) {
            Some(at) => self
                .complaints
                .at(at, format!("this cannot be read: {message}"), remedy),
            None => self
                .complaints
                .whole(format!("this cannot be read: {message}"), remedy),
        }
    }

    /// A mapping with these keys and no others.
    pub(super) fn fields<'n>(
        &mut self,
        node: &'n Node,
        what: &str,
        known: &[&str],
    ) -> Option<Fields<'n>> {
        let Value::Map(entries) = &node.value else {
            let reason = format!(
                "this should be a {what}, a mapping, and is {}",
                kind(&node.value)
            );
            self.at(
                node.id,
                reason,
                format!(
                    "write {{key: value, ...}} with {}",
                    crate::spec::list_names(known)
                ),
            );
            return None;
        };
        let mut fields = Fields {
            id: node.id,
            entries: Vec::new(),
        };
        for (key, value) in entries {
            let Value::Text(name) = &key.value else {
                self.at(
                    key.id,
                    format!("a key is a word, and this is {}", kind(&key.value)),
                    did_you_mean("", known),
                );
                continue;
            };
            if !known.contains(&name.as_str()) {
                self.at(
                    key.id,
                    format!("unknown key `{name}` in a {what}"),
                    did_you_mean(name, known),
                );
            } else if fields.get(name).is_some() {
                self.at(
                    key.id,
                    format!("the key `{name}` stands here twice"),
                    "remove one of the two",
                );
            } else {
                fields.entries.push((name, value));
            }
        }
        Some(fields)
    }

    pub(super) fn list<'n>(&mut self, node: &'n Node) -> Option<&'n [Node]> {
        let Value::List(nodes) = &node.value else {
            self.at(
                node.id,
                format!("this should be a list, and is {}", kind(&node.value)),
                "write [..., ...], or one line with `- ` per entry",
            );
            return None;
        };
        Some(nodes)
    }

    /// A name: any text but the empty one.
    pub(super) fn name(&mut self, node: &Node) -> Option<Name> {
        let Value::Text(text) = &node.value else {
            self.at(
                node.id,
                format!("this should be a name, and is {}", kind(&node.value)),
                "write a word; in quotes, if it looks like a number",
            );
            return None;
        };
        if text.trim().is_empty() {
            self.at(node.id, "this name is empty", "write a word");
            return None;
        }
        Some(Name {
            text: text.clone(),
            at: self.place(node.id),
        })
    }

    /// One of a few words.
    pub(super) fn word(&mut self, node: &Node, known: &[&'static str]) -> Option<&'static str> {
        let Name { text, at } = self.name(node)?;
        let found = known.iter().copied().find(|&word| word == text);
        if found.is_none() {
            self.complaints.at(
                at,
                format!("`{text}` is not among the words possible here"),
                did_you_mean(&text, known),
            );
        }
        found
    }

    /// A finite number without a unit, and whether it was written with `pi`.
    pub(super) fn number(&mut self, node: &Node) -> Option<(f64, bool)> {
        let number = match &node.value {
            Value::Number(number) => Some((*number, false)),
            Value::Text(text) => expression::evaluate(text),
            _ => None,
        };
        match (number, &node.value) {
            (Some((number, _)), _) if number.is_finite() => {
                return number_with_pi(number, &node.value);
            }
            (Some((number, _)), _) => {
                let reason = format!("this number is {number}, which is not finite");
                self.at(node.id, reason, "write a finite number");
            }
            (None, Value::Text(text)) => {
                let reason = format!("`{text}` is not a number");
                self.at(
                    node.id,
                    reason,
                    "write a number, or an expression of numbers and pi such as `pi/2`",
                );
            }
            (None, value) => {
                self.at(
                    node.id,
                    format!("this should be a number, and is {}", kind(value)),
                    "write a number",
                );
            }
        }
        None
    }

    /// A list of exactly `N` things, each read by `one`.
    pub(super) fn exactly<const N: usize, T: Copy>(
        &mut self,
        node: &Node,
        mut one: impl FnMut(&mut Self, &Node) -> Option<T>,
    ) -> Option<[T; N]> {
        let nodes = self.list(node)?;
        if nodes.len() != N {
            self.at(
                node.id,
                format!("this list has {} entries where {N} belong", nodes.len()),
                format!("write {N} entries"),
            );
            return None;
        }
        let read: Vec<Option<T>> = nodes.iter().map(|node| one(self, node)).collect();
        let read: Vec<T> = read.into_iter().collect::<Option<_>>()?;
        read.try_into().ok()
    }
}

fn number_with_pi(number: f64, value: &Value) -> Option<(f64, bool)> {
    let pi = matches!(value, Value::Text(text) if text.contains("pi"));
    Some((number, pi))
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "empty",
        Value::Bool => "a truth value",
        Value::Number(_) => "a number",
        Value::Text(_) => "a text",
        Value::List(_) => "a list",
        Value::Map(_) => "a mapping",
    }
}
