//! Rules that every file of `wgsl/` obeys. A failure lists all findings.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use naga::valid::{Capabilities, ValidationFlags, Validator};
use specula_shaders::{DeclarationKind, MODULES, Module, compose, declarations};

fn crate_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Fails with everything that was found.
fn none(findings: &[String]) {
    assert!(findings.is_empty(), "\n{}", findings.join("\n"));
}

/// Paths of the files below a folder of `wgsl/`, as `Module::path`.
fn files(folder: &Path, prefix: &str, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        if path.is_dir() {
            files(&path, &format!("{prefix}{stem}/"), found);
        } else if path.extension().is_some_and(|e| e == "wgsl") {
            found.insert(format!("{prefix}{stem}"));
        }
    }
}

/// Whole words of a text without its `//` comments.
fn words(text: &str) -> BTreeSet<&str> {
    let code = text.lines().map(|l| l.split("//").next().unwrap_or(l));
    code.flat_map(|l| l.split(|c: char| c != '_' && !c.is_ascii_alphanumeric()))
        .collect()
}

#[test]
fn every_file_is_a_module() {
    let mut found = BTreeSet::new();
    files(&crate_folder().join("wgsl"), "", &mut found);
    let listed: BTreeSet<String> = MODULES.iter().map(|m| m.path.to_owned()).collect();
    let missing: Vec<_> = found.symmetric_difference(&listed).collect();
    assert!(
        missing.is_empty(),
        "files of wgsl/ that build.rs does not list, or listed without a file: {missing:?}"
    );
    assert_eq!(listed.len(), MODULES.len(), "a file is listed twice");
}

#[test]
fn names_of_modules_and_declarations_are_unique() {
    let mut findings = Vec::new();
    let mut seen: BTreeMap<&str, &str> = BTreeMap::new();
    for module in MODULES {
        if let Some(other) = seen.insert(module.name(), module.path) {
            findings.push(format!("{} and {other} have one name", module.path));
        }
    }
    let mut seen: BTreeMap<&str, &str> = BTreeMap::new();
    for module in MODULES {
        for declared in declarations(module.text) {
            if let Some(other) = seen.insert(declared.name, module.path) {
                let name = declared.name;
                findings.push(format!(
                    "`{name}` is declared in {other} and {}",
                    module.path
                ));
            }
        }
    }
    none(&findings);
}

#[test]
fn every_module_is_valid_with_what_it_imports() {
    let mut findings = Vec::new();
    for module in MODULES {
        let text = match compose(&[module.path]) {
            Ok(text) => text,
            Err(error) => {
                findings.push(format!("{}: {error}", module.path));
                continue;
            }
        };
        if let Err(report) = validated(&text) {
            findings.push(format!("{}: {report}", module.path));
        }
    }
    none(&findings);
}

