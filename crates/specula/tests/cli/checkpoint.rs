//! No work is lost: checkpoints, killed renders, and parts merged into one picture.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{SMALL, names, run, small_scene, stderr, succeed};
use specula::render::picture::{Picture, read_exr};

fn picture(folder: &Path, name: &str) -> Picture {
    read_exr(&folder.join(name)).unwrap()
}

#[test]
fn parts_merge_into_the_picture_of_one_render() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(
        folder,
        &[
            "render",
            "small.pbrt",
            "--spp",
            "23",
            "--adaptive=off",
            "-o",
            "whole.exr",
        ],
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
        &[
            "render",
            "small.pbrt",
            "--spp",
            "40",
            "--adaptive=off",
            "-o",
            "expected.exr",
        ],
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
    let parts: [(&[&str], &str); 7] = [
        (&["small.pbrt", "--noise", "0.1"], "different settings"),
        (
            &["small.pbrt", "--samples", "3..6"],
            "samples 3 to 4 are in both",
        ),
        (
            &["small.pbrt", "--samples", "4..6", "--seed", "1"],
            "different settings",
        ),
        (
            &["small.pbrt", "--samples", "4..6", "--clamp", "3"],
            "biased: indirect light clamped to 3",
        ),
        (
            &["small.pbrt", "--samples", "4..6", "--regularize"],
            "biased: regularized",
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
        // On one line, however wide the terminal is.
        let said = said.replace("\n  │ ", " ");
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
            "begin with index 0",
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
        ["--adaptive=off", "--spp", &spp.to_string()]
            .map(str::to_owned)
            .to_vec()
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

/// Kills a render until `times` kills have left a checkpoint, and compares what it ends as with one that was left alone.
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
    // SplitMix64, so that the moments are the same in every run; a machine that is too busy to write a checkpoint until
    // then gets more time.
    let (mut state, mut patience) = (5_u64, 1);
    let mut asked = effort(false);
    while resumable < times {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let wait = 20 + (mixed >> 32) % 130;
        let mut child = line(&asked, "a.exr").spawn().unwrap();
        std::thread::sleep(Duration::from_millis(patience * wait));
        if child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            killed += 1;
            let left = folder.join("a.film").exists();
            resumable += u32::from(left);
            patience *= if left { 1 } else { 2 };
            assert!(
                patience < 1 << 10,
                "{resumable} of {killed} kills left a checkpoint"
            );
        } else {
            // Done before it could be killed: a longer one.
            asked = effort(true);
        }
        child.wait().unwrap();
    }
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

/// A render with two outputs, in folders of which one is gone at the end.
#[test]
fn one_output_that_cannot_be_written_costs_neither_the_other_nor_the_samples() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    for name in ["gone", "temporary"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    let line = [
        "small.pbrt",
        "--spp",
        "3000",
        "--adaptive=off",
        "--resolution",
        "96x64",
        "--threads",
        "1",
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder)
        .arg("render")
        .args(line)
        // The film goes beside the first output.
        .args(["-o", "gone/a.exr", "-o", "b.exr", "--checkpoint", "off"])
        .env("TMPDIR", folder.join("temporary"))
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    std::fs::remove_dir_all(folder.join("gone")).unwrap();
    assert!(child.try_wait().unwrap().is_none(), "it ended too early");
    let output = child.wait_with_output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write the picture"), "{said}");
    assert_eq!(picture(folder, "b.exr").sample_count[0], 3000.0);
    // Beside the output there is no folder: elsewhere, and told.
    let kept = names(&folder.join("temporary"));
    assert_eq!(kept.len(), 1, "{kept:?}\n{said}");
    let film = format!("temporary/{}", kept[0]);
    assert!(said.replace('\n', "").contains(&kept[0]), "{said}");

    let resume = format!("--resume={film}");
    let rest = [&["render"], &line[..], &[&resume, "-o", "c.exr"]].concat();
    succeed(folder, &rest);
    assert_eq!(picture(folder, "c.exr"), picture(folder, "b.exr"));
    let (code, said) = run(
        folder,
        &["render", "small.pbrt", "--resume=none.film", "-o", "d.exr"],
    );
    assert_eq!(code, Some(2), "{said}");
}

/// A film that was kept elsewhere does not replace another render's beside the output.
#[test]
fn a_film_from_elsewhere_replaces_no_other_work() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    for (spp, film) in [("4", "kept.film"), ("8", "a.film")] {
        let even = ["render", "small.pbrt", "--adaptive=off", "--spp", spp];
        succeed(folder, &[&even[..], &["-o", film]].concat());
    }
    let farther = std::fs::read(folder.join("a.film")).unwrap();
    let line = [
        "render",
        "small.pbrt",
        "--spp",
        "16",
        "--resume=kept.film",
        "-o",
        "a.exr",
    ];
    let (code, said) = run(folder, &line);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("another render"), "{said}");
    assert_eq!(std::fs::read(folder.join("a.film")).unwrap(), farther);
    succeed(
        folder,
        &[
            "render",
            "small.pbrt",
            "--spp",
            "2",
            "--restart",
            "-o",
            "a.film",
        ],
    );
    succeed(folder, &line);
    succeed(
        folder,
        &[
            "render",
            "small.pbrt",
            "--spp",
            "16",
            "--adaptive=off",
            "-o",
            "b.exr",
        ],
    );
    assert_eq!(picture(folder, "a.exr"), picture(folder, "b.exr"));
}

#[test]
fn a_second_render_to_the_same_output_is_refused() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let mut first = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder)
        .args([
            "render",
            "small.pbrt",
            "--spp",
            "16000000",
            "--threads",
            "1",
            "-o",
            "a.exr",
        ])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(500));
    // The picture, and the checkpoint of another picture.
    for outputs in [
        &["-o", "a.exr"][..],
        &["-o", "b.png", "-o", "./a.exr"],
        &["-o", "a.png"],
    ] {
        let line = [&["render", "small.pbrt", "--restart"], outputs].concat();
        let (code, said) = run(folder, &line);
        assert_eq!(code, Some(2), "{outputs:?}: {said}");
        assert!(said.contains("another render"), "{said}");
    }
    succeed(folder, &["render", "small.pbrt", "-o", "c.exr"]);
    first.kill().unwrap();
    first.wait().unwrap();
    // What was killed holds no lock.
    succeed(
        folder,
        &["render", "small.pbrt", "--restart", "-o", "a.exr"],
    );
    assert_eq!(names(folder), ["a.exr", "c.exr", "small.pbrt"]);
}
