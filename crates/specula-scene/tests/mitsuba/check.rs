//! All problems of a Mitsuba scene in one run.

use specula_bsdf::Rgb;
use specula_scene::scene::ColourParam;
use specula_scene::{CheckReport, LoadOptions, Severity};

use super::common::Folder;
use super::report::{self, found};

fn check(folder: &Folder, scene: &str) -> CheckReport {
    let path = folder.write("scene.xml", scene);
    specula_scene::check(&path, &LoadOptions::default())
}

#[track_caller]
fn expect_errors(folder: &Folder, scene: &str, expected: &[(usize, &str)]) {
    let load = folder.load(scene).unwrap_err();
    report::expect_errors(&check(folder, scene), &load, expected);
}

#[test]
fn one_run_finds_every_kind_of_mistake() {
    let folder = Folder::new();
    expect_errors(
        &folder,
        r#"<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="-7"/></integrator>
<sensor type="perspective"><float name="fov" value="abc"/>
<film type="nosuch"/>
<sampler type="independent"><integer name="sample_count" value="0"/></sampler></sensor>
<bsdf type="$undefined" id="lost"/>
<bsdf type="nosuch" id="b"/>
<shape type="sphere"><ref id="b"/><float name="radius" value="-1"/></shape>
<shape type="sphere"><ref id="lost"/></shape>
<shape type="sphere"><ref id="ghost"/></shape>
<shape type="obj"><string name="filename" value="missing.obj"/></shape>
<shape type="obj"/>
<shape type="rectangle"><bsdf type="diffuse"><texture name="reflectance" type="bitmap">
<string name="filename" value="missing.png"/></texture></bsdf></shape>
<shape type="nosuch"/>
<shape type="cube"><transform name="to_world"><spin x="1"/>
<scale value="1e30"/><scale value="1e30"/></transform></shape>
<emitter type="point"><rgb name="intensity" value="1, -1, 1"/></emitter>
<emitter type="envmap"><string name="filename" value="missing.exr"/></emitter>
<include filename="missing.xml"/>
<emitter type="nosuch"/>
</scene>"#,
        &[
            (2, "\"max_depth\""),
            (3, "abc"),
            (4, "unknown film"),
            (5, "\"sample_count\""),
            (6, "$undefined"),
            (7, "unknown bsdf"),
            (8, "\"radius\""),
            (10, "\"ghost\""),
            (11, "missing.obj"),
            (12, "needs its \"filename\""),
            (14, "missing.png"),
            (15, "unknown shape"),
            (16, "not finite in single precision"),
            (16, "<spin>"),
            (18, "not negative"),
            (19, "missing.exr"),
            (20, "missing.xml"),
            (21, "unknown emitter"),
        ],
    );
}

#[test]
fn what_is_no_xml_ends_the_report() {
    let folder = Folder::new();
    let report = check(
        &folder,
        "<scene version=\"3.0.0\">\n<shape type=\"cube\">\n</scene>",
    );
    let errors = found(&report, Severity::Error);
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].1.contains("not XML"), "{errors:?}");
}

#[test]
fn plugins_in_a_ring_are_one_error() {
    let folder = Folder::new();
    let scene = r#"<scene version="3.0.0"><sensor type="perspective"/>
<bsdf type="blendbsdf" id="a"><float name="weight" value="0.5"/><ref id="a"/><ref id="a"/></bsdf>
<shape type="sphere"><ref id="a"/></shape></scene>"#;
    let errors = found(&check(&folder, scene), Severity::Error);
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].1.contains("refers to itself"), "{errors:?}");
}

#[test]
fn what_is_unused_or_dark_is_noted() {
    let folder = Folder::new();
    let report = check(
        &folder,
        r#"<scene version="3.0.0"><sensor type="perspective"/>
<bsdf type="null" id="used"/>
<bsdf type="diffuse" id="unused"/>
<emitter type="constant"><rgb name="radiance" value="0"/></emitter>
<shape type="sphere"><ref id="used"/></shape>
<shape type="cube"><float name="wrong" value="1"/></shape>
<shape type="cube"><emitter type="area"><rgb name="radiance" value="0"/></emitter></shape>
</scene>"#,
    );
    assert_eq!(found(&report, Severity::Error), []);
    let notes = found(&report, Severity::Note);
    let lines: Vec<usize> = notes.iter().map(|n| n.0).collect();
    assert_eq!(lines, [3, 4, 7], "{notes:?}");
    let warnings = found(&report, Severity::Warning);
    assert!(warnings[0].1.contains("wrong"), "{warnings:?}");
}

#[test]
fn a_beam_of_an_area_lights_nothing_and_says_so() {
    let folder = Folder::new();
    let scene = r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="rectangle"><emitter type="directionalarea"><rgb name="radiance" value="2"/></emitter></shape>
</scene>"#;
    let report = check(&folder, scene);
    let warnings = found(&report, Severity::Warning);
    assert!(
        matches!(&warnings[..], [(2, m)] if m.contains("\"ptracer\"")),
        "{warnings:?}"
    );
    assert_eq!(found(&report, Severity::Note), []);
    let emission = folder.load(scene).unwrap().scene.shapes[0].emission;
    let black = ColourParam::Value(Rgb::BLACK);
    assert_eq!(emission.map(|e| e.radiance), Some(black));
}

#[test]
fn files_are_looked_for_in_more_folders() {
    let folder = Folder::new();
    folder.write("more/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let scene = r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="obj"><string name="filename" value="a.obj"/></shape></scene>"#;
    let path = folder.write("scene.xml", scene);
    let error = specula_scene::load(&path).unwrap_err();
    let help = error.help().unwrap_or_default();
    assert!(help.contains("--search"), "{error}: {help}");
    let mut options = LoadOptions::default();
    options.folders = vec![folder.path().join("more")];
    let loaded = specula_scene::load_with(&path, &options).unwrap();
    assert_eq!(loaded.scene.shapes.len(), 1);
}
