//! HLSL of naga as a module of Slang.

use std::collections::BTreeSet;

use crate::items::{ItemKind, identifiers, items};

/// What the module is called, and its file.
const MODULE: &str = "module specula;";

/// The HLSL in Slang's words: `select` for the conditional expressions of vectors, since `?:` is for scalars there, and
/// the binding of the tables for Vulkan.
pub(crate) fn from_hlsl(hlsl: &str) -> String {
    let mut text = String::with_capacity(hlsl.len());
    for line in hlsl.lines() {
        let line = selected(line);
        if line.starts_with("ByteAddressBuffer specula_tables ") {
            text += "[[vk::binding(0)]] ";
        }
        text += &line;
        text.push('\n');
    }
    text
}

/// The line with `(condition ? yes : no)` as `select(condition, yes, no)` where vectors are compared; naga writes each
/// in brackets, and vectors beside a splat: `(v < (0.0).xxx)`.
///
/// What is left is an error to Slang's compiler, by the tests: `?:` of vectors is deprecated, and `select` of a vector by
/// a scalar is no SPIR-V before 1.4.
fn selected(line: &str) -> String {
    let mut line = line.to_owned();
    let mut from = 0;
    while let Some(question) = line[from..].find(" ? ").map(|at| from + at) {
        from = question + 3;
        let condition = line[..question].char_indices().rev();
        let open = unmatched(condition, [')', '(']);
        let colon = middle(&line[question..]).map(|at| question + at);
        let close = colon.and_then(|colon| {
            let rest = line[colon..].char_indices();
            unmatched(rest, ['(', ')']).map(|at| colon + at)
        });
        let (Some(open), Some(colon), Some(close)) = (open, colon, close) else {
            continue;
        };
        let condition = &line[open + 1..question];
        if condition.ends_with(".xxx)") || condition.ends_with(".xx)") {
            let (yes, no) = (&line[from..colon], &line[colon + 3..close]);
            let select = format!("select({condition}, {yes}, {no})");
            line.replace_range(open..=close, &select);
            from = open;
        }
    }
    line
}

/// Where a bracket is that the text does not open.
///
/// * `brackets`: the one that opens a pair in the order of the text, and the one that closes it.
fn unmatched(text: impl Iterator<Item = (usize, char)>, brackets: [char; 2]) -> Option<usize> {
    let mut depth = 0_u32;
    for (at, c) in text {
        if c == brackets[1] && depth == 0 {
            return Some(at);
        }
        if c == brackets[0] {
            depth += 1;
        } else if c == brackets[1] {
            depth -= 1;
        }
    }
    None
}

/// Where the ` : ` of the first ` ? ` is.
fn middle(text: &str) -> Option<usize> {
    let mut depth = 0_i32;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' if depth == 0 && text[at..].starts_with(" : ") => return Some(at),
            _ => {}
        }
    }
    None
}

/// Functions that are marked `[Differentiable]` with all that they call: distributions, masking, Fresnel, densities of
/// reflections, conductors.
const DIFFERENTIABLE: [&str; 29] = [
    "ggx_d",
    "ggx_lambda",
    "ggx_g_single",
    "ggx_g_correlated",
    "ggx_g_separable",
    "beckmann_d",
    "beckmann_lambda",
    "beckmann_g_single",
    "beckmann_g_correlated",
    "beckmann_g_separable",
    "conductor_eval",
    "schlick_eval",
    "f82_hump",
    "f82_eval",
    "reflectance_eval",
    "dielectric",
    "cap_reflection_pdf",
    "bounded_reflection_pdf",
    "exact_reflection_pdf",
    "exact_isotropic_reflection_pdf",
    "fit_ggx_loss",
    "fit_ggx_average_loss",
    "kulla_conty_new",
    "kulla_conty_eval",
    "kulla_conty_pdf",
    "kulla_conty_eval_pdf",
    "rough_conductor_eval",
    "rough_conductor_pdf",
    "rough_conductor_eval_pdf",
];

/// What of a text is differentiable.
#[derive(Debug, Default)]
pub(crate) struct Differentiable<'a> {
    functions: BTreeSet<&'a str>,
    structures: BTreeSet<&'a str>,
}

impl<'a> Differentiable<'a> {
    /// What of a text without comments is differentiable.
    ///
    /// * `prefix`: of all names.
    pub(crate) fn of(text: &'a str, prefix: &str) -> Self {
        let items = items(text);
        let of_kind = |kind| items.iter().filter(move |item| item.kind == kind);
        let is_root = |name: &str| {
            let own = name.strip_prefix(prefix);
            own.is_some_and(|own| DIFFERENTIABLE.contains(&own))
        };
        let mut functions = BTreeSet::new();
        let mut words = BTreeSet::new();
        let mut called: BTreeSet<&str> = of_kind(ItemKind::Function)
            .map(|item| item.name)
            .filter(|name| is_root(name))
            .collect();
        loop {
            let before = functions.len();
            for item in of_kind(ItemKind::Function) {
                if called.contains(item.name) && functions.insert(item.name) {
                    let found = || identifiers(item.text);
                    let is_call =
                        |at: usize, word: &str| item.text[at + word.len()..].starts_with('(');
                    called.extend(found().filter(|&(at, w)| is_call(at, w)).map(|(_, w)| w));
                    words.extend(found().map(|(_, word)| word));
                }
            }
            if functions.len() == before {
                break;
            }
        }
        let structures = of_kind(ItemKind::Struct).map(|item| item.name);
        Self {
            functions,
            structures: structures.filter(|name| words.contains(name)).collect(),
        }
    }

