//! `specula shaders`.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use specula::scene::atomic;
use specula::shaders::{EXAMPLE_MODULES, ExportError, File, Language, MODULES, export};

use super::arguments::ShadersArguments;
use super::console::say;
use super::{Failure, print};

/// Writes the library in shading languages, or lists its modules.
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
    if !files.iter().any(|f| f.name == languages[0].example_file()) {
        let calls = EXAMPLE_MODULES.join(" and ");
        say!("note: no worked example, as it calls {calls}");
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
