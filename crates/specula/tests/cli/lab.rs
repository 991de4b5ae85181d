//! `specula lab`, end to end.

use std::fs;
use std::path::Path;

use crate::common::{small_scene, specula, stderr};

/// Runs `specula lab` with these arguments; exit code, standard output and standard error.
fn lab(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let run = specula(folder)
        .arg("lab")
        .args(arguments)
        .output()
        .expect("the program answers");
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    (run.status.code().unwrap_or(-1), said, stderr(&run))
}

/// The JSON of a result.
fn result(folder: &Path) -> serde_json::Value {
    let text = fs::read_to_string(folder.join("result.json")).expect("the program answers");
    serde_json::from_str(&text).expect("the program answers")
}

#[test]
fn experiments_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let (code, text, _) = lab(folder.path(), &["list"]);
    assert_eq!(code, 0);
    for part in [
        "Tokuyoshi and Eto 2024",
        "tokuyoshi24-fig5",
        "lobes and densities",
    ] {
        assert!(text.contains(part), "{text}");
    }
    let (_, lines, _) = lab(folder.path(), &["list", "--json"]);
    let ids: Vec<String> = lines
        .lines()
        .map(|l| serde_json::from_str::<serde_json::Value>(l).unwrap()["id"].to_string())
        .collect();
    assert_eq!(ids.len(), specula::lab::experiments::ALL.len());
}

#[test]
fn an_experiment_leaves_its_files_and_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["run", "tokuyoshi24-fig5", "-o", "out", "--seed", "3"];
    let (code, text, error) = lab(folder.path(), &arguments);
    assert_eq!(code, 0, "{error}");
    assert!(text.starts_with("tokuyoshi24-fig5: reproduced. "), "{text}");
    assert!(error.contains("wrote out/report.html"), "{error}");
    let place = folder.path().join("out/tokuyoshi24-fig5");
    let found = result(&place);
    assert_eq!(found["seed"], 3);
    assert_eq!(found["quality"], "draft");
    for name in ["lobes.csv", "lobes.svg", "lobes.png"] {
        assert!(place.join(name).is_file(), "{name}");
    }
    let page = folder.path().join("out/report.html");
    fs::remove_file(&page).unwrap();
    assert_eq!(lab(folder.path(), &["report", "out"]).0, 0);
    assert!(
        fs::read_to_string(&page)
            .unwrap()
            .contains("lobes and densities")
    );
    let hidden = fs::read_dir(folder.path().join("out")).unwrap();
    let names: Vec<_> = hidden.map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names.len(), 2, "{names:?}");
}

#[test]
fn what_is_wrong_is_told_with_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("file"), "").unwrap();
    fs::create_dir_all(at.join("empty")).unwrap();
    fs::create_dir_all(at.join("damaged/x")).unwrap();
    fs::write(at.join("damaged/x/result.json"), "{\n\"id\": 1,\n}").unwrap();
    for (arguments, parts) in [
        (
            vec!["run", "tokuyoshi24-fig55"],
            vec!["'tokuyoshi24-fig55'", "nearest", "tokuyoshi24-fig5"],
        ),
        (vec!["run", "nothing-*"], vec!["'nothing-*'", "lab list"]),
        (vec!["run", "--quality", "best"], vec!["draft, paper"]),
        (
            vec!["run", "tokuyoshi24-fig5", "-o", "file"],
            vec!["'file' is a file"],
        ),
        (vec!["report", "empty"], vec!["empty", "no results"]),
        (vec!["report", "nowhere"], vec!["'nowhere' is no folder"]),
        (
            vec!["report", "damaged"],
            vec!["x/result.json", "line 2 column"],
        ),
        (vec!["material", "gold"], vec!["no 'gold'", "conductor"]),
        (
            vec!["material", "diffuse 0.5", "-o", "nowhere/a.html"],
            vec!["cannot write 'nowhere/a.html'"],
        ),
        (vec!["compare", "no.pbrt"], vec!["no.pbrt"]),
        (vec!["compare", "--energy", "all"], vec!["kulla-conty"]),
        (vec!["compare", "--samplers", "best"], vec!["exact"]),
        (vec!["compare", "--time", "0"], vec!["above 0"]),
    ] {
        let (code, _, error) = lab(at, &arguments);
        assert_eq!(code, 2, "{arguments:?}: {error}");
        // Long messages are wrapped.
        let line = error.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in parts {
            assert!(
                line.replace("│ ", "").contains(part),
                "{arguments:?}: {line}"
            );
        }
    }
    assert!(!at.join("lab").exists(), "nothing was begun");
}

