//! Declarations of module scope as C++.

use std::collections::{BTreeMap, BTreeSet};

use super::error::Failure;
use super::lexer::Token;
use super::printer::Printer;
use super::types::{Scope, Signature, Type, name};

/// Letters of a line that a function's head may have.
const WIDTH: usize = 118;

/// A declaration, written as C++.
pub(super) struct Item {
    /// The comments above it, behind an empty line where there is one.
    pub(super) before: String,
    pub(super) text: String,
    /// What it takes of the prelude.
    pub(super) taken: BTreeSet<String>,
    /// Of a function: how it is declared, and what it calls.
    pub(super) function: Option<Function>,
}

/// A function beside its text.
pub(super) struct Function {
    pub(super) name: String,
    /// Its head, without the opening brace.
    pub(super) head: String,
    pub(super) called: BTreeSet<String>,
}

/// Where the declarations of a text begin, imports left out.
pub(super) fn starts(tokens: &[Token<'_>]) -> Vec<usize> {
    let mut starts = Vec::new();
    let (mut depth, mut fresh) = (0_usize, true);
    for (at, token) in tokens.iter().enumerate() {
        if depth == 0 && fresh && !token.text.is_empty() {
            starts.push(at);
        }
        match token.text {
            "{" | "(" => depth += 1,
            "}" | ")" => depth = depth.saturating_sub(1),
            _ => {}
        }
        fresh = depth == 0 && matches!(token.text, "}" | ";");
    }
    // The semicolon behind the braces of an import is a declaration of nothing.
    starts.retain(|&at| !matches!(tokens[at].text, "import" | ";"));
    starts
}

/// Adds what a text declares to a scope: structures first, since functions name them.
pub(super) fn declare(tokens: &[Token<'_>], scope: &mut Scope) -> Result<(), Failure> {
    let starts = starts(tokens);
    let of = |keyword: &'static str| starts.iter().filter(move |&&at| tokens[at].text == keyword);
    for &at in of("struct") {
        scope
            .structures
            .entry(tokens[at + 1].text.to_owned())
            .or_default();
    }
    for &at in of("struct") {
        let known = scope.clone();
        let fields = Printer::new(&tokens[at..], &known).read_fields()?;
        scope
            .structures
            .insert(tokens[at + 1].text.to_owned(), fields);
    }
    for &at in of("const") {
        let known = scope.clone();
        let mut printer = Printer::new(&tokens[at + 2..], &known);
        printer.skip_sign(":")?;
        scope
            .values
            .insert(tokens[at + 1].text.to_owned(), printer.read_type()?);
    }
    for &at in of("fn") {
        let known = scope.clone();
        let signature = Printer::new(&tokens[at + 2..], &known).read_signature()?;
        scope
            .functions
            .insert(tokens[at + 1].text.to_owned(), signature);
    }
    Ok(())
}

/// The declaration that tokens begin with.
pub(super) fn item(tokens: &[Token<'_>], scope: &Scope) -> Result<Item, Failure> {
    let mut printer = Printer::new(tokens, scope);
    let first = printer.peek();
    let function = match first.text {
        "fn" => Some(printer.function()?),
        "struct" => {
            printer.structure()?;
            None
        }
        "const" => {
            printer.constant()?;
            None
        }
        "@" => {
            printer.tables()?;
            None
        }
        _ => return Err(printer.unknown("a declaration")),
    };
    let before = first.before.trim_start_matches(' ');
    let gap = if before.starts_with("\n\n") { "\n" } else { "" };
    Ok(Item {
        before: format!("{gap}{}", before.trim_start_matches('\n')),
        text: printer.out,
        taken: printer.taken,
        function,
    })
}

impl Printer<'_> {
    /// The fields of a structure, at `struct`.
    fn read_fields(&mut self) -> Result<Vec<(String, Type)>, Failure> {
        let mut fields = Vec::new();
        self.skip();
        self.skip();
        self.skip_sign("{")?;
        while self.peek().text != "}" {
            let field = self.peek().text.to_owned();
            self.skip();
            self.skip_sign(":")?;
            fields.push((field, self.read_type()?));
            self.skip_sign(",")?;
        }
        Ok(fields)
    }

    /// Arguments and result, behind the function's name.
    fn read_signature(&mut self) -> Result<Signature, Failure> {
        let mut arguments = Vec::new();
        self.skip_sign("(")?;
        while self.peek().text != ")" {
            let argument = self.peek().text.to_owned();
            self.skip();
            self.skip_sign(":")?;
            arguments.push((argument, self.read_type()?));
            if self.peek().text == "," {
                self.skip();
            }
        }
        self.skip();
        let mut result = Type::Nothing;
        if self.peek().text == "->" {
            self.skip();
            result = self.read_type()?;
        }
        Ok(Signature { arguments, result })
    }

    fn structure(&mut self) -> Result<(), Failure> {
        self.drop_before();
        self.copy();
        self.copy();
        self.copy_sign("{")?;
        while self.peek().text != "}" {
            let field = self.peek();
            self.skip();
            self.skip_sign(":")?;
            let found = self.read_type()?;
            self.skip_sign(",")?;
            self.keep_before(field);
            self.out += &format!("{};", found.declared(&name(field.text)));
        }
        self.copy();
        self.out.push(';');
        Ok(())
    }

    fn constant(&mut self) -> Result<(), Failure> {
        self.skip();
        let declared = self.peek().text;
        self.skip();
        self.skip_sign(":")?;
        let found = self.read_type()?;
        self.out += &format!("constexpr {}", found.declared(&name(declared)));
        self.copy_sign("=")?;
        self.expression()?;
        self.copy_sign(";")
    }

    /// The buffer of the tables, a pointer in C++.
    fn tables(&mut self) -> Result<(), Failure> {
        let expected =
            "@ group ( 0 ) @ binding ( 0 ) var < storage , read > specula_tables : array < f32 > ;";
        for word in expected.split(' ') {
            self.skip_sign(word)?;
        }
        self.out += include_str!("tables.hpp").trim_end();
        Ok(())
    }

    fn function(&mut self) -> Result<Function, Failure> {
        self.skip();
        let function = self.peek().text;
        self.skip();
        let signature = self.read_signature()?;
        self.locals.push(
            signature
                .arguments
                .iter()
                .cloned()
                .collect::<BTreeMap<_, _>>(),
        );
        self.block()?;
        let head = self.head(function, &signature);
        self.out.insert_str(0, &head);
        Ok(Function {
            name: function.to_owned(),
            head,
            called: std::mem::take(&mut self.called),
        })
    }

    /// A function's head; on several lines where it is long, and with the names that nothing reads in comments.
    fn head(&self, function: &str, signature: &Signature) -> String {
        let pointers: Vec<&Type> = signature
            .arguments
            .iter()
            .filter(|(argument, found)| {
                matches!(found, Type::Pointer(_)) && self.changed.contains(argument)
            })
            .map(|(_, found)| found.target())
            .collect();
        let argument = |(argument, found): &(String, Type)| {
            let name = match self.used.contains(argument) {
                true => name(argument),
                false => format!("/* {argument} */"),
            };
            // A copy where the function could change what it is given by another argument.
            let is_changed = pointers.iter().any(|outer| self.scope.holds(outer, found));
            match found {
                Type::Structure(structure) if !is_changed => format!("const {structure}& {name}"),
                Type::Pointer(_) if !self.changed.contains(argument) => {
                    format!("const {}", found.declared(&name))
                }
                other => other.declared(&name),
            }
        };
        let arguments: Vec<String> = signature.arguments.iter().map(argument).collect();
        let start = format!("SPECULA_FN {} {function}(", signature.result.name());
        let line = format!("{start}{})", arguments.join(", "));
        if line.len() <= WIDTH {
            return line;
        }
        format!("{start}\n    {})", arguments.join(",\n    "))
    }
}
