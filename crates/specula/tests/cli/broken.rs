//! Broken scenes: each a located report and exit code 2, none a panic, and no good file is lost.

use std::path::{Path, PathBuf};

use crate::common::{SMALL, specula, stderr};

fn broken(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/broken")
        .join(name)
}

/// File, place that the report names, and a word of the message.
const SCENES: [(&str, &str, &str); 10] = [
    (
        "missing_mesh.pbrt",
        "missing_mesh.pbrt:4:",
        "no-such-mesh.ply",
    ),
    ("nan_transform.pbrt", "nan_transform.pbrt:5:", "finite"),
    (
        "unknown_directive.pbrt",
        "unknown_directive.pbrt:4:",
        "Shpae",
    ),
    (
        "truncated_ply.pbrt",
        "truncated_ply.pbrt:5:",
        "truncated.ply",
    ),
    (
        "recursive_include.pbrt",
        "recursive_include.pbrt:4:",
        "includes itself",
    ),
    (
        "negative_roughness.pbrt",
        "negative_roughness.pbrt:5:",
        "roughness",
    ),
    ("zero_area.pbrt", "zero_area.pbrt:", "area"),
    ("empty_scene.pbrt", "empty_scene.pbrt:", "no shape"),
    (
        "billion_triangles.pbrt",
        "billion_triangles.pbrt:4:",
        "billion.ply",
    ),
    ("garbage.pbrt", "garbage.pbrt:1:", ""),
];

#[test]
fn every_broken_scene_is_a_located_error() {
    for (name, place, word) in SCENES {
        for command in ["render", "info"] {
            let folder = tempfile::tempdir().unwrap();
            let run = specula(folder.path())
                .arg(command)
                .arg(broken(name))
                .output()
                .unwrap();
            // The report breaks lines; places and words are looked for without regard to that.
            let text: String = stderr(&run)
                .chars()
                .filter(|c| !c.is_whitespace() && *c != '│')
                .collect();
            let word: String = word.split_whitespace().collect();
            assert_eq!(run.status.code(), Some(2), "{command} {name}: {text}");
            assert!(text.contains(place), "{command} {name}: {}", stderr(&run));
            assert!(text.contains(&word), "{command} {name}: {}", stderr(&run));
            assert!(!text.contains("panicked"), "{command} {name}: {text}");
            let left = std::fs::read_dir(folder.path()).unwrap().count();
            assert_eq!(left, 0, "{command} {name} left files");
        }
    }
}

#[test]
fn a_missing_scene_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let run = specula(folder.path())
        .args(["render", "nowhere.pbrt"])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(stderr(&run).contains("nowhere.pbrt"), "{}", stderr(&run));
}

#[test]
fn a_good_picture_stays_when_a_later_render_fails() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.pbrt");
    let render = || {
        specula(folder.path())
            .args(["render", "-q", "-o", "a.exr", "-o", "a.png"])
            .arg(&scene)
            .output()
            .unwrap()
    };
    std::fs::write(&scene, SMALL).unwrap();
    assert!(render().status.success());
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let before = (read("a.exr"), read("a.png"));
    std::fs::copy(broken("unknown_directive.pbrt"), &scene).unwrap();
    assert_eq!(render().status.code(), Some(2));
    assert_eq!((read("a.exr"), read("a.png")), before);
}

/// A name that leads to a pipe is no file: nobody waits for it. Standard input is one.
#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_to_ends_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["a.pbrt", "a.gltf", "a.xml", "a.ply"] {
        let made = std::process::Command::new("mkfifo").arg(at(name)).status();
        assert!(made.unwrap().success());
        let start = std::time::Instant::now();
        let run = specula(folder.path())
            .args(["render", name])
            .output()
            .unwrap();
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(2), "{said}");
        assert!(
            said.contains("is a pipe that no program writes to"),
            "{said}"
        );
        assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
    }
    // A program that writes, if late, is read to its end.
    let slow =
        "(exec 3>a.pbrt; sleep 1; cat small.pbrt >&3) & exec \"$0\" render a.pbrt -q -o a.exr";
    std::fs::write(at("small.pbrt"), SMALL).unwrap();
    let run = std::process::Command::new("sh")
        .current_dir(folder.path())
        .args(["-c", slow, env!("CARGO_BIN_EXE_specula")])
        .status();
    assert_eq!(run.unwrap().code(), Some(0));
    for device in ["/dev/zero", "/dev/null"] {
        let run = specula(folder.path())
            .args(["render", device])
            .output()
            .unwrap();
        assert!(
            stderr(&run).contains("a device; expected a file, or -"),
            "{}",
            stderr(&run)
        );
    }
    let run = specula(folder.path())
        .args(["render", "-", "-q", "-o", "b.exr"])
        .write_stdin(SMALL)
        .output();
    assert!(run.unwrap().status.success());
}

/// Names, and files that unpack, of megabytes: a short report at once.
#[test]
fn what_is_long_is_cut() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(8 << 20);
    std::fs::write(
        folder.path().join("a.pbrt"),
        format!("WorldBegin\nShape \"{long}\"\n"),
    )
    .unwrap();
    let start = std::time::Instant::now();
    let run = specula(folder.path())
        .args(["render", "a.pbrt"])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    let said = stderr(&run);
    assert!(
        said.contains("unknown shape \"xxx") && said.len() < 3000,
        "{} bytes",
        said.len()
    );
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}

#[test]
fn shapes_that_are_pressed_flat_are_warned_of_and_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let flat = "ConcatTransform [ -0 -0 0 0 0 1 0 0 -1.2246469e-16 0 -1 0 0 0 0 1 ]";
    let line =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0] \"integer indices\" [0 1 2]";
    let scene = format!("{SMALL}AttributeBegin {flat}\n{line}\nShape \"sphere\"\nAttributeEnd\n");
    std::fs::write(folder.path().join("flat.pbrt"), scene).unwrap();
    let run = specula(folder.path())
        .args(["render", "flat.pbrt", "-o", "a.exr"])
        .output()
        .unwrap();
    let said = stderr(&run);
    assert_eq!(run.status.code(), Some(0), "{said}");
    assert!(
        said.contains("flat.pbrt:12:7: the transform presses the shape to no area: it is left out"),
        "{said}"
    );
    assert!(
        said.contains("flat.pbrt:13:7: the transform presses the shape flat"),
        "{said}"
    );
}
