//! Expressions of WGSL as C++, word by word, with their types.

use super::error::Failure;
use super::lexer::TokenKind;
use super::operators::{Operands, is_operator};
use super::printer::Printer;
use super::types::{Type, builtin, components, name, of_floats};

impl Printer<'_> {
    /// Writes an expression; operators of WGSL bind as those of C++ where both allow them without brackets.
    pub(super) fn expression(&mut self) -> Result<Type, Failure> {
        let mut operands = Operands::new(self.operand()?);
        loop {
            let mut sign = self.peek().text;
            if sign == ">" && self.is_shift() {
                self.copy();
                sign = ">>";
            }
            if !is_operator(sign) {
                return operands.folded(self);
            }
            self.copy();
            let operand = self.operand()?;
            operands.push(sign, operand);
        }
    }
    /// Whether the next two words are `>>`.
    fn is_shift(&self) -> bool {
        let next = self.peek_at(1);
        next.text == ">" && next.before.is_empty()
    }

    fn operand(&mut self) -> Result<Type, Failure> {
        let token = self.peek();
        match token.text {
            "-" | "!" | "~" => {
                self.copy();
                let found = self.operand()?;
                self.take(
                    &format!("operator{}", token.text),
                    std::slice::from_ref(&found),
                );
                Ok(found)
            }
            // An address or what is at it: C++ has references.
            "&" | "*" => {
                self.skip();
                self.keep_before(token);
                self.operand()
            }
            "(" if self.peek_at(1).text == "*" => {
                self.skip();
                self.keep_before(token);
                self.skip();
                let found = self.primary()?;
                self.skip_sign(")")?;
                self.postfix(found.target().clone())
            }
            "(" => {
                self.copy();
                let found = self.expression()?;
                self.copy_sign(")")?;
                self.postfix(found)
            }
            _ => {
                let found = self.primary()?;
                self.postfix(found)
            }
        }
    }

    /// A number, a value or a call.
    fn primary(&mut self) -> Result<Type, Failure> {
        let token = self.peek();
        match token.kind {
            TokenKind::Number => Ok(self.number()),
            TokenKind::Name if matches!(token.text, "true" | "false") => {
                self.copy();
                Ok(Type::Bool)
            }
            TokenKind::Name if token.text == "bitcast" => self.bitcast(),
            TokenKind::Name if self.peek_at(1).text == "(" => self.call(),
            TokenKind::Name => self.value(),
            _ => Err(self.unknown("an operand")),
        }
    }

    fn number(&mut self) -> Type {
        let text = self.peek().text;
        let hexadecimal = text.starts_with("0x");
        let (text, found) = if text.ends_with('u') {
            (text.to_owned(), Type::Word)
        } else if !hexadecimal && text.contains(['.', 'e', 'f']) {
            (format!("{}f", text.trim_end_matches('f')), Type::Float)
        } else {
            (text.to_owned(), Type::Integer)
        };
        self.write(&text);
        found
    }

    fn value(&mut self) -> Result<Type, Failure> {
        let text = self.peek().text;
        if self.declaring.as_deref() == Some(text) {
            let message =
                format!("'{text}' is used where it is declared, which C++ takes for itself");
            return Err(self.failure(message));
        }
        let Some(found) = self.type_of(text) else {
            return Err(self.unknown("a value"));
        };
        self.used.insert(text.to_owned());
        if matches!(found, Type::Pointer(_))
            && matches!(self.peek_at(1).text, "," | ")")
            && !self.is_pointed_at()
        {
            self.changed.insert(text.to_owned());
        }
        if text == "specula_tables" {
            self.write("SPECULA_TABLES");
        } else {
            self.write(&name(text));
        }
        Ok(found)
    }

    /// Whether the word before the next one is `*`.
    fn is_pointed_at(&self) -> bool {
        self.last().is_some_and(|last| last.text == "*")
    }

    fn call(&mut self) -> Result<Type, Failure> {
        let text = self.peek().text;
        let is_function = self.scope.functions.contains_key(text);
        if self.declaring.as_deref() == Some(text) || is_function && self.is_local(text) {
            return Err(self.failure(format!("C++ takes '{text}' for the variable of that name")));
        }
        if let Some(fields) = self.scope.structures.get(text) {
            let count = fields.len();
            self.write(text);
            let given = self.arguments(["{", "}"])?;
            if given.len() != count {
                return Err(self.failure(format!("'{text}' has {count} fields")));
            }
            return Ok(Type::Structure(text.to_owned()));
        }
        if let Some(signature) = self.scope.functions.get(text) {
            let result = signature.result.clone();
            self.called.insert(text.to_owned());
            self.write(text);
            self.arguments(["(", ")"])?;
            return Ok(result);
        }
        if let Some(found) = Type::plain(text) {
            return self.conversion(found);
        }
        self.write("");
        let place = self.out.len();
        let given = self.arguments(["(", ")"])?;
        let found = builtin(text, &given);
        let of_floats = of_floats(text, &given);
        if of_floats.is_none() {
            self.take(text, &given);
        }
        self.out.insert_str(place, of_floats.unwrap_or(text));
        found.ok_or_else(|| self.failure(format!("'{text}' is no known function")))
    }

    /// `f32(count)`, `vec3f(a, b, c)`.
    fn conversion(&mut self, to: Type) -> Result<Type, Failure> {
        if to != Type::Word {
            self.write(&to.name());
            let given = self.arguments(["(", ")"])?;
            self.take(&to.name(), &given);
            return Ok(to);
        }
        self.write("");
        let place = self.out.len();
        let given = self.arguments(["(", ")"])?;
        match given[..] {
            [Type::Float] => {
                self.take("to_u32", &given);
                self.out.insert_str(place, "to_u32");
            }
            [Type::Word | Type::Integer | Type::Bool] => self.out.insert_str(place, "uint32_t"),
            _ => return Err(self.failure("a word of neither a number nor a condition")),
        }
        Ok(to)
    }

    fn bitcast(&mut self) -> Result<Type, Failure> {
        self.write("");
        let place = self.out.len();
        self.skip_sign("<")?;
        let to = self.read_type()?;
        self.skip_sign(">")?;
        let given = self.arguments(["(", ")"])?;
        let function = match (&to, &given[..]) {
            (Type::Word, [Type::Float]) | (Type::Words(3), [Type::Floats(3)]) => "bits_of",
            (Type::Float, [Type::Word]) | (Type::Floats(3), [Type::Words(3)]) => "float_of",
            _ => return Err(self.failure("bits of other types")),
        };
        self.take(function, &given);
        self.out.insert_str(place, function);
        Ok(to)
    }

    /// Arguments in brackets, which C++ may write another way; no comma behind the last one.
    fn arguments(&mut self, brackets: [&str; 2]) -> Result<Vec<Type>, Failure> {
        self.expect("(")?;
        self.write(brackets[0]);
        let mut types = Vec::new();
        while self.peek().text != ")" {
            types.push(self.expression()?);
            if self.peek().text == "," && self.peek_at(1).text == ")" {
                self.skip();
            } else if self.peek().text == "," {
                self.copy();
            }
        }
        self.write(brackets[1]);
        Ok(types)
    }

    /// Members, components and elements.
    fn postfix(&mut self, mut found: Type) -> Result<Type, Failure> {
        loop {
            match self.peek().text {
                "." => {
                    self.copy();
                    found = self.member(found.target().clone())?;
                }
                "[" => {
                    self.copy();
                    self.expression()?;
                    self.copy_sign("]")?;
                    found = match found.target() {
                        Type::Array(element, _) => (**element).clone(),
                        Type::Floats(n) => {
                            self.take(&format!("vec{n}f[]"), &[]);
                            Type::Float
                        }
                        _ => {
                            return Err(
                                self.failure("elements of neither an array nor a vector of floats")
                            );
                        }
                    };
                }
                _ => return Ok(found),
            }
        }
    }

    fn member(&mut self, of: Type) -> Result<Type, Failure> {
        let text = self.peek().text;
        if let Some((found, written)) = components(&of, text) {
            if let Some(function) = written.strip_suffix("()") {
                self.take(&format!("{}.{function}", of.name()), &[]);
            }
            self.write(&written);
            return Ok(found);
        }
        let Type::Structure(structure) = &of else {
            return Err(self.unknown("a component"));
        };
        let fields = &self.scope.structures[structure];
        let Some((field, found)) = fields.iter().find(|(field, _)| field == text) else {
            return Err(self.failure(format!("'{structure}' has no field '{text}'")));
        };
        let (field, found) = (name(field), found.clone());
        self.write(&field);
        Ok(found)
    }
}
