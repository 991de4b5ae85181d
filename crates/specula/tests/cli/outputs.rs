//! No file that a command reads is written over, whatever its name.

use std::path::Path;

use crate::common::{SMALL, names, run, small_scene, specula, succeed};
use specula::render::picture::{Metadata, Picture, write_exr};

/// A scene under a picture `env.exr`, in a folder.
fn scene_under_a_picture() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let picture = Picture {
        width: 4,
        height: 4,
        full_resolution: [4, 4],
        colour: vec![specula::bsdf::Rgb::splat(0.5); 16],
        ..Picture::default()
    };
    write_exr(
        &folder.path().join("env.exr"),
        &picture,
        &Metadata::default(),
    )
    .unwrap();
    let light = r#"LightSource "infinite" "string filename" "env.exr""#;
    let text = SMALL.replace(r#"LightSource "infinite" "rgb L" [0.7 0.8 1.0]"#, light);
    assert!(text.contains("env.exr"));
    std::fs::write(folder.path().join("env.pbrt"), text).unwrap();
    folder
}

/// A command is refused with code 2, and the file keeps its bytes.
fn refused(folder: &Path, arguments: &[&str], file: &str) {
    let before = std::fs::read(folder.join(file)).unwrap();
    let (code, said) = run(folder, arguments);
    assert_eq!(code, Some(2), "{arguments:?}: {said}");
    assert!(
        said.contains("was read") || said.contains("reads"),
        "{said}"
    );
    assert_eq!(
        std::fs::read(folder.join(file)).unwrap(),
        before,
        "{arguments:?}"
    );
}

#[test]
fn default_names_step_aside_for_files_that_the_scene_reads() {
    let folder = scene_under_a_picture();
    let folder = folder.path();
    let before = std::fs::read(folder.join("env.exr")).unwrap();
    let (code, said) = run(folder, &["render", "env.pbrt"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("the scene reads 'env.exr'"), "{said}");
    assert!(said.contains("env-render.exr and env-render.png"), "{said}");
    assert_eq!(std::fs::read(folder.join("env.exr")).unwrap(), before);
    assert_eq!(
        names(folder),
        ["env-render.exr", "env-render.png", "env.exr", "env.pbrt"]
    );
}

#[test]
fn a_render_overwrites_no_file_of_its_scene_by_any_name() {
    let folder = scene_under_a_picture();
    let folder = folder.path();
    refused(folder, &["render", "env.pbrt", "-o", "env.exr"], "env.exr");
    refused(
        folder,
        &["render", "env.pbrt", "-o", "./env.exr"],
        "env.exr",
    );
    let place = folder.file_name().unwrap().to_str().unwrap();
    let round = format!("../{place}/env.exr");
    refused(folder, &["render", "env.pbrt", "-o", &round], "env.exr");
    refused(
        folder,
        &["render", "env.pbrt", "-o", "a.png", "-o", "env.exr"],
        "env.exr",
    );
    assert!(!folder.join("a.png").exists());
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("env.exr", folder.join("soft.exr")).unwrap();
        std::fs::hard_link(folder.join("env.exr"), folder.join("hard.exr")).unwrap();
        refused(folder, &["render", "env.pbrt", "-o", "soft.exr"], "env.exr");
        refused(folder, &["render", "env.pbrt", "-o", "hard.exr"], "env.exr");
    }
}

#[test]
fn a_checkpoint_overwrites_no_file_of_its_scene() {
    let (folder, scene) = small_scene();
    let folder = folder.path();
    let text = std::fs::read_to_string(&scene).unwrap();
    std::fs::write(folder.join("b.film"), "Material \"diffuse\"\n").unwrap();
    std::fs::write(&scene, text + "Include \"b.film\"\n").unwrap();
    let line = ["render", "small.pbrt", "--restart", "-o", "b.exr"];
    refused(folder, &line, "b.film");
}

