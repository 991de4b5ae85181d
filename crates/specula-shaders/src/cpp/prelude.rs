//! The vectors and functions of WGSL that the header begins with; or those of them that a text takes.

use std::collections::BTreeSet;

use super::callees::{Function, Functions};
use crate::items::identifiers;

/// All of it. It leaves the namespace open.
pub(crate) const WHOLE: &str = include_str!("prelude.hpp");

/// Where its declarations begin.
const OPEN: &str = "namespace specula {\n";

/// What its head has for functions of one line. In a short header they are functions like all others.
const INLINE: &str = "\
/// What stands in front of those that are a line.
#if defined(__GNUC__)
#define SPECULA_INLINE SPECULA_FN __attribute__((always_inline))
#else
#define SPECULA_INLINE SPECULA_FN
#endif

";

/// What its head has for integers.
const INTEGERS: &str = "\
#if defined(__CUDACC_RTC__)
using uint32_t = unsigned int;
#else
#include <math.h>
#include <stdint.h>
#include <string.h>
#endif
";

/// The prelude with what a text takes, and what that needs: no other type, constructor, swizzle, operator or function.
///
/// * `taken`: signatures, as [`signature`](super::types::signature) writes them.
pub(crate) fn needed(text: &str, taken: &BTreeSet<String>) -> String {
    let (head, body) = WHOLE.split_once(OPEN).unwrap_or((WHOLE, ""));
    let items = items(body);
    let taken = functions(&items).closed(taken);
    let types: BTreeSet<&str> = items.iter().filter_map(|item| item.structure).collect();
    let mut named: BTreeSet<&str> = code_words(text)
        .filter(|word| types.contains(word))
        .collect();
    // A structure that is kept can name others.
    let kept = loop {
        let kept = joined(&items, |item| item.kept(&taken, &named));
        let words: BTreeSet<&str> = code_words(&kept).collect();
        let before = named.len();
        named.extend(types.iter().filter(|name| words.contains(**name)));
        if named.len() == before {
            break kept;
        }
    };
    let kept = kept.replace("SPECULA_INLINE", "SPECULA_FN");
    let head = short_head(head, &(kept.clone() + text));
    format!("{head}{OPEN}\n{}\n", kept.trim_matches('\n'))
}

/// What stays of items; where one went that had an empty line in front of it, the next one gets that.
fn joined<'a>(items: &[Item<'a>], kept: impl Fn(&Item<'a>) -> Option<String>) -> String {
    let (mut text, mut gap) = (String::new(), false);
    for item in items {
        gap |= item.text.starts_with('\n');
        if let Some(kept) = kept(item) {
            text += if gap { "\n" } else { "" };
            text += kept.trim_start_matches('\n');
            gap = false;
        }
    }
    text
}

/// The head with the headers that a text needs.
fn short_head(head: &str, text: &str) -> String {
    let words: BTreeSet<&str> = code_words(text).collect();
    let integers = match (words.contains("uint32_t"), words.contains("memcpy")) {
        (_, true) => INTEGERS.to_owned(),
        (true, false) => INTEGERS.replace("#include <string.h>\n", ""),
        (false, false) => "#if !defined(__CUDACC_RTC__)\n#include <math.h>\n#endif\n".to_owned(),
    };
    head.replace(INLINE, "").replace(INTEGERS, &integers)
}

/// The words of a text but for its comments.
fn code_words(text: &str) -> impl Iterator<Item = &str> {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    code.flat_map(|code| identifiers(code).map(|(_, word)| word))
}

/// The functions of these declarations.
fn functions<'a>(items: &[Item<'a>]) -> Functions<'a> {
    let functions = items.iter().filter(|item| item.structure.is_none());
    let texts = functions.map(|item| item.text[item.head..].trim_end());
    Functions(texts.filter_map(Function::of).collect())
}

/// A declaration with its documentation.
struct Item<'a> {
    text: &'a str,
    /// Where the documentation ends.
    head: usize,
    /// Name of a structure.
    structure: Option<&'a str>,
    /// Of a function.
    signature: Option<String>,
}

impl Item<'_> {
    /// What stays of it.
    ///
    /// * `taken`: signatures of functions; `named`: structures.
    fn kept(&self, taken: &BTreeSet<String>, named: &BTreeSet<&str>) -> Option<String> {
        if let Some(name) = self.structure {
            return named
                .contains(name)
                .then(|| members(self.text, name, taken));
        }
        // Directions are exchanged with other libraries in any case.
        let is_kept = match self.signature.as_deref()? {
            "from_xyz(V)" | "to(vec3f)" => named.contains("vec3f"),
            signature => taken.contains(signature),
        };
        is_kept.then(|| self.text.to_owned())
    }
}

/// A structure without constructors and swizzles that are not taken; the one of all components and the one of none
/// stay.
fn members(text: &str, name: &str, taken: &BTreeSet<String>) -> String {
    let is_kept = |line: &&str| {
        let Some(signature) = signature_of(line.trim_start()) else {
            return true;
        };
        let Some((function, arguments)) = signature.split_once('(') else {
            return true;
        };
        let arguments = arguments.trim_end_matches(')');
        match function {
            "operator[]" => taken.contains(&format!("{name}[]()")),
            _ if function != name => taken.contains(&format!("{name}.{function}()")),
            _ if taken.contains(&signature) || arguments.is_empty() => true,
            _ => arguments.contains(',') && !arguments.contains("vec"),
        }
    };
    let lines = text.split_inclusive('\n').filter(is_kept);
    lines.collect::<String>().replace("\n\n}", "\n}")
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
    let lines = text.split_inclusive('\n');
    let before = lines.take_while(|l| l.trim().is_empty() || l.starts_with("//"));
    let start = before.map(str::len).sum();
    let head = text[start..].lines().next().unwrap_or("");
    let structure = head.strip_prefix("struct ").and_then(|rest| {
        let (_, name) = identifiers(rest).next()?;
        Some(name)
    });
    let signature = signature_of(head).filter(|_| structure.is_none());
    Item {
        text,
        head: start,
        structure,
        signature,
    }
}

