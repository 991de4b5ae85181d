//! WGSL as C++17, word by word, so that comments and names stay.
//!
//! What is read is the WGSL that the library is written in, not all of the language: any other construct is an
//! error with its place. Types of values are followed, since C++ names them; that they are right is for naga and
//! for the compiler to say.

mod callees;
mod declare;
mod error;
mod expression;
mod lexer;
mod operators;
mod prelude;
mod printer;
mod short;
mod statement;
mod types;

use std::collections::BTreeSet;

use crate::modules::Module;
use crate::translate::TranslateError;
use declare::{Item, declare, item, starts};
use error::Failure;
use lexer::tokens;
use types::Scope;

/// What the prelude has changed, changed back.
const POSTLUDE: &str = "\
#if defined(__clang__) && !defined(__CUDACC__) && !defined(__HIP_DEVICE_COMPILE__)
#pragma float_control(pop)
#elif defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#pragma GCC pop_options
#endif
";

/// The header's text: the prelude, then the modules in their order, each behind those that it imports.
///
/// * `is_short`: whether the prelude has what the modules take of it only, short functions are one line, and each
///   stands behind those that it calls.
pub(crate) fn library(modules: &[Module<'_>], is_short: bool) -> Result<String, TranslateError> {
    let mut scope = base();
    let mut text = String::new();
    let mut taken = BTreeSet::new();
    for module in modules {
        let (head, code) = module.text.split_at(head_length(module.text));
        let lines = head.matches('\n').count();
        let body = module_text(code, &mut scope, is_short).map_err(|failure| {
            TranslateError::of(format!("{}.wgsl:{}", module.path, failure.behind(lines)))
        })?;
        text += &format!(
            "\n// {} {}\n{head}\n{}",
            "-".repeat(60),
            module.path,
            body.text.trim_start_matches('\n')
        );
        taken.extend(body.taken);
    }
    if is_short {
        let prelude = prelude::needed(&text, &taken);
        return Ok(in_namespace(
            &short::joined(&prelude),
            &short::joined(&text),
        ));
    }
    Ok(in_namespace(prelude::WHOLE, &text))
}

/// C++17 of a WGSL text that is written as the library is: constants, structures and functions of scalars,
/// vectors and arrays, with pointers as arguments only. It begins with WGSL's vectors, in the namespace `specula`.
///
/// # Errors
///
/// A construct that the library does not use, with its line.
pub fn to_cpp(wgsl: &str) -> Result<String, TranslateError> {
    let body = module_text(wgsl, &mut base(), false).map_err(TranslateError::of)?;
    Ok(in_namespace(prelude::WHOLE, &body.text))
}

/// * `prelude`: it leaves the namespace open.
fn in_namespace(prelude: &str, text: &str) -> String {
    format!("{prelude}{text}\n}} // namespace specula\n\n{POSTLUDE}")
}

/// What is there without being declared.
fn base() -> Scope {
    let mut scope = Scope::default();
    let tables = types::Type::Array(Box::new(types::Type::Float), String::new());
    scope.values.insert("specula_tables".to_owned(), tables);
    scope
}

/// Length of the comment that a file begins with.
fn head_length(text: &str) -> usize {
    let lines = text.split_inclusive('\n');
    let head = lines.take_while(|l| l.starts_with("//") && !l.starts_with("///"));
    head.map(str::len).sum()
}

/// A module as C++.
struct Written {
    text: String,
    /// What it takes of the prelude: `operator*(vec3f,float)`.
    taken: BTreeSet<String>,
}

/// Constants and structures, then functions, below declarations of those that are called before they are there.
///
/// * `sorts`: whether functions are put behind those that they call, so that no such declarations are needed.
fn module_text(text: &str, scope: &mut Scope, sorts: bool) -> Result<Written, Failure> {
    let tokens = tokens(text)?;
    declare(&tokens, scope)?;
    let starts = starts(&tokens);
    let items = starts.iter().map(|&at| item(&tokens[at..], scope));
    let items: Vec<Item> = items.collect::<Result<_, _>>()?;
    let (mut functions, values): (Vec<Item>, Vec<Item>) =
        items.into_iter().partition(|i| i.function.is_some());
    if sorts {
        functions = callees_first(functions);
        for function in &mut functions {
            function.before = format!("\n{}", function.before.trim_start_matches('\n'));
        }
    }
    let mut written: String = values.iter().map(whole).collect();
    let early = early(&functions);
    if !early.is_empty() {
        written += &format!("\n{}", early.concat());
    }
    written.extend(functions.iter().map(whole));
    let items = values.into_iter().chain(functions);
    Ok(Written {
        text: written,
        taken: items.flat_map(|item| item.taken).collect(),
    })
}

fn whole(item: &Item) -> String {
    format!("{}{}\n", item.before, item.text)
}

/// Each function behind those that it calls, else in the order of the source. WGSL has no recursion.
fn callees_first(mut functions: Vec<Item>) -> Vec<Item> {
    let mut sorted = Vec::with_capacity(functions.len());
    while !functions.is_empty() {
        let names = functions.iter().filter_map(|item| item.function.as_ref());
        let waiting: BTreeSet<String> = names.map(|function| function.name.clone()).collect();
        let is_ready =
            |item: &Item| (item.function.as_ref()).is_none_or(|f| f.called.is_disjoint(&waiting));
        let next = functions.iter().position(is_ready).unwrap_or(0);
        sorted.push(functions.remove(next));
    }
    sorted
}

/// Declarations of the functions that are called above their definition.
fn early(functions: &[Item]) -> Vec<String> {
    let functions = || functions.iter().filter_map(|item| item.function.as_ref());
    let mut wanted = BTreeSet::new();
    let mut defined = BTreeSet::new();
    for function in functions() {
        defined.insert(&function.name);
        wanted.extend(
            function
                .called
                .iter()
                .filter(|name| !defined.contains(name)),
        );
    }
    let early = functions().filter(|f| wanted.contains(&f.name));
    early.map(|f| format!("{};\n", f.head)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What `module_text` writes.
    fn written(wgsl: &str) -> String {
        module_text(wgsl, &mut base(), false).unwrap().text
    }

    #[test]
    fn callees_stand_in_front_of_their_callers_in_short_texts() {
        let wgsl = "fn a_f() -> f32 {\n    return a_g() + a_h();\n}\nfn a_g() -> f32 {\n    return a_h();\n}\n\
                    fn a_h() -> f32 {\n    return 1.0;\n}\nfn a_i() -> f32 {\n    return 2.0;\n}\n";
        let text = module_text(wgsl, &mut base(), true).unwrap().text;
        let heads = text.lines().filter(|line| line.starts_with("SPECULA_FN"));
        let expected =
            ["a_h", "a_g", "a_f", "a_i"].map(|name| format!("SPECULA_FN float {name}() {{"));
        assert_eq!(heads.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn comments_names_and_lines_stay() {
        let wgsl = "/// Half.\nconst A_HALF: f32 = 0.5;\n\n/// F.\nfn a_f(v: vec3f, n: u32) -> f32 {\n\
                    \x20   // Why.\n    let long = a_g(v);\n    return select(long.x, A_HALF, v.z > 0.0); // Here.\n}\n\n\
                    /// G.\nfn a_g(v: vec3f) -> vec2f {\n    return vec2f(abs(v.x), 2.0) * v.xy;\n}\n\n\
                    /// P.\nstruct AP {\n    /// X.\n    x: array<f32, 2>,\n}\n";
        let expected = "/// Half.\nconstexpr float A_HALF = 0.5f;\n\n/// P.\nstruct AP {\n    /// X.\n    float x[2];\n};\n\n\
                        SPECULA_FN vec2f a_g(vec3f v);\n\n\
                        /// F.\nSPECULA_FN float a_f(vec3f v, uint32_t /* n */) {\n\
                        \x20   // Why.\n    const vec2f long_ = a_g(v);\n    return select(long_.x, A_HALF, v.z > 0.0f); // Here.\n}\n\n\
                        /// G.\nSPECULA_FN vec2f a_g(vec3f v) {\n    return vec2f(fabsf(v.x), 2.0f) * v.xy();\n}\n";
        assert_eq!(written(wgsl), expected);
    }

    #[test]
    fn control_flow_gets_its_brackets() {
        let wgsl = "fn a(n: u32) -> u32 {\n    var i = n;\n    while i > 2u {\n        i -= 1u;\n    }\n    switch i {\n\
                    \x20       case 1u, 2u: {\n            i = 7u;\n        }\n        default: {\n            return i;\n        }\n    }\n\
                    \x20   if i == n { return 1u; } else if i < n { return 2u; }\n    return u32(f32(i) * 0.5);\n}\n";
        let expected = "SPECULA_FN uint32_t a(uint32_t n) {\n    uint32_t i = n;\n    while (i > 2u) {\n        i -= 1u;\n    }\n\
                        \x20   switch (i) {\n        case 1u:\n        case 2u: {\n            i = 7u;\n            break;\n        }\n\
                        \x20       default: {\n            return i;\n        }\n    }\n\
                        \x20   if (i == n) { return 1u; } else if (i < n) { return 2u; }\n    return to_u32(float(i) * 0.5f);\n}\n";
        assert_eq!(written(wgsl), expected);
    }

    #[test]
    fn pointers_are_references_and_copies_stay_copies() {
        let wgsl = "struct Inner {\n    a: f32,\n}\nstruct Outer {\n    b: Inner,\n}\n\
                    fn read(o: ptr<function, Outer>, i: Inner) -> f32 {\n    return (*o).b.a + i.a;\n}\n\
                    fn change(o: ptr<function, Outer>, i: Inner) {\n    (*o).b.a = 2.0;\n    (*o).b.a += i.a;\n}\n\
                    fn call() -> f32 {\n    var o: Outer;\n    change(&o, o.b);\n    return read(&o, o.b);\n}\n";
        let text = written(wgsl);
        for part in [
            "float read(const Outer& o, const Inner& i) {\n    return o.b.a + i.a;",
            "void change(Outer& o, Inner i) {\n    o.b.a = 2.0f;",
            "    Outer o{};\n    change(o, o.b);\n    return read(o, o.b);",
        ] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }

    #[test]
    fn other_constructs_are_errors_with_their_line() {
        for (body, message) in [
            ("let a = b;", "2: expected a value, found 'b'"),
            ("let a = sin(1.0);", "2: 'sin' is no known function"),
            ("loop { break; }", "2: expected a value, found 'loop'"),
            (
                "let x = x + 1.0;",
                "2: 'x' is used where it is declared, which C++ takes for itself",
            ),
            (
                "let helper = helper(x);",
                "2: C++ takes 'helper' for the variable of that name",
            ),
            (
                "let a = vec2f(x).yyxx;",
                "2: expected a component, found 'yyxx'",
            ),
            (
                "let a = 1;",
                "2: 'a' is neither a number, a vector nor a structure",
            ),
            (
                "let a = mat2x2f(x, x, x, x);",
                "2: 'mat2x2f' is no known function",
            ),
            ("_ = helper(x);", "2: expected a statement, found '_'"),
            ("switch 1u { case 1u { } }", "2: expected ':', found '{'"),
            ("let a: i32 = 1;", "2: expected a type, found 'i32'"),
        ] {
            let wgsl = format!("fn helper(x: f32) {{\n    {body}\n}}\n");
            let failure = module_text(&wgsl, &mut base(), false).err().unwrap();
            assert_eq!(failure.to_string(), message, "{body}");
        }
        let module = Module {
            path: "a/b",
            text: "// Head.\n//\n\nimport package::c::{d};\n\nfn f() {\n    discard;\n}\n",
        };
        let error = library(&[module], false).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a/b.wgsl:7: expected a value, found 'discard'"
        );
    }
}
