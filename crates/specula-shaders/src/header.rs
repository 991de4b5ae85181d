//! What stands at the top of a library file.

use crate::language::Language;
use crate::modules::Module;
use crate::papers::references;

/// The module that binds the tables.
pub(crate) const TABLE_MODULE: &str = "energy/energy_table";

/// The comment: what the file is, its version and licence, how to use it, its modules, their papers.
///
/// * `asked`: the options that chose what is in it.
pub(crate) fn header(language: Language, asked: &str, modules: &[Module<'_>]) -> String {
    let mut lines = vec![
        format!(
            "Specula {}: microfacet functions in {}.",
            env!("CARGO_PKG_VERSION"),
            title(language)
        ),
        "Copyright (c) 2026 The Specula authors".to_owned(),
        "SPDX-License-Identifier: MIT OR Apache-2.0".to_owned(),
        String::new(),
        format!("Written by `specula export --lang {language}{asked}`."),
    ];
    lines.extend(origin(language).iter().map(|&l| l.to_owned()));
    lines.push(String::new());
    lines.push("Usage:".to_owned());
    lines.extend(usage(language).iter().map(|l| format!("  {l}")));
    if modules.iter().any(|m| m.path == TABLE_MODULE) {
        lines.extend(tables(language).iter().map(|l| format!("  {l}")));
    }
    lines.push(String::new());
    lines.push("Modules, each behind those that it uses:".to_owned());
    for module in modules {
        lines.extend(wrapped(&format!("{}: {}", module.path, module.summary())));
    }
    let papers = references(modules);
    if !papers.is_empty() {
        lines.push(String::new());
        lines.push("Papers:".to_owned());
        lines.extend(papers.iter().flat_map(|p| wrapped(p)));
    }
    let lines = lines
        .iter()
        .map(|l| format!("// {l}").trim_end().to_owned() + "\n");
    lines.collect::<String>() + "\n"
}

/// The language's name, with the version that is written.
fn title(language: Language) -> &'static str {
    match language {
        Language::Wgsl => "WGSL",
        Language::Hlsl => "HLSL (shader model 5.1)",
        Language::Glsl => "GLSL 4.50",
        Language::GlslEs => "GLSL ES 3.10",
        Language::Msl => "Metal Shading Language 2.0",
        Language::SpirV => "SPIR-V 1.3",
        Language::Cpp => "C++17, for CUDA and HIP too",
        Language::Slang => "Slang",
    }
}

/// How the text came about.
fn origin(language: Language) -> &'static [&'static str] {
    match language {
        Language::Wgsl | Language::SpirV => &[],
        Language::Cpp => &["Printed from WGSL: the first part has its vectors and its functions."],
        _ => &[
            "Translated from WGSL by naga: what begins with `naga_`, `Construct` or `_e` is of the",
            "translation. Comments within functions are in the WGSL.",
        ],
    }
}

fn usage(language: Language) -> &'static [&'static str] {
    match language {
        Language::Wgsl => &[
            "Put this text in front of your own: WGSL has no include. Names begin with their module's,",
            "so that they do not meet yours.",
        ],
        Language::Hlsl => &[
            "#include \"specula.hlsl\"",
            "For shader model 5.1 and 6, with `-HV 2018` or later.",
        ],
        Language::Glsl => &[
            "#extension GL_GOOGLE_include_directive : require",
            "#include \"specula.glsl\"",
            "Where there is no include: put this text behind your `#version` line, 430 or later.",
        ],
        Language::GlslEs => &[
            "Put this text behind your `#version 310 es` or later and your precisions, which must be highp",
            "for float and int; or include it, where your compiler can.",
        ],
        Language::Msl => &["#include \"specula.metal\""],
        Language::SpirV => &[],
        Language::Slang => &["import specula;"],
        Language::Cpp => &[
            "#include \"specula.hpp\"",
            "All is in the namespace `specula`. `from_xyz(v)` and `to<V>(v)` exchange vectors with yours.",
        ],
    }
}

/// How the tables are bound.
fn tables(language: Language) -> &'static [&'static str] {
    match language {
        Language::Wgsl => &[
            "Tables: bind the bytes of `energy_tables.bin` as the storage buffer of group 0, binding 0,",
            "or write `energy_table` yourself.",
        ],
        Language::Hlsl | Language::Slang => {
            &["Tables: bind the bytes of `energy_tables.bin` as the raw buffer t0."]
        }
        Language::Glsl | Language::GlslEs => {
            &["Tables: bind the bytes of `energy_tables.bin` as the shader storage buffer 0."]
        }
        Language::Msl => &[
            "Tables: pass the bytes of `energy_tables.bin`, a buffer of floats in `device`, to the",
            "functions that take `specula_tables`.",
        ],
        Language::SpirV => &[],
        Language::Cpp => &[
            "Tables: read `energy_tables.bin` as floats, and let `specula::specula_tables` point at them; or",
            "define `SPECULA_TABLES`, in front of the include, as an array or a pointer of yours.",
        ],
    }
}

/// A point of a list on lines of at most 100 characters.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines = vec!["*".to_owned()];
    for word in text.split_whitespace() {
        if lines.last().map_or(0, String::len) + 1 + word.len() > 96 {
            lines.push(" ".to_owned());
        }
        if let Some(line) = lines.last_mut() {
            line.push(' ');
            *line += word;
        }
    }
    lines
}
