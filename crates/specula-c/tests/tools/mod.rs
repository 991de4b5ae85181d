//! Compilers of C and C++, and the libraries of this build.
#![allow(dead_code, reason = "each suite uses some")]

pub(crate) mod known_lobes;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Every warning is an error.
const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-pedantic", "-Werror"];

/// What the static library needs of the system.
const SYSTEM: [&str; 4] = ["-lpthread", "-ldl", "-lm", "-lgcc_s"];

/// How a program takes the library in.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Library {
    Shared,
    Static,
}

pub(crate) fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of the libraries that were built for this test: not the one above, where older ones may lie.
pub(crate) fn libraries() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    test.parent().unwrap().to_owned()
}

/// A compiler that is installed, or a line that says what was skipped.
#[track_caller]
fn compiler(source: &Path, what: &str) -> Option<Command> {
    let (name, standard) = match source.extension().unwrap().to_str() {
        Some("c") => ("gcc", "-std=c99"),
        _ => ("g++", "-std=c++17"),
    };
    if cfg!(not(target_os = "linux")) {
        specula_testing::not_of_this_machine(what, "it is tested on Linux");
        return None;
    }
    if Command::new(name).arg("--version").output().is_err() {
        let why = format!("{name} is not installed");
        specula_testing::skip(what, why, format!("apt-get install {name}"));
        return None;
    }
    let mut command = Command::new(name);
    command.arg(standard).args(STRICT);
    Some(command)
}

/// A program that was compiled; its folder is removed in the end.
pub(crate) struct Program {
    folder: tempfile::TempDir,
}

impl Program {
    /// Compiles a source without warnings; `None`: there is no compiler.
    #[track_caller]
    pub(crate) fn compiled(source: &str, library: Library) -> Option<Self> {
        let source = here().join(source);
        let mut command = compiler(&source, &source.display().to_string())?;
        let folder = tempfile::tempdir().unwrap();
        let libraries = libraries();
        command.arg(&source).arg("-I").arg(here().join("include"));
        command.arg("-o").arg(folder.path().join("program"));
        match library {
            Library::Shared => {
                command.arg("-L").arg(&libraries).arg("-lspecula_c");
                command.arg(format!("-Wl,-rpath,{}", libraries.display()));
            }
            Library::Static => {
                command.arg(libraries.join("libspecula_c.a")).args(SYSTEM);
            }
        }
        let output = command.output().unwrap();
        assert!(output.status.success(), "{command:?}:\n{}", text(&output));
        Some(Self { folder })
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Runs it in its folder and gives what it prints.
    pub(crate) fn printed(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert!(output.status.success(), "{}", text(&output));
        String::from_utf8(output.stdout).unwrap()
    }

    /// Runs it in its folder.
    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(self.folder().join("program"));
        // Cargo names folders where an older library may lie.
        command.env_remove("LD_LIBRARY_PATH");
        command.current_dir(self.folder()).args(arguments);
        command.output().unwrap()
    }
}

/// What a program said.
pub(crate) fn text(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|o| String::from_utf8_lossy(o));
    format!("{out}{err}")
}
