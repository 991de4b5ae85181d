//! What `export` writes: names and documentation survive, and other compilers take it.
//!
//! Compilers that are not there are skipped, loudly: `glslangValidator` (GLSL, GLSL ES, HLSL), `spirv-val`
//! and `spirv-link` (SPIR-V), DXC (HLSL) through a Python that has the package `compushady`, named by
//! the variable `SPECULA_DXC_PYTHON`, and Slang's, which `SPECULA_SLANGC` names.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use std::collections::BTreeSet;

use specula_shaders::{
    DeclarationKind, Export, Language, MODULES, compose, declarations, export, fields, ordered,
};
use specula_testing::compilers;
use tools::{Folder, STRICT};

const TEXTS: [Language; 7] = [
    Language::Wgsl,
    Language::Hlsl,
    Language::Glsl,
    Language::GlslEs,
    Language::Msl,
    Language::Cpp,
    Language::Slang,
];

/// The library of all modules in a language of text.
fn library(language: Language) -> String {
    let files = export(language, &[]).unwrap();
    String::from_utf8(files[0].bytes.clone()).unwrap()
}

/// Whole words of a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c != '_' && !c.is_ascii_alphanumeric())
}

#[test]
fn every_name_survives() {
    let wgsl = compose(&[]).unwrap();
    let parsed = naga::front::wgsl::parse_str(&wgsl).unwrap();
    for language in TEXTS {
        let text = library(language);
        let words: BTreeSet<&str> = words(&text).collect();
        let mut findings = Vec::new();
        for declared in declarations(&wgsl) {
            if !words.contains(declared.name) {
                findings.push(declared.name.to_owned());
            }
        }
        for (_, function) in parsed.functions.iter() {
            let name = function.name.as_deref().unwrap();
            let Some(signature) = signature(&text, name) else {
                findings.push(format!("{name}()"));
                continue;
            };
            let arguments = function.arguments.iter().filter_map(|a| a.name.as_deref());
            for argument in arguments {
                if !self::words(signature).any(|w| w == argument) {
                    findings.push(format!("{argument} in `{signature}`"));
                }
            }
        }
        // A field whose name is reserved would get an underscore.
        let reserved = fields(&wgsl).into_iter().map(|f| format!("{}_", f.name));
        findings.extend(reserved.filter(|name| text.contains(&format!(".{name} "))));
        assert!(findings.is_empty(), "{language}: {}", findings.join("\n"));
    }
}

/// The arguments in the definition of a function.
fn signature<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let call = format!(" {name}(");
    let mut places = text.match_indices(&call).map(|(at, _)| at);
    let definition = places.find(|&at| {
        let line = &text[text[..at].rfind('\n').map_or(0, |n| n + 1)..at];
        !line.starts_with([' ', '/'])
    })?;
    let end = text[definition..].find(')')?;
    Some(&text[definition..definition + end])
}

#[test]
fn all_documentation_survives() {
    for language in TEXTS {
        let text = library(language);
        let mut lines = text.lines().filter_map(|l| l.strip_prefix("///"));
        let count = |kind: DeclarationKind| {
            let all = MODULES.iter().flat_map(|m| declarations(m.text));
            let documented = all.filter(|d| d.kind == kind);
            documented.map(|d| d.docs.len()).sum::<usize>()
        };
        // naga writes buffers its own way, and no comment finds them.
        let expected = count(DeclarationKind::Function)
            + count(DeclarationKind::Struct)
            + count(DeclarationKind::Constant);
        let found = lines.by_ref().count();
        assert!(found >= expected, "{language}: {found} lines of {expected}");
        for module in MODULES {
            assert!(
                text.contains(&format!("--- {}\n", module.path))
                    || is_without_functions(module.text),
                "{language}: {}",
                module.path
            );
        }
    }
}

fn is_without_functions(text: &str) -> bool {
    !declarations(text)
        .iter()
        .any(|d| d.kind == DeclarationKind::Function)
}

#[test]
fn every_module_is_written_alone_in_every_language() {
    for module in MODULES {
        for language in Language::ALL {
            let files = export(language, &[module.path]);
            assert!(files.is_ok(), "{}: {}", module.path, files.unwrap_err());
        }
    }
}