#[test]
fn a_material_has_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let text = "conductor Au alpha 0.5";
    let (code, said, error) = lab(folder.path(), &["material", text, "-o", "gold.html"]);
    assert_eq!(code, 0, "{error}");
    assert!(
        said.contains("material-conductor-au-alpha-0.5: holds"),
        "{said}"
    );
    let page = fs::read_to_string(folder.path().join("gold.html")).unwrap();
    for part in [
        text,
        "Directional albedo",
        "chi-square",
        "Densities of the samplers",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 1, "nothing but the page is left");
    let (code, ..) = lab(
        folder.path(),
        &["material", "conductor Au alpha 0", "-o", "all"],
    );
    assert_eq!(code, 0);
    let found = result(&folder.path().join("all/material-conductor-au-alpha-0"));
    assert!(
        found["verdict"]["caveat"]
            .as_str()
            .unwrap()
            .contains("Dirac")
    );
}

#[test]
fn samplers_are_compared_on_a_scene() {
    let (folder, scene) = small_scene();
    let scene = scene.to_str().unwrap();
    let arguments = [
        "compare",
        scene,
        "--time",
        "100ms",
        "--samplers",
        "cap,exact",
        "--energy",
        "none,turquin",
        "-o",
        "out",
    ];
    let (code, said, error) = lab(folder.path(), &arguments);
    assert_eq!(code, 0, "{error}");
    for part in [
        "With energy none, ",
        "With energy turquin, ",
        "take ",
        "mean brightness",
    ] {
        assert!(said.contains(part), "{said}");
    }
    assert!(folder.path().join("out/report.html").is_file());
    let found = result(&folder.path().join("out/compare-small"));
    assert_eq!(found["tables"][0]["rows"].as_array().unwrap().len(), 4);
    assert!(
        found["command"]
            .as_str()
            .unwrap()
            .contains("--samplers cap,exact")
    );
    answers_follow_from_figures(&found);
    let pictures = &found["comparisons"][0];
    assert_eq!(pictures["shots"].as_array().unwrap().len(), 3);
    // Its own reference may be used again, but only for one treatment of energy and the same size.
    let reference = folder
        .path()
        .join("out/compare-small/energy-none-reference.exr");
    let reference = reference.to_str().unwrap();
    let given = [
        "compare",
        scene,
        "--time",
        "50ms",
        "--reference",
        reference,
        "-o",
        "given",
    ];
    let (code, _, error) = lab(folder.path(), &given);
    assert_eq!(code, 0, "{error}");
    for (more, part) in [
        (["--energy", "none,turquin"], "--reference"),
        (["--resolution", "32x32"], "--reference"),
    ] {
        let (code, _, error) = lab(folder.path(), &[&given[..], &more[..]].concat());
        assert_eq!(code, 2, "{error}");
        assert!(error.contains(part), "{error}");
    }
}

