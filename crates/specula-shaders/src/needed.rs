//! Functions and what they need: the declarations of modules that some functions reach, and nothing else.

use std::collections::{BTreeMap, BTreeSet};

use crate::declarations::{DeclarationKind, declared};
use crate::error::ComposeError;
use crate::items::identifiers;
use crate::modules::Module;
use crate::names::nearest;

/// A module of which a part is left.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    path: String,
    text: String,
}

impl Part {
    /// As modules are taken.
    pub(crate) fn module(&self) -> Module<'_> {
        Module {
            path: &self.path,
            text: &self.text,
        }
    }
}

/// Letters of a line of a comment.
const WIDTH: usize = 110;

/// The modules with the declarations that `functions` need; all of them where none is named.
///
/// Of what a file says of itself, the first sentence stays where only a part of the file does.
///
/// * `modules`: each behind those that it imports.
/// * `prefix`: put in front of every name but that of the tables.
///
/// # Errors
///
/// A function that is not there.
pub(crate) fn parts(
    modules: &[Module<'static>],
    functions: &[&str],
    prefix: &str,
) -> Result<Vec<Part>, ComposeError> {
    let mut parts = match functions {
        [] => whole(modules),
        wanted => reached(modules, wanted)?,
    };
    if !prefix.is_empty() {
        let texts: Vec<&str> = parts.iter().map(|p| p.text.as_str()).collect();
        let names = texts
            .iter()
            .flat_map(|text| text.lines().filter_map(declared));
        let names: BTreeSet<String> = names
            .filter(|(kind, _)| *kind != DeclarationKind::Variable)
            .map(|(_, name)| name.to_owned())
            .collect();
        for part in &mut parts {
            part.text = prefixed(&part.text, &names, prefix);
        }
    }
    Ok(parts)
}

fn whole(modules: &[Module<'static>]) -> Vec<Part> {
    let part = |module: &Module<'static>| Part {
        path: module.path.to_owned(),
        text: module.text.to_owned(),
    };
    modules.iter().map(part).collect()
}

fn reached(modules: &[Module<'static>], wanted: &[&str]) -> Result<Vec<Part>, ComposeError> {
    let codes: Vec<String> = modules.iter().map(Module::code).collect();
    let pieces: Vec<Vec<Piece<'_>>> = codes.iter().map(|code| pieces(code)).collect();
    let all = || pieces.iter().flatten();
    let by_name: BTreeMap<&str, &Piece<'_>> = all().map(|piece| (piece.name, piece)).collect();
    let mut open: Vec<&str> = Vec::new();
    for name in wanted {
        let is_function = |p: &&Piece<'_>| p.kind == DeclarationKind::Function;
        let found = by_name.get(name).copied().filter(|p| is_function(p));
        open.push(found.map(|p| p.name).ok_or_else(|| {
            let names = all().filter(is_function).map(|p| p.name);
            ComposeError::UnknownFunction {
                name: (*name).to_owned(),
                nearest: nearest(name, names)
                    .into_iter()
                    .map(str::to_owned)
                    .collect(),
            }
        })?);
    }
    let mut needed = BTreeSet::new();
    while let Some(name) = open.pop() {
        if let Some(piece) = by_name.get(name)
            && needed.insert(piece.name)
        {
            open.extend(piece.used());
        }
    }
    let parts = modules.iter().zip(&pieces).filter_map(|(module, pieces)| {
        let kept: Vec<&str> = pieces
            .iter()
            .filter(|piece| needed.contains(piece.name))
            .map(|piece| piece.text.trim_matches('\n'))
            .collect();
        let head = match kept.len() == pieces.len() {
            true => head(module.text),
            false => summary(&module.summary()),
        };
        (!kept.is_empty()).then(|| Part {
            path: module.path.to_owned(),
            text: format!("{head}\n{}\n", kept.join("\n\n")),
        })
    });
    Ok(parts.collect())
}

/// A sentence as a comment.
fn summary(sentence: &str) -> String {
    let mut text = "//".to_owned();
    let mut length = text.len();
    for word in sentence.split_whitespace() {
        if length + 1 + word.len() > WIDTH {
            text += "\n//";
            length = 2;
        }
        text += " ";
        text += word;
        length += 1 + word.len();
    }
    text + "\n"
}

/// The comment that a file begins with.
fn head(text: &str) -> String {
    let lines = text.lines().take_while(|line| line.starts_with("//"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// A declaration with its documentation and attributes.
#[derive(Debug)]
struct Piece<'a> {
    kind: DeclarationKind,
    name: &'a str,
    text: &'a str,
}

impl<'a> Piece<'a> {
    /// The words of its code.
    fn used(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        let code = self
            .text
            .lines()
            .map(|line| line.split("//").next().unwrap_or(""));
        code.flat_map(|code| identifiers(code).map(|(_, word)| word))
    }
}

/// The declarations of a text without imports. A declaration begins with the comments and attributes in front of it.
fn pieces(code: &str) -> Vec<Piece<'_>> {
    // Where declarations begin, with what they declare.
    let mut begins: Vec<(usize, DeclarationKind, &str)> = Vec::new();
    let (mut before, mut at) = (None, 0);
    for line in code.split_inclusive('\n') {
        if let Some((kind, name)) = declared(line) {
            begins.push((before.take().unwrap_or(at), kind, name));
        } else if line.starts_with("//") || line.starts_with('@') {
            before = before.or(Some(at));
        } else if line.trim().is_empty() {
            // The comment of a file is not that of its first declaration.
            before = None;
        }
        at += line.len();
    }
    let ends = begins.iter().skip(1).map(|(begin, ..)| *begin);
    let ends = ends.chain([code.len()]);
    begins
        .iter()
        .zip(ends)
        .map(|(&(begin, kind, name), end)| Piece {
            kind,
            name,
            text: &code[begin..end],
        })
        .collect()
}

fn prefixed(text: &str, names: &BTreeSet<String>, prefix: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut end = 0;
    for (at, word) in identifiers(text) {
        if names.contains(word) {
            result += &text[end..at];
            result += prefix;
            end = at;
        }
    }
    result + &text[end..]
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODULES: [Module<'static>; 2] = [
        Module {
            path: "a/first",
            text: "// First things. And more.\n\n/// One.\nconst FIRST_ONE: f32 = 1.0;\n\n/// A pair.\n///\n/// See first_other.\n\
                   struct FirstPair {\n    /// a.\n    a: f32,\n}\n\n/// F.\nfn first_f() -> f32 {\n    return FIRST_ONE; // first_other\n}\n\n\
                   /// Other.\nfn first_other() -> f32 {\n    return 2.0;\n}\n",
        },
        Module {
            path: "b/second",
            text: "// Second.\n\nimport package::a::first::{FirstPair, first_f};\n\n/// G.\n@must_use\nfn second_g(p: FirstPair) -> f32 {\n    return p.a * first_f();\n}\n",
        },
    ];

    fn texts(functions: &[&str], prefix: &str) -> Vec<String> {
        let parts = parts(&MODULES, functions, prefix).unwrap();
        parts.into_iter().map(|p| p.text).collect()
    }

    #[test]
    fn what_functions_call_comes_with_them_and_nothing_else() {
        assert_eq!(
            texts(&["second_g"], ""),
            [
                "// First things.\n\n/// One.\nconst FIRST_ONE: f32 = 1.0;\n\n/// A pair.\n///\n/// See first_other.\n\
                 struct FirstPair {\n    /// a.\n    a: f32,\n}\n\n/// F.\nfn first_f() -> f32 {\n    return FIRST_ONE; // first_other\n}\n",
                "// Second.\n\n/// G.\n@must_use\nfn second_g(p: FirstPair) -> f32 {\n    return p.a * first_f();\n}\n",
            ]
        );
        let other = texts(&["first_other"], "");
        assert_eq!(
            other,
            ["// First things.\n\n/// Other.\nfn first_other() -> f32 {\n    return 2.0;\n}\n"]
        );
        assert_eq!(texts(&[], ""), MODULES.map(|m| m.text));
    }

    #[test]
    fn names_get_their_prefix_and_members_do_not() {
        let texts = texts(&["second_g"], "my_");
        assert!(
            texts[1].contains(
                "fn my_second_g(p: my_FirstPair) -> f32 {\n    return p.a * my_first_f();"
            ),
            "{}",
            texts[1]
        );
    }

    #[test]
    fn unknown_functions_are_told_with_their_neighbours() {
        let error = parts(&MODULES, &["second_h"], "").unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no function `second_h`; did you mean `second_g`?"
        );
        // A structure is no function.
        assert!(parts(&MODULES, &["FirstPair"], "").is_err());
    }

    #[test]
    fn every_declaration_is_a_piece() {
        for module in crate::modules::MODULES {
            let code = module.code();
            let names: Vec<&str> = pieces(&code).iter().map(|p| p.name).collect();
            let declared = crate::declarations::declarations(&code);
            let declared: Vec<&str> = declared.iter().map(|d| d.name).collect();
            assert_eq!(names, declared, "{}", module.path);
        }
    }
}