#[test]
fn headers_say_what_the_file_is() {
    for language in TEXTS {
        let files = export(language, &["bounded", "ggx"]).unwrap();
        let text = String::from_utf8(files[0].bytes.clone()).unwrap();
        let head = text.split("\n\n").next().unwrap();
        for part in [
            format!("// Specula {}: ", env!("CARGO_PKG_VERSION")),
            "SPDX-License-Identifier: MIT OR Apache-2.0".to_owned(),
            format!("`specula export --lang {language} --modules bounded,ggx`"),
            "// Usage:\n".to_owned(),
            "// * vndf/bounded: ".to_owned(),
            "// * Tokuyoshi and Eto 2024. Bounded VNDF".to_owned(),
        ] {
            assert!(head.contains(&part), "{language}: {part} in\n{head}");
        }
        assert!(!head.contains("energy_tables"), "{head}");
        assert!(head.lines().all(|l| l.len() <= 110), "{head}");
    }
}

#[test]
fn tables_and_examples_come_with_what_uses_them() {
    for language in Language::ALL {
        let names = |modules: &[&str]| -> Vec<&str> {
            let files = export(language, modules).unwrap();
            files.iter().map(|f| f.name).collect()
        };
        let (library, example) = (language.text_file(), language.example_file());
        assert_eq!(names(&["ggx"]), [library]);
        assert_eq!(names(language.example_modules()), [library, example]);
        let tests: &[&str] = match language {
            Language::Cpp => &["chi_square.cpp", "Makefile"],
            _ => &[],
        };
        let all = [&[library, example][..], tests, &["energy_tables.bin"]].concat();
        assert_eq!(names(&[]), all);
    }
    let names: Vec<_> = ordered(&["bounded"]).unwrap();
    assert!(names.iter().any(|m| m.path == "vndf/bounded"));
}

#[test]
fn glsl_compiles() {
    let Some(compiler) = tools::program("glslangValidator", "GLSL and GLSL ES") else {
        return;
    };
    let heads = [
        (Language::Glsl, "#version 430\n"),
        (
            Language::GlslEs,
            "#version 310 es\nprecision highp float;\nprecision highp int;\n",
        ),
    ];
    for (language, head) in heads {
        let folder = Folder::with(&export(language, &[]).unwrap());
        let whole =
            |text: &str| format!("{head}{text}\nlayout(local_size_x = 1) in;\nvoid main() {{}}\n");
        let text = library(language);
        folder.write("whole.comp", &whole(&text));
        let example = folder.read(language.example_file());
        folder.write(
            "pasted.comp",
            &pasted(&example, language.text_file(), &text),
        );
        for arguments in [
            &["whole.comp"][..],
            &["-V", "--target-env", "vulkan1.1", "whole.comp"],
            &["pasted.comp"],
            &["-V", "--target-env", "vulkan1.1", language.example_file()],
        ] {
            folder.accepted(&compiler, arguments);
        }
        folder.write(
            "whole.comp",
            &whole(&text.replacen("return ", "return not_there * ", 1)),
        );
        folder.refused(&compiler, &["-V", "whole.comp"]);
    }
}

/// The example with the library's text in place of its include.
fn pasted(example: &str, file: &str, library: &str) -> String {
    example
        .replace(&format!("#include \"{file}\""), library)
        .replace("#extension GL_GOOGLE_include_directive : require\n", "")
}

#[test]
fn hlsl_compiles_with_glslang() {
    let Some(compiler) = tools::program("glslangValidator", "HLSL") else {
        return;
    };
    let folder = Folder::with(&export(Language::Hlsl, &[]).unwrap());
    let text = library(Language::Hlsl);
    let whole = |text: &str| format!("{text}\n[numthreads(1, 1, 1)] void main() {{}}\n");
    folder.write("whole.hlsl", &whole(&text));
    for file in ["whole.hlsl", "example.hlsl"] {
        folder.accepted(&compiler, &["-V", "-D", "-S", "comp", "-e", "main", file]);
    }
    folder.write(
        "whole.hlsl",
        &whole(&text.replacen("return ", "return not_there * ", 1)),
    );
    folder.refused(
        &compiler,
        &["-V", "-D", "-S", "comp", "-e", "main", "whole.hlsl"],
    );
}

