//! Statements of WGSL as C++.

use std::collections::BTreeMap;

use super::error::Failure;
use super::lexer::TokenKind;
use super::printer::Printer;
use super::types::{Type, name};

impl Printer<'_> {
    /// Writes statements in braces.
    pub(super) fn block(&mut self) -> Result<(), Failure> {
        self.locals.push(BTreeMap::new());
        self.copy_sign("{")?;
        while self.peek().text != "}" {
            self.statement()?;
        }
        self.copy();
        self.locals.pop();
        Ok(())
    }

    fn statement(&mut self) -> Result<(), Failure> {
        match self.peek().text {
            "let" | "var" | "const" => {
                self.declaration()?;
                self.copy_sign(";")
            }
            "if" => self.branch(),
            "for" => self.counted_loop(),
            "while" => {
                self.write("while");
                self.condition()?;
                self.block()
            }
            "switch" => self.switch(),
            "return" => {
                self.copy();
                if self.peek().text != ";" {
                    self.expression()?;
                }
                self.copy_sign(";")
            }
            "break" | "continue" => {
                self.copy();
                self.copy_sign(";")
            }
            "{" => self.block(),
            _ if self.peek().kind == TokenKind::Name
                || self.peek().text.starts_with(['*', '(']) =>
            {
                self.assignment()?;
                self.copy_sign(";")
            }
            _ => Err(self.unknown("a statement")),
        }
    }

    /// `let`, `var` or `const`, without the semicolon.
    fn declaration(&mut self) -> Result<(), Failure> {
        let keyword = self.peek();
        self.skip();
        let declared = self.peek().text;
        self.skip();
        let mut found = None;
        if self.peek().text == ":" {
            self.skip();
            found = Some(self.read_type()?);
        }
        self.keep_before(keyword);
        if self.peek().text != "=" {
            let Some(found) = found else {
                return Err(self.unknown("a declaration"));
            };
            let array = matches!(found, Type::Array(..));
            self.out += &found.declared(&name(declared));
            self.out += if array { " = {}" } else { "{}" };
            self.declare(declared, found);
            return Ok(());
        }
        let place = self.out.len();
        self.copy();
        self.declaring = Some(declared.to_owned());
        let given = self.expression()?;
        self.declaring = None;
        let found = found.unwrap_or(given);
        let constant = match keyword.text {
            "var" => "",
            "let" => "const ",
            _ => "constexpr ",
        };
        if matches!(
            found,
            Type::Array(..) | Type::Pointer(_) | Type::Integer | Type::Nothing
        ) {
            return Err(self.failure(format!(
                "'{declared}' is neither a number, a vector nor a structure"
            )));
        }
        let value = self.out.split_off(place);
        self.out += &format!("{constant}{}", found.declared(&name(declared)));
        self.out += constructed(&value, &found).as_deref().unwrap_or(&value);
        self.declare(declared, found);
        Ok(())
    }

    /// An assignment or a call, without the semicolon.
    fn assignment(&mut self) -> Result<(), Failure> {
        if self.peek().text == "_" {
            return Err(self.unknown("a statement"));
        }
        let target = (0..).map(|ahead| self.peek_at(ahead));
        let target = target.map(|t| t.text).find(|t| !matches!(*t, "(" | "*"));
        let changed = self.expression()?;
        if self.peek().text != ";" {
            self.changed.extend(target.map(str::to_owned));
        }
        match self.peek().text {
            ";" => Ok(()),
            "++" | "--" => {
                self.copy();
                Ok(())
            }
            sign @ ("=" | "+=" | "-=" | "*=" | "/=") => {
                self.copy();
                let given = self.expression()?;
                self.take(&format!("operator{sign}"), &[changed, given]);
                Ok(())
            }
            _ => Err(self.unknown("a statement")),
        }
    }

    /// A condition, in the brackets that C++ wants.
    fn condition(&mut self) -> Result<(), Failure> {
        self.out += " (";
        self.drop_before();
        self.expression()?;
        self.out.push(')');
        Ok(())
    }

    fn branch(&mut self) -> Result<(), Failure> {
        self.copy();
        self.condition()?;
        self.block()?;
        if self.peek().text != "else" {
            return Ok(());
        }
        self.copy();
        if self.peek().text == "if" {
            return self.branch();
        }
        self.block()
    }

    fn counted_loop(&mut self) -> Result<(), Failure> {
        self.locals.push(BTreeMap::new());
        self.copy();
        self.copy_sign("(")?;
        self.declaration()?;
        self.copy_sign(";")?;
        self.expression()?;
        self.copy_sign(";")?;
        self.assignment()?;
        self.copy_sign(")")?;
        self.block()?;
        self.locals.pop();
        Ok(())
    }

    /// A choice between values; where a case of WGSL ends, C++ needs `break`.
    fn switch(&mut self) -> Result<(), Failure> {
        self.copy();
        self.condition()?;
        self.copy_sign("{")?;
        while self.peek().text != "}" {
            let indent = self.peek().before.to_owned();
            match self.peek().text {
                "default" => self.copy(),
                "case" => {
                    self.copy();
                    self.expression()?;
                    while self.peek().text == "," {
                        self.skip();
                        self.out += &format!(":{indent}case");
                        self.expression()?;
                    }
                }
                _ => return Err(self.unknown("a case")),
            }
            self.copy_sign(":")?;
            self.block()?;
            self.end_case(&indent);
        }
        self.copy();
        Ok(())
    }

    /// Adds `break` to the block written last, unless that returns.
    fn end_case(&mut self, indent: &str) {
        let body = self.out.trim_end_matches('}').trim_end().len();
        let last = self.out[..body]
            .lines()
            .next_back()
            .unwrap_or("")
            .trim_start();
        let leaves = last.starts_with("return") || matches!(last, "break;" | "continue;");
        if !leaves {
            self.out.truncate(body);
            self.out += &format!("{indent}    break;{indent}}}");
        }
    }
}

/// ` = vec3f(x, y, z)` as `{x, y, z}`, where the value is a constructor of the type and nothing more.
fn constructed(value: &str, found: &Type) -> Option<String> {
    if !matches!(found, Type::Floats(_) | Type::Words(_) | Type::Structure(_)) {
        return None;
    }
    let arguments = value.strip_prefix(" = ")?.strip_prefix(&found.name())?;
    let inside = arguments
        .strip_prefix(['(', '{'])?
        .strip_suffix([')', '}'])?;
    let mut depth = 0_usize;
    for c in inside.chars() {
        match c {
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    Some(format!("{{{inside}}}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructors_lose_their_name() {
        let two = |value| constructed(value, &Type::Floats(2));
        assert_eq!(two(" = vec2f(a, f(b))").as_deref(), Some("{a, f(b)}"));
        assert_eq!(two(" = vec2f(a) + vec2f(b)"), None);
        assert_eq!(two(" = f(a)"), None);
        assert_eq!(constructed(" = float(a)", &Type::Float), None);
    }
}
