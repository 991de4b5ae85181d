//! Tokens of a pbrt file: words, quoted strings, brackets; `#` begins a comment.

use std::borrow::Cow;
use std::sync::Arc;

use super::number_list;
use crate::error::{ErrorKind, Place, SceneError, SourceText};
use crate::num::shorten;
use crate::problems::Problems;

/// Kinds of tokens.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind<'a> {
    /// A directive, a number, `true` or `false`.
    Word(&'a str),
    /// A quoted string, escapes decoded.
    Text(Cow<'a, str>),
    /// `[`
    Open,
    /// `]`
    Close,
}

/// A token with its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token<'a> {
    pub(super) kind: TokenKind<'a>,
    pub(super) offset: usize,
    pub(super) length: usize,
}

/// Reads the tokens of one file, with one token of lookahead.
pub(super) struct Tokens<'a> {
    source: &'a Arc<SourceText>,
    position: usize,
    peeked: Option<Token<'a>>,
    /// Where mistakes go.
    pub(super) problems: Problems,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(source: &'a Arc<SourceText>, problems: Problems) -> Self {
        // A byte-order mark is skipped.
        let position = if source.text().starts_with('\u{feff}') {
            3
        } else {
            0
        };
        Self {
            source,
            position,
            peeked: None,
            problems,
        }
    }

    /// Goes on after a mistake: at the first token for which `resumes` holds, from the mistake on,
    /// but behind `after`, where its directive or parameter begins.
    pub(super) fn recover(
        &mut self,
        mistake: &Place,
        after: &Place,
        resumes: impl Fn(&TokenKind<'_>) -> bool,
    ) {
        // A mistake in a file that is included says nothing about this one.
        if std::ptr::eq(mistake.source(), &raw const **self.source) {
            let behind = after.offset() + after.length();
            self.position = mistake.offset().max(behind);
            self.peeked = None;
        }
        loop {
            match self.peek() {
                Ok(None) => return,
                Ok(Some(token)) if resumes(&token.kind) => return,
                Ok(Some(_)) => self.peeked = None,
                Err(_) => self.skip_line(),
            }
        }
    }

    /// Goes on behind the end of the line.
    fn skip_line(&mut self) {
        let rest = self.source.text().as_bytes().get(self.position..);
        let length = rest.and_then(|r| r.iter().position(|b| *b == b'\n'));
        self.position = match length {
            Some(length) => self.position + length + 1,
            None => self.source.text().len(),
        };
        self.peeked = None;
    }

    pub(super) fn place(&self, token: &Token<'_>) -> Place {
        Place::new(self.source, token.offset, token.length)
    }

    /// The place of the token that was peeked, else where the next begins or its mistake is.
    fn here(&self) -> Place {
        match &self.peeked {
            Some(token) => self.place(token),
            None => Place::new(self.source, self.position, 0),
        }
    }

    /// The next token, with the place to go on behind after a mistake.
    pub(super) fn look(&mut self) -> (Result<Option<&Token<'a>>, SceneError>, Place) {
        let looked = self.peek().map(|_| ());
        let here = self.here();
        (looked.map(|()| self.peeked.as_ref()), here)
    }

    /// The place after the last token.
    pub(super) fn end(&self) -> Place {
        Place::new(self.source, self.source.text().trim_end().len(), 0)
    }

    pub(super) fn peek(&mut self) -> Result<Option<&Token<'a>>, SceneError> {
        if self.peeked.is_none() {
            self.peeked = self.read()?;
        }
        Ok(self.peeked.as_ref())
    }

    pub(super) fn next(&mut self) -> Result<Option<Token<'a>>, SceneError> {
        match self.peeked.take() {
            Some(token) => Ok(Some(token)),
            None => self.read(),
        }
    }

    /// The next token, which must exist; `what` names it in the message.
    pub(super) fn expect(&mut self, what: &str) -> Result<Token<'a>, SceneError> {
        self.next()?.ok_or_else(|| {
            let message = format!("the file ends where {what} was expected");
            SceneError::new(ErrorKind::Syntax, &self.end(), message)
        })
    }

    /// The next token as a quoted string.
    pub(super) fn expect_text(&mut self, what: &str) -> Result<(String, Place), SceneError> {
        let token = self.expect(what)?;
        let place = self.place(&token);
        match token.kind {
            TokenKind::Text(text) => Ok((text.into_owned(), place)),
            other => Err(SceneError::new(
                ErrorKind::Syntax,
                &place,
                format!("expected {what} in quotes, found {}", describe(&other)),
            )),
        }
    }

    /// The next token as a number.
    pub(super) fn expect_number(&mut self, what: &str) -> Result<f64, SceneError> {
        let token = self.expect(what)?;
        self.number(&token, what)
    }

    /// `token` as a finite number that an `f32` can hold.
    pub(super) fn number(&self, token: &Token<'_>, what: &str) -> Result<f64, SceneError> {
        let wrong = |message: String| {
            Err(SceneError::new(
                ErrorKind::Syntax,
                &self.place(token),
                message,
            ))
        };
        let TokenKind::Word(word) = token.kind else {
            return wrong(format!("expected {what}, found {}", describe(&token.kind)));
        };
        match word.parse::<f64>() {
            Ok(x) if !x.is_finite() => {
                wrong(format!("expected {what} that is finite, found {word}"))
            }
            Ok(x) if x.abs() > f64::from(f32::MAX) => {
                wrong(format!("expected {what} within 3.4e38, found {word}"))
            }
            Ok(x) => Ok(x),
            Err(_) => wrong(format!("expected {what}, found `{}`", shorten(word))),
        }
    }

    /// The numbers behind `[`, with the `]` that ends them; nothing is taken where anything else is among them.
    ///
    /// * `integers`: whether they must be integers of 32 bits.
    pub(super) fn numbers(&mut self, integers: bool) -> Option<Vec<f64>> {
        if self.peeked.is_some() {
            return None;
        }
        let (numbers, length) = number_list::read(&self.source.text()[self.position..], integers)?;
        self.position += length + 1;
        Some(numbers)
    }

    fn read(&mut self) -> Result<Option<Token<'a>>, SceneError> {
        let text = self.source.text();
        let bytes = text.as_bytes();
        loop {
            match bytes.get(self.position) {
                None => return Ok(None),
                Some(b' ' | b'\t' | b'\r' | b'\n') => self.position += 1,
                Some(b'#') => {
                    while !matches!(bytes.get(self.position), None | Some(b'\n' | b'\r')) {
                        self.position += 1;
                    }
                }
                Some(_) => break,
            }
        }
        let offset = self.position;
        let kind = match bytes[offset] {
            b'[' => {
                self.position += 1;
                TokenKind::Open
            }
            b']' => {
                self.position += 1;
                TokenKind::Close
            }
            b'"' => TokenKind::Text(self.read_text()?),
            _ => {
                let ends =
                    |b: &u8| matches!(b, b' ' | b'\t' | b'\r' | b'\n' | b'"' | b'[' | b']' | b'#');
                let length = bytes[offset..].iter().position(ends);
                self.position = length.map_or(bytes.len(), |l| offset + l);
                TokenKind::Word(&text[offset..self.position])
            }
        };
        Ok(Some(Token {
            kind,
            offset,
            length: self.position - offset,
        }))
    }

    fn read_text(&mut self) -> Result<Cow<'a, str>, SceneError> {
        let text = self.source.text();
        let start = self.position + 1;
        let mut escaped = false;
        let mut end = start;
        loop {
            match text.as_bytes().get(end) {
                Some(b'"') => break,
                Some(b'\\') => {
                    escaped = true;
                    end += 2;
                }
                Some(b'\n') | None => {
                    let place = Place::new(self.source, start - 1, 1);
                    return Err(SceneError::new(
                        ErrorKind::Syntax,
                        &place,
                        "a quoted string is not closed on its line; expected \"",
                    ));
                }
                Some(_) => end += 1,
            }
        }
        self.position = end + 1;
        let raw = &text[start..end];
        if escaped {
            self.unescape(raw, start).map(Cow::Owned)
        } else {
            Ok(Cow::Borrowed(raw))
        }
    }

    fn unescape(&self, raw: &str, start: usize) -> Result<String, SceneError> {
        let mut out = String::with_capacity(raw.len());
        let mut chars = raw.char_indices();
        while let Some((i, c)) = chars.next() {
            if c != '\\' {
                out.push(c);
                continue;
            }
            out.push(match chars.next().map(|(_, c)| c) {
                Some('n') => '\n',
                Some('t') => '\t',
                Some('r') => '\r',
                Some('b') => '\u{8}',
                Some('f') => '\u{c}',
                Some(c @ ('\\' | '\'' | '"')) => c,
                _ => {
                    let place = Place::new(self.source, start + i, 2);
                    return Err(SceneError::new(
                        ErrorKind::Syntax,
                        &place,
                        "unknown escape; expected one of \\n \\t \\r \\b \\f \\\\ \\' \\\"",
                    ));
                }
            });
        }
        Ok(out)
    }
}