#[test]
fn hlsl_compiles_with_dxc() {
    let Some(python) = compilers::dxc_python("HLSL with DXC") else {
        return;
    };
    let folder = Folder::with(&export(Language::Hlsl, &[]).unwrap());
    let text = library(Language::Hlsl);
    folder.write("dxc.py", include_str!("tools/dxc.py"));
    let example = folder.read("example.hlsl");
    folder.write("pasted.hlsl", &pasted(&example, "specula.hlsl", &text));
    for arguments in [
        ["dxc.py", "specula.hlsl", "", "lib_6_3"],
        ["dxc.py", "pasted.hlsl", "main", "cs_6_0"],
        ["dxc.py", "pasted.hlsl", "main", "cs_6_6"],
    ] {
        folder.accepted(&python, &arguments);
    }
    folder.write(
        "broken.hlsl",
        &text.replacen("return ", "return not_there * ", 1),
    );
    folder.refused(&python, &["dxc.py", "broken.hlsl", "", "lib_6_3"]);
}

/// What Slang's compiler is asked for: without optimisation SPIR-V needs no second library.
const SLANG_TARGETS: [&[&str]; 3] = [
    &["-target", "spirv", "-O0", "-o", "example.spv"],
    &["-target", "hlsl", "-o", "example.hlsl"],
    &["-target", "cuda", "-o", "example.cu"],
];

#[test]
fn slang_compiles() {
    let Some(compiler) = compilers::slangc("Slang") else {
        return;
    };
    let strict = ["-warnings-as-errors", "all"];
    let folder = Folder::with(&export(Language::Slang, &[]).unwrap());
    let entry = ["example.slang", "-entry", "sample_reflections"];
    for target in SLANG_TARGETS {
        folder.accepted(&compiler, &[&entry[..], target, &strict].concat());
    }
    let text = library(Language::Slang);
    let hidden = text.replace(
        "public float3 bounded_sample",
        "internal float3 bounded_sample",
    );
    folder.write("specula.slang", &hidden);
    folder.refused(&compiler, &[&entry[..], SLANG_TARGETS[1]].concat());
    folder.write("specula.slang", &text);
    for target in [
        &["-o", "specula.slang-module"][..],
        &["-target", "cuda", "-o", "specula.cu"],
    ] {
        let file = ["specula.slang"];
        folder.accepted(&compiler, &[&file[..], target, &strict].concat());
    }
    folder.write(
        "broken.slang",
        &text.replacen("return ", "return not_there * ", 1),
    );
    folder.refused(&compiler, &["broken.slang", "-o", "broken.slang-module"]);
}

#[test]
fn spirv_is_valid_and_links() {
    let (Some(validator), Some(assembler), Some(linker)) = (
        tools::program("spirv-val", "SPIR-V"),
        tools::program("spirv-as", "linking SPIR-V"),
        tools::program("spirv-link", "linking SPIR-V"),
    ) else {
        return;
    };
    let folder = Folder::with(&export(Language::SpirV, &[]).unwrap());
    folder.accepted(&validator, &["--target-env", "vulkan1.1", "example.spv"]);
    folder.accepted(&validator, &["--target-env", "spv1.3", "specula.spv"]);
    folder.write("caller.spvasm", include_str!("tools/caller.spvasm"));
    let assemble = [
        "--target-env",
        "spv1.3",
        "caller.spvasm",
        "-o",
        "caller.spv",
    ];
    folder.accepted(&assembler, &assemble);
    let link = [
        "--target-env",
        "spv1.3",
        "caller.spv",
        "specula.spv",
        "-o",
        "linked.spv",
    ];
    folder.accepted(&linker, &link);
    folder.accepted(&validator, &["--target-env", "vulkan1.1", "linked.spv"]);
    let other = include_str!("tools/caller.spvasm").replace("ggx_d", "ggx_e");
    folder.write("caller.spvasm", &other);
    folder.accepted(&assembler, &assemble);
    folder.refused(&linker, &link);
}

