//! No work is lost: checkpoints, killed renders, and parts merged into one picture.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

mod common;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use common::{SMALL, small_scene, specula, stderr};
use specula::render::picture::{Picture, read_exr};

/// Runs the program; returns its exit code and what it said.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = specula(folder).args(arguments).output().unwrap();
    (output.status.code(), stderr(&output))
}

fn succeed(folder: &Path, arguments: &[&str]) {
    let (code, said) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {said}");
}

fn picture(folder: &Path, name: &str) -> Picture {
    read_exr(&folder.join(name)).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn parts_merge_into_the_picture_of_one_render() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(
        folder,
        &["render", "small.pbrt", "--spp", "23", "-o", "whole.exr"],
    );
    for (range, name) in [
        ("0..5", "a.film"),
        ("5..16", "b.film"),
        ("16..23", "c.film"),
    ] {
        succeed(
            folder,
            &["render", "small.pbrt", "--samples", range, "-o", name],
        );
    }
    succeed(
        folder,
        &["merge", "c.film", "a.film", "b.film", "-o", "merged.exr"],
    );
    assert_eq!(picture(folder, "merged.exr"), picture(folder, "whole.exr"));

    // By steps, with a gap in between, and gone on with at the end.
    succeed(folder, &["merge", "a.film", "c.film", "-o", "gap.film"]);
    succeed(folder, &["merge", "gap.film", "b.film", "-o", "all.film"]);
    let go_on = ["render", "small.pbrt", "--spp", "40", "--resume", "-o"];
    succeed(folder, &[&go_on[..], &["all.film"]].concat());
    succeed(folder, &["merge", "all.film", "-o", "forty.exr"]);
    succeed(
        folder,
        &["render", "small.pbrt", "--spp", "40", "-o", "expected.exr"],
    );
    assert_eq!(
        picture(folder, "forty.exr"),
        picture(folder, "expected.exr")
    );
    let (code, said) = run(folder, &[&go_on[..], &["gap.film"]].concat());
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("samples are missing"), "{said}");
}

#[test]
fn what_does_not_belong_together_is_not_merged() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let other = SMALL.replace("radius\" 1", "radius\" 1.01");
    std::fs::write(folder.join("other.pbrt"), other).unwrap();
    succeed(
        folder,
        &["render", "small.pbrt", "--samples", "0..4", "-o", "a.film"],
    );
    let parts: [(&[&str], &str); 5] = [
        (&["small.pbrt", "--noise", "0.1"], "different settings"),
        (
            &["small.pbrt", "--samples", "3..6"],
            "samples 3 to 4 are in both",
        ),
        (
            &["small.pbrt", "--samples", "4..6", "--seed", "1"],
            "different settings",
        ),
        (&["other.pbrt", "--samples", "4..6"], "different scenes"),
        (
            &["small.pbrt", "--samples", "4..6", "--resolution", "12x8"],
            "different size",
        ),
    ];
    std::fs::write(folder.join("out.exr"), "an old picture").unwrap();
    for (arguments, expected) in parts {
        let line = [&["render"], arguments, &["-o", "b.film", "--restart"]].concat();
        succeed(folder, &line);
        let (code, said) = run(folder, &["merge", "a.film", "b.film", "-o", "out.exr"]);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
    }
    std::fs::write(folder.join("b.film"), "no film").unwrap();
    let (code, said) = run(folder, &["merge", "a.film", "b.film", "-o", "out.exr"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("no film of Specula's"), "{said}");
    let kept = std::fs::read(folder.join("out.exr")).unwrap();
    assert_eq!(kept, b"an old picture");
}

