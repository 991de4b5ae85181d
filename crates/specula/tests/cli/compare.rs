//! `specula compare`, `specula info` and the help, end to end.

use crate::common::{small_scene, specula, stderr};

#[test]
fn equal_and_different_pictures() {
    let (folder, scene) = small_scene();
    for (name, seed) in [("a.exr", "1"), ("b.exr", "1"), ("c.exr", "2")] {
        specula(folder.path())
            .args(["render", "-q", "--spp", "2", "-o", name, "--seed", seed])
            .arg(&scene)
            .assert()
            .success();
    }
    let compare = |test: &str, rest: &[&str]| {
        specula(folder.path())
            .args(["compare", "a.exr", test])
            .args(rest)
            .output()
            .unwrap()
    };
    let equal = compare("b.exr", &["--fail-above", "0"]);
    assert_eq!(equal.status.code(), Some(0));
    let text = String::from_utf8_lossy(&equal.stdout).into_owned();
    assert!(text.contains("RMSE      0.000000"), "{text}");
    assert!(text.contains("HDR-FLIP  0.000000"), "{text}");

    let different = compare(
        "c.exr",
        &["--fail-above", "0", "--metric", "rmse", "--diff", "d.png"],
    );
    assert_eq!(different.status.code(), Some(1));
    assert!(
        stderr(&different).contains("rmse is 0.0"),
        "{}",
        stderr(&different)
    );
    assert!(folder.path().join("d.png").exists());
    assert_eq!(
        compare("c.exr", &["--fail-above", "1"]).status.code(),
        Some(0)
    );
}

#[test]
fn pictures_that_cannot_be_compared() {
    let (folder, scene) = small_scene();
    for (name, size) in [("a.exr", "8x8"), ("b.exr", "9x8")] {
        specula(folder.path())
            .args([
                "render",
                "-q",
                "--spp",
                "1",
                "-o",
                name,
                "--resolution",
                size,
            ])
            .arg(&scene)
            .assert()
            .success();
    }
    std::fs::write(folder.path().join("junk.exr"), b"no picture").unwrap();
    for (test, expected) in [
        ("b.exr", "differ in size"),
        ("none.exr", "none.exr"),
        ("junk.exr", "junk.exr"),
    ] {
        let run = specula(folder.path())
            .args(["compare", "a.exr", test])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2), "{test}");
        assert!(stderr(&run).contains(expected), "{}", stderr(&run));
    }
}

#[test]
fn info_counts_what_is_there() {
    let (folder, scene) = small_scene();
    let run = specula(folder.path())
        .arg("info")
        .arg(&scene)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    for expected in [
        "24x16",
        "1 sphere",
        "1 conductor",
        "1 infinite",
        "4 samples per pixel",
    ] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    specula(folder.path()).arg("info").assert().success();
}

#[test]
fn every_command_explains_itself_with_examples() {
    let folder = tempfile::tempdir().unwrap();
    for command in [
        &["--help"][..],
        &["render", "--help"],
        &["info", "--help"],
        &["compare", "--help"],
    ] {
        let run = specula(folder.path()).args(command).output().unwrap();
        assert!(run.status.success());
        let text = String::from_utf8_lossy(&run.stdout).into_owned();
        assert!(text.contains("Usage: specula"), "{text}");
        assert!(text.contains("Examples:"), "{text}");
    }
    let version = specula(folder.path()).arg("--version").output().unwrap();
    let expected = format!("specula {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8_lossy(&version.stdout), expected);
}
