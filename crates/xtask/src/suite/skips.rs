//! What the tests of a run skipped.

use std::collections::BTreeSet;
use std::fmt::{self, Display};
use std::fs;
use std::path::{Path, PathBuf};

use specula_testing::Reason;

use crate::Result;

/// The file to which tests append a line for each skip.
pub(super) struct File(PathBuf);

impl File {
    /// An empty one in the workspace's target folder.
    pub(super) fn new(root: &Path) -> Result<Self> {
        let folder = root.join("target");
        fs::create_dir_all(&folder)?;
        let path = folder.join("skips.txt");
        fs::write(&path, "")?;
        Ok(Self(path))
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    pub(super) fn read(&self) -> Result<Skips> {
        Ok(Skips::parse(&fs::read_to_string(&self.0)?))
    }
}

/// The lines of a run, each once.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Skips {
    /// What could run with more installed.
    skipped: BTreeSet<String>,
    /// What needs other hardware.
    hardware: BTreeSet<String>,
}

impl Skips {
    fn parse(text: &str) -> Self {
        let mut skips = Self::default();
        for line in text.lines() {
            let hardware = line.starts_with(Reason::Hardware.label());
            let lines = match hardware {
                true => &mut skips.hardware,
                false => &mut skips.skipped,
            };
            lines.insert(line.to_owned());
        }
        skips
    }

    /// An error where the run is strict and something was skipped that could be had.
    pub(super) fn verdict(&self, strict: bool) -> Result<()> {
        match self.skipped.len() {
            n if strict && n > 0 => Err(format!("{n} skipped; --strict allows none").into()),
            _ => Ok(()),
        }
    }
}

impl Display for Skips {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in self.skipped.iter().chain(&self.hardware) {
            writeln!(f, "{line}")?;
        }
        let (skipped, hardware) = (self.skipped.len(), self.hardware.len());
        write!(f, "{skipped} skipped, {hardware} not of this machine")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "SKIPPED a.rs:1: x: no y (install y)\nSKIPPED a.rs:1: x: no y (install y)\n\
                        NOT OF THIS MACHINE b.rs:2: z: no AVX-512\n";

    #[test]
    fn each_skip_counts_once_and_fails_strict_runs() {
        let skips = Skips::parse(TEXT);
        assert_eq!((skips.skipped.len(), skips.hardware.len()), (1, 1));
        assert!(skips.verdict(false).is_ok());
        let error = skips.verdict(true).unwrap_err().to_string();
        assert_eq!(error, "1 skipped; --strict allows none");
        let shown = skips.to_string();
        assert!(shown.contains("install y"), "{shown}");
        assert!(
            shown.ends_with("\n1 skipped, 1 not of this machine"),
            "{shown}"
        );
    }

    #[test]
    fn hardware_alone_passes() {
        let skips = Skips::parse("NOT OF THIS MACHINE b.rs:2: z: no AVX-512\n");
        assert!(skips.verdict(true).is_ok());
        assert_eq!(Skips::parse(""), Skips::default());
    }
}
