//! The files that users take away: a library, a worked example, the tables.

use thiserror::Error;

use crate::compose::{compose, ordered};
use crate::cpp;
use crate::document::documented;
use crate::error::ComposeError;
use crate::header::{TABLE_MODULE, header};
use crate::language::Language;
use crate::modules::Module;
use crate::needed::{Part, parts};
use crate::slang;
use crate::spirv::with_exports;
use crate::tables::tables;
use crate::translate::{self, TranslateError};

/// Modules that `chi_square.cpp` calls.
const TESTED: [&str; 12] = [
    "heitz",
    "cap",
    "bounded",
    "exact",
    "beckmann_visible",
    "rough_conductor",
    "compensated",
    "compensated_dielectric",
    "coated_diffuse",
    "lambert",
    "eon",
    "diffuse_transmission",
];

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
    /// What cannot stand in front of names.
    #[error("prefix '{0}': expected letters, digits and single underscores, no digit first")]
    Prefix(String),
    /// What names no namespace.
    #[error("namespace '{0}': expected names that are joined by ::")]
    Namespace(String),
    /// The language cannot say it.
    #[error("cannot be written in {language}: {error}")]
    Translate {
        /// The language.
        language: Language,
        /// What is in the way.
        error: TranslateError,
    },
}

/// The file of the energy tables.
pub const TABLES_FILE: &str = "energy_tables.bin";

/// The library in a language, with what goes with it: all of it, or what is chosen.
///
/// ```
/// use specula_shaders::{Export, Language};
///
/// let bounded = Export {
///     functions: &["bounded_sample_direction", "bounded_reflection_pdf"],
///     ..Export::new(Language::Glsl)
/// };
/// let files = bounded.files()?;
/// assert_eq!(files[0].name, "specula.glsl");
/// # Ok::<(), specula_shaders::ExportError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Export<'a> {
    /// The language.
    pub language: Language,
    /// Names of modules, which come with all that they import ([`ordered`]); none: all modules.
    pub modules: &'a [&'a str],
    /// Names of functions of these modules: only they and what they need are written; none: all functions.
    pub functions: &'a [&'a str],
    /// In front of the names of functions, structures and constants, so that they do not meet those of another program.
    pub prefix: &'a str,
    /// The namespace, in C++; [`NAMESPACE`](Self::NAMESPACE) elsewhere.
    pub namespace: &'a str,
}

