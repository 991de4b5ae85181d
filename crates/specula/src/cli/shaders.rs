//! `specula shaders`.

use crate::cli::ExitCode;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::scene::atomic;
use crate::shaders::{ExportError, File, Language, MODULES, export};
use clap::Args;

use super::console::say;
use super::{Failure, print};

const SHADERS_EXAMPLES: &str = "\
Examples:
  specula shaders --lang hlsl -o shaders
      shaders/specula.hlsl to include, shaders/example.hlsl that does, and the energy tables
  specula shaders --lang glsl --modules ggx,bounded -o shaders
      these modules and what they use
  specula shaders --lang cpp -o include
      include/specula.hpp for C++17, CUDA and HIP
  specula shaders -o shaders
      all languages
  specula shaders --list
      the modules

Every function keeps its name and its documentation. Files are replaced whole or not at all.";

#[derive(Args, Debug)]
#[command(after_help = SHADERS_EXAMPLES)]
pub(crate) struct ShadersArguments {
    /// Languages, separated by commas: wgsl, hlsl, glsl, glsl-es, msl, spirv, cpp [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) lang: Vec<Language>,

    /// Modules, separated by commas; what they use comes with them [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) modules: Vec<String>,

    /// Folder to write to, made where there is none
    #[arg(short, long, value_name = "DIR", required_unless_present = "list")]
    pub(crate) output: Option<PathBuf>,

    /// List the modules and write nothing
    #[arg(long, conflicts_with_all = ["lang", "modules", "output"])]
    pub(crate) list: bool,
}

/// Writes the library in languages of shaders and in C++, or lists its modules.
pub(crate) fn run(arguments: &ShadersArguments) -> Result<ExitCode, Failure> {
    let Some(folder) = &arguments.output else {
        print(&list())?;
        return Ok(ExitCode::SUCCESS);
    };
    let modules: Vec<&str> = arguments.modules.iter().map(String::as_str).collect();
    let languages = match &arguments.lang[..] {
        [] => &Language::ALL[..],
        some => some,
    };
    // All are made before the first is written.
    let mut files: Vec<File> = Vec::new();
    for language in languages {
        for file in export(*language, &modules).map_err(failure)? {
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
    Ok(ExitCode::SUCCESS)
}

fn failure(error: ExportError) -> Failure {
    match error {
        ExportError::Compose(error) => Failure::bad_input(format_args!(
            "{error}\n`specula shaders --list` names all modules"
        )),
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