#[test]
fn no_other_command_overwrites_what_it_reads() {
    let folder = scene_under_a_picture();
    let folder = folder.path();
    let render = ["render", "env.pbrt", "-q", "--samples"];
    succeed(folder, &[&render[..], &["0..2", "-o", "a.film"]].concat());
    succeed(folder, &[&render[..], &["2..4", "-o", "b.film"]].concat());
    refused(
        folder,
        &["merge", "a.film", "b.film", "-o", "a.film"],
        "a.film",
    );
    refused(
        folder,
        &["merge", "a.film", "b.film", "-o", "./b.film"],
        "b.film",
    );
    std::fs::copy(folder.join("env.exr"), folder.join("other.png")).unwrap();
    let compare = ["compare", "env.exr", "other.png", "--diff", "other.png"];
    refused(folder, &compare, "other.png");
    refused(folder, &["convert", "env.pbrt", "env.pbrt"], "env.pbrt");

    // Assets would go into a folder that the scene reads from.
    std::fs::create_dir(folder.join("new-files")).unwrap();
    std::fs::rename(folder.join("env.exr"), folder.join("new-files/env.exr")).unwrap();
    let text = std::fs::read_to_string(folder.join("env.pbrt")).unwrap();
    let moved = text.replace("env.exr", "new-files/env.exr");
    std::fs::write(folder.join("env.pbrt"), moved).unwrap();
    let convert = ["convert", "env.pbrt", "new.pbrt"];
    refused(folder, &convert, "new-files/env.exr");
    assert!(!folder.join("new.pbrt").exists());
    succeed(folder, &["convert", "env.pbrt", "newer.pbrt"]);
}

#[test]
fn the_laboratory_overwrites_no_scene_and_no_results() {
    let folder = scene_under_a_picture();
    let folder = folder.path();
    // The result's folder is replaced as a whole.
    std::fs::create_dir_all(folder.join("lab/compare-env")).unwrap();
    for name in ["env.pbrt", "env.exr"] {
        std::fs::rename(folder.join(name), folder.join("lab/compare-env").join(name)).unwrap();
    }
    let scene = "lab/compare-env/env.pbrt";
    let line = [
        "lab",
        "compare",
        scene,
        "--time",
        "100ms",
        "--resolution",
        "8x8",
    ];
    refused(folder, &line, scene);
    assert!(folder.join("lab/compare-env/env.exr").exists());

    std::fs::create_dir_all(folder.join("results/x")).unwrap();
    for (from, to) in [
        ("results", "results"),
        ("results/x", "results"),
        ("results", "./results/."),
    ] {
        let (code, said) = run(folder, &["lab", "report", from, "--markdown", to]);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("--markdown"), "{said}");
        assert!(folder.join("results/x").exists());
    }
}

#[test]
fn an_output_is_given_once_by_whatever_name() {
    let (folder, _) = small_scene();
    let line = ["render", "small.pbrt", "-o", "a.exr", "-o", "./a.exr"];
    let (code, said) = run(folder.path(), &line);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("given twice"), "{said}");
}

/// What `specula farm` sends to other machines.
#[test]
fn info_lists_the_files_of_a_scene() {
    let (folder, _) = small_scene();
    let path = folder.path();
    let outer = "Include \"small.pbrt\"\n";
    std::fs::write(path.join("outer.pbrt"), outer).unwrap();
    let listed = |arguments: &[&str]| {
        let run = specula(path).arg("info").args(arguments).output().unwrap();
        assert!(run.status.success());
        String::from_utf8(run.stdout).unwrap()
    };
    assert_eq!(listed(&["--files", "small.pbrt"]), "small.pbrt\n");
    let both = listed(&["--files", "outer.pbrt"]);
    assert_eq!(both.lines().count(), 2, "{both}");
    assert!(both.contains("outer.pbrt\n") && both.contains("small.pbrt\n"));
    assert_eq!(listed(&["--files"]), "");
}