/// The signature of the function that a line declares.
fn signature_of(line: &str) -> Option<String> {
    Function::of(line).map(|function| function.signature())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_items_are_the_prelude() {
        let body = WHOLE.split_once(OPEN).unwrap().1;
        let items = items(body);
        let whole: String = items.iter().map(|i| i.text).collect();
        assert_eq!(whole, body);
        let structures: Vec<&str> = items.iter().filter_map(|i| i.structure).collect();
        assert_eq!(
            structures,
            [
                "vec2f", "vec3f", "vec4f", "vec2u", "vec3u", "vec2b", "vec3b"
            ]
        );
        let functions = functions(&items);
        let signatures: BTreeSet<String> = items.into_iter().filter_map(|i| i.signature).collect();
        for known in [
            "min(float,float)",
            "dot(vec3f,vec3f)",
            "select(T,T,bool)",
            "select(vec3f,vec3f,vec3b)",
            "to_u32(float)",
            "from_xyz(V)",
            "operator-(vec2f)",
            "operator*=(vec3f,float)",
        ] {
            assert!(signatures.contains(known), "{known} of {signatures:?}");
        }
        for (signature, callees) in [
            (
                "normalize(vec3f)",
                &["length(vec3f)", "operator/(vec3f,float)"][..],
            ),
            (
                "clamp(vec3f,vec3f,vec3f)",
                &["clamp(T,T,T)", "max(vec3f,vec3f)", "min(vec3f,vec3f)"],
            ),
            ("to_u32(float)", &["max(float,float)", "min(float,float)"]),
            ("operator-=(vec2f,float)", &["operator-(vec2f,float)"]),
            ("fract(vec2f)", &["fract(float)"]),
            ("float_of(vec3u)", &["float_of(uint32_t)"]),
            ("bits_of(vec3f)", &["bits_of(float)"]),
            ("select(float,float,bool)", &["select(T,T,bool)"]),
            ("dot(vec3f,vec3f)", &[]),
        ] {
            let found = functions.callees(signature);
            let found: Vec<&str> = found
                .iter()
                .map(String::as_str)
                .filter(|f| !f.starts_with("vec"))
                .collect();
            assert_eq!(found, callees, "{signature}");
        }
        for part in [INLINE, INTEGERS] {
            assert!(WHOLE.contains(part), "{part}");
        }
    }

    /// The short prelude of a WGSL text.
    fn of(wgsl: &str) -> String {
        let written = super::super::module_text(wgsl, &mut super::super::base(), false);
        let written = written.ok().unwrap();
        needed(&written.text, &written.taken)
    }

    #[test]
    fn what_is_not_taken_goes() {
        let text =
            of("fn f(v: vec2f) -> f32 {\n    return min(v.x, v.y); // vec4f, dot(v, v)\n}\n");
        let body = text.split_once(OPEN).unwrap().1;
        let expected = "
// ------------------------------------------------------------ vectors and functions of WGSL

/// Two floats.
struct vec2f {
    float x, y;

    vec2f() = default;
    SPECULA_FN vec2f(float x_, float y_) : x(x_), y(y_) {}
};

SPECULA_FN float min(float a, float b) { return b < a ? b : a; }
";
        assert_eq!(body, expected);
        for gone in ["SPECULA_INLINE", "stdint", "string.h"] {
            assert!(!text.contains(gone), "{gone} in\n{text}");
        }
    }

    #[test]
    fn what_functions_take_themselves_comes_with_them() {
        let text = of(
            "fn f(v: vec3f, n: u32) -> vec3f {\n    var w = clamp(normalize(v), vec3f(0.0), vec3f(1.0));\n    \
             w *= 2.0 + w.z * 3.0;\n    return select(w, vec3f(v.xy, f32(bitcast<u32>(w.x) + n)), w < vec3f(1.0));\n}\n",
        );
        for there in [
            "struct vec2f {",
            "struct vec3b {",
            "#include <string.h>",
            " dot(vec3f a",
            " operator/(vec3f v, float s)",
            " length(vec3f",
            " T clamp(T",
            " max(vec3f",
            " max(float",
            " operator*=(vec3f& v, float s)",
            " operator*(vec3f v, float s)",
            " select(vec3f f",
            " operator<(vec3f",
            " bits_of(float",
            " explicit vec3f(float s)",
            " vec3f(vec2f v, float z_)",
            " xy() const",
            " from_xyz(",
            " to(vec3f",
        ] {
            assert!(text.contains(there), "{there} in\n{text}");
        }
        for gone in [
            " dot(vec2f a",
            " operator+(",
            " operator*(float s, vec3f",
            " operator/(vec3f a, vec3f",
            " vec3f(float x_, vec2f",
            " explicit vec2f(",
            " yz() const",
            "operator[]",
            "T select(T",
            " select(vec2f",
            " min(uint32_t",
            " bits_of(vec3f",
            " from_xy(",
            "vec4f",
        ] {
            assert!(!text.contains(gone), "{gone} in\n{text}");
        }
    }
}
