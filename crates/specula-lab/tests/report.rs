//! The page of results: that it holds all it shows, says what is wrong with results, and works in a
//! browser.

mod browser;

use std::fs;
use std::path::Path;

use specula_bsdf::Rgb;
use specula_lab::output::{PictureComparison, Shot, Table};
use specula_lab::plot::{Axis, Content, Figure, Panel, Series};
use specula_lab::{Claim, LabError, Machine, Outcome, Quality, Record, Source, Verdict, report};
use specula_render::picture::Picture;

/// A picture of stripes, the brighter the larger `gain`.
fn stripes(gain: f32) -> Picture {
    let pixel = |i: u16| Rgb::splat(gain * f32::from(i % 48) / 48.0);
    Picture::from_colour(48, 32, (0..48 * 32).map(pixel).collect())
}

/// A result with everything that there can be, in a folder of its own.
fn result(folder: &Path, id: &str, source: Source) -> Record {
    let place = folder.join(id);
    fs::create_dir(&place).expect("a writable folder");
    let (a, b, c) = (stripes(0.5), stripes(0.8), stripes(0.6));
    let shot = |label, picture, note: &str| Shot {
        label,
        picture,
        note: note.to_owned(),
    };
    let pictures = PictureComparison {
        name: "stripes",
        caption: "Stripes & <b>more</b>.",
        shots: vec![shot("cap", &a, "16 spp"), shot("bounded", &b, "")],
        reference: Some(&c),
        insets: Vec::new(),
        exposure_stops: 0.0,
    };
    let mut long = Table::new("long", "A long table.", &["x [m]", "name"]);
    for i in 0..300_u32 {
        long.push([i.into(), format!("row {i}").into()]);
    }
    let mut short = Table::new("short", "A short table.", &["x [m]"]);
    short.push([0.25.into()]);
    for table in [&long, &short] {
        let path = place.join(format!("{}.csv", table.name));
        table.write_csv(&path).expect("a writable folder");
    }
    let line = Series::new("a line", 1, vec![[0.0, 0.0], [1.0, 2.0]]);
    let figure = Figure::single(Panel {
        title: "a panel".to_owned(),
        x: Axis::linear("x [m]"),
        y: Axis::linear("y [m]"),
        content: Content::Lines(vec![line]),
    });
    let law = |holds| Claim::law("Stripes are stripes", "always", "so here".to_owned(), holds);
    let verdict = Verdict {
        summary: "Stripes are 0.5, 0.8 and 0.6 bright.".to_owned(),
        claims: vec![law(true), law(false)],
        caveat: "No light was harmed.".to_owned(),
    };
    let record = Record {
        id: id.to_owned(),
        source,
        item: "fig. 99".to_owned(),
        title: "<script>alert(1)</script> stripes".to_owned(),
        statement: "Stripes \"are\" stripes.".to_owned(),
        command: format!("specula lab run {id}"),
        quality: Quality::Draft,
        seed: 1,
        version: "0.0.0".to_owned(),
        machine: Machine::here(),
        seconds: 0.5,
        outcome: Outcome::Partly,
        verdict,
        tables: vec![long, short],
        plots: vec![
            figure
                .write(&place, "plot", "A plot.")
                .expect("a writable folder"),
        ],
        comparisons: vec![pictures.write(&place).expect("a writable folder")],
    };
    record.write(&place).expect("a writable folder");
    record
}

/// A folder with two results, and the page about them.
fn page() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a writable folder");
    result(folder.path(), "tokuyoshi24-fig99", Source::Tokuyoshi24);
    result(folder.path(), "compare-stripes", Source::Specula);
    let page = report::write(folder.path()).expect("a writable folder");
    assert_eq!(page.results, 2);
    let text = fs::read_to_string(&page.path).expect("a writable folder");
    assert_eq!(text.len() as u64, page.bytes);
    (folder, text)
}

