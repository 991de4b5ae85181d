//! Compilers of other languages, where they are installed.
#![allow(dead_code, reason = "each suite uses some")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use specula_shaders::File;

/// Flags of g++ and clang++ for the header: every warning is an error.
pub(crate) const STRICT: &[&str] = &[
    "-std=c++17",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wpedantic",
    "-Werror",
];

/// A program that can be started, or a line that says what was skipped.
#[track_caller]
pub(crate) fn program(name: &str, what: &str) -> Option<PathBuf> {
    if Command::new(name).arg("--version").output().is_ok() {
        return Some(PathBuf::from(name));
    }
    let packages = match name {
        "g++" => "g++",
        "clang++" => "clang",
        _ => "glslang-tools spirv-tools",
    };
    let why = format!("{name} is not installed");
    specula_testing::skip(what, why, format!("apt-get install {packages}"));
    None
}

/// A folder of its own that is removed in the end.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    /// A folder with these files.
    pub(crate) fn with(files: &[File]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for file in files {
            std::fs::write(folder.path().join(file.name), &file.bytes).unwrap();
        }
        folder
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Writes a file.
    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path().join(name), text).unwrap();
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path().join(name)).unwrap()
    }

    /// Runs a compiler here and expects it to be content.
    pub(crate) fn accepted(&self, program: &Path, arguments: &[&str]) {
        let output = self.run(program, arguments);
        assert!(output.status.success(), "{arguments:?}:\n{}", text(&output));
    }

    /// Runs a program that was compiled here and gives what it prints.
    pub(crate) fn printed(&self, program: &str) -> String {
        let output = self.run(&self.path().join(program), &[]);
        assert!(output.status.success(), "{program}:\n{}", text(&output));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Runs a compiler here and expects an error.
    pub(crate) fn refused(&self, program: &Path, arguments: &[&str]) {
        let output = self.run(program, arguments);
        assert!(
            !output.status.success(),
            "{arguments:?}:\n{}",
            text(&output)
        );
    }

    fn run(&self, program: &Path, arguments: &[&str]) -> Output {
        let mut command = Command::new(program);
        command.current_dir(self.path()).args(arguments);
        command.output().unwrap()
    }
}

/// The first lines of what a compiler said.
fn text(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|o| String::from_utf8_lossy(o));
    let lines = out.lines().chain(err.lines()).take(30);
    lines.collect::<Vec<_>>().join("\n")
}
