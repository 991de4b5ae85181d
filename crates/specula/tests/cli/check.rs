//! `specula check`, end to end: what it prints and how it ends.

use std::path::Path;
use std::process::Output;

use crate::common::{small_scene, specula, stderr};
use serde_json::Value;

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn check(folder: &Path, arguments: &[&str]) -> Output {
    specula(folder)
        .arg("check")
        .args(arguments)
        .output()
        .expect("the program runs")
}

/// One JSON object for each scene.
fn json(output: &Output) -> Vec<Value> {
    let text = stdout(output);
    text.lines()
        .map(|line| serde_json::from_str(line).expect("a JSON object"))
        .collect()
}

/// Lines of the problems of a severity.
fn lines(report: &Value, severity: &str) -> Vec<u64> {
    let problems = report["problems"].as_array().expect("a list");
    problems
        .iter()
        .filter(|p| p["severity"] == severity)
        .map(|p| p["line"].as_u64().expect("a number"))
        .collect()
}

const BROKEN_PBRT: &str = "WorldBegin
Shape \"sphere\" \"float radius\" -1
Shape \"plymesh\" \"string filename\" \"missing.ply\"
NamedMaterial \"nobody\" Shape \"disk\"
Shape \"sphere\" \"float wrong\" 1
Shape \"sphere\" \"float wrong\" 2
";

const BROKEN_MITSUBA: &str = r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="sphere"><float name="radius" value="-1"/></shape>
<shape type="obj"><string name="filename" value="missing.obj"/></shape>
<shape type="sphere"><ref id="nobody"/></shape></scene>"#;

#[test]
fn a_sound_scene_has_no_problems() {
    let (folder, _) = small_scene();
    let run = check(folder.path(), &["small.pbrt", "--strict"]);
    assert_eq!(run.status.code(), Some(0), "{}", stdout(&run));
    assert_eq!(stdout(&run), "small.pbrt: no problems\n");
    assert_eq!(stderr(&run), "");
}

#[test]
fn every_error_is_printed_with_its_excerpt() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.pbrt"), BROKEN_PBRT).unwrap();
    let run = check(folder.path(), &["a.pbrt"]);
    let text = stdout(&run);
    assert_eq!(run.status.code(), Some(2), "{text}");
    for part in [
        "a.pbrt:2:",
        "a.pbrt:3:",
        "a.pbrt:4:",
        "a.pbrt:5:",
        "\"float radius\" -1",
        "looked for in",
        "--search FOLDER",
        "(and 1 more like it)",
        "a.pbrt: 3 errors, ",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert_eq!(text.matches("unused parameter").count(), 1, "{text}");
}

#[test]
fn machines_get_a_line_for_each_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.pbrt"), BROKEN_PBRT).unwrap();
    std::fs::write(folder.path().join("b.xml"), BROKEN_MITSUBA).unwrap();
    let run = check(folder.path(), &["--json", "a.pbrt", "b.xml"]);
    assert_eq!(run.status.code(), Some(2));
    let reports = json(&run);
    assert_eq!(reports.len(), 2);
    assert_eq!(reports[0]["file"], "a.pbrt");
    assert_eq!(lines(&reports[0], "error"), [2, 3, 4]);
    assert_eq!(reports[0]["errors"], 3);
    assert_eq!(lines(&reports[1], "error"), [2, 3, 4]);
    let missing = &reports[1]["problems"][1];
    assert_eq!(missing["kind"], "mesh");
    assert!(missing["message"].as_str().unwrap().contains("missing.obj"));
    assert!(missing["help"].as_str().unwrap().contains("--search"));
    assert_eq!(
        (&missing["column"], &missing["count"]),
        (&19.into(), &1.into())
    );
}

#[test]
fn warnings_count_under_strict_alone() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "WorldBegin\nShape \"sphere\" \"float wrong\" 1\n";
    std::fs::write(folder.path().join("a.pbrt"), scene).unwrap();
    let run = check(folder.path(), &["a.pbrt"]);
    assert_eq!(run.status.code(), Some(0), "{}", stdout(&run));
    assert!(
        stdout(&run).contains("a.pbrt: 3 warnings"),
        "{}",
        stdout(&run)
    );
    let run = check(folder.path(), &["a.pbrt", "--strict"]);
    assert_eq!(run.status.code(), Some(2));
}

#[test]
fn names_of_a_scene_get_their_values() {
    let folder = tempfile::tempdir().unwrap();
    let scene = r#"<scene version="3.0.0"><sensor type="perspective"/>
<emitter type="constant"/>
<shape type="sphere"><float name="radius" value="$r"/></shape></scene>"#;
    std::fs::write(folder.path().join("a.xml"), scene).unwrap();
    assert_eq!(check(folder.path(), &["a.xml"]).status.code(), Some(2));
    let run = check(folder.path(), &["a.xml", "-D", "r=2"]);
    assert_eq!(run.status.code(), Some(0), "{}", stdout(&run));
}

#[test]
fn limits_and_folders_reach_every_command() {
    let (folder, _) = small_scene();
    for command in ["render", "info", "check", "convert"] {
        let mut line = specula(folder.path());
        line.args([command, "small.pbrt", "--limit-bytes", "10"]);
        if command == "convert" {
            line.arg("out.pbrt");
        }
        let run = line.output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{command}");
        let text = stdout(&run) + &stderr(&run);
        assert!(text.contains("--limit-bytes"), "{command}: {text}");
    }
    std::fs::create_dir(folder.path().join("more")).unwrap();
    std::fs::write(folder.path().join("more/part.pbrt"), "Shape \"sphere\"\n").unwrap();
    let scene = "WorldBegin\nLightSource \"infinite\"\nInclude \"part.pbrt\"\n";
    std::fs::write(folder.path().join("a.pbrt"), scene).unwrap();
    let info = |more: &[&str]| {
        let mut line = specula(folder.path());
        line.args(["info", "a.pbrt"]).args(more).output().unwrap()
    };
    let run = info(&[]);
    assert_eq!(run.status.code(), Some(2));
    assert!(stderr(&run).contains("--search"), "{}", stderr(&run));
    assert!(info(&["--search", "more"]).status.success());
}