/// A token in words, for messages.
pub(super) fn describe(kind: &TokenKind<'_>) -> String {
    match kind {
        TokenKind::Word(word) => format!("`{}`", shorten(word)),
        TokenKind::Text(text) => format!("\"{}\"", shorten(text)),
        TokenKind::Open => "`[`".to_owned(),
        TokenKind::Close => "`]`".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<String> {
        let source = SourceText::new("t", text);
        let mut tokens = Tokens::new(&source, Problems::default());
        std::iter::from_fn(|| tokens.next().unwrap())
            .map(|t| describe(&t.kind))
            .collect()
    }

    #[test]
    fn words_texts_brackets_and_comments() {
        assert_eq!(
            kinds("\u{feff}Shape \"a\\\"b\"[1 -2e3]# \"x\n]"),
            [
                "`Shape`",
                "\"a\\\"b\"",
                "`[`",
                "`1`",
                "`-2e3`",
                "`]`",
                "`]`"
            ]
        );
    }

    #[test]
    fn numbers_must_be_finite_and_fit_f32() {
        for bad in ["nan", "inf", "-infinity", "1e39", "1x", "\"1\"", "["] {
            let source = SourceText::new("t", bad);
            assert!(
                Tokens::new(&source, Problems::default())
                    .expect_number("a number")
                    .is_err(),
                "{bad}"
            );
        }
        let source = SourceText::new("t", "-1.5e-3");
        assert_eq!(
            Tokens::new(&source, Problems::default())
                .expect_number("a number")
                .unwrap(),
            -1.5e-3
        );
    }

    #[test]
    fn open_strings_are_located() {
        let source = SourceText::new("t", "Film \"rgb\n\"");
        let mut tokens = Tokens::new(&source, Problems::default());
        tokens.next().unwrap();
        let error = tokens.next().unwrap_err();
        assert_eq!((error.line(), error.column()), (1, 6));
    }
}
