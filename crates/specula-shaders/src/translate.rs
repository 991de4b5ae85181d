//! WGSL to the other languages, through naga.

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use thiserror::Error;

use crate::items::identifiers;
use crate::language::Language;
use crate::restore::restore_names;
use crate::slang;

/// What naga says where it cannot read or write a module.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct TranslateError(String);

impl TranslateError {
    pub(crate) fn of(error: impl std::fmt::Display) -> Self {
        Self(error.to_string())
    }
}

/// The entry point without which naga writes no GLSL; not in the text that is returned.
const ENTRY: &str = "specula_entry";

/// Where the tables are bound.
const TABLES: naga::ResourceBinding = naga::ResourceBinding {
    group: 0,
    binding: 0,
};

/// A text in the language, with the names of the WGSL and no comments.
pub(crate) fn text(wgsl: &str, language: Language) -> Result<String, TranslateError> {
    let text = match language {
        Language::Wgsl => return Ok(wgsl.to_owned()),
        Language::Hlsl => to_hlsl(wgsl)?,
        Language::Slang => slang::from_hlsl(&to_hlsl(wgsl)?),
        Language::Glsl => library_part(&to_glsl(wgsl, glsl::Version::Desktop(450))?),
        Language::GlslEs => library_part(&to_glsl(wgsl, glsl::Version::new_gles(310))?),
        Language::Msl => to_msl(wgsl)?,
        Language::SpirV => return Err(TranslateError::of("SPIR-V is no text")),
        Language::Cpp => return Err(TranslateError::of("naga writes no C++")),
    };
    Ok(restore_names(&text))
}

/// The words of a SPIR-V module with names.
pub(crate) fn words(wgsl: &str) -> Result<Vec<u32>, TranslateError> {
    let (module, info) = parse(wgsl)?;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG,
        force_loop_bounding: false,
        ..spv::Options::default()
    };
    spv::write_vec(&module, &info, &options, None).map_err(TranslateError::of)
}

/// The module that naga makes of a text, and what it knows of it.
pub(crate) fn parse(wgsl: &str) -> Result<(naga::Module, ModuleInfo), TranslateError> {
    let module =
        naga::front::wgsl::parse_str(wgsl).map_err(|e| TranslateError(e.emit_to_string(wgsl)))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| TranslateError(e.emit_to_string(wgsl)))?;
    Ok((module, info))
}

fn to_hlsl(wgsl: &str) -> Result<String, TranslateError> {
    let (module, info) = parse(wgsl)?;
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V5_1,
        restrict_indexing: false,
        force_loop_bounding: false,
        ..hlsl::Options::default()
    };
    let mut text = String::new();
    hlsl::Writer::new(&mut text, &options, &hlsl::PipelineOptions::default())
        .write(&module, &info, None)
        .map_err(TranslateError::of)?;
    Ok(text)
}

fn to_glsl(wgsl: &str, version: glsl::Version) -> Result<String, TranslateError> {
    let wgsl = format!("{wgsl}\n@compute @workgroup_size(1)\nfn {ENTRY}() {{\n}}\n");
    let (module, info) = parse(&wgsl)?;
    let options = glsl::Options {
        version,
        writer_flags: glsl::WriterFlags::INCLUDE_UNUSED_ITEMS,
        binding_map: [(TABLES, 0)].into_iter().collect(),
        ..glsl::Options::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: naga::ShaderStage::Compute,
        entry_point: ENTRY.to_owned(),
        multiview: None,
    };
    let mut text = String::new();
    let policies = naga::proc::BoundsCheckPolicies::default();
    glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map_err(TranslateError::of)?;
    Ok(text)
}

fn to_msl(wgsl: &str) -> Result<String, TranslateError> {
    let (module, info) = parse(wgsl)?;
    let options = msl::Options {
        lang_version: (2, 0),
        force_loop_bounding: false,
        ..msl::Options::default()
    };
    let (text, _) = msl::write_string(&module, &info, &options, &msl::PipelineOptions::default())
        .map_err(TranslateError::of)?;
    Ok(with_joined_arguments(&with_plain_tables(&text)))
}

/// Longest line that [`with_joined_arguments`] makes.
const WIDTH: usize = 120;

/// The text with the arguments of a function on its line, where they fit; naga gives each a line of its own.
fn with_joined_arguments(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let is_function = line.ends_with('(') && !line.starts_with(' ');
        let mut head = vec![line];
        while is_function && !head[head.len() - 1].starts_with(')') {
            let Some(next) = lines.next() else { break };
            head.push(next);
        }
        let [first, arguments @ .., last] = &head[..] else {
            joined += line;
            joined.push('\n');
            continue;
        };
        let arguments: Vec<&str> = arguments.iter().map(|line| line.trim()).collect();
        let one = format!("{first}{}{last}", arguments.join(" "));
        joined += &match one.len() <= WIDTH {
            true => one,
            false => head.join("\n"),
        };
        joined.push('\n');
    }
    joined
}

