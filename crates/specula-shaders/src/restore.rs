//! Names as the WGSL has them.
//!
//! naga makes names of arguments and variables unique over a whole text: the second function with an
//! `alpha` gets `alpha_1`, the third `alpha_2`. No name of our WGSL ends in a digit, so that these can be
//! told and taken back, function by function.

use std::collections::{BTreeMap, BTreeSet};

use crate::items::{ItemKind, identifiers, items};

/// The text with `alpha_7` written `alpha` in every function that has one `alpha` only; where there are
/// more, they are counted within the function.
pub(crate) fn restore_names(text: &str) -> String {
    let items = items(text);
    let declared: BTreeSet<&str> = items.iter().map(|i| i.name).collect();
    // What stands outside of functions keeps its name.
    let outside = items.iter().filter(|i| i.kind != ItemKind::Function);
    let mut fixed = declared.clone();
    fixed.extend(outside.flat_map(|i| identifiers(i.text).map(|(_, word)| word)));
    let words: BTreeSet<&str> = identifiers(text).map(|(_, w)| w).collect();
    let mut restored = String::with_capacity(text.len());
    for item in &items {
        if item.kind == ItemKind::Function {
            let names = names(item.text, &fixed, &declared, &words);
            restored += &replaced(item.text, &names);
        } else {
            restored += item.text;
        }
    }
    restored
}

/// New names of a function's own things.
///
/// * `fixed`: names that stay as they are; `declared`: names that nothing else may get; `words`: all of
///   the text.
fn names<'a>(
    function: &'a str,
    fixed: &BTreeSet<&str>,
    declared: &BTreeSet<&str>,
    words: &BTreeSet<&'a str>,
) -> BTreeMap<&'a str, String> {
    let mut variants: BTreeMap<&str, BTreeSet<(u32, &str)>> = BTreeMap::new();
    for (_, word) in identifiers(function) {
        if let Some((base, number)) = numbered(word)
            && !fixed.contains(word)
        {
            variants.entry(base).or_default().insert((number, word));
        }
    }
    let mut names = BTreeMap::new();
    for (base, numbered) in variants {
        // A reserved word got an underscore when it was first used.
        let reserved = format!("{base}_");
        let plain = match words.get(reserved.as_str()) {
            Some(reserved) => reserved,
            None => base,
        };
        let used = identifiers(function).any(|(_, w)| w == plain) || declared.contains(plain);
        for (count, (_, word)) in (u32::from(used)..).zip(numbered) {
            let name = match count {
                0 => plain.to_owned(),
                n => format!("{base}_{n}"),
            };
            names.insert(word, name);
        }
    }
    names
}

/// `alpha_7` as `alpha` and 7.
fn numbered(word: &str) -> Option<(&str, u32)> {
    let (base, number) = word.rsplit_once('_')?;
    let named = base.contains(|c: char| c.is_ascii_alphabetic());
    let number = number.parse().ok().filter(|_| named)?;
    Some((base, number))
}

fn replaced(text: &str, names: &BTreeMap<&str, String>) -> String {
    let mut result = String::with_capacity(text.len());
    let mut end = 0;
    for (at, word) in identifiers(text) {
        if let Some(name) = names.get(word) {
            result += &text[end..at];
            result += name;
            end = at + word.len();
        }
    }
    result + &text[end..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_function_gets_its_names_back() {
        let text = "struct Type_3 {\n    float wi_1;\n};\n\
                    float f(float alpha) {\n    return alpha;\n}\n\
                    float g(float alpha_1, float sample_) {\n    return alpha_1 * t.wi_1;\n}\n\
                    Type_3 h(float alpha_2, float alpha_3, float f_1, float sample_1) {\n\
                    \x20   float _e12 = f(alpha_2) + alpha_3 + f_1 + sample_1;\n    return Type_3(_e12);\n}\n";
        let expected = "struct Type_3 {\n    float wi_1;\n};\n\
                    float f(float alpha) {\n    return alpha;\n}\n\
                    float g(float alpha, float sample_) {\n    return alpha * t.wi_1;\n}\n\
                    Type_3 h(float alpha, float alpha_1, float f_1, float sample_) {\n\
                    \x20   float _e12 = f(alpha) + alpha_1 + f_1 + sample_;\n    return Type_3(_e12);\n}\n";
        assert_eq!(restore_names(text), expected);
        assert_eq!(restore_names(expected), expected);
    }
}