/// The module that naga makes of a text, validated.
fn validated(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

#[test]
fn every_import_exists_and_is_used() {
    let mut findings = Vec::new();
    for module in MODULES {
        let imports = match module.imports() {
            Ok(imports) => imports,
            Err(error) => {
                findings.push(error.to_string());
                continue;
            }
        };
        let code = module.code();
        let used = words(&code);
        for import in imports {
            let Some(other) = MODULES.iter().find(|m| m.path == import.path) else {
                findings.push(format!("{}: there is no {}", module.path, import.path));
                continue;
            };
            let declared: Vec<&str> = declarations(other.text).iter().map(|d| d.name).collect();
            for name in &import.names {
                if !declared.contains(&name.as_str()) {
                    findings.push(format!("{}: {} has no `{name}`", module.path, other.path));
                }
                if !used.contains(name.as_str()) {
                    findings.push(format!("{}: `{name}` is not used", module.path));
                }
            }
        }
        findings.extend(not_imported(module, &used));
    }
    none(&findings);
}

/// Names of other modules that are used without an import.
fn not_imported(module: &Module, used: &BTreeSet<&str>) -> Vec<String> {
    let imports = module.imports().unwrap();
    let imported: BTreeSet<&String> = imports.iter().flat_map(|i| &i.names).collect();
    let others = MODULES.iter().filter(|m| m.path != module.path);
    others
        .flat_map(|other| {
            declarations(other.text)
                .into_iter()
                .map(move |d| (other, d))
        })
        .filter(|(_, d)| used.contains(d.name) && !imported.contains(&d.name.to_owned()))
        .map(|(other, d)| {
            let (name, from) = (d.name, other.path);
            format!("{}: `{name}` of {from} is not imported", module.path)
        })
        .collect()
}

#[test]
fn everything_is_documented() {
    let mut findings = Vec::new();
    for module in MODULES {
        if !module.text.starts_with("// ") || module.summary().is_empty() {
            findings.push(format!("{}: the first line says nothing", module.path));
        }
        for declared in declarations(module.text) {
            if declared.docs.first().is_none_or(|d| d.is_empty()) {
                findings.push(format!(
                    "{}: `{}` has no documentation",
                    module.path, declared.name
                ));
            }
        }
        findings.extend(undocumented_fields(module));
    }
    none(&findings);
}

/// Fields of structures with no `///` line above them.
fn undocumented_fields(module: &Module) -> Vec<String> {
    let mut findings = Vec::new();
    let mut before = "";
    let mut structure = None;
    for line in module.text.lines() {
        if let Some(rest) = line.strip_prefix("struct ") {
            structure = Some(rest.trim_end_matches([' ', '{']));
        } else if line.starts_with('}') {
            structure = None;
        } else if let (Some(name), Some((field, _))) = (structure, line.split_once(':')) {
            let is_field = !line.trim_start().starts_with("//");
            if is_field && !before.trim_start().starts_with("///") {
                let field = field.trim();
                findings.push(format!(
                    "{}: `{name}.{field}` has no documentation",
                    module.path
                ));
            }
        }
        before = line;
    }
    findings
}

#[test]
fn every_function_has_its_twin() {
    let mut findings = Vec::new();
    for module in MODULES {
        for declared in declarations(module.text) {
            let has_twin = declared.docs.iter().any(|d| d.contains("Twin: "));
            if declared.kind == DeclarationKind::Function && !has_twin {
                findings.push(format!("{}: `{}` has no twin", module.path, declared.name));
            }
        }
        findings.extend(wrong_twins(module.path, module.text));
    }
    none(&findings);
}

#[test]
fn twins_of_the_tracer_are_there() {
    let folder = crate_folder().join("../specula-gpu/wgsl");
    let mut names = BTreeSet::new();
    files(&folder, "", &mut names);
    let mut findings = Vec::new();
    for name in names {
        let text = std::fs::read_to_string(folder.join(format!("{name}.wgsl"))).unwrap();
        findings.extend(wrong_twins(&name, &text));
    }
    none(&findings);
}

/// The twins of a WGSL text that Rust does not have.
fn wrong_twins(module: &str, text: &str) -> Vec<String> {
    let twins = text.lines().filter_map(|l| {
        let doc = l.trim_start().strip_prefix("/// ")?;
        Some(doc.split_once("Twin: ")?.1)
    });
    // Others are functions of Rust's libraries, or none for a reason that is given.
    let specula = twins.filter(|twin| twin.starts_with("specula-"));
    let wrong = specula.filter_map(missing_twin);
    wrong.map(|w| format!("{module}: {w}")).collect()
}

/// What is not there of `specula-bsdf/src/vndf/cap.rs, Cap::sample_wm`: the file, the type in it (`struct`, `enum`,
/// `trait` or `impl`), or the function, constant, type or variant of exactly that name.
fn missing_twin(twin: &str) -> Option<String> {
    let Some((file, names)) = twin.split_once(".rs, ") else {
        return Some(format!("`{twin}` is not `file.rs, name`"));
    };
    let file = format!("{file}.rs");
    let Ok(source) = std::fs::read_to_string(crate_folder().join("..").join(&file)) else {
        return Some(format!("there is no {file}"));
    };
    let end = names.find(|c: char| c != ':' && c != '_' && !c.is_ascii_alphanumeric());
    let path: Vec<&str> = names[..end.unwrap_or(names.len())].split("::").collect();
    let is_there = match path[..] {
        [name] => declares(&source, name),
        [owner, name] => {
            holds(&source, owner) && (declares(&source, name) || has_variant(&source, name))
        }
        _ => false,
    };
    (!is_there).then(|| format!("{file} has no `{}`", path.join("::")))
}

/// The words of each line of code.
fn lines_of_words(source: &str) -> impl Iterator<Item = Vec<&str>> {
    let code = source.lines().map(|l| l.split("//").next().unwrap_or(l));
    code.map(|l| {
        l.split(|c: char| c != '_' && !c.is_ascii_alphanumeric())
            .filter(|word| !word.is_empty())
            .collect()
    })
}

/// Whether Rust declares a function, constant or type of that name.
fn declares(source: &str, name: &str) -> bool {
    const KEYWORDS: [&str; 7] = ["fn", "const", "static", "struct", "enum", "trait", "type"];
    lines_of_words(source).any(|words| {
        words
            .windows(2)
            .any(|pair| KEYWORDS.contains(&pair[0]) && pair[1] == name)
    })
}

/// Whether Rust declares a type of that name, or implements something for it.
fn holds(source: &str, owner: &str) -> bool {
    lines_of_words(source).any(|words| {
        let is_impl = words.first() == Some(&"impl") && words.contains(&owner);
        let declares = |pair: &[&str]| {
            ["struct", "enum", "trait", "mod"].contains(&pair[0]) && pair[1] == owner
        };
        is_impl || words.windows(2).any(declares)
    })
}

/// Whether an enumeration has a variant of that name.
fn has_variant(source: &str, name: &str) -> bool {
    source.lines().any(|line| {
        let rest = line.trim_start().strip_prefix(name);
        rest.is_some_and(|rest| matches!(rest.trim_start().chars().next(), Some(',' | '(' | '{')))
    })
}

#[test]
fn twins_are_compared_by_their_whole_names() {
    for (twin, is_there) in [
        ("specula-bsdf/src/vndf/cap.rs, sample_wm.", true),
        ("specula-bsdf/src/vndf/cap.rs, sample_w.", false),
        ("specula-bsdf/src/vndf/cap.rs, ample_wm.", false),
        ("specula-bsdf/src/vndf/mod.rs, Sampler::Heitz.", true),
        ("specula-bsdf/src/vndf/mod.rs, Sampler::Heit.", false),
        ("specula-bsdf/src/vndf/mod.rs, Sample::Heitz.", false),
        ("specula-bsdf/src/vndf/none.rs, sample_wm.", false),
        ("specula-bsdf/src/vndf/cap.rs", false),
    ] {
        assert_eq!(missing_twin(twin).is_none(), is_there, "{twin}");
    }
}

#[test]
fn codes_are_those_of_rust() {
    let codes = specula_bsdf::internal::shader_codes::ALL;
    let stated: BTreeMap<&str, u32> = codes.iter().copied().collect();
    let mut written = BTreeMap::new();
    for module in MODULES {
        for line in module.text.lines() {
            let Some(constant) = line.strip_prefix("const ") else {
                continue;
            };
            let Some((name, value)) = constant.split_once(": u32 = ") else {
                continue;
            };
            if stated.contains_key(name) || is_module_of_codes(module.path) {
                written.insert(name, value.trim_end_matches("u;").parse().unwrap());
            }
        }
    }
    assert_eq!(written, stated);
}

/// Whether all constants of a module are codes of a choice that Rust has, too.
fn is_module_of_codes(path: &str) -> bool {
    matches!(
        path,
        "ndf/distribution" | "vndf/sampler" | "energy/model" | "multibounce/multibounce_model"
    )
}

#[test]
fn every_name_begins_with_its_module() {
    let mut findings = Vec::new();
    for module in MODULES {
        for declared in declarations(module.text) {
            if let Some(fault) = fault_of_name(module, declared.kind, declared.name) {
                findings.push(format!("{}: {fault}", module.path));
            }
        }
    }
    none(&findings);
}

/// What is wrong with the name of a declaration.
///
/// Functions and constants begin with the module's name, structures with its words in capitals; so that a
/// structure does not take a common word from the caller (`Frame`), it has two words at least. No name begins
/// with another module's longer name.
fn fault_of_name(module: &Module, kind: DeclarationKind, name: &str) -> Option<String> {
    let spelt = |m: &Module| match kind {
        DeclarationKind::Constant => m.name().to_uppercase(),
        DeclarationKind::Struct | DeclarationKind::Alias => {
            m.name().split('_').map(capitalised).collect()
        }
        DeclarationKind::Variable => "specula".to_owned(),
        _ => m.name().to_owned(),
    };
    let is_type = matches!(kind, DeclarationKind::Struct | DeclarationKind::Alias);
    let begins = |m: &Module| {
        name.strip_prefix(spelt(m).as_str()).is_some_and(|rest| {
            let next = rest.chars().next();
            next.is_none_or(|c| c == '_' || (is_type && c.is_ascii_uppercase()))
        })
    };
    let case = match kind {
        DeclarationKind::Constant => name.chars().all(|c| !c.is_ascii_lowercase()),
        DeclarationKind::Struct | DeclarationKind::Alias => !name.contains('_'),
        _ => name.chars().all(|c| !c.is_ascii_uppercase()),
    };
    let prefix = spelt(module);
    if !begins(module) || !case {
        return Some(format!("`{name}` does not begin with `{prefix}`"));
    }
    if is_type && name.chars().filter(char::is_ascii_uppercase).count() < 2 {
        return Some(format!(
            "`{name}` is one word: say what of `{prefix}` it is"
        ));
    }
    let longer = |m: &&Module| m.name().len() > module.name().len() && begins(m);
    let other = MODULES
        .iter()
        .find(longer)
        .filter(|_| kind != DeclarationKind::Variable)?;
    Some(format!("`{name}` looks like a name of {}", other.path))
}

/// `Frame` of `frame`.
fn capitalised(word: &str) -> String {
    let (first, rest) = word.split_at(usize::from(!word.is_empty()));
    first.to_uppercase() + rest
}

#[test]
fn names_without_their_module_are_found() {
    let module = |path: &str| MODULES.iter().find(|m| m.path == path).unwrap();
    for (path, kind, name, sound) in [
        ("math/frame", DeclarationKind::Struct, "FrameBasis", true),
        ("math/frame", DeclarationKind::Struct, "Frame", false),
        ("math/frame", DeclarationKind::Struct, "Basis", false),
        ("math/frame", DeclarationKind::Struct, "Framework", false),
        ("energy/albedo", DeclarationKind::Struct, "Loss", false),
        (
            "energy/interface",
            DeclarationKind::Struct,
            "InterfaceKnot",
            true,
        ),
        (
            "energy/interface",
            DeclarationKind::Struct,
            "InterfaceLayer",
            false,
        ),
        (
            "energy/interface_layer",
            DeclarationKind::Struct,
            "InterfaceLayer",
            true,
        ),
        (
            "fresnel/dielectric",
            DeclarationKind::Function,
            "dielectric",
            true,
        ),
        (
            "fresnel/dielectric",
            DeclarationKind::Function,
            "dielectrics_f",
            false,
        ),
        (
            "fresnel/dielectric",
            DeclarationKind::Function,
            "dielectric_albedo_f",
            false,
        ),
        ("fresnel/f82", DeclarationKind::Function, "f82_eval", true),
        ("fresnel/f82", DeclarationKind::Function, "f_eval", false),
        (
            "bsdf/bsdf_sample",
            DeclarationKind::Constant,
            "BSDF_SAMPLE_VALID",
            true,
        ),
        (
            "bsdf/bsdf_sample",
            DeclarationKind::Constant,
            "BSDF_VALID",
            false,
        ),
        (
            "bsdf/bsdf_sample",
            DeclarationKind::Constant,
            "bsdf_sample_valid",
            false,
        ),
        (
            "energy/energy_table",
            DeclarationKind::Variable,
            "specula_tables",
            true,
        ),
        (
            "energy/energy_table",
            DeclarationKind::Variable,
            "tables",
            false,
        ),
    ] {
        let fault = fault_of_name(module(path), kind, name);
        assert_eq!(fault.is_none(), sound, "{path} {name}: {fault:?}");
    }
}

#[test]
fn names_survive_translation() {
    let mut findings = Vec::new();
    for module in MODULES {
        if let Ok(text) = compose(&[module.path])
            && let Ok(parsed) = naga::front::wgsl::parse_str(&text)
        {
            let names = all_names(&parsed).into_iter();
            let bad = names.filter(|n| {
                n.ends_with(|c: char| c.is_ascii_digit() || c == '_') || n.contains("__")
            });
            findings
                .extend(bad.map(|n| format!("{}: `{n}` ends in a digit or has `__`", module.path)));
        }
    }
    none(&findings);
}

/// Names of functions, arguments, variables, structures, fields and constants.
fn all_names(module: &naga::Module) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (_, function) in module.functions.iter() {
        names.extend(function.name.clone());
        names.extend(function.arguments.iter().filter_map(|a| a.name.clone()));
        names.extend(
            function
                .local_variables
                .iter()
                .filter_map(|(_, v)| v.name.clone()),
        );
        names.extend(function.named_expressions.values().cloned());
    }
    for (_, kind) in module.types.iter() {
        names.extend(kind.name.clone());
        if let naga::TypeInner::Struct { members, .. } = &kind.inner {
            names.extend(members.iter().filter_map(|m| m.name.clone()));
        }
    }
    names.extend(module.constants.iter().filter_map(|(_, c)| c.name.clone()));
    names
}