/// MSL that takes the tables as a pointer, without the sizes that naga passes along with buffers, and
/// whose numbered types carry our name.
fn with_plain_tables(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut inside_sizes = false;
    for line in text.lines() {
        inside_sizes |= line.starts_with("struct _mslBufferSizes");
        let sizes = line.trim_start().starts_with("constant _mslBufferSizes&");
        let unsized_array = line.starts_with("typedef float type_") && line.ends_with("[1];");
        if sizes {
            // The tables come before their size, which is the last argument.
            plain.truncate(plain.trim_end_matches([',', '\n']).len());
            plain.push('\n');
        } else if line.trim_start().starts_with("device type_") {
            plain += "    device const float* specula_tables,\n";
        } else if !inside_sizes && !unsized_array && !line.starts_with("// language") {
            let line = line.replace(", _buffer_sizes)", ")");
            plain += &with_own_types(&line);
            plain.push('\n');
        }
        inside_sizes &= line != "};";
    }
    plain
}

/// `type_7` as `specula_type_7`.
fn with_own_types(line: &str) -> String {
    let mut result = String::with_capacity(line.len());
    let mut end = 0;
    for (at, word) in identifiers(line) {
        if word.starts_with("type_") {
            result += &line[end..at];
            result += "specula_";
            end = at;
        }
    }
    result + &line[end..]
}

/// GLSL without what belongs to a whole shader (the version, extensions, precisions, the size of a
/// workgroup, `main`), and with the names of the tables.
fn library_part(text: &str) -> String {
    let whole = [
        "#version ",
        "#extension ",
        "precision ",
        "layout(local_size_x ",
    ];
    let mut part = String::with_capacity(text.len());
    let mut inside_main = false;
    for line in text.lines() {
        inside_main |= line.starts_with("void main()");
        if !inside_main && !whole.iter().any(|w| line.starts_with(w)) {
            part += &with_table_names(line);
            part.push('\n');
        }
        inside_main &= line != "}";
    }
    part
}

/// A line of GLSL with `specula_tables` for the name that naga makes of the binding.
fn with_table_names(line: &str) -> String {
    let line = line.replace("_group_0_binding_0_cs", "specula_tables");
    match line.split_once(" buffer ") {
        Some((layout, block)) if line.starts_with("layout(") => {
            let members = block.find('{').map_or("", |at| &block[at..]);
            format!("{layout} buffer SpeculaTables {members}")
        }
        _ => line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_has_nothing_of_a_whole_shader() {
        let wgsl = "@group(0) @binding(0) var<storage, read> specula_tables: array<f32>;\n\
                    fn energy_table(index: u32) -> f32 {\n    return specula_tables[index];\n}\n";
        for (language, expected) in [
            (
                Language::Glsl,
                "layout(std430, binding = 0) readonly buffer SpeculaTables { float specula_tables[]; };",
            ),
            (
                Language::GlslEs,
                "layout(std430, binding = 0) readonly buffer SpeculaTables { float specula_tables[]; };",
            ),
            (
                Language::Hlsl,
                "ByteAddressBuffer specula_tables : register(t0);",
            ),
            (
                Language::Msl,
                "float energy_table(uint index, device const float* specula_tables) {\n",
            ),
        ] {
            let text = text(wgsl, language).unwrap();
            assert!(text.contains(expected), "{text}");
            assert!(text.contains("float energy_table("), "{text}");
            for other in [
                "#version",
                "#extension",
                "precision",
                "local_size",
                "main",
                "Sizes",
            ] {
                assert!(!text.contains(other), "{other} in {text}");
            }
        }
    }

    #[test]
    fn arguments_that_fit_are_on_the_line_of_their_function() {
        let long = format!(
            "float g(\n    float {},\n    float b\n) {{\n}}\n",
            "a".repeat(WIDTH)
        );
        let short = "float f(\n    float a,\n    float b\n) {\n    return g(\n        a, b);\n}\n";
        let expected = "float f(float a, float b) {\n    return g(\n        a, b);\n}\n";
        assert_eq!(
            with_joined_arguments(&format!("{long}{short}")),
            long + expected
        );
    }

    #[test]
    fn errors_are_told_with_their_place() {
        let error = text("fn f() -> f32 {\n    return g;\n}\n", Language::Hlsl).unwrap_err();
        assert!(error.to_string().contains("wgsl:2:12"), "{error}");
    }
}
