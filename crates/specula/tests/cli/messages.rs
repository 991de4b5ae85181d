//! Messages that nobody can read: a lost standard error ends no render, and a result that cannot be
//! written is a failure.

use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{small_scene, succeed};
use specula::render::picture::read_exr;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_specula"));
    command.current_dir(folder).args(arguments);
    command
}

fn full() -> File {
    File::options().write(true).open("/dev/full").unwrap()
}

#[test]
fn a_render_without_a_standard_error_writes_its_picture() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let render = |name: &str| {
        command(
            folder,
            &["render", "small.pbrt", "--time", "1s", "-o", name],
        )
    };

    let status = render("full.exr").stderr(full()).status().unwrap();
    assert_eq!(status.code(), Some(0));
    assert!(read_exr(&folder.join("full.exr")).is_ok());

    // `2>&1 | head -1`: the reader goes away at once.
    let mut child = render("gone.exr").stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(read_exr(&folder.join("gone.exr")).is_ok());

    // `2>&-`: there is none at all.
    let script = "exec \"$0\" render small.pbrt --time 1s -o none.exr 2>&-";
    let program = env!("CARGO_BIN_EXE_specula");
    let status = Command::new("sh")
        .current_dir(folder)
        .args(["-c", script, program])
        .status();
    assert_eq!(status.unwrap().code(), Some(0));
    assert!(read_exr(&folder.join("none.exr")).is_ok());
}

#[test]
fn exit_codes_hold_without_a_standard_error() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    for (arguments, code) in [
        (&["render", "none.pbrt"][..], 2),
        (&["render", "--no-such-option"], 2),
        (&["merge", "none.film", "-o", "a.exr"], 2),
        (&["convert", "small.pbrt", "copy.pbrt"], 0),
        (&["export", "--lang", "wgsl", "-o", "shaders"], 0),
    ] {
        let status = command(folder, arguments).stderr(full()).status().unwrap();
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

#[test]
fn results_that_cannot_be_written_are_a_failure() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(folder, &["render", "small.pbrt", "-q", "-o", "a.exr"]);
    for arguments in [
        &["info", "small.pbrt"][..],
        &["check", "small.pbrt"],
        &["check", "--json", "small.pbrt"],
        &["compare", "a.exr", "a.exr"],
        &["lab", "list"],
        &["lab", "list", "--json"],
        &["export", "--list"],
        &["devices"],
        &["gpu-report", "--help"],
        &["--help"],
        &["render", "--help"],
        &["--version"],
    ] {
        let run = command(folder, arguments).stdout(full()).output().unwrap();
        assert_eq!(run.status.code(), Some(1), "{arguments:?}");

        // `| head -0`: who does not want to read has read enough.
        let mut command = command(folder, arguments);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments:?}");
    }
}