impl Export<'_> {
    /// The namespace of C++ where no other is asked for.
    pub const NAMESPACE: &'static str = "specula";

    /// All of the library.
    #[must_use]
    pub fn new(language: Language) -> Self {
        Self {
            language,
            modules: &[],
            functions: &[],
            prefix: "",
            namespace: Self::NAMESPACE,
        }
    }

    /// The files:
    ///
    /// * the library;
    /// * a worked example, where all that it calls is there by its name;
    /// * in C++, chi-square tests of the samplers and a Makefile for `make check`, likewise;
    /// * the energy tables, where they are read: little-endian floats.
    ///
    /// # Errors
    ///
    /// A name that nothing has, or one that is no name.
    pub fn files(&self) -> Result<Vec<File>, ExportError> {
        self.check()?;
        let language = self.language;
        let modules = ordered(self.modules)?;
        let parts = parts(&modules, self.functions, self.prefix)?;
        let parts: Vec<Module<'_>> = parts.iter().map(Part::module).collect();
        let failed = |error| ExportError::Translate { language, error };
        let mut files = vec![File {
            name: language.text_file(),
            bytes: self.library(&parts).map_err(failed)?,
        }];
        let called = ordered(language.example_modules())?;
        let is_plain = self.functions.is_empty()
            && self.prefix.is_empty()
            && self.namespace == Self::NAMESPACE;
        if is_plain && called.iter().all(|m| modules.contains(m)) {
            files.push(File {
                name: language.example_file(),
                bytes: example(language).map_err(failed)?,
            });
        }
        if language == Language::Cpp
            && is_plain
            && ordered(&TESTED)?.iter().all(|m| modules.contains(m))
        {
            let texts = [
                ("chi_square.cpp", include_str!("../example/chi_square.cpp")),
                ("Makefile", include_str!("../example/Makefile")),
            ];
            files.extend(texts.map(|(name, text)| File {
                name,
                bytes: text.as_bytes().to_vec(),
            }));
        }
        if parts.iter().any(|m| m.path == TABLE_MODULE) {
            files.push(File {
                name: TABLES_FILE,
                bytes: tables().to_vec(),
            });
        }
        Ok(files)
    }

    fn check(&self) -> Result<(), ExportError> {
        let is_name = |name: &str| {
            let is_part = |c: char| c == '_' || c.is_ascii_alphanumeric();
            name.chars().all(is_part) && !name.starts_with(|c: char| c.is_ascii_digit())
        };
        let names = self.namespace.split("::");
        if names.clone().any(|n| n.is_empty() || !is_name(n)) {
            return Err(ExportError::Namespace(self.namespace.to_owned()));
        }
        // Languages keep names with two of them for themselves.
        if !is_name(self.prefix) || self.prefix.contains("__") || self.prefix == "_" {
            return Err(ExportError::Prefix(self.prefix.to_owned()));
        }
        Ok(())
    }

    /// The options that choose the same again.
    fn asked(&self) -> String {
        let list = |name: &str, values: &[&str]| match values {
            [] => String::new(),
            values => format!(" --{name} {}", values.join(",")),
        };
        let mut asked = list("modules", self.modules) + &list("functions", self.functions);
        if !self.prefix.is_empty() {
            asked += &format!(" --prefix {}", self.prefix);
        }
        if self.namespace != Self::NAMESPACE {
            asked += &format!(" --namespace {}", self.namespace);
        }
        asked
    }

    fn library(&self, modules: &[Module<'_>]) -> Result<Vec<u8>, TranslateError> {
        let language = self.language;
        let codes: Vec<String> = modules.iter().map(Module::code).collect();
        let wgsl = codes.join("\n");
        let body = match language {
            Language::SpirV => return Ok(bytes(&with_exports(&translate::words(&wgsl)?))),
            Language::Wgsl => {
                let marked = modules.iter().zip(&codes);
                let marked =
                    marked.map(|(m, code)| format!("// {} {}\n{code}", "-".repeat(60), m.path));
                marked.collect::<Vec<_>>().join("\n")
            }
            Language::Cpp => cpp::library(modules, !self.functions.is_empty())?,
            Language::Slang => {
                let text = translate::text(&wgsl, language)?;
                let marked = slang::Differentiable::of(&text, self.prefix);
                slang::module(documented(&text, modules).trim_matches('\n'), &marked)
            }
            _ => documented(&translate::text(&wgsl, language)?, modules),
        };
        let text = header(language, &self.asked(), modules) + &self.guarded(&body);
        Ok(self.in_namespace(text).into_bytes())
    }

    /// The text of C++ in the namespace that is asked for.
    fn in_namespace(&self, text: String) -> String {
        if self.language != Language::Cpp || self.namespace == Self::NAMESPACE {
            return text;
        }
        let own = self.namespace;
        text.replace("namespace specula", &format!("namespace {own}"))
            .replace("namespace `specula`", &format!("namespace `{own}`"))
            .replace("specula::", &format!("{own}::"))
    }

    /// The text once, however often it is included.
    fn guarded(&self, body: &str) -> String {
        let guard = match self.language {
            Language::Wgsl | Language::SpirV | Language::Slang => return body.to_owned(),
            Language::Hlsl => "SPECULA_HLSL",
            Language::Glsl | Language::GlslEs => "SPECULA_GLSL",
            Language::Msl => "SPECULA_METAL",
            Language::Cpp => "SPECULA_HPP",
        };
        let own = match self.namespace {
            Self::NAMESPACE => String::new(),
            other => other.replace("::", "_") + "_",
        };
        let guard = (self.prefix.to_owned() + &own).to_uppercase() + guard;
        let body = body.trim_matches('\n');
        format!("#ifndef {guard}\n#define {guard}\n\n{body}\n\n#endif\n")
    }
}

/// [`Export::files`] of modules.
///
/// # Errors
///
/// A name that no module has.
pub fn export(language: Language, wanted: &[&str]) -> Result<Vec<File>, ExportError> {
    let export = Export {
        modules: wanted,
        ..Export::new(language)
    };
    export.files()
}

/// A WGSL text that is written as the library is, in a language: as [`Export::files`] writes the library, but for the
/// header and the documentation. SPIR-V exports every function by name.
///
/// # Errors
///
/// What the language cannot say.
pub fn translated(wgsl: &str, language: Language) -> Result<Vec<u8>, TranslateError> {
    Ok(match language {
        Language::SpirV => bytes(&with_exports(&translate::words(wgsl)?)),
        Language::Cpp => cpp::to_cpp(wgsl)?.into_bytes(),
        _ => translate::text(wgsl, language)?.into_bytes(),
    })
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
        Language::Slang => include_str!("../example/example.slang"),
        Language::SpirV => {
            let example = include_str!("../example/example.wgsl");
            let library = compose(language.example_modules()).map_err(TranslateError::of)?;
            return Ok(bytes(&translate::words(&format!("{library}\n{example}"))?));
        }
    };
    Ok(text.as_bytes().to_vec())
}
