//! `specula export`, end to end.

use crate::common::{specula, stderr};

#[test]
fn a_language_is_written_with_its_example() {
    let folder = tempfile::tempdir().unwrap();
    let run = specula(folder.path())
        .args([
            "export",
            "--lang",
            "hlsl",
            "--modules",
            "ggx,bounded",
            "-o",
            "out/hlsl",
        ])
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    let mut names: Vec<_> = std::fs::read_dir(folder.path().join("out/hlsl"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["example.hlsl", "specula.hlsl"]);
    let text = std::fs::read_to_string(folder.path().join("out/hlsl/specula.hlsl")).unwrap();
    assert!(
        text.contains("float bounded_reflection_pdf("),
        "{text:.400}"
    );
}

#[test]
fn all_languages_are_the_default() {
    let folder = tempfile::tempdir().unwrap();
    specula(folder.path())
        .args(["shaders", "-o", "."])
        .assert()
        .success();
    for name in [
        "specula.wgsl",
        "specula.spv",
        "specula_es.glsl",
        "example.metal",
        "specula.hpp",
        "specula.slang",
        "example.slang",
        "example.cpp",
    ] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    let tables = std::fs::metadata(folder.path().join("energy_tables.bin")).unwrap();
    assert_eq!(tables.len(), specula::shaders::tables().len() as u64);
}

#[test]
fn modules_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let run = specula(folder.path())
        .args(["export", "--list"])
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    for module in specula::shaders::MODULES {
        assert!(text.contains(&format!("  {} ", module.name())), "{text}");
    }
}

#[test]
fn what_is_not_there_is_told_with_code_2_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, message) in [
        (["--lang", "hlsll", "-o", "out"], "did you mean `hlsl`?"),
        (
            ["--modules", "boundet", "-o", "out"],
            "did you mean `bounded`?",
        ),
        (
            ["--functions", "ggx_dd", "-o", "out"],
            "did you mean `ggx_d`?",
        ),
        (["--prefix", "2x", "-o", "out"], "prefix '2x'"),
        (["--namespace", "a:b", "-o", "out"], "namespace 'a:b'"),
    ] {
        let run = specula(folder.path())
            .arg("export")
            .args(arguments)
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
        assert!(stderr(&run).contains(message), "{}", stderr(&run));
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn an_example_that_could_not_compile_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let run = specula(folder.path())
        .args(["export", "--lang", "glsl", "--modules", "ggx", "-o", "."])
        .output()
        .unwrap();
    assert!(
        stderr(&run).contains("note: no worked example"),
        "{}",
        stderr(&run)
    );
    assert!(!folder.path().join("example.comp").exists());
}

#[test]
fn functions_come_alone_with_their_prefix() {
    let folder = tempfile::tempdir().unwrap();
    specula(folder.path())
        .args(["export", "--lang", "wgsl", "--functions", "ggx_d"])
        .args(["--prefix", "my_", "-o", "."])
        .assert()
        .success();
    let text = std::fs::read_to_string(folder.path().join("specula.wgsl")).unwrap();
    assert!(text.contains("fn my_ggx_d("), "{text}");
    assert!(!text.contains("ggx_lambda"), "{text}");
    assert!(text.contains("--functions ggx_d --prefix my_`"), "{text}");
}
