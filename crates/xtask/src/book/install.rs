//! The program mdBook at the version that the book is written for.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Result, workspace};

/// The version. Another one may name anchors and files otherwise.
const VERSION: &str = "0.5.4";

/// mdBook: that of the PATH where its version is right, else our own in `target/book-tools`, installed where
/// it is missing.
pub(super) fn mdbook(root: &Path) -> Result<PathBuf> {
    let folder = root.join("target/book-tools");
    let own = folder.join(format!("bin/mdbook{}", std::env::consts::EXE_SUFFIX));
    for program in [Path::new("mdbook"), &own] {
        if is_right(program) {
            return Ok(program.to_owned());
        }
    }
    let mut install = workspace::install(root, &folder, "mdbook", VERSION);
    install.args(["--no-default-features", "--features", "search"]);
    if !install.status()?.success() {
        return Err(format!("mdBook {VERSION} could not be installed").into());
    }
    Ok(own)
}

fn is_right(program: &Path) -> bool {
    Command::new(program)
        .arg("--version")
        .output()
        .is_ok_and(|output| says(&String::from_utf8_lossy(&output.stdout), VERSION))
}

/// Whether a program's `--version` names this version: `mdbook v0.5.4`.
fn says(text: &str, version: &str) -> bool {
    let last = text.split_whitespace().last().unwrap_or("");
    last.strip_prefix('v').unwrap_or(last) == version
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_right_version_is_taken() {
        assert!(says("mdbook v0.5.4\n", "0.5.4"));
        assert!(!says("mdbook v0.5.40\n", "0.5.4"));
        assert!(!says("mdbook v0.4.52\n", "0.5.4"));
        assert!(!says("", "0.5.4"));
        assert!(!is_right(Path::new("no-such-program")));
    }
}
