//! Where the workspace is, and what source files it has.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Result;

/// The workspace's root folder.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

/// Specula's program: `given`, or built from this workspace.
pub(crate) fn program(root: &Path, given: Option<&Path>) -> Result<PathBuf> {
    program_with(root, given, "default")
}

/// The same with these features.
pub(crate) fn program_with(root: &Path, given: Option<&Path>, features: &str) -> Result<PathBuf> {
    if let Some(program) = given {
        return Ok(program.to_owned());
    }
    let mut build = cargo(root);
    build.args(["build", "--release", "--quiet", "--package", "specula"]);
    build.args(["--features", features]);
    if !build.status()?.success() {
        return Err("Specula does not build".into());
    }
    let name = format!("specula{}", std::env::consts::EXE_SUFFIX);
    // Cargo puts it beside this chore's.
    Ok(std::env::current_exe()?.with_file_name(name))
}

/// A `cargo` to be run in the workspace: the one that runs this chore.
pub(crate) fn cargo(root: &Path) -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root);
    command
}

/// A command that installs this version of a crate's program in `folder/bin`, and says so.
pub(crate) fn install(root: &Path, folder: &Path, name: &str, version: &str) -> Command {
    println!("installing {name} {version} in {}", folder.display());
    let mut install = cargo(root);
    install
        .args(["install", name, "--quiet", "--locked", "--force"])
        .args(["--version", &format!("={version}")])
        // Such programs take seconds without optimisation; to optimise and to describe them takes minutes.
        .arg("--debug")
        .env("CARGO_PROFILE_DEV_DEBUG", "false")
        .arg("--root")
        .arg(folder)
        .arg("--target-dir")
        .arg(folder.join("build"));
    install
}

/// Every `.rs` file under `crates`, sorted; folders named `target` are left out.
pub(crate) fn rust_files(root: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![root.join("crates")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                if path.file_name().is_some_and(|name| name != "target") {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|e| e == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
