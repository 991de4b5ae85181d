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
fn measured_materials_are_written_for_shaders() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let mut command = specula(folder.path());
        command.args(arguments).output().unwrap()
    };
    let small = ["--views", "8", "--normals", "24", "--colours", "8"];
    let mut tabulate = vec![
        "lab",
        "tabulate",
        "conductor Au alpha 0.3",
        "-o",
        "gold.bsdf",
    ];
    tabulate.extend(small);
    assert!(run(&tabulate).status.success());
    std::fs::copy(
        folder.path().join("gold.bsdf"),
        folder.path().join("b.bsdf"),
    )
    .unwrap();
    let export = ["export", "--lang", "wgsl", "-o", "out"];
    let measured = ["--measured", "gold.bsdf", "--measured", "b.bsdf"];
    let done = run(&[&export[..], &measured].concat());
    let said = stderr(&done);
    assert!(done.status.success(), "{said}");
    let read = |name: &str| std::fs::read(folder.path().join("out").join(name)).unwrap();
    let tables = specula::scene::measured::read_tables(&folder.path().join("gold.bsdf")).unwrap();
    let lobe = specula::bsdf::measured::Measured::<f32>::new(&tables).unwrap();
    let numbers: Vec<f32> = (read("gold.measured.bin").as_chunks().0.iter())
        .map(|&bytes| f32::from_le_bytes(bytes))
        .collect();
    assert_eq!(numbers, lobe.packed());
    // Where the numbers begin once the files are one array.
    let first = read("energy_tables.bin").len() / 4;
    let second = first + numbers.len();
    assert!(
        said.contains(&format!("measured_of({first}) behind energy_tables.bin")),
        "{said}"
    );
    assert!(
        said.contains(&format!("measured_of({second}) behind gold.measured.bin")),
        "{said}"
    );

    std::fs::write(folder.path().join("bad.bsdf"), "no tables").unwrap();
    for (file, problem) in [
        ("bad.bsdf", "bad.bsdf"),
        ("./gold.bsdf", "becomes gold.measured.bin, too"),
    ] {
        let files = ["--measured", "gold.bsdf", "--measured", file];
        let done = run(&[&["export", "--lang", "wgsl", "-o", "none"], &files[..]].concat());
        assert_eq!(done.status.code(), Some(2));
        assert!(stderr(&done).contains(problem), "{}", stderr(&done));
        assert!(!folder.path().join("none").exists());
    }
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
