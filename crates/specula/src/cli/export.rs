//! `specula export`.

use crate::cli::ExitCode;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::bsdf::measured::Measured;
use crate::scene::{atomic, measured};
use crate::shaders::{Export, ExportError, File, Language, MODULES, TABLES_FILE};
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
  specula export --lang wgsl --measured gold.bsdf -o shaders
      beside the library the numbers of a measured material, and where measured_of finds them
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

    /// A measured material to write as NAME.measured.bin, the numbers that the module measured reads: little-endian
    /// floats. May be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) measured: Vec<PathBuf>,

    /// Folder to write to, made where there is none
    #[arg(short, long, value_name = "DIR", required_unless_present = "list")]
    pub(crate) output: Option<PathBuf>,

    /// List the modules and write nothing
    #[arg(long, conflicts_with_all = ["lang", "modules", "functions", "measured", "output"])]
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
    let materials = measured_files(&arguments.measured)?;
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
    let tables = files.iter().find(|f| f.name == TABLES_FILE);
    write_measured(folder, &materials, tables)?;
    let is_plain = arguments.prefix.is_empty() && arguments.namespace == Export::NAMESPACE;
    if functions.is_empty() && is_plain {
        tell_what_lacks_an_example(languages, &files);
    }
    Ok(ExitCode::SUCCESS)
}

/// A measured material as shaders read it.
struct MeasuredFile {
    name: String,
    numbers: Vec<f32>,
}

fn measured_files(paths: &[PathBuf]) -> Result<Vec<MeasuredFile>, Failure> {
    let mut files: Vec<MeasuredFile> = Vec::new();
    for path in paths {
        let wrong = |e: &dyn Display| Failure::bad_input(format_args!("{}: {e}", path.display()));
        let tables = measured::read_tables(path).map_err(|e| wrong(&e))?;
        let lobe = Measured::<f32>::new(&tables).map_err(|e| wrong(&e))?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}.measured.bin");
        if files.iter().any(|f| f.name == name) {
            return Err(wrong(&format_args!("another file becomes {name}, too")));
        }
        files.push(MeasuredFile {
            name,
            numbers: lobe.packed(),
        });
    }
    Ok(files)
}

/// Writes measured materials, and says where each begins once all are in one array.
///
/// * `tables`: what they go behind.
fn write_measured(
    folder: &Path,
    files: &[MeasuredFile],
    tables: Option<&File>,
) -> Result<(), Failure> {
    let mut at = tables.map_or(0, |file| file.bytes.len() / size_of::<f32>());
    let mut before = tables.map_or("", |_| TABLES_FILE);
    for file in files {
        let path = folder.join(&file.name);
        let bytes: Vec<u8> = (file.numbers.iter())
            .flat_map(|x| x.to_le_bytes())
            .collect();
        atomic::replace(&path, |out| out.write_all(&bytes))
            .map_err(|e: io::Error| cannot_write(&path, &e))?;
        let place = match before {
            "" => String::new(),
            name => format!(" behind {name}"),
        };
        say!("wrote {}: measured_of({at}){place}", path.display());
        at += file.numbers.len();
        before = &file.name;
    }
    Ok(())
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
