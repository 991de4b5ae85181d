//! The items of module scope in a text that naga has written.

/// An item, whole lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Item<'a> {
    pub(crate) kind: ItemKind,
    /// What it declares; nothing where `kind` is `Other`.
    pub(crate) name: &'a str,
    pub(crate) text: &'a str,
}

/// What an item is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ItemKind {
    Function,
    Struct,
    Constant,
    /// Directives, type names, buffers, empty lines.
    Other,
}

/// The items of a text in order; together they are the text.
pub(crate) fn items(text: &str) -> Vec<Item<'_>> {
    let mut items = Vec::new();
    let (mut start, mut end, mut depth) = (0, 0, 0_usize);
    for line in text.split_inclusive('\n') {
        end += line.len();
        for c in line.chars() {
            match c {
                '(' | '{' => depth += 1,
                ')' | '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        let line = line.trim_end();
        let whole = line.is_empty() || line.starts_with(['#', '/']) || line.ends_with([';', '}']);
        // HLSL has the opening brace of a function on its own line.
        if depth == 0 && whole {
            items.push(item(&text[start..end]));
            start = end;
        }
    }
    if start < text.len() {
        items.push(item(&text[start..]));
    }
    items
}

fn item(text: &str) -> Item<'_> {
    let head = text.lines().next().unwrap_or("");
    let words = || identifiers(head).map(|(at, word)| (head[at + word.len()..].trim_start(), word));
    let constant = ["const ", "static const ", "constant "];
    let (kind, name) = if head.starts_with("struct ") {
        (ItemKind::Struct, words().nth(1))
    } else if constant.iter().any(|c| head.starts_with(c)) {
        let name = words().find(|(rest, _)| rest.starts_with(['=', '[']));
        (ItemKind::Constant, name)
    } else if text.trim_end().ends_with('}') && !head.starts_with("layout") {
        let name = words().find(|(rest, _)| rest.starts_with('('));
        (ItemKind::Function, name)
    } else {
        (ItemKind::Other, None)
    };
    match name {
        Some((_, name)) => Item { kind, name, text },
        None => Item {
            kind: ItemKind::Other,
            name: "",
            text,
        },
    }
}

/// The identifiers of a text with where they begin; members and what a name space qualifies are left
/// out.
pub(crate) fn identifiers(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_part = |c: char| c == '_' || c.is_ascii_alphanumeric();
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let start = at + text[at..].find(is_part)?;
            let length = text[start..].find(|c| !is_part(c));
            at = length.map_or(text.len(), |l| start + l);
            let word = &text[start..at];
            let qualified = text[..start].ends_with(['.', ':']) && !text[..start].ends_with(" :");
            if !word.starts_with(|c: char| c.is_ascii_digit()) && !qualified {
                return Some((start, word));
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_of_every_kind() {
        let text = "// language\n#include <x>\n\nstruct Pair {\n    float a;\n};\n\
                    static const float ARR[2] = F(1.0, 2.0);\nconstant uint N = 3u;\n\
                    layout(std430) readonly buffer b { float t[]; };\n\
                    float f(float x)\n{\n    if (x) {\n    }\n    return x;\n}\n\
                    metal::float2 g(\n    float x\n) {\n    return x;\n}\n";
        let found = items(text);
        assert_eq!(found.iter().map(|i| i.text).collect::<String>(), text);
        let named: Vec<_> = found.iter().filter(|i| i.kind != ItemKind::Other).collect();
        let rows: Vec<_> = named.iter().map(|i| (i.kind, i.name)).collect();
        assert_eq!(
            rows,
            [
                (ItemKind::Struct, "Pair"),
                (ItemKind::Constant, "ARR"),
                (ItemKind::Constant, "N"),
                (ItemKind::Function, "f"),
                (ItemKind::Function, "g"),
            ]
        );
        assert!(named[3].text.ends_with("return x;\n}\n"), "{:?}", named[3]);
    }

    #[test]
    fn members_and_numbers_are_no_identifiers() {
        let words: Vec<&str> = identifiers("metal::max(a.xy_1, 1.0e5, _b) ? c : d_2")
            .map(|(_, w)| w)
            .collect();
        assert_eq!(words, ["metal", "a", "_b", "c", "d_2"]);
    }
}
