//! Reading nodes as what they have to be, with diagnostics.

use super::node::{self, Broken, Node, Value};
use super::tokens::Unsupported;
use super::{Collector, Name, Source, did_you_mean, expression};
use crate::spec::{Location, bounds, list_names, look_alike, suggest};

/// The text, for places, and what was wrong with it so far.
pub(super) struct Reader<'s> {
    text: &'s str,
    pub diagnostics: Collector<'s>,
    /// Whether joints may be passive, and say so.
    pub of_mechanism: bool,
}

/// A mapping whose keys are all known.
pub(super) struct Fields<'n> {
    /// Where the mapping stands.
    pub at: usize,
    entries: Vec<Entry<'n>>,
    /// Keys that unknown ones were most likely meant to be.
    misspelt: Vec<String>,
}

struct Entry<'n> {
    key: &'n str,
    key_at: usize,
    value: &'n Node,
}

impl<'n> Fields<'n> {
    pub(super) fn get(&self, key: &str) -> Option<&'n Node> {
        self.entry(key).map(|entry| entry.value)
    }

    /// A value that must be there. One whose key is misspelt has been
    /// reported under the key it has.
    pub(super) fn required(&self, key: &str, reader: &mut Reader) -> Option<&'n Node> {
        let found = self.get(key);
        if found.is_none() && !self.misspelt.iter().any(|meant| meant == key) {
            reader.at(
                self.at,
                format!("`{key}` is missing"),
                format!("add `{key}: {}`", example(key)),
            );
        }
        found
    }

    /// Where a key stands, to report its being there.
    pub(super) fn key(&self, key: &str) -> usize {
        self.entry(key).map_or(self.at, |entry| entry.key_at)
    }

    fn entry(&self, key: &str) -> Option<&Entry<'n>> {
        self.entries.iter().find(|entry| entry.key == key)
    }
}

impl<'s> Reader<'s> {
    pub(super) fn new(source: &'s Source) -> Self {
        Reader {
            text: &source.text,
            diagnostics: Collector::new(source),
            of_mechanism: false,
        }
    }

    /// The place of a byte offset.
    pub(super) fn place(&self, offset: usize) -> Location {
        self.diagnostics.place(offset)
    }

    /// Reports what stands at a byte offset.
    pub(super) fn at(
        &mut self,
        offset: usize,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let at = self.place(offset);
        self.diagnostics.at(at, reason, remedy);
    }

    /// The text is not read.
    pub(super) fn explain(&mut self, broken: Broken) {
        match broken {
            Broken::Syntax(error) => self.explain_syntax(&error),
            Broken::Unsupported(Unsupported {
                offset,
                reason,
                remedy,
            }) => self.at(offset, reason, remedy),
        }
    }

    /// The text is no YAML at all.
    fn explain_syntax(&mut self, error: &serde_yaml::Error) {
        let mut message = format!("this cannot be read: {error}");
        let mut remedy = "correct the YAML; the format is described in kin_codegen::spec::yaml";
        if let Some(second) = self
            .second_document()
            .filter(|_| message.contains("document"))
        {
            let reason = "a second document begins here, and a file has one robot";
            return self.at(second, reason, "give it a file of its own");
        }
        let Some(at) = node::place(error) else {
            return self.diagnostics.whole(message, remedy);
        };
        // Ours names the place already.
        let place = format!(" at line {} column {}", at.line, at.column);
        if let Some(start) = message.find(&place) {
            message.replace_range(start..start + place.len(), "");
        }
        // At its end the parser is a line ahead.
        let end = self.place(self.text.trim_end().len());
        let at = if at.line > end.line { end } else { at };
        let line = self.text.lines().nth(at.line.saturating_sub(1) as usize);
        let line = line.unwrap_or("");
        let before = at.column.saturating_sub(1) as usize;
        if line.chars().nth(before) == Some('\t') {
            message = "this line is indented with a tab, and YAML takes blanks alone".into();
            remedy = "replace the tab by blanks";
        } else if message.contains("parsing a flow") {
            remedy = "close what `{` and `[` open, here or in a line before, and put commas between \
                      entries";
        } else if message.contains("mapping values") {
            remedy = "indent the line as its neighbours, write the colon that it or a line before \
                      lacks, or put what contains a colon and a blank in quotes";
        } else if before > 0 && line.chars().take(before).all(|c| c == ' ') {
            remedy = "indent the line as its neighbours: entries of one list or mapping begin in \
                      one column";
        }
        self.diagnostics.at(at, message, remedy);
    }

