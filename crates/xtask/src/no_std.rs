//! Whether `specula-bsdf` compiles without the standard library, for a machine that has none.

use std::path::Path;
use std::process::Command;

use crate::{Result, workspace};

/// A target without a standard library.
const TARGET: &str = "x86_64-unknown-none";

/// Checks the crate for the target, or says why not.
pub(crate) fn run(root: &Path) -> Result<()> {
    let rustc = Command::new("rustc")
        .args(["--print", "sysroot"])
        .output()?;
    let sysroot = String::from_utf8(rustc.stdout)?;
    let installed = Path::new(sysroot.trim()).join("lib/rustlib").join(TARGET);
    if !installed.exists() {
        println!("skipped: no target {TARGET} (rustup target add {TARGET})");
        return Ok(());
    }
    let mut check = workspace::cargo(root);
    check.args(["check", "--quiet", "--package", "specula-bsdf"]);
    check.args(["--no-default-features", "--features", "glam,mint,serde"]);
    check.args(["--target", TARGET]);
    if !check.status()?.success() {
        return Err(format!("specula-bsdf does not compile for {TARGET}").into());
    }
    println!("specula-bsdf compiles for {TARGET}");
    Ok(())
}
