//! `cargo xtask bench`.

use std::path::Path;

use crate::{Result, workspace};

/// Runs every bench of the workspace.
pub(crate) fn run(root: &Path, arguments: &[String]) -> Result<()> {
    let mut command = workspace::cargo(root);
    command.args(["bench", "--workspace"]).args(arguments);
    match command.status()?.success() {
        true => Ok(()),
        false => Err("the benches failed".into()),
    }
}