    /// The line that declares a function or a structure, marked where that is differentiable.
    fn marked(&self, line: &str) -> String {
        let head = line.split(['(', '{']).next().unwrap_or(line).trim_end();
        let name = head.rsplit(' ').next().unwrap_or(head);
        if self.functions.contains(name) {
            return format!("[Differentiable] public {line}");
        }
        match self.structures.contains(name) {
            true => format!("public {head} : IDifferentiable {{"),
            false => format!("public {line}"),
        }
    }
}

/// The module: its name, then the text with all that it declares public.
pub(crate) fn module(text: &str, differentiable: &Differentiable<'_>) -> String {
    let mut module = format!("{MODULE}\n\n");
    let mut inside_struct = false;
    for line in text.lines() {
        let is_function = line.ends_with(')') || line.ends_with(") {");
        let is_declared = line.starts_with(|c: char| c.is_ascii_alphabetic())
            && (is_function || line.starts_with("struct ") || line.starts_with("static const "));
        inside_struct |= line.starts_with("struct ");
        inside_struct &= !line.starts_with('}');
        let field = line
            .strip_prefix("    ")
            .filter(|rest| inside_struct && rest.ends_with(';'));
        match field {
            Some(field) => module += &format!("    public {field}"),
            None if is_declared => module += &differentiable.marked(line),
            None => module += line,
        }
        module.push('\n');
    }
    module
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_selected() {
        let scalar = "    float s = (1.0 + ((a <= 1.0) ? sine : -(sine)));\n";
        assert_eq!(from_hlsl(scalar), scalar);
        let hlsl = "return ((t < (0.0).xxx) ? (b ? c(1, 2) : d) : (e ? f : g));\n";
        let slang = "return select((t < (0.0).xxx), (b ? c(1, 2) : d), (e ? f : g));\n";
        assert_eq!(from_hlsl(hlsl), slang);
        let inside = "return (b ? ((v != (c).xx) ? d : e) : f);\n";
        let selected = "return (b ? select((v != (c).xx), d, e) : f);\n";
        assert_eq!(from_hlsl(inside), selected);
        assert_eq!(from_hlsl("case 1: {\n"), "case 1: {\n");
        let tables = "ByteAddressBuffer specula_tables : register(t0);\n";
        assert_eq!(from_hlsl(tables), format!("[[vk::binding(0)]] {tables}"));
    }

    #[test]
    fn what_a_module_declares_is_public() {
        let text = "/// A.\nstruct A {\n    /// B.\n    float b;\n};\nstatic const uint N = 1u;\n\
                    float f(A a)\n{\n    return (a.b);\n}\nA g(float b) {\n    A ret;\n}\n\
                    ByteAddressBuffer t : register(t0);\n";
        let expected = "module specula;\n\n/// A.\npublic struct A {\n    /// B.\n    public float b;\n};\n\
                        public static const uint N = 1u;\npublic float f(A a)\n{\n    return (a.b);\n}\n\
                        public A g(float b) {\n    A ret;\n}\nByteAddressBuffer t : register(t0);\n";
        assert_eq!(module(text, &Differentiable::default()), expected);
    }

    #[test]
    fn what_is_called_is_differentiable_too() {
        let text = "struct A {\n    float b;\n};\nstruct B {\n    float b;\n};\n\
                    float p_other(B b)\n{\n    return b.b;\n}\n\
                    A ConstructA(float b) {\n    A ret;\n    return ret;\n}\n\
                    float p_ggx_d(float b)\n{\n    A a = ConstructA(b);\n    return a.b;\n}\n";
        let marked = Differentiable::of(text, "p_");
        assert_eq!(marked.functions, ["ConstructA", "p_ggx_d"].into());
        assert_eq!(marked.structures, ["A"].into());
        let module = module(text, &marked);
        for part in [
            "public struct A : IDifferentiable {\n    public float b;\n};\npublic struct B {\n",
            "};\npublic float p_other(B b)\n{\n",
            "}\n[Differentiable] public A ConstructA(float b) {\n",
            "}\n[Differentiable] public float p_ggx_d(float b)\n{\n",
        ] {
            assert!(module.contains(part), "{part} in\n{module}");
        }
    }
}