#[test]
fn every_name_that_is_parsed_is_a_declaration() {
    for module in MODULES {
        let Ok(text) = compose(&[module.path]) else {
            continue;
        };
        let Ok(parsed) = naga::front::wgsl::parse_str(&text) else {
            continue;
        };
        let found: BTreeSet<&str> = declarations(&text).iter().map(|d| d.name).collect();
        let functions = parsed
            .functions
            .iter()
            .filter_map(|(_, f)| f.name.as_deref());
        let constants = parsed
            .constants
            .iter()
            .filter_map(|(_, c)| c.name.as_deref());
        for name in functions.chain(constants) {
            assert!(found.contains(name), "{}: `{name}`", module.path);
        }
    }
}

macro_rules! shaders_of_lobes {
    ($($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
        &[$((stringify!($name), $shader)),*]
    };
}

#[test]
fn every_lobe_has_its_shader() {
    let lobes: &[(&str, &str)] = specula_bsdf::lobe_table!(shaders_of_lobes);
    let missing = lobes
        .iter()
        .filter(|(_, shader)| !MODULES.iter().any(|m| m.path == *shader));
    none(
        &missing
            .map(|(lobe, shader)| {
                format!("lobe {lobe}: there is no crates/specula-shaders/wgsl/{shader}.wgsl")
            })
            .collect::<Vec<_>>(),
    );
}