#[test]
fn the_page_holds_all_that_it_shows() {
    let (_folder, text) = page();
    for attribute in ["src=\"", "href=\""] {
        for rest in text.split(attribute).skip(1) {
            let begins: String = rest.chars().take(24).collect();
            assert!(
                begins.starts_with("data:") || begins.starts_with('#'),
                "{begins}"
            );
        }
    }
    for outside in [
        "http://", "https://", "@import", "url(", "fetch(", "import(",
    ] {
        assert!(!text.contains(outside), "{outside}");
    }
    for there in [
        "Tokuyoshi and Eto 2024",
        "fig. 99",
        "partly",
        "Stripes are 0.5, 0.8 and 0.6 bright.",
        "No light was harmed.",
        "so here",
        "16 spp",
        "HDR-FLIP",
        "row 99",
        "200 more rows are in the file",
        "specula lab run compare-stripes",
        "seed 1, 0.500 s",
    ] {
        assert!(text.contains(there), "{there}");
    }
    assert!(!text.contains("row 100<"), "long tables are cut");
}

#[test]
fn what_results_say_is_text() {
    let (_folder, text) = page();
    assert!(!text.contains("<script>alert"));
    assert!(text.contains("&lt;script&gt;alert"));
    assert!(text.contains("Stripes &amp; &lt;b&gt;more"));
}

#[test]
fn one_result_has_a_page_of_its_own() {
    let (folder, _) = page();
    let place = folder.path().join("compare-stripes");
    let page = report::write_to(&place, &folder.path().join("one.html")).unwrap();
    assert_eq!(page.results, 1);
    assert!(folder.path().join("one.html").is_file());
}

#[test]
fn what_is_wrong_with_results_is_named() {
    let (folder, before) = page();
    let damaged = folder.path().join("compare-stripes/result.json");
    fs::write(&damaged, "{\n  \"id\": 7\n}").unwrap();
    let error = report::write(folder.path()).unwrap_err();
    assert!(matches!(error, LabError::NotAResult { .. }));
    let text = error.to_string();
    for part in ["compare-stripes", "result.json", "line 2"] {
        assert!(text.contains(part), "{text}");
    }
    fs::remove_dir_all(folder.path().join("compare-stripes")).unwrap();
    fs::remove_file(folder.path().join("tokuyoshi24-fig99/stripes-cap.png")).unwrap();
    let text = report::write(folder.path()).unwrap_err().to_string();
    assert!(text.contains("stripes-cap.png"), "{text}");
    // The page of before is as it was.
    let now = fs::read_to_string(folder.path().join(report::PAGE)).unwrap();
    assert_eq!(now, before);
    let empty = tempfile::tempdir().unwrap();
    let error = report::write(empty.path()).unwrap_err();
    assert!(matches!(error, LabError::NoResults(_)));
}

/// The page does in a browser what it is for, in a wide window and in a narrow one; its own check does
/// see faults.
#[test]
fn the_page_works_in_a_browser() {
    let (folder, text) = page();
    let path = folder.path().join(report::PAGE);
    for width in [1400, 500] {
        let Some(outcome) = browser::check(&path, width) else {
            return;
        };
        assert_eq!(outcome, "passed: 2 viewers", "{width}");
    }
    for (right, wrong, blamed) in [
        ("left.style.clipPath", "left.style.clip", "the slider cuts"),
        (
            "this.x += u / this.zoom",
            "this.x += 0 / this.zoom",
            "all zoom about the middle",
        ),
        (
            "this.press(\"errors\", on);\n    this.show();",
            "",
            "the slider shows error maps",
        ),
        (
            "data:image/png;base64,iVBORw0KGgo",
            "data:image/png;base64,AAAAAAAAAAA",
            "a picture is readable",
        ),
        (
            "max-width: 84rem",
            "min-width: 184rem",
            "the page is as wide as its window",
        ),
    ] {
        assert!(text.contains(right), "{right}");
        let faulty = folder.path().join("faulty.html");
        fs::write(&faulty, text.replacen(right, wrong, 1)).unwrap();
        let outcome = browser::check(&faulty, 1400).unwrap_or_default();
        let expected = format!("failed: {blamed}");
        assert!(outcome.starts_with(&expected), "{wrong}: {outcome}");
    }
}
