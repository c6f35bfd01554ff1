//! Files that are nearly robots: a word put in another's place, a line or an
//! element moved, doubled or lost, a number that is none.

use kin_codegen::random::Random;

/// What means something to some reader.
const PIECES: [&str; 76] = [
    // Numbers
    "0",
    "-0",
    "1",
    "nan",
    "inf",
    "-inf",
    "1e308",
    "1e999",
    "5e-324",
    "-1e308",
    ".5",
    "1.",
    "1,5",
    "0x10",
    "1_000",
    "pi",
    "-pi/2",
    "(((1)))",
    "180",
    "1e-300",
    // XML
    "<",
    ">",
    "/>",
    "\"",
    "'",
    "&",
    "&#10;",
    "&#0;",
    "&lt;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?",
    "${pi}",
    "<joint",
    "</joint>",
    "</robot>",
    "<link name=\"a\"/>",
    "<mimic joint=\"a\"/>",
    "<axis xyz=\"0 0 0\"/>",
    "<loop_joint",
    "xmlns:x=\"u\"",
    "<x:y/>",
    "type=\"fixed\"",
    "type=\"floating\"",
    "quat_xyzw=\"0 0 0 1\"",
    // YAML
    "[",
    "]",
    "{",
    "}",
    ": ",
    "- ",
    ", ",
    "#",
    "|",
    "&a ",
    "*a",
    "!t ",
    "? ",
    "~",
    "---\n",
    "type: prismatic",
    "mimic: {joint: a}",
    "matrix: [[1,0,0],[0,1,0],[0,0,1]]",
    "\"\\n\"",
    // Text
    " ",
    "\t",
    "\n",
    "\r",
    "é",
    "\u{0}",
    "\u{1b}[31m",
    "\u{202e}",
    "\u{85}",
    "\u{feff}",
];

/// What a link, a joint or a robot might be called.
const NAMES: [&str; 12] = [
    "a",
    "tool0",
    "left_finger",
    "f64",
    "r#type",
    "é",
    "a b",
    "a`b",
    "*/ //",
    "\\n",
    "\u{202e}",
    "{}",
];

/// Changes a file in one to three ways. `other` is one to take pieces from.
pub fn mutate(text: &str, other: &str, random: &mut Random) -> String {
    let mut text = text.to_owned();
    for _ in 0..=random.below(3) {
        text = once(&text, other, random);
    }
    text
}

fn once(text: &str, other: &str, random: &mut Random) -> String {
    match random.below(12) {
        // A word by another one: of a list, of the file, of the other file.
        0 => replace(
            words(text),
            text,
            PIECES[random.below(PIECES.len() as u64)],
            random,
        ),
        1 => {
            let piece = pick(&words(text), random).map_or("", |word| &text[word.0..word.1]);
            replace(words(text), text, piece, random)
        }
        2 => {
            let piece = pick(&words(other), random).map_or("", |word| &other[word.0..word.1]);
            replace(words(text), text, piece, random)
        }
        // A line, or what stands between two brackets.
        3 => replace(lines(text), text, "", random),
        4 => {
            let from = if random.below(2) == 0 { text } else { other };
            let piece = pick(&lines(from), random).map_or("", |line| &from[line.0..line.1]);
            let (at, _) = pick(&lines(text), random).unwrap_or_default();
            spliced(text, (at, at), piece)
        }
        5 => replace(elements(text), text, "", random),
        6 => {
            let piece = pick(&elements(text), random).map_or("", |span| &text[span.0..span.1]);
            let (_, at) = pick(&elements(text), random).unwrap_or_default();
            spliced(text, (at, at), piece)
        }
        // A number by another one.
        7 | 8 => {
            let number = |&(start, end): &Span| text[start..end].parse::<f64>().is_ok();
            let numbers: Vec<Span> = words(text).into_iter().filter(number).collect();
            let value = random.between(-4.0, 4.0).to_string();
            replace(numbers, text, &value, random)
        }
        // A name, wherever it stands.
        9 | 10 => {
            let name = pick(&words(text), random).map_or("-", |word| &text[word.0..word.1]);
            text.replace(name, NAMES[random.below(NAMES.len() as u64)])
        }
        // A piece anywhere, or nothing from there on.
        _ => {
            let at = boundary(text, random);
            let end = if random.below(8) == 0 { text.len() } else { at };
            spliced(text, (at, end), PIECES[random.below(PIECES.len() as u64)])
        }
    }
}

/// Byte offsets of a piece.
type Span = (usize, usize);

fn pick(spans: &[Span], random: &mut Random) -> Option<Span> {
    let count = spans.len() as u64;
    (count > 0).then(|| spans[random.below(count)])
}

fn replace(spans: Vec<Span>, text: &str, piece: &str, random: &mut Random) -> String {
    match pick(&spans, random) {
        Some(span) => spliced(text, span, piece),
        None => piece.to_owned(),
    }
}

fn spliced(text: &str, (start, end): Span, piece: &str) -> String {
    [&text[..start], piece, &text[end..]].concat()
}

fn boundary(text: &str, random: &mut Random) -> usize {
    let mut at = random.below(text.len() as u64 + 1);
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Names and numbers.
fn words(text: &str) -> Vec<Span> {
    let word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '+');
    let mut spans = Vec::new();
    let mut start = None;
    for (i, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (start, word(c)) {
            (None, true) => start = Some(i),
            (Some(first), false) => {
                spans.push((first, i));
                start = None;
            }
            _ => {}
        }
    }
    spans
}

/// Lines with their breaks.
fn lines(text: &str) -> Vec<Span> {
    let mut start = 0;
    let span = |line: &str| {
        let span = (start, start + line.len());
        start = span.1;
        span
    };
    text.split_inclusive('\n').map(span).collect()
}

/// What stands between an opening bracket and one of those that may close it.
fn elements(text: &str) -> Vec<Span> {
    let mut open = Vec::new();
    let mut spans = Vec::new();
    for (i, byte) in text.bytes().enumerate() {
        match byte {
            b'<' | b'[' | b'{' => open.push(i),
            b'>' | b']' | b'}' => spans.extend(open.pop().map(|start| (start, i + 1))),
            _ => {}
        }
    }
    spans
}
