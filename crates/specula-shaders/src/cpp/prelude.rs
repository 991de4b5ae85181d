//! The vectors and functions of WGSL that the header begins with; or those of them that a text needs.

use std::collections::BTreeSet;

use crate::items::identifiers;

/// All of it.
pub(crate) const WHOLE: &str = include_str!("prelude.hpp");

/// Where its declarations begin, and what closes them.
const OPEN: &str = "namespace specula {\n";
const CLOSE: &str = "} // namespace specula\n";

/// What comparisons of vectors give; it has a name in them alone.
const COMPARED: [(&str, [&str; 2]); 2] =
    [("vec2b", ["any", "select"]), ("vec3b", ["any", "select"])];

/// The prelude without types that a text has no need of, and functions that it does not call.
///
/// Operators stay where the vectors do that they are of.
pub(crate) fn needed(text: &str) -> String {
    let (head, rest) = WHOLE.split_once(OPEN).unwrap_or((WHOLE, ""));
    let body = rest.strip_suffix(CLOSE).unwrap_or(rest);
    let items = items(body);
    let types: BTreeSet<&str> = items.iter().filter_map(|item| item.structure).collect();
    let mut words: BTreeSet<&str> = code_words(text).collect();
    for (name, calls) in COMPARED {
        if calls.iter().any(|call| words.contains(call)) {
            words.insert(name);
        }
    }
    // What is kept can need more.
    loop {
        let before = words.len();
        for item in &items {
            if item.is_needed(&words, &types) {
                words.extend(code_words(item.text));
            }
        }
        if words.len() == before {
            break;
        }
    }
    let kept = items.iter().filter(|item| item.is_needed(&words, &types));
    let mut kept: String = kept.map(|item| item.text).collect();
    while kept.contains("\n\n\n") {
        kept = kept.replace("\n\n\n", "\n\n");
    }
    format!("{head}{OPEN}\n{}\n\n{CLOSE}", kept.trim_matches('\n'))
}

/// The words of a text but for its comments.
fn code_words(text: &str) -> impl Iterator<Item = &str> {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    code.flat_map(|code| identifiers(code).map(|(_, word)| word))
}

/// A declaration with its documentation, or a comment of its own.
struct Item<'a> {
    text: &'a str,
    /// Name of a structure.
    structure: Option<&'a str>,
    /// Name of a function that is no operator.
    function: Option<&'a str>,
}

impl Item<'_> {
    /// * `words`: of what is kept; `types`: the prelude's structures.
    fn is_needed(&self, words: &BTreeSet<&str>, types: &BTreeSet<&str>) -> bool {
        if let Some(name) = self.structure {
            return words.contains(name);
        }
        let are_there = || {
            let mut named = code_words(self.text).filter(|word| types.contains(word));
            named.all(|word| words.contains(word))
        };
        match self.function {
            Some("from_xy" | "from_xyz" | "to") => are_there(),
            Some(name) => words.contains(name) && are_there(),
            None => are_there(),
        }
    }
}

/// The declarations of the prelude, each with the comments and empty lines in front of it.
fn items(body: &str) -> Vec<Item<'_>> {
    let mut items = Vec::new();
    let (mut begin, mut at, mut depth) = (0, 0, 0_usize);
    for line in body.split_inclusive('\n') {
        at += line.len();
        depth += line.matches('{').count();
        depth = depth.saturating_sub(line.matches('}').count());
        let is_code = !line.trim().is_empty() && !line.starts_with("//");
        if is_code && depth == 0 && line.trim_end().ends_with(['}', ';']) {
            items.push(item(&body[begin..at]));
            begin = at;
        }
    }
    items
}

fn item(text: &str) -> Item<'_> {
    let mut lines = text
        .lines()
        .skip_while(|l| l.is_empty() || l.starts_with("//"));
    let head = lines.next().unwrap_or("");
    let structure = head.strip_prefix("struct ").and_then(|rest| {
        let (_, name) = identifiers(rest).next()?;
        Some(name)
    });
    let call = identifiers(head).find(|(at, word)| head[at + word.len()..].starts_with('('));
    let function = call.map(|(_, name)| name).filter(|_| structure.is_none());
    Item {
        text,
        structure,
        function,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_items_are_the_prelude() {
        let body = WHOLE.split_once(OPEN).unwrap().1;
        let body = body.strip_suffix(CLOSE).unwrap();
        let items = items(body);
        let whole: String = items.iter().map(|i| i.text).collect();
        assert_eq!(whole.trim_end(), body.trim_end());
        let structures: Vec<&str> = items.iter().filter_map(|i| i.structure).collect();
        assert_eq!(
            structures,
            [
                "vec2f", "vec3f", "vec4f", "vec2u", "vec3u", "vec2b", "vec3b"
            ]
        );
        let functions = items.iter().filter_map(|i| i.function);
        let functions: BTreeSet<&str> = functions.collect();
        for name in ["min", "dot", "select", "to_u32", "from_xyz", "clamp"] {
            assert!(functions.contains(name), "{name} of {functions:?}");
        }
    }

    #[test]
    fn what_is_not_needed_goes() {
        let text = needed("float f(vec2f v) {\n    return min(v.x, v.y); // vec4f, dot(v, v)\n}\n");
        for there in [
            "struct vec2f",
            "float min(float",
            "operator+(vec2f a",
            "from_xy(",
        ] {
            assert!(text.contains(there), "{there} in\n{text}");
        }
        for gone in ["vec3f", "vec4f", "vec2u", "dot(", "to_u32", "select"] {
            assert!(!text.contains(gone), "{gone} in\n{text}");
        }
        let text = needed("x = clamp(length(vec3f(1.0f)), 0.0f, 1.0f);");
        for there in [
            "struct vec2f",
            "struct vec3f",
            "float dot(vec3f",
            "T clamp(T",
            "float max(float",
        ] {
            assert!(text.contains(there), "{there} in\n{text}");
        }
        assert!(needed("any(v >= w); vec2f v;").contains("vec2b operator>="));
    }
}
