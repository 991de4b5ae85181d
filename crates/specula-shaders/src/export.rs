//! The files that users take away: a library, a worked example, the tables.

use thiserror::Error;

use crate::compose::{compose, ordered};
use crate::cpp;
use crate::document::documented;
use crate::error::ComposeError;
use crate::header::{TABLE_MODULE, header};
use crate::language::Language;
use crate::modules::Module;
use crate::spirv::with_exports;
use crate::tables::tables;
use crate::translate::{self, TranslateError};

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name, in a folder that the user chooses.
    pub name: &'static str,
    /// All of it.
    pub bytes: Vec<u8>,
}

/// Why there is nothing to write.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ExportError {
    /// What was asked for is not there.
    #[error(transparent)]
    Compose(#[from] ComposeError),
    /// The language cannot say it.
    #[error("cannot be written in {language}: {error}")]
    Translate {
        /// The language.
        language: Language,
        /// What is in the way.
        error: TranslateError,
    },
}

/// The library in a language, and what goes with it:
///
/// * the wanted modules and all that they import ([`ordered`]); all modules where none is named;
/// * a worked example, where the modules that it calls are among them;
/// * the energy tables, where they are read: little-endian floats.
///
/// # Errors
///
/// A name that no module has.
pub fn export(language: Language, wanted: &[&str]) -> Result<Vec<File>, ExportError> {
    let modules = ordered(wanted)?;
    let failed = |error| ExportError::Translate { language, error };
    let mut files = vec![File {
        name: language.text_file(),
        bytes: library(language, wanted, &modules).map_err(failed)?,
    }];
    let called = ordered(language.example_modules())?;
    if called.iter().all(|m| modules.contains(m)) {
        files.push(File {
            name: language.example_file(),
            bytes: example(language).map_err(failed)?,
        });
    }
    if modules.iter().any(|m| m.path == TABLE_MODULE) {
        files.push(File {
            name: "energy_tables.bin",
            bytes: tables().to_vec(),
        });
    }
    Ok(files)
}

fn library(
    language: Language,
    wanted: &[&str],
    modules: &[Module],
) -> Result<Vec<u8>, TranslateError> {
    let parts: Vec<String> = modules.iter().map(Module::code).collect();
    let wgsl = parts.join("\n");
    let body = match language {
        Language::SpirV => return Ok(bytes(&with_exports(&translate::words(&wgsl)?))),
        Language::Wgsl => {
            let marked = modules.iter().zip(&parts);
            let marked =
                marked.map(|(m, part)| format!("// {} {}\n{part}", "-".repeat(60), m.path));
            marked.collect::<Vec<_>>().join("\n")
        }
        Language::Cpp => cpp::library(modules)?,
        _ => documented(&translate::text(&wgsl, language)?, modules),
    };
    let text = header(language, wanted, modules) + &guarded(language, &body);
    Ok(text.into_bytes())
}

/// The text once, however often it is included.
fn guarded(language: Language, body: &str) -> String {
    let guard = match language {
        Language::Wgsl | Language::SpirV => return body.to_owned(),
        Language::Hlsl => "SPECULA_HLSL",
        Language::Glsl | Language::GlslEs => "SPECULA_GLSL",
        Language::Msl => "SPECULA_METAL",
        Language::Cpp => "SPECULA_HPP",
    };
    let body = body.trim_matches('\n');
    format!("#ifndef {guard}\n#define {guard}\n\n{body}\n\n#endif\n")
}

/// The words of SPIR-V as they lie in a file.
fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|w| w.to_le_bytes()).collect()
}

/// The worked example, ready to be compiled beside the library; for SPIR-V, compiled.
fn example(language: Language) -> Result<Vec<u8>, TranslateError> {
    let text = match language {
        Language::Wgsl => include_str!("../example/example.wgsl"),
        Language::Hlsl => include_str!("../example/example.hlsl"),
        Language::Glsl => include_str!("../example/example.comp"),
        Language::GlslEs => include_str!("../example/example_es.comp"),
        Language::Msl => include_str!("../example/example.metal"),
        Language::Cpp => include_str!("../example/example.cpp"),
        Language::SpirV => {
            let example = include_str!("../example/example.wgsl");
            let library = compose(language.example_modules()).map_err(TranslateError::of)?;
            return Ok(bytes(&translate::words(&format!("{library}\n{example}"))?));
        }
    };
    Ok(text.as_bytes().to_vec())
}
