//! Words of a WGSL text, with the white space and the comments before each.

use super::error::Failure;

/// A word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub(super) kind: TokenKind,
    pub(super) text: &'a str,
    /// White space and comments since the last one.
    pub(super) before: &'a str,
    /// Line in the file, from 1.
    pub(super) line: usize,
}

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind {
    Name,
    Number,
    Sign,
    /// Behind the last one.
    End,
}

/// Signs of more than one letter, the longest first.
const SIGNS: [&str; 18] = [
    "<<=", ">>=", "->", "++", "--", "+=", "-=", "*=", "/=", "|=", "&=", "==", "!=", "<=", ">=",
    "&&", "||", "<<",
];

/// The words of a text and the end; `>>` is two.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Failure> {
    let mut tokens = Vec::new();
    let (mut at, mut line) = (0, 1);
    loop {
        let start = at + blank(&text[at..]);
        let before = &text[at..start];
        line += before.matches('\n').count();
        let rest = &text[start..];
        let Some(first) = rest.chars().next() else {
            tokens.push(Token {
                kind: TokenKind::End,
                text: rest,
                before,
                line,
            });
            return Ok(tokens);
        };
        let (kind, length) = if first.is_ascii_digit() {
            (TokenKind::Number, number(rest))
        } else if is_part(first) {
            (
                TokenKind::Name,
                rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
            )
        } else if let Some(sign) = SIGNS.iter().find(|s| rest.starts_with(**s)) {
            (TokenKind::Sign, sign.len())
        } else if "(){}[]<>+-*/%&|^~!=.,:;@".contains(first) {
            (TokenKind::Sign, 1)
        } else {
            return Err(Failure::new(
                line,
                format!("no word of WGSL begins with '{first}'"),
            ));
        };
        at = start + length;
        tokens.push(Token {
            kind,
            text: &text[start..at],
            before,
            line,
        });
    }
}

fn is_part(c: char) -> bool {
    c == '_' || c.is_ascii_alphanumeric()
}

/// Length of the white space and the comments that a text begins with.
fn blank(text: &str) -> usize {
    let mut at = 0;
    loop {
        let rest = &text[at..];
        let inner = rest.trim_start();
        at += rest.len() - inner.len();
        if !inner.starts_with("//") {
            return at;
        }
        at += inner.find('\n').unwrap_or(inner.len());
    }
}

/// Length of the number that a text begins with: digits, a point, an exponent, a suffix.
fn number(text: &str) -> usize {
    let is_hexadecimal = text.starts_with("0x");
    let mut last = ' ';
    let end = text.find(|c: char| {
        let signed = matches!(c, '+' | '-') && last == 'e' && !is_hexadecimal;
        last = c;
        !(c.is_ascii_alphanumeric() || c == '.' || signed)
    });
    end.unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_with_what_is_before_them() {
        let text = "// A\n let a = (1e-3-0x1eu) >> 1.5; // b\n";
        let tokens = tokens(text).unwrap();
        let words: Vec<&str> = tokens.iter().map(|t| t.text).collect();
        let expected = [
            "let", "a", "=", "(", "1e-3", "-", "0x1eu", ")", ">", ">", "1.5", ";", "",
        ];
        assert_eq!(words, expected);
        assert_eq!((tokens[0].before, tokens[0].line), ("// A\n ", 2));
        let again: String = tokens.iter().map(|t| [t.before, t.text].concat()).collect();
        assert_eq!(again, text);
    }

    #[test]
    fn other_signs_are_errors() {
        let error = tokens("let a = 1;\nlet b = a ? 1 : 2;").unwrap_err();
        assert_eq!(error.to_string(), "2: no word of WGSL begins with '?'");
    }
}