    /// Where a line of dashes ends what comes before it.
    fn second_document(&self) -> Option<usize> {
        let is_content = |line: &str| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with(['#', '%']) && !line.starts_with("---")
        };
        let mut begun = false;
        let mut offset = 0;
        for line in self.text.split_inclusive('\n') {
            if begun && line.starts_with("---") {
                return Some(offset);
            }
            begun |= is_content(line);
            offset += line.len();
        }
        None
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
            let remedy = match &node.value {
                Value::Text(text) if text.starts_with('<') => {
                    "name the file `.urdf`, if this is XML".into()
                }
                _ => format!("write {{key: value, ...}} with {}", list_names(known)),
            };
            self.at(node.at, reason, remedy);
            return None;
        };
        let mut fields = Fields {
            at: node.at,
            entries: Vec::new(),
            misspelt: Vec::new(),
        };
        for (key, value) in entries {
            self.field(key, value, what, known, &mut fields);
        }
        Some(fields)
    }

    fn field<'n>(
        &mut self,
        key: &'n Node,
        value: &'n Node,
        what: &str,
        known: &[&str],
        fields: &mut Fields<'n>,
    ) {
        let Value::Text(name) = &key.value else {
            let reason = format!("a key is a word, and this is {}", kind(&key.value));
            let point = match key.value {
                Value::Number(_) => "write decimals with a point, and ",
                _ => "",
            };
            let remedy = format!("{point}use one of {}", list_names(known));
            return self.at(key.at, reason, remedy);
        };
        if !known.contains(&name.as_str()) {
            let meant = suggest::nearest(name, known.iter().copied());
            fields.misspelt.extend(meant.map(str::to_string));
            let reason = format!("unknown key `{name}` in a {what}");
            let remedy = match name.split_once(':') {
                Some((key, value)) if known.contains(&key) => {
                    format!("put a blank behind the colon: `{key}: {value}`")
                }
                _ => instead_of(name, known),
            };
            self.at(key.at, reason, remedy);
        } else if fields.get(name).is_some() {
            let reason = format!("the key `{name}` stands here twice");
            self.at(key.at, reason, "remove one of the two");
        } else {
            fields.entries.push(Entry {
                key: name,
                key_at: key.at,
                value,
            });
        }
    }

    pub(super) fn list<'n>(&mut self, node: &'n Node) -> Option<&'n [Node]> {
        if let Value::List(nodes) = &node.value {
            return Some(nodes);
        }
        let remedy = match &node.value {
            Value::Text(text) if text.split_whitespace().all(|it| it.parse::<f64>().is_ok()) => {
                let entries: Vec<&str> = text.split_whitespace().collect();
                format!("write [{}]", entries.join(", "))
            }
            _ => "write [..., ...], or one line with `- ` per entry".into(),
        };
        let reason = format!("this should be a list, and is {}", kind(&node.value));
        self.at(node.at, reason, remedy);
        None
    }

    /// A name: any text but the empty one, and not too long.
    pub(super) fn name(&mut self, node: &Node) -> Option<Name> {
        let Value::Text(text) = &node.value else {
            self.at(
                node.at,
                format!("this should be a name, and is {}", kind(&node.value)),
                "write a word; in quotes, if it looks like a number",
            );
            return None;
        };
        if text.trim().is_empty() {
            self.at(node.at, "this name is empty", "write a word");
            return None;
        }
        let length = text.chars().count();
        if length > bounds::NAME {
            let reason = format!(
                "this name has {length} characters, and at most {} are read",
                bounds::NAME
            );
            self.at(node.at, reason, "write a shorter one");
            return None;
        }
        Some(Name {
            text: text.clone(),
            at: self.place(node.at),
        })
    }

    /// One of a few words.
    pub(super) fn word(&mut self, node: &Node, known: &[&'static str]) -> Option<&'static str> {
        let Name { text, at } = self.name(node)?;
        let found = known.iter().copied().find(|&word| word == text);
        if found.is_none() {
            self.diagnostics.at(
                at,
                format!("`{text}` is not among the words possible here"),
                instead_of(&text, known),
            );
        }
        found
    }

    /// `true` or `false`.
    pub(super) fn truth(&mut self, node: &Node) -> Option<bool> {
        if let Value::Bool(truth) = node.value {
            return Some(truth);
        }
        let reason = format!("this should be true or false, and is {}", kind(&node.value));
        self.at(node.at, reason, "write `true` or `false`");
        None
    }

    /// A finite number without a unit, and whether it was written with `pi`.
    pub(super) fn number(&mut self, node: &Node) -> Option<(f64, bool)> {
        let number = match &node.value {
            Value::Number(number) => Some((*number, false)),
            Value::Text(text) => expression::evaluate(text),
            _ => None,
        };
        let reason = match (number, &node.value) {
            (Some((number, pi)), _) if number.is_finite() => return Some((number, pi)),
            (Some((number, _)), _) => format!("this number is {number}, which is not finite"),
            (None, Value::Text(text)) => format!("`{text}` is not a number"),
            (None, value) => format!("this should be a number, and is {}", kind(value)),
        };
        let remedy = match number {
            Some((number, _)) if number.is_infinite() => {
                "write a finite number; where there are no limits, leave `limits` out".into()
            }
            _ => plainly(&node.value),
        };
        self.at(node.at, reason, remedy);
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
            let entries = if nodes.len() == 1 { "entry" } else { "entries" };
            let reason = format!("this list has {} {entries} where {N} belong", nodes.len());
            let is_run = |it: &Node| matches!(&it.value, Value::Text(text) if text.contains(' '));
            let between = match nodes.iter().any(is_run) {
                true => ", with commas between them",
                false => "",
            };
            self.at(node.at, reason, format!("write {N} entries{between}"));
            return None;
        }
        let read: Vec<Option<T>> = nodes.iter().map(|node| one(self, node)).collect();
        let read: Vec<T> = read.into_iter().collect::<Option<_>>()?;
        read.try_into().ok()
    }
}