/// The claim about the exact sampler says what the table of pairs says: yes where no interval is below 1, no
/// where one is.
fn answers_follow_from_figures(found: &serde_json::Value) {
    let tables = found["tables"].as_array().unwrap();
    let pairs = tables.iter().find(|t| t["name"] == "pairs").unwrap();
    let rows = pairs["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2, "cap and exact, twice");
    let mut expected = "yes";
    for row in rows {
        assert_eq!((&row[1], &row[2]), (&"exact".into(), &"cap".into()));
        // Where nothing is known there is no number.
        let bound = |i: usize, otherwise: f64| row[i].as_f64().unwrap_or(otherwise);
        let (from, to) = (bound(4, 0.0), bound(5, f64::INFINITY));
        let decided = match (from > 1.0, to < 1.0) {
            (true, _) => "more efficient",
            (_, true) => "less efficient",
            _ => "not told apart",
        };
        assert_eq!(row[6], decided, "{row}");
        if to < 1.0 {
            expected = "no";
        } else if from < 1.0 && expected == "yes" {
            expected = "undecided";
        }
    }
    let claims = found["verdict"]["claims"].as_array().unwrap();
    let about_exact = |c: &&serde_json::Value| {
        c["statement"]
            .as_str()
            .is_some_and(|s| s.contains("at least as efficient"))
    };
    let claim = claims.iter().find(about_exact).unwrap();
    assert_eq!(claim["holds"], expected, "{claim}");
}

#[cfg(unix)]
mod interrupted {
    use super::*;
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Stdio};

    fn start(folder: &Path, arguments: &[&str]) -> Child {
        crate::common::heeding_signals()
            .current_dir(folder)
            .arg("lab")
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program runs")
    }

    fn interrupt(child: &Child) {
        crate::common::send("INT", child.id());
    }

    /// What was finished is kept, and there is a page about it.
    #[test]
    fn a_run_keeps_what_is_finished() {
        let folder = tempfile::tempdir().unwrap();
        let all = specula::lab::experiments::ALL;
        let first = all.iter().position(|e| e.id == "tokuyoshi24-fig5").unwrap();
        let Some(next) = all.get(first + 1) else {
            return;
        };
        let arguments = [
            "run",
            "tokuyoshi24-fig5",
            next.id,
            "--quality",
            "paper",
            "-o",
            "out",
        ];
        let mut child = start(folder.path(), &arguments);
        let mut line = String::new();
        let out = child.stdout.take().unwrap();
        BufReader::new(out).read_line(&mut line).unwrap();
        assert!(line.starts_with("tokuyoshi24-fig5"), "{line}");
        interrupt(&child);
        let run = child.wait_with_output().unwrap();
        assert_eq!(run.status.code(), Some(130), "{}", stderr(&run));
        assert!(
            stderr(&run).contains("1 of 2 experiments"),
            "{}",
            stderr(&run)
        );
        let out = folder.path().join("out");
        assert!(out.join("report.html").is_file());
        assert!(!out.join(next.id).exists());
    }

    #[test]
    fn a_comparison_is_all_or_nothing() {
        let (folder, scene) = small_scene();
        let scene = scene.to_str().unwrap();
        let arguments = ["compare", scene, "--time", "1h", "-o", "out"];
        let child = start(folder.path(), &arguments);
        let unfinished = folder.path().join("out/.compare-small.unfinished");
        while !unfinished.exists() {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        interrupt(&child);
        let run = child.wait_with_output().unwrap();
        assert_eq!(run.status.code(), Some(130), "{}", stderr(&run));
        assert_eq!(fs::read_dir(folder.path().join("out")).unwrap().count(), 0);
    }
}

#[test]
fn a_metal_becomes_a_measured_material_that_renders() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--views", "8", "--normals", "24", "--colours", "8"];
    let mut arguments = vec!["tabulate", "conductor Au alpha 0.3", "-o", "gold.bsdf"];
    arguments.extend(small);
    let (code, _, error) = lab(folder.path(), &arguments);
    assert_eq!(code, 0, "{error}");
    assert!(error.contains("wrote gold.bsdf"), "{error}");
    let scene =
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 Camera \"perspective\"
        WorldBegin LightSource \"infinite\" Translate 0 0 3
        Material \"measured\" \"string filename\" \"gold.bsdf\" Shape \"sphere\"";
    fs::write(folder.path().join("gold.pbrt"), scene).unwrap();
    let run = specula(folder.path())
        .args(["render", "gold.pbrt", "--spp", "4", "-o", "gold.exr"])
        .output()
        .expect("the program answers");
    assert!(run.status.success(), "{}", stderr(&run));
    assert!(folder.path().join("gold.exr").is_file());

    for (text, output, problem) in [
        ("diffuse 0.5 0.5 0.5", "x.bsdf", "expected a rough metal"),
        ("conductor Au alpha 0.1 0.3", "x.binary", "isotropic"),
    ] {
        let (code, _, error) = lab(folder.path(), &["tabulate", text, "-o", output]);
        assert_eq!(code, 2, "{error}");
        assert!(error.contains(problem), "{error}");
        assert!(!folder.path().join(output).exists());
    }
}

#[test]
fn a_measured_material_is_fitted_and_its_text_renders() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, error) = lab(
        folder.path(),
        &["tabulate", "conductor Cu alpha 0.4", "-o", "copper.binary"],
    );
    assert_eq!(code, 0, "{error}");
    let quick = ["--bounces", "single", "--distributions", "ggx"];
    let mut arguments = vec!["fit", "copper.binary", "-o", "out"];
    arguments.extend(quick);
    let (code, printed, error) = lab(folder.path(), &arguments);
    assert_eq!(code, 0, "{error}");
    assert!(
        printed.starts_with("fit-copper.binary: holds."),
        "{printed}"
    );
    let record =
        fs::read_to_string(folder.path().join("out/fit-copper.binary/result.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    let tables = record["tables"].as_array().unwrap();
    let rows = |name: &str| {
        let table = tables.iter().find(|t| t["name"] == name).unwrap();
        table["rows"].as_array().unwrap().clone()
    };
    let alpha = rows("fits")[0][1].as_f64().unwrap();
    assert!((alpha / 0.4 - 1.0).abs() < 0.02, "{alpha}");
    let texts = rows("text");
    let own = texts.iter().find(|r| r[0] == "specula render").unwrap();
    let own = own[1].as_str().unwrap();
    let material = own.split('"').nth(1).unwrap();
    let run = specula(folder.path())
        .args([
            "render",
            "--material",
            material,
            "--spp",
            "1",
            "--resolution",
            "16x16",
            "-o",
            "x.exr",
        ])
        .output()
        .expect("the program answers");
    assert!(run.status.success(), "{}", stderr(&run));

    for (bytes, problem) in [
        (&b"P6 no such file"[..], "tensor_file"),
        (
            &[90, 0, 0, 0, 90, 0, 0, 0, 180, 0, 0, 0][..],
            "expected 34992012",
        ),
    ] {
        fs::write(folder.path().join("bad.bsdf"), bytes).unwrap();
        let (code, _, error) = lab(folder.path(), &["fit", "bad.bsdf", "-o", "bad.html"]);
        assert_eq!(code, 2, "{error}");
        assert!(
            error.contains("bad.bsdf") && error.contains(problem),
            "{error}"
        );
        assert!(!folder.path().join("bad.html").exists());
    }
}
