//! Debian's Rust compiler, which builds for WebAssembly: installed, or unpacked without being installed.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Result;

/// The compiler, its libraries for this machine, the standard library's source, and LLVM.
const PACKAGES: [&str; 5] = [
    "rustc-web",
    "libstd-rust-web-1.96",
    "libstd-rust-web-dev",
    "rust-web-src",
    "libllvm22",
];

/// Where packages are installed.
const INSTALLED: &str = "/usr";

/// Debian's compiler in a folder.
pub(super) struct Compiler {
    /// Its `usr`.
    usr: PathBuf,
}

impl Compiler {
    /// The compiler that is installed, or unpacked in `folder`.
    pub(super) fn present(folder: &Path) -> Option<Self> {
        let places = [PathBuf::from(INSTALLED), folder.join("usr")];
        let usr = places
            .into_iter()
            .find(|usr| is_whole(|path| usr.join(path).exists()))?;
        Some(Self { usr })
    }

    /// The same, downloaded and unpacked in `folder` if it is not there yet.
    pub(super) fn unpacked(folder: &Path) -> Result<Self> {
        if let Some(present) = Self::present(folder) {
            return Ok(present);
        }
        std::fs::create_dir_all(folder)?;
        let mut download = Command::new("apt-get");
        download.arg("download").args(PACKAGES).current_dir(folder);
        let is_there = download.status().is_ok_and(|status| status.success());
        if !is_there {
            let how = "no Debian, or its lists are old (apt-get update)";
            return Err(format!("{} are not to be had: {how}", PACKAGES.join(", ")).into());
        }
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "deb") {
                let unpack = Command::new("dpkg")
                    .arg("-x")
                    .args([&path, folder])
                    .status()?;
                if !unpack.success() {
                    return Err(format!("{} cannot be unpacked", path.display()).into());
                }
                std::fs::remove_file(path)?;
            }
        }
        Self::present(folder).ok_or_else(|| "Debian's compiler is not whole".into())
    }

    /// Lets a build use this compiler, and the linker of the toolchain at `sysroot`. It has no library for WebAssembly:
    /// that is built, too, which only unstable flags do.
    pub(super) fn apply(&self, build: &mut Command, sysroot: &Path) -> Result<()> {
        if self.usr != Path::new(INSTALLED) {
            let libraries = ["lib/x86_64-linux-gnu", "lib"].map(|folder| self.usr.join(folder));
            build.env("LD_LIBRARY_PATH", std::env::join_paths(libraries)?);
        }
        build.env("RUSTC", self.usr.join("bin/rustc"));
        build.env("RUSTC_BOOTSTRAP", "1");
        build.args(["-Z", "build-std=std,panic_abort"]);
        let linkers = std::fs::read_dir(sysroot.join("lib/rustlib"))?;
        let linker = linkers
            .filter_map(|host| Some(host.ok()?.path().join("bin/rust-lld")))
            .find(|linker| linker.exists());
        let linker = linker.ok_or("no rust-lld in the toolchain")?;
        build.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
        Ok(())
    }
}

/// What the compiler is where it can be used; other packages of Debian have a `rustc` too old for this workspace.
const WHOLE: [&str; 3] = ["bin/rustc", "share/doc/rustc-web", "share/doc/rust-web-src"];

/// Whether the compiler and its sources are there.
fn is_whole(exists: impl Fn(&str) -> bool) -> bool {
    WHOLE.into_iter().all(exists)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_compiler_without_its_sources_is_not_used() {
        assert!(is_whole(|_| true));
        for absent in WHOLE {
            assert!(!is_whole(|path| path != absent), "{absent}");
        }
    }
}
