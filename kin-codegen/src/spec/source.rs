//! A robot file in memory.

use super::places::Places;
use super::{Diagnostic, Diagnostics, Location};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::ops::Range;
use std::path::Path;

/// A robot file in memory: the text, and the path that messages name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// As the user wrote it; its extension chooses the format.
    pub path: String,
    /// The whole file.
    pub text: String,
}

/// No robot file has more bytes.
const MOST: u64 = 64 << 20;

/// The bytes of a file, of a longer one so many and one more.
fn read_up_to(most: u64, file: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(file)?.take(most + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

impl Source {
    /// Reads a robot file. A relative `path` is relative to `root`; messages
    /// name the file as `path` does.
    ///
    /// # Errors
    ///
    /// The file cannot be read, is not text, or is larger than 64 MB.
    pub fn read(path: &str, root: &Path) -> Result<Source, Diagnostics> {
        let file = root.join(path);
        let bytes = read_up_to(MOST, &file);
        let bytes = bytes.map_err(|error| unreadable(path, root, &file, &error))?;
        if bytes.len() as u64 > MOST {
            let reason = format!("the file is larger than {} MB", MOST >> 20);
            let remedy = "give a URDF or YAML file of a robot, without meshes in it";
            return Err(Diagnostics::one(path, Diagnostic::whole(reason, remedy)));
        }
        let text = text(bytes).map_err(|diagnostic| Diagnostics::one(path, diagnostic))?;
        Ok(Source {
            path: path.into(),
            text,
        })
    }

    /// Without the byte order mark that some editors write.
    pub(super) fn without_mark(&self) -> Source {
        let text = self.text.strip_prefix('\u{feff}').unwrap_or(&self.text);
        Source {
            path: self.path.clone(),
            text: text.into(),
        }
    }
}

/// A file's name without its ending, `.urdf.xacro` being one: `arm.v2.urdf` is `arm.v2`.
pub(crate) fn stem(path: &str) -> &str {
    let file = file_name(path);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    stem.strip_suffix(".urdf").unwrap_or(stem)
}

/// The last part of a path, on any system.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The text of a file, or why it is none.
fn text(mut bytes: Vec<u8>) -> Result<String, Diagnostic> {
    const UTF_16: [&[u8]; 2] = [&[0xff, 0xfe], &[0xfe, 0xff]];
    if UTF_16.iter().any(|mark| bytes.starts_with(mark)) {
        return Err(Diagnostic::whole(
            "the file is in UTF-16",
            "save it in UTF-8",
        ));
    }
    // Some programs write the zero that ends a string.
    let end = bytes.iter().rposition(|byte| *byte != 0);
    bytes.truncate(end.map_or(0, |last| last + 1));
    if bytes.contains(&0) {
        return Err(Diagnostic::whole(
            "the file is binary",
            "give a URDF or YAML file, which are text",
        ));
    }
    let mut text = String::with_capacity(bytes.len());
    let mut read = 0;
    for comment in comments(&bytes) {
        text += in_utf8(&bytes, read..comment.start)?;
        text += &String::from_utf8_lossy(&bytes[comment.clone()]);
        read = comment.end;
    }
    text += in_utf8(&bytes, read..bytes.len())?;
    Ok(text)
}

/// Comments are not read, and may have any encoding.
fn comments(bytes: &[u8]) -> Vec<Range<usize>> {
    let begin = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if begin.trim_ascii_start().first() != Some(&b'<') {
        let mut next = 0;
        let lines = bytes.split_inclusive(|it| *it == b'\n').map(|line| {
            next += line.len();
            Some(next - line.len() + comment(line)?..next)
        });
        return lines.flatten().collect();
    }
    let find = |word: &[u8], from: usize| {
        let mut words = bytes[from..].windows(word.len());
        words.position(|it| it == word).map(|place| from + place)
    };
    let (mut all, mut read) = (Vec::new(), 0);
    while let Some(start) = find(b"<!--", read) {
        read = find(b"-->", start).unwrap_or(bytes.len());
        all.push(start..read);
    }
    all
}

/// Where in a line of YAML its comment begins: at a `#` behind a space, not within quotes.
fn comment(line: &[u8]) -> Option<usize> {
    let (mut quote, mut before) = (None, b' ');
    line.iter().position(|&byte| {
        let may_begin = before.is_ascii_whitespace();
        let may_open = may_begin || b"[{,:".contains(&before);
        before = byte;
        match quote {
            Some(open) if byte == open => quote = None,
            None if may_open && matches!(byte, b'"' | b'\'') => quote = Some(byte),
            _ => {}
        }
        quote.is_none() && may_begin && byte == b'#'
    })
}

/// A part of a file, or where it is not UTF-8.
fn in_utf8(bytes: &[u8], part: Range<usize>) -> Result<&str, Diagnostic> {
    str::from_utf8(&bytes[part.clone()]).map_err(|error| {
        let end = part.start + error.valid_up_to();
        let start = bytes[..end]
            .iter()
            .rposition(|b| *b == b'\n')
            .map_or(0, |i| i + 1);
        let line = bytes[start..].split(|b| matches!(b, b'\n' | b'\r')).next();
        let line = String::from_utf8_lossy(line.unwrap_or_default());
        let place = Location {
            line: bytes[..end].iter().filter(|b| **b == b'\n').count() as u32 + 1,
            column: String::from_utf8_lossy(&bytes[start..end]).chars().count() as u32 + 1,
        };
        let reason = format!("the byte {:#04x} is not UTF-8", bytes[end]);
        let alone = Location { line: 1, ..place };
        Diagnostic {
            at: Some(place),
            ..Diagnostic::whole(reason, "save the file in UTF-8").in_text(alone, &Places::of(&line))
        }
    })
}

fn unreadable(path: &str, root: &Path, file: &Path, error: &io::Error) -> Diagnostics {
    let shown = file.display();
    let relative = Path::new(path).is_relative() && !root.as_os_str().is_empty();
    let (reason, remedy) = match error.kind() {
        ErrorKind::NotFound if relative => (
            format!("there is no such file: looked for {shown}"),
            format!("write the path relative to {}, or absolute", root.display()),
        ),
        ErrorKind::NotFound => ("there is no such file".into(), "check the path".into()),
        ErrorKind::IsADirectory => (
            "this is a folder".into(),
            "give the path of a URDF or YAML file in it".into(),
        ),
        _ => (
            format!("cannot read {shown}: {error}"),
            "give the path of a URDF or YAML file".into(),
        ),
    };
    Diagnostics::one(path, Diagnostic::whole(reason, remedy))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_tells_where_it_was_looked_for() {
        let refused = Source::read("arms/arm.urdf", Path::new("/nowhere")).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "arms/arm.urdf: there is no such file: looked for /nowhere/arms/arm.urdf\n\
             help: write the path relative to /nowhere, or absolute"
        );
    }

    #[test]
    fn a_folder_is_no_file() {
        let refused = Source::read("src", Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err();
        assert!(refused.to_string().starts_with("src: this is a folder"));
    }

    #[test]
    fn zeros_at_the_end_are_left_out() {
        assert_eq!(text(b"<robot/>\n\0\0".to_vec()).unwrap(), "<robot/>\n");
        assert_eq!(text(b"\0".to_vec()).unwrap(), "");
    }

    #[test]
    fn other_encodings_are_told() {
        let message = |bytes: &[u8]| {
            let diagnostic = text(bytes.to_vec()).unwrap_err();
            Diagnostics::one("arm.urdf", diagnostic).to_string()
        };
        assert_eq!(
            message(b"<robot\r\n  name=\"M\xfcller\">\r\n"),
            "arm.urdf:2:10: the byte 0xfc is not UTF-8\n  name=\"M\u{fffd}ller\">\n         ^\n\
             help: save the file in UTF-8"
        );
        assert_eq!(
            message(b"<!-- \xfc -->\n<!-- -->\xe4<!-- \xf6 -->"),
            "arm.urdf:2:9: the byte 0xe4 is not UTF-8\n<!-- -->\u{fffd}<!-- \u{fffd} -->\n        ^\n\
             help: save the file in UTF-8"
        );
        for (line, column) in [
            (&b"a: 1# gr\xfcn\n"[..], 9),
            (b"a: \"# gr\xfcn\"", 9),
            (b"a: {b: 'x', c: '\xfc #'} # \xfc", 17),
            (b"a: b's \xfc # 's", 8),
        ] {
            let place = format!("arm.urdf:1:{column}: the byte 0xfc");
            assert!(message(line).starts_with(&place), "{}", message(line));
        }
        assert!(message(b"\xff\xfe<\0").starts_with("arm.urdf: the file is in UTF-16"));
        assert!(message(b"solid \0\x01").starts_with("arm.urdf: the file is binary"));
    }

    /// As many files have them, in the encoding of whoever wrote them.
    #[test]
    fn comments_may_have_any_encoding() {
        let read = |bytes: &[u8]| text(bytes.to_vec()).unwrap();
        // In GBK, and one that never ends.
        assert_eq!(
            read(b"\xef\xbb\xbf<robot><!-- \xb9\xd8\xbd\xda --><!---->\n<!-- \xfc"),
            "\u{feff}<robot><!-- \u{fffd}\u{63d}\u{fffd} --><!---->\n<!-- \u{fffd}"
        );
        assert_eq!(
            read(b"robot: arm\r\n  # gr\xfcn\r\na: \"#\xc3\xa4\"\n#\xe4"),
            "robot: arm\r\n  # gr\u{fffd}n\r\na: \"#\u{e4}\"\n#\u{fffd}"
        );
        assert_eq!(
            read(b"dh: # \xb1\n- {a: \"# 1\", d: 'x'} # b's \xfc\n- b's # \xe4"),
            "dh: # \u{fffd}\n- {a: \"# 1\", d: 'x'} # b's \u{fffd}\n- b's # \u{fffd}"
        );
    }
}
