//! A YAML document as a tree whose nodes know where they stand.
//!
//! serde tells the place of an error and of nothing else. So the text is cut
//! into [`tokens`] first, and while serde hands over node after node, in the
//! order of the text, each takes the token it comes from. Words are borrowed
//! from the text, which says where they are: should nodes and tokens ever
//! part, they meet again at the next word.

use super::tokens::{Kind, Token, Unsupported, tokens, too_deep};
use crate::spec::Location;
use crate::spec::bounds::{YAML_ALIASED, YAML_DEPTH};
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess, Visitor};
use std::cell::{Cell, RefCell};
use std::fmt;

/// A place in the document.
#[derive(Debug)]
pub(super) struct Node {
    /// Byte offset. A collection without brackets stands where its first entry
    /// does, and what an alias repeats stands where the alias does.
    pub at: usize,
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

/// Why a text is not read.
#[derive(Debug)]
pub(super) enum Broken {
    /// It is no YAML.
    Syntax(serde_yaml::Error),
    /// It is, and more than what robots need.
    Unsupported(Unsupported),
}

/// Reads a document.
pub(super) fn parse(text: &str) -> Result<Node, Broken> {
    let cursor = Cursor {
        text,
        tokens: tokens(text).map_err(Broken::Unsupported)?,
        next: Cell::new(0),
        aliased: Cell::new(0),
        refused: RefCell::new(None),
    };
    let reading = Reading {
        cursor: &cursor,
        depth: 0,
        dashed: false,
        alias: None,
    };
    let read = reading.deserialize(serde_yaml::Deserializer::from_str(text));
    match cursor.refused.take() {
        Some(unsupported) => Err(Broken::Unsupported(unsupported)),
        None => read.map_err(Broken::Syntax),
    }
}

/// The place of an error, if it has one.
pub(super) fn place(error: &serde_yaml::Error) -> Option<Location> {
    let location = error.location()?;
    Some(Location {
        line: location.line() as u32,
        column: location.column() as u32,
    })
}

/// Which token the next node comes from.
struct Cursor<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    next: Cell<usize>,
    /// How many nodes come from aliases so far.
    aliased: Cell<usize>,
    /// Why reading was given up, if it was not the parser that did.
    refused: RefCell<Option<Unsupported>>,
}

impl Cursor<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.next.get()).copied()
    }

    /// The next token, if it is of this kind.
    fn take(&self, kind: Kind) -> Option<Token> {
        let token = self.peek().filter(|token| token.kind == kind)?;
        self.next.set(self.next.get() + 1);
        Some(token)
    }

    /// Goes to the token that a borrowed text is from.
    fn meet(&self, borrowed: &str) {
        let offset = (borrowed.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        let Some(ahead) = self.tokens.get(self.next.get()..) else {
            return;
        };
        // What an alias repeats lies behind.
        if offset < self.text.len() && ahead.first().is_some_and(|token| token.start <= offset) {
            let passed = ahead.iter().take_while(|token| token.end <= offset);
            self.next.set(self.next.get() + passed.count());
        }
    }

    /// Where an empty node is: behind what came last.
    fn behind(&self) -> usize {
        let last = self.next.get().checked_sub(1);
        let Some(token) = last.and_then(|last| self.tokens.get(last)) else {
            return 0;
        };
        token.end + usize::from(self.text[token.end..].starts_with(':'))
    }

    fn is_null(&self, token: Token) -> bool {
        matches!(
            &self.text[token.start..token.end],
            "~" | "null" | "Null" | "NULL"
        )
    }
}

/// Reads one node.
#[derive(Clone, Copy)]
struct Reading<'c, 't> {
    cursor: &'c Cursor<'t>,
    /// How many collections it lies in.
    depth: usize,
    /// Whether it is an entry of a list that is written with dashes.
    dashed: bool,
    /// The alias that repeats it.
    alias: Option<usize>,
}

impl Reading<'_, '_> {
    /// Passes the dash, and the alias that stands in for the node. Called
    /// when the node is there, since only then it is known to be.
    fn arrive<E: Error>(&mut self) -> Result<(), E> {
        let cursor = self.cursor;
        if self.alias.is_none() {
            if self.dashed {
                cursor.take(Kind::Dash);
            }
            self.alias = cursor.take(Kind::Alias).map(|token| token.start);
        }
        if self.alias.is_some() {
            cursor.aliased.set(cursor.aliased.get() + 1);
        }
        if cursor.aliased.get() > YAML_ALIASED {
            let reason = format!(
                "the aliases (`*name`) of this file repeat more than {YAML_ALIASED} values"
            );
            return Err(self.refuse(reason, "write the robot without aliases"));
        }
        Ok(())
    }

