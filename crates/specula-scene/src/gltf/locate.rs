//! Where in a JSON text the element stands that a message names by its path.

use std::ops::Range;

/// Longest text that is searched.
const LONGEST: usize = 16 << 20;

/// The bytes of the element that `message` begins with, such as `meshes[0].primitives[1]`; what it
/// names beyond the text's own elements (`.POSITION` of an accessor) is not looked for.
pub(super) fn locate(text: &str, message: &str) -> Option<Range<usize>> {
    let end = message.find([':', ' ']).unwrap_or(message.len());
    let mut walk = Walk {
        text: text.as_bytes(),
        at: 0,
    };
    if text.len() > LONGEST || !message[..end].contains('[') {
        return None;
    }
    walk.blank();
    let mut found = None;
    'path: for part in message[..end].split('.') {
        let (name, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
        if !walk.member(name) {
            break;
        }
        for index in indices.split('[').skip(1) {
            let index = index.strip_suffix(']').and_then(|i| i.parse().ok());
            if !index.is_some_and(|i| walk.element(i)) {
                break 'path;
            }
        }
        found = Some(walk.at);
    }
    let start = found?;
    let line = text[start..].find('\n').unwrap_or(text.len() - start);
    Some(start..start + line)
}

/// A walk through a text that was parsed before: whatever it holds, the walk ends.
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
