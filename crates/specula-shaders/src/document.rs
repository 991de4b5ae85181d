//! Comments of the WGSL, put back into what naga has written.
//!
//! naga keeps no comments. Doc comments go above the functions, structures, fields and constants that
//! they are of, what a module's file says of itself above the first of its functions. Comments within
//! functions stay in the WGSL.

use std::collections::{BTreeMap, BTreeSet};

use crate::declarations::{DeclarationKind, declarations, fields};
use crate::items::{Item, ItemKind, identifiers, items};
use crate::modules::Module;

/// The text with the comments of the modules that it was made of.
pub(crate) fn documented(text: &str, modules: &[Module<'_>]) -> String {
    let comments = Comments::of(modules);
    let mut said = BTreeSet::new();
    let mut result = String::with_capacity(2 * text.len());
    let mut after_struct = false;
    for item in items(text) {
        if item.kind == ItemKind::Struct && after_struct {
            result.push('\n');
        }
        after_struct = item.kind == ItemKind::Struct;
        comments.write(&item, &mut said, &mut result);
    }
    result
}

/// What the modules say, by name.
struct Comments<'a> {
    docs: BTreeMap<&'a str, Vec<&'a str>>,
    /// Of `Structure.field`.
    fields: BTreeMap<(&'a str, &'a str), Vec<&'a str>>,
    /// The module of a function.
    homes: BTreeMap<&'a str, &'a Module<'a>>,
}

impl<'a> Comments<'a> {
    fn of(modules: &'a [Module<'a>]) -> Self {
        let mut comments = Self {
            docs: BTreeMap::new(),
            fields: BTreeMap::new(),
            homes: BTreeMap::new(),
        };
        for module in modules {
            for declared in declarations(module.text) {
                if declared.kind == DeclarationKind::Function {
                    comments.homes.insert(declared.name, module);
                }
                comments.docs.insert(declared.name, declared.docs);
            }
            for field in fields(module.text) {
                let name = (field.structure, field.name);
                comments.fields.insert(name, field.docs);
            }
        }
        comments
    }

    /// Writes an item below what is said of it.
    fn write(&self, item: &Item<'_>, said: &mut BTreeSet<&'a str>, result: &mut String) {
        if let Some(home) = self.homes.get(item.name)
            && item.kind == ItemKind::Function
            && said.insert(home.path)
        {
            *result += &head(home);
        }
        if let Some(docs) = self.docs.get(item.name) {
            write_docs(docs, "", result);
        }
        if item.kind != ItemKind::Struct {
            *result += item.text;
            return;
        }
        for line in item.text.split_inclusive('\n') {
            if is_padding(line) {
                continue;
            }
            if let Some(docs) = self.fields.get(&(item.name, field_name(line))) {
                write_docs(docs, "    ", result);
            }
            *result += line;
        }
    }
}

/// What a file says of itself, below a line with its path.
fn head(module: &Module<'_>) -> String {
    let lines = module.text.lines().take_while(|l| l.starts_with("//"));
    let head: String = lines.map(|l| format!("{l}\n")).collect();
    format!("// {} {}\n{head}\n", "-".repeat(60), module.path)
}

fn write_docs(docs: &[&str], indent: &str, result: &mut String) {
    for doc in docs {
        *result += format!("{indent}/// {doc}").trim_end();
        result.push('\n');
    }
}

/// The name in `    float3 wi;`, `    float rates[48];`; nothing on other lines.
fn field_name(line: &str) -> &str {
    let declaration = line.trim_end().strip_suffix(';').unwrap_or("");
    let declaration = declaration.split('[').next().unwrap_or("");
    identifiers(declaration).last().map_or("", |(_, word)| word)
}

/// Fields that naga adds to HLSL, so that structures lie in buffers as WGSL has them: no structure of
/// the library does, and naga's code names fields one by one.
fn is_padding(line: &str) -> bool {
    let field = line.trim_start();
    field.starts_with("int _pad") || field.starts_with("int _end_pad_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_go_above_what_they_are_of() {
        let module = Module {
            path: "vndf/cap",
            text: "// Caps.\n//\n// More.\n\nimport package::a::b;\n\n/// Half.\nconst CAP_A: f32 = 0.5;\n\n\
                   /// A pair.\nstruct Pair {\n    /// First.\n    /// Really.\n    a: f32,\n    /// Last.\n    b: array<f32, 4>,\n}\n\n\
                   /// F.\n///\n/// Twin: x.\nfn cap_f() {\n}\n\n/// G.\nfn cap_g() {\n}\n",
        };
        let text = "struct Pair {\n    float a;\n    int _pad1_0;\n    int _end_pad_0;\n    float b[4];\n};\n\
                    static const float CAP_A = 0.5;\n\nvoid naga_f() {\n}\n\nvoid cap_f()\n{\n}\n\nvoid cap_g()\n{\n}\n";
        let expected = "/// A pair.\nstruct Pair {\n    /// First.\n    /// Really.\n    float a;\n    /// Last.\n    float b[4];\n};\n\
                        /// Half.\nstatic const float CAP_A = 0.5;\n\nvoid naga_f() {\n}\n\n\
                        // ------------------------------------------------------------ vndf/cap\n// Caps.\n//\n// More.\n\n\
                        /// F.\n///\n/// Twin: x.\nvoid cap_f()\n{\n}\n\n/// G.\nvoid cap_g()\n{\n}\n";
        assert_eq!(documented(text, &[module]), expected);
    }
}