    fn refuse<E: Error>(&self, reason: String, remedy: &'static str) -> E {
        let offset = self.alias.or(self.cursor.peek().map(|token| token.start));
        let unsupported = Unsupported {
            offset: offset.unwrap_or(self.cursor.text.len()),
            reason,
            remedy,
        };
        let error = E::custom(&unsupported.reason);
        self.cursor.refused.replace(Some(unsupported));
        error
    }

    /// The place of a collection's node, and how its entries are read.
    fn enter<E: Error>(mut self, starts_with_dash: bool) -> Result<(usize, Self), E> {
        self.arrive()?;
        if self.depth == YAML_DEPTH {
            return Err(self.refuse(too_deep(), "write them side by side; a robot needs four"));
        }
        let cursor = self.cursor;
        let open = self
            .alias
            .or_else(|| cursor.take(Kind::Open).map(|token| token.start));
        let entries = Reading {
            depth: self.depth + 1,
            dashed: starts_with_dash && open.is_none(),
            ..self
        };
        let first = cursor.peek().map(|token| token.start);
        Ok((open.or(first).unwrap_or_else(|| cursor.behind()), entries))
    }

    fn leaf<E: Error>(mut self, value: Value) -> Result<Node, E> {
        if let Value::Null = value {
            return self.null();
        }
        self.arrive()?;
        let at = self
            .alias
            .or_else(|| self.cursor.take(Kind::Scalar).map(|token| token.start));
        let at = at.unwrap_or_else(|| self.cursor.behind());
        Ok(Node { at, value })
    }

    /// Nothing at all, or a word for it.
    fn null<E: Error>(mut self) -> Result<Node, E> {
        self.arrive()?;
        let cursor = self.cursor;
        let word = |token: &Token| token.kind == Kind::Scalar && cursor.is_null(*token);
        let at = match (self.alias, cursor.peek().filter(word)) {
            (Some(at), _) => at,
            (None, Some(token)) => {
                cursor.take(Kind::Scalar);
                token.start
            }
            (None, None) => cursor.behind(),
        };
        Ok(Node {
            at,
            value: Value::Null,
        })
    }
}

impl<'de> DeserializeSeed<'de> for Reading<'_, '_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reading<'_, '_> {
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