/// What engineers take most often, and how many lines of code each may have in WGSL, and in C++ with its vectors.
const TAKEN: [(&str, &[&str], [usize; 2]); 5] = [
    (
        "bounded",
        &["bounded_sample_direction", "bounded_reflection_pdf"],
        [69, 103],
    ),
    (
        "exact",
        &["exact_sample_direction", "exact_reflection_pdf"],
        [154, 198],
    ),
    (
        "exact isotropic",
        &[
            "exact_isotropic_sample_direction",
            "exact_isotropic_reflection_pdf",
        ],
        [109, 149],
    ),
    (
        "conductor",
        &[
            "rough_conductor_sample",
            "rough_conductor_eval",
            "rough_conductor_pdf",
        ],
        [606, 653],
    ),
    ("Kulla-Conty", &KULLA_CONTY, [187, 246]),
];

/// A compensated metal without tables.
const KULLA_CONTY: [&str; 4] = [
    "kulla_conty_new",
    "kulla_conty_sample",
    "kulla_conty_eval",
    "kulla_conty_pdf",
];

/// The library of these functions alone.
fn of_functions(language: Language, functions: &[&str], prefix: &str) -> String {
    let export = Export {
        functions,
        prefix,
        ..Export::new(language)
    };
    let files = export.files().unwrap();
    assert_eq!(files.len(), 1, "{language} {functions:?}");
    String::from_utf8(files[0].bytes.clone()).unwrap()
}

/// Lines that are neither empty nor a comment.
fn lines_of_code(text: &str) -> usize {
    let lines = text.lines().map(str::trim);
    lines
        .filter(|l| !l.is_empty() && !l.starts_with("//"))
        .count()
}

#[test]
fn functions_alone_are_short() {
    let documented = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/shaders/README.md");
    let documented = std::fs::read_to_string(documented).unwrap();
    for (name, functions, most) in TAKEN {
        for language in TEXTS {
            let text = of_functions(language, functions, "");
            println!(
                "{name} {language}: {} lines, {} of code",
                text.lines().count(),
                lines_of_code(&text)
            );
        }
        let lines = [
            Language::Wgsl,
            Language::Glsl,
            Language::Hlsl,
            Language::Msl,
            Language::Cpp,
        ]
        .map(|language| lines_of_code(&of_functions(language, functions, "")));
        let [wgsl, glsl, hlsl, msl, cpp] = lines;
        assert!(wgsl <= most[0] && cpp <= most[1], "{name}: {lines:?}");
        let row = format!(" | {wgsl} | {glsl} | {hlsl} | {msl} | {cpp} |\n");
        assert!(
            documented.contains(&row),
            "docs/shaders/README.md has no row{row}"
        );
        let text = of_functions(Language::Wgsl, functions, "");
        // Nothing that is not needed.
        let parsed = naga::front::wgsl::parse_str(&text).unwrap();
        for (_, function) in parsed.functions.iter() {
            let own = function.name.as_deref().unwrap();
            let called = text.matches(&format!("{own}(")).count() > 1;
            assert!(called || functions.contains(&own), "{name}: {own}");
        }
    }
}

/// The compensated metal in one file: no table, few lines, few bytes.
#[test]
fn a_compensated_metal_is_one_short_file() {
    for language in [
        Language::Hlsl,
        Language::Glsl,
        Language::Slang,
        Language::Msl,
        Language::Cpp,
    ] {
        let text = of_functions(language, &KULLA_CONTY, "");
        assert!(!text.contains("energy_table"), "{language}");
        let code: Vec<&str> = text
            .lines()
            .filter(|l| !l.trim().is_empty() && !l.trim().starts_with("//"))
            .collect();
        let bytes: usize = code.iter().map(|line| line.len() + 1).sum();
        println!("{language}: {} lines of code, {bytes} bytes", code.len());
        assert!(code.len() <= 250, "{language}: {}", code.len());
        assert!(code.len() > 100 && bytes < 20_000, "{language}: {bytes}");
    }
    // The lobe that reads tables has them beside it.
    let files = export(Language::Hlsl, &["compensated"]).unwrap();
    assert!(files.iter().any(|file| file.bytes.len() > 3_000_000));
}

