//! What the prelude's functions call of the prelude, read from their text.
//!
//! Their bodies are expressions of C++ without side effects but assignments to a variable. Types are followed through
//! them, since which `min` is called depends on its arguments.

use std::collections::{BTreeMap, BTreeSet};

/// A function of the prelude.
pub(super) struct Function<'a> {
    name: &'a str,
    /// What it gives.
    result: &'a str,
    /// Types and names of its arguments.
    arguments: Vec<(&'a str, &'a str)>,
    /// What is behind its arguments.
    body: &'a str,
}

impl<'a> Function<'a> {
    /// The function that a text defines, from its first line on.
    pub(super) fn of(text: &'a str) -> Option<Self> {
        let open = text.find('(').filter(|_| !text.starts_with("//"))?;
        let close = open + text[open..].find(')')?;
        let (before, name) = text[..open].rsplit_once(' ')?;
        let argument = |argument: &'a str| {
            let argument = argument.trim_start_matches("const ");
            let (found, name) = argument.rsplit_once(' ').unwrap_or((argument, ""));
            (found.trim_end_matches('&'), name)
        };
        Some(Self {
            name,
            result: before.rsplit(' ').next()?.trim_end_matches('&'),
            arguments: text[open + 1..close].split(", ").map(argument).collect(),
            body: &text[close + 1..],
        })
    }

    /// `min(float,float)`.
    pub(super) fn signature(&self) -> String {
        let types: Vec<&str> = self.arguments.iter().map(|(found, _)| *found).collect();
        format!("{}({})", self.name, types.join(","))
    }

    /// The type that `T` is where it is called with these arguments; itself where it has none.
    fn bound<'t>(&self, arguments: &[&'t str]) -> Option<&'t str> {
        let mut bound = "T";
        let fits = self.arguments.len() == arguments.len()
            && self
                .arguments
                .iter()
                .zip(arguments)
                .all(|((own, _), given)| {
                    let is_new = *own == "T" && bound == "T";
                    bound = if is_new { given } else { bound };
                    *own == *given || *own == "T" && bound == *given
                });
        fits.then_some(bound)
    }
}

/// Functions by their names.
pub(super) struct Functions<'a>(pub(super) Vec<Function<'a>>);

impl Functions<'_> {
    /// These signatures, and those of all functions that they call.
    pub(super) fn closed(&self, taken: &BTreeSet<String>) -> BTreeSet<String> {
        let mut closed = BTreeSet::new();
        let mut open: Vec<String> = taken.iter().cloned().collect();
        while let Some(signature) = open.pop() {
            if closed.insert(signature.clone()) {
                open.extend(self.callees(&signature));
            }
        }
        closed
    }

    /// What the function of a signature calls, and its template.
    pub(super) fn callees(&self, signature: &str) -> BTreeSet<String> {
        let Some((function, bound)) = self.find(signature) else {
            return BTreeSet::new();
        };
        let typed = |found: &str| if found == "T" { bound } else { found }.to_owned();
        let arguments = function.arguments.iter();
        let mut reader = Reader {
            functions: self,
            words: words(function.body).into_iter(),
            variables: arguments
                .map(|(found, name)| (*name, typed(found)))
                .collect(),
            called: BTreeSet::new(),
        };
        reader.body();
        reader.called.insert(function.signature());
        reader.called.remove(signature);
        reader.called
    }

    /// The function that a call is of, and what `T` is in it.
    fn find<'s>(&self, signature: &'s str) -> Option<(&Function<'_>, &'s str)> {
        let (name, arguments) = signature.trim_end_matches(')').split_once('(')?;
        let arguments: Vec<&str> = arguments.split(',').collect();
        let named = || self.0.iter().filter(|function| function.name == name);
        let found = |function| Function::bound(function, &arguments).map(|bound| (function, bound));
        let exact = named().find(|function| function.signature() == signature);
        exact.and_then(found).or_else(|| named().find_map(found))
    }
}