    fn visit_borrowed_str<E: Error>(self, text: &'de str) -> Result<Node, E> {
        if self.alias.is_none() {
            self.cursor.meet(text);
        }
        self.visit_str(text)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Node, E> {
        self.leaf(Value::Text(text.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Node, A::Error> {
        let (at, entry) = self.enter(true)?;
        let mut nodes = Vec::new();
        while let Some(node) = list.next_element_seed(entry)? {
            nodes.push(node);
        }
        Ok(Node {
            at,
            value: Value::List(nodes),
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Node, A::Error> {
        let (at, entry) = self.enter(false)?;
        let mut entries = Vec::new();
        while let Some(pair) = map.next_entry_seed(entry, entry)? {
            entries.push(pair);
        }
        Ok(Node {
            at,
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
    use proptest::prelude::*;

    /// The places of all nodes, keys included, in the order of the text.
    fn places(node: &Node, found: &mut Vec<usize>) {
        found.push(node.at);
        match &node.value {
            Value::List(nodes) => nodes.iter().for_each(|node| places(node, found)),
            Value::Map(entries) => entries.iter().for_each(|(key, value)| {
                places(key, found);
                places(value, found);
            }),
            _ => {}
        }
    }

    /// A text in which `^` stands before every node; twice, where a collection
    /// and its first entry begin together.
    #[track_caller]
    fn check(marked: &str) {
        let mut expected = Vec::new();
        let mut text = String::new();
        for c in marked.chars() {
            match c {
                '^' => expected.push(text.len()),
                c => text.push(c),
            }
        }
        let mut found = Vec::new();
        places(&parse(&text).unwrap(), &mut found);
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn every_node_is_found() {
        check("^^a: ^[^1, ^pi/2]\n^b:\n  ^- ^{^c: ^true}\n  - ^~\n");
        check("^^'it''s': ^\"a\\\"[\" # [ {\n^b:^\n^c: ^don't # '\n^d: ^-1\n");
        check("^^a:\n^- ^^b: ^1\n  ^c: ^2\n- ^- ^3\n  - ^4\n-^\n- ^5\n");
        check("---\n^{^a: ^b c,^d:^ , ^\"e\":^1}\n");
        check("^[^^ü: ^1, ^{}, ^[], ^null, ^x]\n...\n");
        check("^^a: &a ^[^1, ^{^x: ^2}]\n^b: ^^^^^*a\n^c: ^3\n");
        check("^^a: ^one\n  two\n^b: ^3\n");
        check("^^a: ^'one\n\n  two'\n^b: ^3\n");
    }

    /// How a text is refused that repeats a piece as often as the bound allows,
    /// and once more.
    #[track_caller]
    fn beyond(bound: usize, text: impl Fn(usize) -> String, reason: &str) {
        assert!(!matches!(parse(&text(bound)), Err(Broken::Unsupported(_))));
        match parse(&text(bound + 1)) {
            Err(Broken::Unsupported(refused)) => assert_eq!(refused.reason, reason),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn collections_are_read_up_to_a_depth() {
        assert_eq!(YAML_DEPTH, 64);
        let reason =
            "64 brackets, lists and mappings stand here one inside another, and no more are read";
        beyond(64, |n| "[".repeat(n) + &"]".repeat(n), reason);
        beyond(64, |n| "{a: ".repeat(n) + &"}".repeat(n), reason);
        beyond(64, |n| "- ".repeat(n), reason);
        beyond(
            64,
            |n| "[".repeat(n / 2) + &"{a: ".repeat(n - n / 2),
            reason,
        );
    }

    #[test]
    fn aliases_repeat_up_to_a_number() {
        assert_eq!(YAML_ALIASED, 100_000);
        let text = |n: usize| {
            let list = "[1, 2, 3, 4, 5, 6, 7, 8, 9]";
            format!(
                "a: &a {list}\nb: [{}]\nc: [{}]",
                "*a,".repeat(n / 10),
                "*a,".repeat(n % 10)
            )
        };
        assert!(parse(&text(100_000)).is_ok());
        beyond(
            100_000,
            text,
            "the aliases (`*name`) of this file repeat more than 100000 values",
        );
        // Inside itself.
        assert!(parse("&a [*a]").is_err());
    }

    /// Whether a leaf stands where its place says it does.
    fn stands(text: &str, node: &Node) -> bool {
        let there = text.get(node.at..).unwrap_or("");
        match &node.value {
            Value::Null | Value::Bool(_) => true,
            Value::Number(number) => {
                let word = there
                    .split([',', ']', '}', ':', ' ', '#'])
                    .next()
                    .unwrap_or("");
                word.parse() == Ok(*number)
            }
            Value::Text(word) => {
                let first = word.split([' ', '\n']).next().unwrap_or("");
                there.starts_with(['\'', '"', '*']) || there.starts_with(first)
            }
            Value::List(nodes) => nodes.iter().all(|node| stands(text, node)),
            Value::Map(entries) => entries
                .iter()
                .all(|(key, value)| stands(text, key) && stands(text, value)),
        }
    }

    const PIECES: [&str; 24] = [
        "[", "]", "{", "}", ",", ": ", ":", "- ", "-", "\n- ", "\n  ", " ", " #", "'", "\"", "a",
        "b", "1", "25", "null", "'c d'", "&x ", "é", "\\",
    ];

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 20_000, ..ProptestConfig::default() })]

        // libyaml is the judge of what is a node, and the tokens of where.
        #[test]
        fn tokens_and_nodes_agree(pieces in prop::collection::vec(0..PIECES.len(), 0..14)) {
            let text: String = pieces.iter().map(|&piece| PIECES[piece]).collect();
            if let Ok(document) = parse(&text) {
                // The next line of a text without quotes is a token of its own.
                prop_assert!(text.contains('\n') || stands(&text, &document), "{document:?}");
            }
        }
    }

    #[test]
    fn what_no_robot_needs_is_refused() {
        for (text, offset) in [
            ("a: |\n  b", 3),
            ("a: >-\n  b", 3),
            ("? a\n: b", 0),
            ("{? a}", 1),
            ("a: 'b\u{0}'", 5),
        ] {
            match parse(text) {
                Err(Broken::Unsupported(refused)) => assert_eq!(refused.offset, offset),
                other => panic!("{other:?}"),
            }
        }
    }
}