#[test]
fn a_film_is_never_lost_by_mistake() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(
        folder,
        &["render", "small.pbrt", "--spp", "4", "-o", "a.film"],
    );
    let film = std::fs::read(folder.join("a.film")).unwrap();
    let refused: [(&[&str], &str); 4] = [
        (&["-o", "a.exr"], "--resume goes on with it"),
        (
            &["-o", "a.exr", "--resume", "--seed", "2"],
            "different settings",
        ),
        (
            &["-o", "a.exr", "--resume", "--samples", "8..9"],
            "begin with number 0",
        ),
        (
            &["-o", "a.exr", "--resume", "--resolution", "12x8"],
            "24 x 16 pixels",
        ),
    ];
    for (arguments, expected) in refused {
        let (code, said) = run(folder, &[&["render", "small.pbrt"], arguments].concat());
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
        assert_eq!(std::fs::read(folder.join("a.film")).unwrap(), film);
        assert!(!folder.join("a.exr").exists());
    }
    succeed(
        folder,
        &["render", "small.pbrt", "-o", "a.exr", "--restart"],
    );
    assert_eq!(names(folder), ["a.exr", "small.pbrt"]);
    // What a render that was killed left half-written goes, too.
    std::fs::write(folder.join(".b.exr.123456.part"), "half").unwrap();
    succeed(folder, &["render", "small.pbrt", "-o", "b.exr", "--resume"]);
    assert_eq!(names(folder), ["a.exr", "b.exr", "small.pbrt"]);
}

/// Twenty kills at moments spread over a render; each run goes on from the last checkpoint.
#[test]
fn a_killed_render_ends_as_if_nothing_had_happened() {
    let (folder, _) = small_scene();
    let mut spp = 500;
    let effort = |harder: bool| {
        if harder {
            spp *= 2;
        }
        vec!["--spp".to_owned(), spp.to_string()]
    };
    kill(folder.path(), 20, effort);
}

/// A film that is done for one noise is gone on with for a smaller one, too.
#[test]
fn a_killed_adaptive_render_ends_as_if_nothing_had_happened() {
    let (folder, _) = small_scene();
    let mut noise = 0.012;
    let effort = |harder: bool| {
        if harder {
            noise *= 0.7;
        }
        vec!["--noise".to_owned(), noise.to_string()]
    };
    kill(folder.path(), 10, effort);
    let counts = picture(folder.path(), "a.exr").sample_count;
    assert!(counts.iter().any(|n| *n != counts[0]), "{}", counts[0]);
}

/// Kills a render `times` times, and compares what it ends as with one that was left alone.
///
/// * `effort`: how long it is, as arguments; longer ones where it is told that it ended too early.
fn kill(folder: &Path, times: u32, mut effort: impl FnMut(bool) -> Vec<String>) {
    let line = |effort: &[String], output: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_specula"));
        command
            .current_dir(folder)
            .args(["render", "small.pbrt", "--threads", "1", "--resume"])
            .args(["--resolution", "48x32", "--checkpoint", "1ms", "-o", output])
            .args(effort)
            .stderr(Stdio::null());
        command
    };
    let (mut killed, mut resumable) = (0, 0);
    // SplitMix64, so that the moments are the same in every run.
    let mut state = 5_u64;
    let mut asked = effort(false);
    while killed < times {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let wait = 20 + (mixed >> 32) % 130;
        let mut child = line(&asked, "a.exr").spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        if child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            killed += 1;
            resumable += u32::from(folder.join("a.film").exists());
        } else {
            // Done before it could be killed: a longer one.
            asked = effort(true);
        }
        child.wait().unwrap();
    }
    assert!(resumable > times / 2, "{resumable} kills left a checkpoint");
    assert!(line(&asked, "a.exr").status().unwrap().success());
    assert!(line(&asked, "b.exr").status().unwrap().success());
    assert_eq!(picture(folder, "a.exr"), picture(folder, "b.exr"));
    assert_eq!(names(folder), ["a.exr", "b.exr", "small.pbrt"]);
}

/// Files may not grow beyond 4 KiB: as on a full disk, writes fail half-way.
#[test]
#[cfg(unix)]
fn a_full_disk_is_told_and_the_old_picture_stays() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    std::fs::write(folder.join("a.exr"), "an old picture").unwrap();
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" render small.pbrt --spp 8 \
                  --resolution 96x64 -o a.exr";
    let output = Command::new("sh")
        .current_dir(folder)
        .args(["-c", script, env!("CARGO_BIN_EXE_specula")])
        .output()
        .unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write the picture"), "{said}");
    let kept = std::fs::read(folder.join("a.exr")).unwrap();
    assert_eq!(kept, b"an old picture");
    assert_eq!(names(folder), ["a.exr", "small.pbrt"]);
}