/// Names, numbers and signs of a text of C++ without comments.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_number = first.is_ascii_digit();
        let is_part = |c: char| c == '_' || c.is_ascii_alphanumeric() || is_number && c == '.';
        let is_double = ["<=", ">=", "==", "!=", "&&", "||"]
            .iter()
            .any(|sign| rest.starts_with(sign));
        let length = match rest.find(|c| !is_part(c)) {
            Some(0) => 1 + usize::from(is_double),
            length => length.unwrap_or(rest.len()),
        };
        words.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    words
}

/// How tightly an operator binds.
fn level(sign: &str) -> Option<usize> {
    let levels: [&[&str]; 7] = [
        &["="],
        &["?"],
        &["&&", "||"],
        &["<", ">", "<=", ">=", "==", "!="],
        &["&", "^"],
        &["+", "-"],
        &["*", "/"],
    ];
    levels.iter().position(|level| level.contains(&sign))
}

/// The level of comparisons.
const COMPARISON: usize = 3;

/// The vector type of a type's letter with these components.
fn vector(of: &str, components: usize) -> String {
    format!("vec{components}{}", &of[4..])
}

/// Reads a body.
struct Reader<'a> {
    functions: &'a Functions<'a>,
    words: std::vec::IntoIter<&'a str>,
    variables: BTreeMap<&'a str, String>,
    called: BTreeSet<String>,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> &'a str {
        self.words.as_slice().first().copied().unwrap_or("")
    }

    fn next(&mut self) -> &'a str {
        self.words.next().unwrap_or("")
    }

    fn body(&mut self) {
        while !self.peek().is_empty() {
            match self.words.as_slice() {
                ["{" | "}" | ";" | "return" | "const" | ":" | ",", ..] => {
                    self.next();
                }
                [found, name, ";", ..] => {
                    self.variables.insert(name, (*found).to_owned());
                    self.words.nth(1);
                }
                _ => {
                    self.expression(0);
                }
            }
        }
    }

    /// An expression of operators of this level and of those that bind more tightly; its type.
    fn expression(&mut self, least: usize) -> String {
        let mut left = self.operand();
        while let Some(level) = level(self.peek()).filter(|level| *level >= least) {
            let sign = self.next();
            let right = self.expression(level + usize::from(level > 1));
            if sign == "?" {
                self.next();
                self.expression(1);
                left = right;
            } else if sign != "=" {
                left = self.combined(sign, level, left, right);
            }
        }
        left
    }

    /// What an operator gives.
    fn combined(&mut self, sign: &str, level: usize, left: String, right: String) -> String {
        if left.starts_with("vec") || right.starts_with("vec") {
            return self.call(&format!("operator{sign}"), &[left, right]);
        }
        if level == COMPARISON {
            "bool".to_owned()
        } else {
            left
        }
    }

    /// What a function gives: one of C gives a float.
    fn call(&mut self, name: &str, arguments: &[String]) -> String {
        let signature = format!("{name}({})", arguments.join(","));
        let Some((function, bound)) = self.functions.find(&signature) else {
            return "float".to_owned();
        };
        let result = if function.result == "T" {
            bound
        } else {
            function.result
        };
        let result = result.to_owned();
        self.called.insert(signature);
        result
    }

    fn operand(&mut self) -> String {
        let word = self.next();
        let found = match word {
            "-" => {
                let found = self.operand();
                if found.starts_with("vec") {
                    return self.call("operator-", &[found]);
                }
                return found;
            }
            "&" | "*" | "sizeof" => return self.operand(),
            "(" => {
                let found = self.expression(0);
                self.next();
                found
            }
            "static_cast" => {
                let to = self.words.nth(1).unwrap_or("").to_owned();
                self.words.next();
                self.operand();
                to
            }
            _ if word.starts_with(|c: char| c.is_ascii_digit()) => if word.ends_with('u') {
                "uint32_t"
            } else {
                "float"
            }
            .to_owned(),
            _ if matches!(self.peek(), "(" | "{") => {
                let arguments = self.arguments();
                if word.starts_with("vec") {
                    self.called
                        .insert(format!("{word}({})", arguments.join(",")));
                    word.to_owned()
                } else {
                    self.call(word, &arguments)
                }
            }
            _ => self.variables.get(word).cloned().unwrap_or_default(),
        };
        self.members(found)
    }

    fn arguments(&mut self) -> Vec<String> {
        self.next();
        let mut types = Vec::new();
        while !matches!(self.peek(), ")" | "}" | "") {
            types.push(self.expression(0));
            if self.peek() == "," {
                self.next();
            }
        }
        self.next();
        types
    }

    /// Components and swizzles.
    fn members(&mut self, mut of: String) -> String {
        while self.peek() == "." {
            self.next();
            let member = self.next();
            of = if self.peek() == "(" {
                self.arguments();
                self.called.insert(format!("{of}.{member}()"));
                vector(&of, member.len())
            } else {
                match of.chars().last() {
                    Some('u') => "uint32_t",
                    Some('b') => "bool",
                    _ => "float",
                }
                .to_owned()
            };
        }
        of
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: [&str; 9] = [
        "INLINE float min(float a, float b) { return b < a ? b : a; }",
        "INLINE vec2f min(vec2f a, vec2f b) { return vec2f(min(a.x, b.x), min(a.y, b.y)); }",
        "INLINE vec2f operator/(vec2f v, float s) { return vec2f(v.x / s, v.y / s); }",
        "INLINE vec2f& operator/=(vec2f& v, float s) { return v = v / s; }",
        "INLINE float dot(vec2f a, vec2f b) { return a.x * b.x + a.y * b.y; }",
        "INLINE float length(vec2f v) {\n    return sqrtf(dot(v, v));\n}",
        "template <class T> INLINE T least(T a, T b) { return min(a, b); }",
        "INLINE bool f(vec2f v) { return -v.yx() / length(v) != vec2f(1.0f) ? 1.0f < v.x : v.y < 2.0f; }",
        "INLINE uint32_t bits(float x) {\n    uint32_t b;\n    copy(&b, &x, sizeof b);\n    return bits(b) + bits(x);\n}",
    ];

    fn functions() -> Functions<'static> {
        let mut all: Vec<_> = TEXT.iter().filter_map(|text| Function::of(text)).collect();
        let more = [
            "INLINE vec2f operator-(vec2f v) { return vec2f(-v.x, -v.y); }",
            "INLINE vec2b operator!=(vec2f a, vec2f b) { return vec2b{a.x != b.x, a.y != b.y}; }",
        ];
        all.extend(more.iter().filter_map(|text| Function::of(text)));
        Functions(all)
    }

    fn callees(signature: &str) -> Vec<String> {
        functions().callees(signature).into_iter().collect()
    }

    #[test]
    fn overloads_are_those_of_the_arguments() {
        assert_eq!(callees("min(float,float)"), [""; 0]);
        assert_eq!(
            callees("min(vec2f,vec2f)"),
            ["min(float,float)", "vec2f(float,float)"]
        );
        assert_eq!(callees("length(vec2f)"), ["dot(vec2f,vec2f)"]);
        assert_eq!(
            callees("operator/=(vec2f,float)"),
            ["operator/(vec2f,float)"]
        );
        assert_eq!(callees("bits(float)"), [""; 0]);
        assert_eq!(callees("sqrt(float)"), [""; 0]);
    }

    #[test]
    fn templates_call_what_their_type_has() {
        assert_eq!(
            callees("least(float,float)"),
            ["least(T,T)", "min(float,float)"]
        );
        assert_eq!(
            callees("least(vec2f,vec2f)"),
            ["least(T,T)", "min(vec2f,vec2f)"]
        );
        assert_eq!(callees("least(float,vec2f)"), [""; 0]);
    }

    #[test]
    fn operators_bind_as_in_cpp() {
        assert_eq!(
            callees("f(vec2f)"),
            [
                "length(vec2f)",
                "operator!=(vec2f,vec2f)",
                "operator-(vec2f)",
                "operator/(vec2f,float)",
                "vec2f(float)",
                "vec2f.yx()"
            ]
        );
    }

    #[test]
    fn what_callees_call_is_taken_too() {
        let closed = functions().closed(&["f(vec2f)".to_owned()].into());
        assert!(closed.contains("dot(vec2f,vec2f)"), "{closed:?}");
    }
}