#[test]
fn functions_alone_compile() {
    let glslang = tools::program("glslangValidator", "functions in GLSL and HLSL");
    let gcc = tools::program("g++", "functions in C++");
    let clang = tools::program("clang++", "functions in C++");
    for (name, functions, _) in TAKEN {
        for prefix in ["", "my_own_"] {
            let folder = Folder::with(&[]);
            let in_language = |language| of_functions(language, functions, prefix);
            naga::front::wgsl::parse_str(&in_language(Language::Wgsl)).unwrap();
            if let Some(glslang) = &glslang {
                let glsl = in_language(Language::Glsl);
                folder.write(
                    "a.comp",
                    &format!("#version 430\n{glsl}\nvoid main() {{}}\n"),
                );
                folder.accepted(glslang, &["a.comp"]);
                let hlsl = in_language(Language::Hlsl);
                let entry = "[numthreads(1, 1, 1)] void main() {}";
                folder.write("a.hlsl", &format!("{hlsl}\n{entry}\n"));
                folder.accepted(glslang, &["-V", "-D", "-S", "comp", "-e", "main", "a.hlsl"]);
            }
            for compiler in [&gcc, &clang].into_iter().flatten() {
                let call = format!("specula::{prefix}{}", functions[0]);
                let cpp = in_language(Language::Cpp);
                let caller = format!("{cpp}\nvoid* taken = reinterpret_cast<void*>(&{call});\n");
                folder.write("a.cpp", &caller);
                let flags = [STRICT, &["-c", "a.cpp"]].concat();
                folder.accepted(compiler, &flags);
                folder.write(
                    "a.cpp",
                    &caller.replacen("return ", "return not_there * ", 1),
                );
                folder.refused(compiler, &flags);
            }
            println!("{name} '{prefix}'");
        }
    }
}

/// Any function alone has all that it needs of the vectors: each is the only one of a namespace, and is compiled.
#[test]
fn any_function_alone_compiles_in_cpp() {
    let Some(gcc) = tools::program("g++", "each function alone in C++") else {
        return;
    };
    let all = &export(Language::Wgsl, &[]).unwrap()[0].bytes;
    let all = String::from_utf8_lossy(all);
    let names = all.lines().filter_map(|line| line.strip_prefix("fn "));
    let names: Vec<&str> = names.filter_map(|line| line.split('(').next()).collect();
    assert!(names.len() > 400, "{}", names.len());
    let mut text = String::new();
    // A fourth of them, another with each change of the library.
    for (at, name) in names.iter().enumerate().step_by(4) {
        let namespace = format!("alone_{at}");
        let export = Export {
            functions: &[name],
            namespace: &namespace,
            ..Export::new(Language::Cpp)
        };
        text += &String::from_utf8_lossy(&export.files().unwrap()[0].bytes);
    }
    let folder = Folder::with(&[]);
    let flags = [STRICT, &["-fsyntax-only", "a.cpp"]].concat();
    folder.write("a.cpp", &text);
    folder.accepted(&gcc, &flags);
    let product = "SPECULA_FN vec3f operator*(vec3f v, float s)";
    folder.write(
        "a.cpp",
        &text.replacen(product, "SPECULA_FN vec3f without(vec3f v, float s)", 1),
    );
    folder.refused(&gcc, &flags);
}

/// Two libraries with different namespaces go into one program.
#[test]
fn namespaces_do_not_meet() {
    let Some(gcc) = tools::program("g++", "namespaces of C++") else {
        return;
    };
    let folder = Folder::with(&[]);
    let mut text = String::new();
    for namespace in ["first", "second::inner"] {
        let export = Export {
            functions: &["bounded_norm"],
            namespace,
            ..Export::new(Language::Cpp)
        };
        let files = export.files().unwrap();
        text += &String::from_utf8(files[0].bytes.clone()).unwrap();
    }
    text += "int main() {\n    return first::bounded_norm({0.5f, 0.5f}, {0.0f, 0.0f, 1.0f})\n        \
             == second::inner::bounded_norm({0.5f, 0.5f}, {0.0f, 0.0f, 1.0f}) ? 0 : 1;\n}\n";
    folder.write("a.cpp", &text);
    folder.accepted(&gcc, &["-std=c++17", "a.cpp", "-o", "a"]);
    folder.printed("./a");
}
