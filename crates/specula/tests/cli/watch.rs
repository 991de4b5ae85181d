//! `render --watch`, scenes from standard input, and materials by name.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::time::Duration;

use crate::common::{SMALL, heeding_signals, run, send, small_scene, specula, stderr};
use specula::render::picture::read_exr;

/// A render that watches its scene, and what it has said so far.
struct Watched {
    child: Child,
    said: BufReader<ChildStderr>,
}

impl Watched {
    fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut child = heeding_signals()
            .current_dir(folder)
            .args(["render", "small.pbrt", "--watch", "-o", "a.exr"])
            .args(arguments)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let said = BufReader::new(child.stderr.take().unwrap());
        Self { child, said }
    }

    /// Reads up to a line with `wanted`; returns all lines.
    fn wait_for(&mut self, wanted: &str) -> String {
        let mut text = String::new();
        while !text.contains(wanted) {
            let read = self.said.read_line(&mut text).unwrap();
            assert!(read > 0, "ended without `{wanted}`:\n{text}");
        }
        text
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Mean of a picture's red, over its mean blue.
fn redness(folder: &Path) -> f32 {
    let picture = read_exr(&folder.join("a.exr")).unwrap();
    let sum = |of: fn(&specula::bsdf::Rgb<f32>) -> f32| picture.colour.iter().map(of).sum::<f32>();
    sum(|c| c.r) / sum(|c| c.b)
}

fn write(folder: &Path, text: &str) {
    // As editors do: a new file in the place of the old one.
    std::fs::write(folder.join("new"), text).unwrap();
    std::fs::rename(folder.join("new"), folder.join("small.pbrt")).unwrap();
}

#[test]
fn a_watched_scene_is_rendered_again_when_it_changes() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let mut watched = Watched::start(folder, &["--threads", "1"]);
    watched.wait_for("waiting for changes");
    let first = redness(folder);

    write(folder, &SMALL.replace("0.7 0.8 1.0", "1.0 0.8 0.1"));
    watched.wait_for("the scene has changed");
    watched.wait_for("waiting for changes");
    assert!(redness(folder) > 2.0 * first);

    // A broken scene is told, and the picture stays; then it is mended.
    write(folder, "Camera \"no such camera\"\nWorldBegin\n");
    let text = watched.wait_for("waiting for changes");
    assert!(text.contains("the scene has changed"), "{text}");
    assert!(text.contains("no such camera"), "{text}");
    assert!(redness(folder) > 2.0 * first);
    write(folder, SMALL);
    watched.wait_for("waiting for changes");
    assert!((redness(folder) - first).abs() < 1e-6);

    send("INT", watched.child.id());
    assert_eq!(watched.child.wait().unwrap().code(), Some(130));
}

#[test]
fn a_change_ends_a_render_that_would_take_long() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let mut watched = Watched::start(folder, &["--spp", "16000000", "--threads", "1"]);
    watched.wait_for("ready after");
    std::thread::sleep(Duration::from_secs(3));
    // The picture is there long before the end.
    let first = redness(folder);
    write(folder, &SMALL.replace("0.7 0.8 1.0", "1.0 0.8 0.1"));
    watched.wait_for("the scene has changed");
    watched.wait_for("ready after");
    std::thread::sleep(Duration::from_secs(3));
    assert!(redness(folder) > 2.0 * first);
    send("TERM", watched.child.id());
    assert_eq!(watched.child.wait().unwrap().code(), Some(143));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    for (line, expected) in [
        (&["render", "--watch"][..], "--watch needs"),
        (&["render", "-", "--watch"], "--watch needs"),
        (
            &["render", "small.pbrt", "--watch", "-o", "a.film"],
            ".film",
        ),
        (
            &["render", "small.pbrt", "--watch", "--resume"],
            "cannot be used",
        ),
    ] {
        let (code, said) = run(folder, line);
        assert_eq!(code, Some(2), "{line:?}: {said}");
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder)
        .args(["render", "-", "-o", "a.exr"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(SMALL.as_bytes()).unwrap();
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    // As a process substitution has it.
    let script = "\"$0\" render <(cat small.pbrt) -o b.exr";
    let program = env!("CARGO_BIN_EXE_specula");
    let run = Command::new("bash")
        .current_dir(folder)
        .args(["-c", script, program])
        .output();
    let run = run.unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    specula(folder)
        .args(["render", "small.pbrt", "-o", "c.exr"])
        .assert()
        .success();
    let read = |name: &str| read_exr(&folder.join(name)).unwrap();
    assert_eq!(read("a.exr").colour, read("c.exr").colour);
    assert_eq!(read("b.exr").colour, read("c.exr").colour);
}

#[test]
fn one_material_is_replaced_by_name() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let two = SMALL.replace(
        "Material \"conductor\" \"float roughness\" 0.3 \"rgb reflectance\" [0.9 0.6 0.3]",
        "MakeNamedMaterial \"Ball gold\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.1 0.1 0.1]\n\
         MakeNamedMaterial \"Other\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.1 0.1 0.1]\n\
         NamedMaterial \"Ball gold\"",
    );
    assert!(two.contains("Ball gold"));
    std::fs::write(folder.join("small.pbrt"), two).unwrap();
    let redness_with = |materials: &[&str]| {
        let mut line = vec!["render", "small.pbrt", "-q", "-o", "a.exr"];
        for m in materials {
            line.extend(["--material", m]);
        }
        let (code, said) = run(folder, &line);
        assert_eq!(code, Some(0), "{said}");
        redness(folder)
    };
    let plain = redness_with(&[]);
    assert_eq!(redness_with(&["Other=conductor Cu"]), plain);
    let copper = redness_with(&["Ball*=conductor Cu"]);
    assert!(copper > 1.1 * plain, "{copper} {plain}");
    // The last one counts.
    assert_eq!(
        redness_with(&["diffuse 0.5", "Ball gold=conductor Cu"]),
        copper
    );
    let line = [
        "render",
        "small.pbrt",
        "--material",
        "Bell=conductor Cu",
        "-o",
        "a.exr",
    ];
    let (code, said) = run(folder, &line);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("'Ball gold'"), "{said}");
}
