//! Whether `specula-bsdf` compiles with the oldest compiler that its manifest names.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Result, workspace};

/// Names the compiler; without it the toolchain of rustup and `/usr/bin/rustc` are asked.
const COMPILER: &str = "SPECULA_MSRV_RUSTC";

/// Checks the crate with every set of features, or says why not.
pub(crate) fn run(root: &Path) -> Result<()> {
    let manifest = std::fs::read_to_string(root.join("crates/specula-bsdf/Cargo.toml"))?;
    let wanted = rust_version(&manifest).ok_or("crates/specula-bsdf names no rust-version")?;
    let Some(compiler) = compiler(wanted)? else {
        println!("skipped: no Rust {wanted} (rustup toolchain install {wanted}, or {COMPILER})");
        return Ok(());
    };
    for features in [&[][..], &["--no-default-features"], &["--all-features"]] {
        let mut check = workspace::cargo(root);
        check.args(["check", "--quiet", "--package", "specula-bsdf"]);
        check.args(features).env("RUSTC", &compiler);
        // Lints are those of the workspace's own compiler.
        check.env("RUSTFLAGS", "--cap-lints=warn");
        // A folder of its own: the compilers' outputs do not mix.
        check.env("CARGO_TARGET_DIR", root.join("target/msrv"));
        if !check.status()?.success() {
            let features = features.join(" ");
            return Err(format!("specula-bsdf needs more than Rust {wanted} {features}").into());
        }
    }
    println!("specula-bsdf compiles with {}", version(&compiler)?);
    Ok(())
}

/// The `rust-version` of a manifest.
fn rust_version(manifest: &str) -> Option<&str> {
    let value = manifest
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = \""))?;
    value.strip_suffix('"')
}

/// A compiler of that version.
fn compiler(wanted: &str) -> Result<Option<PathBuf>> {
    if let Some(named) = std::env::var_os(COMPILER) {
        let named = PathBuf::from(named);
        let version = version(&named)?;
        if !is_version(&version, wanted) {
            return Err(format!("{COMPILER} is {version}, not {wanted}").into());
        }
        return Ok(Some(named));
    }
    let asked = [wanted.to_owned(), format!("{wanted}.0")].map(|toolchain| {
        let mut rustup = Command::new("rustup");
        rustup.args(["which", "rustc", "--toolchain", &toolchain]);
        let answer = rustup.output().ok()?;
        let path = String::from_utf8(answer.stdout).ok()?;
        answer.status.success().then(|| PathBuf::from(path.trim()))
    });
    let system = Some(PathBuf::from("/usr/bin/rustc"));
    let all = asked.into_iter().chain([system]).flatten();
    Ok(all
        .filter(|path| path.exists())
        .find(|path| version(path).is_ok_and(|version| is_version(&version, wanted))))
}

/// What a compiler says of itself.
fn version(compiler: &Path) -> Result<String> {
    let answer = Command::new(compiler).arg("--version").output()?;
    Ok(String::from_utf8(answer.stdout)?.trim().to_owned())
}

/// Whether `rustc 1.89.0 (...)` is `1.89`.
fn is_version(said: &str, wanted: &str) -> bool {
    let number = said.split_whitespace().nth(1).unwrap_or_default();
    number
        .strip_prefix(wanted)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_told_apart() {
        assert!(is_version("rustc 1.89.0 (29483883e 2025-08-04)", "1.89"));
        assert!(is_version("rustc 1.89.0", "1.89.0"));
        assert!(!is_version("rustc 1.8.0", "1.89"));
        assert!(!is_version("rustc 1.89.0", "1.8"));
        assert!(!is_version("", "1.89"));
        let manifest = "[package]\nname = \"x\"\nrust-version = \"1.89\"\n";
        assert_eq!(rust_version(manifest), Some("1.89"));
        assert_eq!(rust_version("rust-version.workspace = true"), None);
    }
}
