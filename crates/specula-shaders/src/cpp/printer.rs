//! The place in a WGSL text, and the C++ that has been written up to it.

use std::collections::{BTreeMap, BTreeSet};

use super::error::Failure;
use super::lexer::{Token, TokenKind};
use super::types::{Scope, Type, signature};

/// Reads words and writes C++.
pub(super) struct Printer<'a> {
    tokens: &'a [Token<'a>],
    at: usize,
    /// Whether what is before the next word is left out.
    dropped: bool,
    pub(super) scope: &'a Scope,
    pub(super) out: String,
    /// Variables of the blocks that are open.
    pub(super) locals: Vec<BTreeMap<String, Type>>,
    /// The variable whose value is being read.
    pub(super) declaring: Option<String>,
    /// Values that have been read.
    pub(super) used: BTreeSet<String>,
    /// Variables that are assigned to, or given on as pointers.
    pub(super) changed: BTreeSet<String>,
    /// Functions that have been called.
    pub(super) called: BTreeSet<String>,
    /// What has been taken of the prelude.
    pub(super) taken: BTreeSet<String>,
}

impl<'a> Printer<'a> {
    /// At the beginning of `tokens`, which end with an end.
    pub(super) fn new(tokens: &'a [Token<'a>], scope: &'a Scope) -> Self {
        Self {
            tokens,
            at: 0,
            dropped: false,
            scope,
            out: String::new(),
            locals: Vec::new(),
            declaring: None,
            used: BTreeSet::new(),
            changed: BTreeSet::new(),
            called: BTreeSet::new(),
            taken: BTreeSet::new(),
        }
    }

    /// Notes a function, an operator or a constructor of the prelude.
    pub(super) fn take(&mut self, name: &str, arguments: &[Type]) {
        self.taken.insert(signature(name, arguments));
    }

    pub(super) fn peek(&self) -> Token<'a> {
        self.peek_at(0)
    }

    pub(super) fn peek_at(&self, ahead: usize) -> Token<'a> {
        self.tokens[(self.at + ahead).min(self.tokens.len() - 1)]
    }

    pub(super) fn last(&self) -> Option<Token<'a>> {
        self.at.checked_sub(1).map(|at| self.tokens[at])
    }

    /// Writes text in place of the next word.
    pub(super) fn write(&mut self, text: &str) {
        self.keep_before(self.peek());
        self.out += text;
        self.at += 1;
    }

    /// Writes the next word as it is.
    pub(super) fn copy(&mut self) {
        self.write(self.peek().text);
    }

    pub(super) fn copy_sign(&mut self, sign: &str) -> Result<(), Failure> {
        self.expect(sign)?;
        self.copy();
        Ok(())
    }

    /// Leaves the next word out, and what is before it.
    pub(super) fn skip(&mut self) {
        self.at += 1;
    }

    pub(super) fn skip_sign(&mut self, sign: &str) -> Result<(), Failure> {
        self.expect(sign)?;
        self.skip();
        Ok(())
    }

    pub(super) fn expect(&self, sign: &str) -> Result<(), Failure> {
        if self.peek().text == sign {
            return Ok(());
        }
        Err(self.unknown(&format!("'{sign}'")))
    }

    /// Writes what is before a word.
    pub(super) fn keep_before(&mut self, token: Token<'_>) {
        if !std::mem::take(&mut self.dropped) {
            self.out += token.before;
        }
    }

    /// Leaves out what is before the next word.
    pub(super) fn drop_before(&mut self) {
        self.dropped = true;
    }

    pub(super) fn declare(&mut self, name: &str, found: Type) {
        if let Some(block) = self.locals.last_mut() {
            block.insert(name.to_owned(), found);
        }
    }

    pub(super) fn is_local(&self, name: &str) -> bool {
        self.locals.iter().any(|block| block.contains_key(name))
    }

    /// The type of a variable or of a constant.
    pub(super) fn type_of(&self, name: &str) -> Option<Type> {
        let mut blocks = self.locals.iter().rev();
        let local = blocks.find_map(|block| block.get(name));
        local.or_else(|| self.scope.values.get(name)).cloned()
    }

    /// Reads a type and writes nothing.
    pub(super) fn read_type(&mut self) -> Result<Type, Failure> {
        let text = self.peek().text;
        let found = match text {
            "array" => {
                self.skip();
                self.skip_sign("<")?;
                let element = self.read_type()?;
                self.skip_sign(",")?;
                let count = self.peek().text.to_owned();
                self.skip();
                self.expect(">")?;
                Type::Array(Box::new(element), count)
            }
            "ptr" => {
                self.skip();
                self.skip_sign("<")?;
                self.skip_sign("function")?;
                self.skip_sign(",")?;
                let target = self.read_type()?;
                self.expect(">")?;
                Type::Pointer(Box::new(target))
            }
            _ => match Type::plain(text) {
                Some(found) => found,
                None if self.scope.structures.contains_key(text) => {
                    Type::Structure(text.to_owned())
                }
                None => return Err(self.unknown("a type")),
            },
        };
        self.skip();
        Ok(found)
    }

    pub(super) fn failure(&self, message: impl Into<String>) -> Failure {
        Failure::new(self.peek().line, message)
    }

    /// The next word stands where something else is expected.
    pub(super) fn unknown(&self, expected: &str) -> Failure {
        let token = self.peek();
        let found = match token.kind {
            TokenKind::End => "the end of the text".to_owned(),
            _ => format!("'{}'", token.text),
        };
        self.failure(format!("expected {expected}, found {found}"))
    }
}
