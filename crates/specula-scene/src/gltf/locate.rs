//! Finds the element in a JSON text that a message names by its path.

use std::ops::Range;

/// Longest text that is searched.
const LONGEST: usize = 16 << 20;

/// A step from a value into it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    Name(String),
    Index(usize),
}

/// A path as messages have it, such as `meshes[0].primitives[1]`.
pub(super) fn written(path: &[Step]) -> String {
    let mut text = String::new();
    for step in path {
        match step {
            Step::Name(name) if text.is_empty() => text.push_str(name),
            Step::Name(name) => text.extend([".", name]),
            Step::Index(index) => text.push_str(&format!("[{index}]")),
        }
    }
    text
}

/// The bytes of the element that `message` begins with, such as `meshes[0].primitives[1]`; what it
/// names beyond the text's own elements (`.POSITION` of an accessor) is ignored.
pub(super) fn locate(text: &str, message: &str) -> Option<Range<usize>> {
    let end = message.find([':', ' ']).unwrap_or(message.len());
    if !message[..end].contains('[') {
        return None;
    }
    let mut path = Vec::new();
    for part in message[..end].split('.') {
        let (name, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
        path.push(Step::Name(name.to_owned()));
        for index in indices.split('[').skip(1) {
            let index = index.strip_suffix(']').and_then(|i| i.parse().ok());
            path.push(Step::Index(index.unwrap_or(usize::MAX)));
        }
    }
    find(text, &path)
}

/// Longest excerpt of a value that is marked.
const LONGEST_SPAN: usize = 80;

/// The bytes of the value that a path leads to, or of the innermost on the way that is there: the
/// beginning of its first line.
pub(super) fn find(text: &str, path: &[Step]) -> Option<Range<usize>> {
    let mut walk = Walk {
        text: text.as_bytes(),
        at: 0,
    };
    if text.len() > LONGEST {
        return None;
    }
    walk.blank();
    let (mut found, mut outer) = (None, None);
    for step in path {
        let is_there = match step {
            Step::Name(name) => {
                outer = found;
                walk.member(name)
            }
            Step::Index(index) => walk.element(*index),
        };
        if !is_there {
            // A list without the element is not what a message is about.
            if matches!(step, Step::Index(_)) {
                found = outer;
            }
            break;
        }
        found = Some(walk.at);
    }
    let start = found?;
    walk.at = start;
    walk.skip();
    let end = walk.at.min(text.floor_char_boundary(start + LONGEST_SPAN));
    let line = text[start..].find('\n').unwrap_or(text.len() - start);
    Some(start..end.min(start + line))
}

/// A walk through a text that was parsed before; it ends for every text.
struct Walk<'a> {
    text: &'a [u8],
    at: usize,
}

impl Walk<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn blank(&mut self) {
        while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Goes into an object, to the value of a member.
    fn member(&mut self, name: &str) -> bool {
        if self.peek() != Some(b'{') {
            return false;
        }
        self.at += 1;
        loop {
            self.blank();
            let start = self.at + 1;
            if self.peek() != Some(b'"') {
                return false;
            }
            self.skip();
            let key = self.text.get(start..self.at.saturating_sub(1));
            self.blank();
            if self.peek() != Some(b':') {
                return false;
            }
            self.at += 1;
            self.blank();
            if key == Some(name.as_bytes()) {
                return true;
            }
            self.skip();
            self.blank();
            if self.peek() != Some(b',') {
                return false;
            }
            self.at += 1;
        }
    }

    /// Goes into an array, to one of its elements.
    fn element(&mut self, index: usize) -> bool {
        if self.peek() != Some(b'[') {
            return false;
        }
        self.at += 1;
        self.blank();
        for _ in 0..index {
            self.skip();
            self.blank();
            if self.peek() != Some(b',') {
                return false;
            }
            self.at += 1;
            self.blank();
        }
        !matches!(self.peek(), None | Some(b']'))
    }

    /// Goes behind a value.
    fn skip(&mut self) {
        let mut depth = 0_usize;
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => {
                    self.at += 1;
                    while let Some(byte) = self.peek().filter(|b| *b != b'"') {
                        self.at += if byte == b'\\' { 2 } else { 1 };
                    }
                }
                b'[' | b'{' => depth += 1,
                b']' | b'}' if depth == 0 => return,
                b']' | b'}' => depth -= 1,
                b',' if depth == 0 => return,
                _ => {}
            }
            self.at += 1;
            let ends = matches!(byte, b'"' | b']' | b'}');
            if depth == 0 && ends {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_found() {
        let text = r#"{ "asset": {"version": "2.0", "x": [1, "}]", {}]},
"images": [ {"uri": "a.png"},
  {"uri": "b\".png"} ], "meshes": [
{"primitives": [{"mode": 1}, {"mode": 2}]} ] }"#;
        let line = |message: &str| {
            let range = locate(text, message)?;
            Some(text[..range.start].matches('\n').count() + 1)
        };
        assert_eq!(line("images[0]: broken"), Some(2));
        assert_eq!(line("images[1]: broken"), Some(3));
        assert_eq!(line("meshes[0].primitives[1].POSITION: short"), Some(4));
        assert_eq!(line("images[2]: broken"), None);
        assert_eq!(line("meshes[0].primitives[2]: broken"), Some(4));
        let path = |names: [&str; 2]| names.map(|n| Step::Name(n.to_owned()));
        let range = find(text, &path(["asset", "version"])).unwrap();
        assert_eq!(&text[range], "\"2.0\"");
        let range = find(text, &path(["asset", "generator"])).unwrap();
        assert!(text[range].starts_with("{\"version\""));
        let steps = [
            Step::Name("meshes".to_owned()),
            Step::Index(0),
            Step::Name("x.y".to_owned()),
        ];
        assert_eq!(written(&steps), "meshes[0].x.y");
        assert_eq!(line("picture x"), None);
        let range = locate(text, "meshes[0].primitives[1]: a").unwrap();
        assert!(text[range].starts_with("{\"mode\": 2}"));
    }

    #[test]
    fn texts_that_end_early_end_the_walk() {
        let text = r#"{"images": [{"uri": "a\"#;
        for end in 0..text.len() {
            let _ = locate(&text[..end], "images[3]: x");
        }
        assert_eq!(locate(text, "images[1]: x"), None);
    }
}
