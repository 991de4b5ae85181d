//! `cargo xtask c-library`: the C interface, built and laid out below a prefix, as compilers look for it.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Result, workspace};

/// The static library.
const STATIC: &str = if cfg!(windows) {
    "specula_c.lib"
} else {
    "libspecula_c.a"
};

/// Where to.
#[derive(clap::Args)]
pub(crate) struct CLibrary {
    /// Folder with `include` and `lib`, made where there is none
    #[arg(long, value_name = "DIR", default_value = "target/c")]
    prefix: PathBuf,
}

/// Builds the libraries and installs them.
pub(crate) fn run(root: &Path, arguments: &CLibrary) -> Result<()> {
    let mut build = workspace::cargo(root);
    build.args(["build", "--release", "--package", "specula-c"]);
    // The folder is known only if we say it.
    let target = root.join("target");
    build.arg("--target-dir").arg(&target);
    if !build.status()?.success() {
        return Err("the C interface does not build".into());
    }
    fs::create_dir_all(&arguments.prefix)?;
    let prefix = fs::canonicalize(&arguments.prefix)?;
    let files = install(root, &target.join("release"), &prefix)?;
    for file in &files {
        without_debug_information(file);
    }
    for file in files {
        println!("wrote {}", file.display());
    }
    println!(
        "compile with the flags of: PKG_CONFIG_PATH={} pkg-config --cflags --libs specula",
        prefix.join("lib/pkgconfig").display()
    );
    Ok(())
}

/// Makes a library a quarter of its size, where there is a program for it.
fn without_debug_information(file: &Path) {
    let is_library = ["so", "a", "dylib"]
        .map(Some)
        .contains(&file.extension().and_then(|e| e.to_str()));
    if is_library {
        let mut strip = Command::new("strip");
        let option = if cfg!(target_os = "macos") {
            "-S"
        } else {
            "--strip-debug"
        };
        // It serves as well with it.
        let _ = strip.arg(option).arg(file).status();
    }
}

/// Copies what was built.
///
/// * `built`: where the libraries are.
fn install(root: &Path, built: &Path, prefix: &Path) -> Result<Vec<PathBuf>> {
    let source = root.join("crates/specula-c");
    let shared = format!("{DLL_PREFIX}specula_c{DLL_SUFFIX}");
    let folder = if cfg!(windows) { "bin" } else { "lib" };
    let copies = [
        (
            source.join("include/specula.h"),
            "include/specula.h".to_owned(),
        ),
        (built.join(&shared), format!("{folder}/{shared}")),
        (built.join(STATIC), format!("lib/{STATIC}")),
        (
            source.join("cmake/SpeculaConfig.cmake"),
            "lib/cmake/Specula/SpeculaConfig.cmake".to_owned(),
        ),
    ];
    let mut written = Vec::new();
    for (from, to) in copies {
        let to = made(prefix.join(to))?;
        fs::copy(&from, &to).map_err(|e| format!("{}: {e}", from.display()))?;
        written.push(to);
    }
    let template = fs::read_to_string(source.join("specula.pc.in"))?;
    let text = template
        .lines()
        .filter(|line| !line.starts_with("# @"))
        .flat_map(|line| [line, "\n"])
        .collect::<String>()
        .replace("@PREFIX@", &prefix.to_string_lossy())
        .replace("@VERSION@", env!("CARGO_PKG_VERSION"));
    let to = made(prefix.join("lib/pkgconfig/specula.pc"))?;
    fs::write(&to, text)?;
    written.push(to);
    Ok(written)
}

/// A file's path, whose folder is there then.
fn made(file: PathBuf) -> Result<PathBuf> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_go_where_compilers_look() {
        let folder = std::env::temp_dir().join(format!("c-library-{}", std::process::id()));
        let (built, prefix) = (folder.join("built"), folder.join("prefix"));
        fs::create_dir_all(&built).unwrap();
        // Nothing is built.
        assert!(install(&workspace::root(), &built, &prefix).is_err());
        for name in [
            format!("{DLL_PREFIX}specula_c{DLL_SUFFIX}"),
            STATIC.to_owned(),
        ] {
            fs::write(built.join(name), "library").unwrap();
        }
        let files = install(&workspace::root(), &built, &prefix).unwrap();
        assert!(
            files.len() == 5 && files.iter().all(|f| f.is_file()),
            "{files:?}"
        );
        let text = fs::read_to_string(prefix.join("lib/pkgconfig/specula.pc")).unwrap();
        let head = format!("prefix={}\n", prefix.display());
        assert!(text.starts_with(&head) && !text.contains('@'), "{text}");
        fs::remove_dir_all(&folder).unwrap();
    }
}