/// What to write for a word that is not known here, which other formats may have.
fn instead_of(word: &str, known: &[&str]) -> String {
    let (instead, remedy) = match word {
        "offset" => (
            "theta",
            "write the offset of a joint's angle as `theta`, of a slide as `d`",
        ),
        "quat_wxyz" => (
            "quat_xyzw",
            "write `quat_xyzw`, and w as the last of its numbers",
        ),
        "continuous" => (
            "revolute",
            "write `revolute`, and leave out `limits`: it turns freely then",
        ),
        "fixed" => (
            "prismatic",
            "leave the row out: what lies behind the last joint is `tip: {xyz: [...], rpy: [...]}`",
        ),
        _ => return did_you_mean(word, known),
    };
    match known.contains(&instead) {
        true => remedy.into(),
        false => did_you_mean(word, known),
    }
}

/// What stands behind a key.
fn example(key: &str) -> &'static str {
    match key {
        "units" => "{angle: rad, length: m}`, or with `deg` and `mm",
        "angle" => "rad` or `angle: deg",
        "length" => "m` or `length: mm",
        _ => "...",
    }
}

/// How to write what is no number.
fn plainly(value: &Value) -> String {
    if let Value::Text(text) = value {
        if let Some(remedy) = look_alike::remedy(text) {
            return remedy;
        }
        if let Some(expression) = as_expression(text) {
            return format!("write `{expression}`");
        }
        let bare = text.trim_start_matches(['-', '+', '.']).to_lowercase();
        if matches!(&*bare, "inf" | "infinity" | "∞") {
            return "leave out what has no bound: without `limits` a joint has none".into();
        }
        let unit = |c: char| c.is_alphabetic() || c == '°';
        let point = text.replacen(',', ".", 1);
        let bare = text.trim_end_matches(unit).trim_end();
        let is_unit = bare != text && !text.ends_with("pi");
        if is_unit && expression::evaluate(bare).is_some() {
            return format!("write `{bare}` alone: `units` tells what numbers measure");
        }
        if point != *text && expression::evaluate(&point).is_some() {
            return format!("write a decimal point: `{point}`");
        }
    }
    "write a number, or an expression of numbers and pi such as `pi/2`".into()
}

/// What a text says as an expression, if only that is no name of π here, or a product without its sign.
fn as_expression(text: &str) -> Option<String> {
    const PI: [&str; 6] = ["numpy.pi", "np.pi", "math.pi", "M_PI", "PI", "π"];
    let named = PI
        .iter()
        .fold(text.to_owned(), |text, pi| text.replace(pi, "pi"));
    let mut plain = String::new();
    for c in named.chars() {
        let factor = plain.trim_end();
        if c == 'p' && factor.ends_with(|before: char| before.is_ascii_digit()) {
            plain.truncate(factor.len());
            plain.push('*');
        }
        plain.push(c);
    }
    (plain != text && expression::evaluate(&plain).is_some()).then_some(plain)
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "empty",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::Text(_) => "a text",
        Value::List(_) => "a list",
        Value::Map(_) => "a mapping",
    }
}
