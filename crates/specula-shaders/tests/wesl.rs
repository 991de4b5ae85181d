//! The sources are WESL: its own linker composes them as they are.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use specula_shaders::{Kind, MODULES, declarations};
use wesl::{CompileOptions, ManglerKind, Wesl};

#[test]
fn wesl_links_every_module() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/wgsl");
    for module in MODULES {
        let mut linker = Wesl::new(folder);
        linker.set_mangler(ManglerKind::None);
        linker.set_options(CompileOptions {
            strip: false,
            lower: false,
            ..CompileOptions::default()
        });
        let path = format!("package::{}", module.path.replace('/', "::"));
        let linked = linker.compile(&path.parse().unwrap());
        let text = linked.unwrap_or_else(|e| panic!("{path}: {e}")).to_string();
        let parsed = naga::front::wgsl::parse_str(&text);
        assert!(parsed.is_ok(), "{path}: {}", parsed.unwrap_err());
        let own = declarations(module.text).into_iter();
        for function in own.filter(|d| d.kind == Kind::Function) {
            let begin = format!("fn {}(", function.name);
            assert!(text.contains(&begin), "{path}: {begin}");
        }
    }
}
