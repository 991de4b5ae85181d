//! What the tests of the command line share.

#![allow(dead_code, reason = "each test file uses a part of this")]

use std::path::{Path, PathBuf};

use assert_cmd::Command;

/// A scene that renders in no time: a metal sphere in a constant environment.
pub(crate) const SMALL: &str = r#"
LookAt 0 -4 1  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Sampler "halton" "integer pixelsamples" 4
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [0.7 0.8 1.0]
Material "conductor" "float roughness" 0.3 "rgb reflectance" [0.9 0.6 0.3]
Shape "sphere" "float radius" 1
"#;

/// The program, to be run in `folder`.
pub(crate) fn specula(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("specula").expect("the binary is built");
    command.current_dir(folder).env("NO_COLOR", "1");
    command
}

/// A folder with the small scene in it, and the scene's path.
pub(crate) fn small_scene() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("small.pbrt");
    std::fs::write(&scene, SMALL).expect("a writable folder");
    (folder, scene)
}

/// Standard error of a finished command.
pub(crate) fn stderr(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs the program; returns its exit code and what it said.
pub(crate) fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = specula(folder)
        .args(arguments)
        .output()
        .expect("the program runs");
    (output.status.code(), stderr(&output))
}

/// Runs the program, which must succeed.
pub(crate) fn succeed(folder: &Path, arguments: &[&str]) {
    let (code, said) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {said}");
}

/// The files of a folder, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|e| {
            e.expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

/// The program, which heeds signals though the tests may have been started to ignore them: by `nohup`, or in the
/// background of a script.
pub(crate) fn heeding_signals() -> std::process::Command {
    let program = env!("CARGO_BIN_EXE_specula");
    if !cfg!(target_os = "linux") {
        return std::process::Command::new(program);
    }
    let mut command = std::process::Command::new("env");
    command.args(["--default-signal=INT,HUP,TERM", program]);
    command
}

/// Sends a signal, such as `INT`, to a process.
#[cfg(unix)]
pub(crate) fn send(signal: &str, process: u32) {
    let sent = std::process::Command::new("kill")
        .args([&format!("-{signal}"), &process.to_string()])
        .status();
    assert!(sent.expect("there is `kill`").success());
}
