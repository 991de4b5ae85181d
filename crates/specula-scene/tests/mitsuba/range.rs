//! Numbers beyond what they may be: the nearest that is rendered, and a warning.

use specula_scene::scene::{FloatParam, MaterialKind};
use specula_scene::{LoadOptions, Severity, check};

use super::common::{Folder, REST, load_shape, warnings};

/// The one warning of a surface in a load, which a check has, too; and what the surface is.
#[track_caller]
fn warned(bsdf: &str) -> (String, MaterialKind) {
    let loaded = load_shape(bsdf).unwrap();
    let [warning] = &warnings(&loaded)[..] else {
        panic!("{:?}", loaded.warnings)
    };
    assert_eq!(loaded.warnings[0].line(), 2);
    let folder = Folder::new();
    let path = folder.write(
        "scene.xml",
        format!(
            "<scene version=\"3.0.0\">\n<shape type=\"rectangle\">{bsdf}</shape>\n{REST}</scene>"
        ),
    );
    let report = check(&path, &LoadOptions::default());
    assert_eq!(report.count(Severity::Warning), 1);
    assert_eq!(report.problems()[0].message(), warning);
    let material = &loaded.scene.materials[loaded.scene.shapes[0].material.0];
    (warning.clone(), material.kind)
}

#[test]
fn the_widest_alpha_is_said() {
    let bsdf = "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"1e9\"/></bsdf>";
    let (warning, kind) = warned(bsdf);
    assert!(warning.contains("\"alpha\": 1000000000"), "{warning}");
    let MaterialKind::Conductor { roughness, .. } = kind else {
        panic!("{kind:?}")
    };
    assert_eq!(roughness.u, FloatParam::Value(10.0));
    let error = load_shape(&bsdf.replace("1e9", "-1")).unwrap_err();
    assert!(error.message().contains("not negative"), "{error}");
    assert_eq!(error.line(), 2);
}

#[test]
fn shares_end_at_one() {
    let (warning, kind) =
        warned("<bsdf type=\"principled\"><float name=\"metallic\" value=\"7\"/></bsdf>");
    assert!(
        warning.contains("\"metallic\": a share above 1"),
        "{warning}"
    );
    let MaterialKind::Principled(principled) = kind else {
        panic!("{kind:?}")
    };
    assert_eq!(principled.metallic, FloatParam::Value(1.0));
}

#[test]
fn a_scene_needs_a_sensor() {
    let folder = Folder::new();
    let scene =
        "<scene version=\"3.0.0\">\n<emitter type=\"constant\"/><shape type=\"cube\"/></scene>";
    let error = folder.load(scene).unwrap_err();
    assert!(error.message().contains("no <sensor>"), "{error}");
    let report = check(&folder.path().join("scene.xml"), &LoadOptions::default());
    assert_eq!(report.count(Severity::Error), 1);
}

#[test]
fn views_and_sizes_that_are_none_are_errors() {
    let shape = "<shape type=\"cube\"/>";
    for (inside, part) in [
        (
            "<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>",
            "above 0",
        ),
        (
            "<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>",
            "finite",
        ),
        (
            "<shape type=\"cube\"><transform name=\"to_world\"><lookat origin=\"0 0 0\" target=\"0 1 0\" \
             up=\"0 1 0\"/></transform></shape>",
            "along the view",
        ),
        (
            "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"1e30\"/><scale value=\"1e30\"/></transform></shape>",
            "not finite in single precision",
        ),
        (
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0\" z=\"0\"/></emitter>",
            "direction",
        ),
        (
            "<shape type=\"cylinder\"><point name=\"p0\" x=\"1\" y=\"1\" z=\"1\"/><point name=\"p1\" x=\"1\" \
             y=\"1\" z=\"1\"/></shape>",
            "same point",
        ),
        (
            "<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"-20\"/></emitter>",
            "cutoff_angle",
        ),
    ] {
        let error = super::common::load(&format!("{shape}{inside}")).unwrap_err();
        assert!(error.message().contains(part), "{inside}: {error}");
        assert_eq!(error.line(), 2, "{inside}");
    }
}
