//! `specula export`.

use crate::cli::ExitCode;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::scene::atomic;
use crate::shaders::{Export, ExportError, File, Language, MODULES};
use clap::Args;

use super::console::say;
use super::{Failure, print};

const EXPORT_EXAMPLES: &str = "\
Examples:
  specula export --lang hlsl -o shaders
      shaders/specula.hlsl to include, shaders/example.hlsl that does, and the energy tables
  specula export --lang glsl --modules ggx,bounded -o shaders
      these modules and what they use
  specula export --lang cpp -o include
      include/specula.hpp for C++17, CUDA and HIP
  specula export --lang hlsl --functions bounded_sample_direction,bounded_reflection_pdf -o shaders
      these two functions and what they call, nothing else
  specula export --lang glsl --modules compensated --prefix spc_ -o shaders
      every name with a prefix, so that none meets one of yours
  specula export -o shaders
      all languages
  specula export --list
      the modules

Every function keeps its name and its documentation. Files are replaced whole or not at all.";

#[derive(Args, Debug)]
#[command(after_help = EXPORT_EXAMPLES)]
pub(crate) struct ExportArguments {
    /// Languages, separated by commas: wgsl, hlsl, glsl, glsl-es, msl, spirv, cpp (or cuda) [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) lang: Vec<Language>,

    /// Modules, separated by commas; what they use comes with them [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) modules: Vec<String>,

    /// Functions, separated by commas: they and what they need are written, and nothing else of the modules
    /// [default: all]
    #[arg(
        long,
        visible_alias = "minimal",
        value_name = "NAMES",
        value_delimiter = ','
    )]
    pub(crate) functions: Vec<String>,

    /// In front of the names of functions, structures and constants
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub(crate) prefix: String,

    /// Namespace of C++, such as my::brdf
    #[arg(long, value_name = "NAME", default_value = Export::NAMESPACE)]
    pub(crate) namespace: String,

    /// Folder to write to, made where there is none
    #[arg(short, long, value_name = "DIR", required_unless_present = "list")]
    pub(crate) output: Option<PathBuf>,

    /// List the modules and write nothing
    #[arg(long, conflicts_with_all = ["lang", "modules", "functions", "output"])]
    pub(crate) list: bool,
}

/// Writes the library in languages of shaders and in C++, or lists its modules.
pub(crate) fn run(arguments: &ExportArguments) -> Result<ExitCode, Failure> {
    let Some(folder) = &arguments.output else {
        print(&list())?;
        return Ok(ExitCode::SUCCESS);
    };
    let modules: Vec<&str> = arguments.modules.iter().map(String::as_str).collect();
    let functions: Vec<&str> = arguments.functions.iter().map(String::as_str).collect();
    let languages = match &arguments.lang[..] {
        [] => &Language::ALL[..],
        some => some,
    };
    // All are made before the first is written.
    let mut files: Vec<File> = Vec::new();
    for language in languages {
        let export = Export {
            language: *language,
            modules: &modules,
            functions: &functions,
            prefix: &arguments.prefix,
            namespace: &arguments.namespace,
        };
        for file in export.files().map_err(failure)? {
            if !files.iter().any(|f| f.name == file.name) {
                files.push(file);
            }
        }
    }
    std::fs::create_dir_all(folder).map_err(|e| cannot_write(folder, &e))?;
    for file in &files {
        let path = folder.join(file.name);
        atomic::replace(&path, |out| out.write_all(&file.bytes))
            .map_err(|e: io::Error| cannot_write(&path, &e))?;
        say!("wrote {}", path.display());
    }
    let is_plain = arguments.prefix.is_empty() && arguments.namespace == Export::NAMESPACE;
    if functions.is_empty() && is_plain {
        tell_what_lacks_an_example(languages, &files);
    }
    Ok(ExitCode::SUCCESS)
}

/// The languages whose worked example calls what was not asked for.
fn tell_what_lacks_an_example(languages: &[Language], files: &[File]) {
    let is_absent = |language: &&Language| !files.iter().any(|f| f.name == language.example_file());
    let absent = languages.iter().filter(is_absent);
    let mut calls: Vec<&[&str]> = absent.map(|language| language.example_modules()).collect();
    calls.dedup();
    for calls in calls {
        say!(
            "note: no worked example, as it calls {}",
            calls.join(" and ")
        );
    }
}

fn failure(error: ExportError) -> Failure {
    match error {
        ExportError::Compose(error) => Failure::bad_input(format_args!(
            "{error}\n`specula export --list` names all modules"
        )),
        ExportError::Prefix(_) | ExportError::Namespace(_) => Failure::bad_input(error),
        other => Failure::other(other),
    }
}

fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    Failure::other(format_args!("cannot write '{}': {error}", path.display()))
}

/// Every module with what it is, by folder.
fn list() -> String {
    let width = MODULES.iter().map(|m| m.name().len()).max().unwrap_or(0);
    let mut text = String::new();
    let mut folder = "";
    for module in MODULES {
        if module.folder() != folder {
            folder = module.folder();
            text += &format!("\n{folder}\n");
        }
        text += &format!("  {:width$}  {}\n", module.name(), module.summary());
    }
    text
}
