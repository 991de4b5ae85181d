//! `docs/shaders/modules.md` is made from the modules. To make it anew:
//! `SPECULA_WRITE=1 cargo test -p specula-shaders --test documentation`.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use specula_shaders::{DeclarationKind, MODULES, declarations};

const HEAD: &str = "\
# Modules

Made from the first sentences of `crates/specula-shaders/wgsl`; `specula export --list` prints the same.
";

fn table() -> String {
    let mut text = HEAD.to_owned();
    let mut folder = None;
    for module in MODULES {
        if folder != Some(module.folder()) {
            folder = Some(module.folder());
            let name = match module.folder() {
                "" => "(no folder)",
                name => name,
            };
            text += &format!("\n## {name}\n\n| module | functions | |\n|---|---|---|\n");
        }
        let declared = declarations(module.text);
        let functions = declared
            .iter()
            .filter(|d| d.kind == DeclarationKind::Function);
        text += &format!(
            "| `{}` | {} | {} |\n",
            module.name(),
            functions.count(),
            module.summary().replace('|', "\\|")
        );
    }
    text
}

#[test]
fn the_list_of_modules_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/shaders/modules.md");
    let text = table();
    if std::env::var_os("SPECULA_WRITE").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let written = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        written == text,
        "docs/shaders/modules.md is not current; run\n\
         SPECULA_WRITE=1 cargo test -p specula-shaders --test documentation"
    );
}
