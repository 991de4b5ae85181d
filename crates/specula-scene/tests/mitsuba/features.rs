//! The list of features against what the reader does.

use specula_scene::features::FORMATS;
use specula_scene::{ErrorKind, Feature, Support};

use super::common::Folder;

/// The features of Mitsuba's reader.
fn features() -> &'static [Feature] {
    let mitsuba = FORMATS.iter().find(|f| f.0 == "Mitsuba 3");
    mitsuba.unwrap().1
}

/// A scene that asks for a feature, with what the feature needs.
fn scene(feature: &Feature) -> String {
    let Feature { class, name, .. } = *feature;
    let nested = match name {
        "twosided" | "mask" | "coating" | "roughcoating" => r#"<bsdf type="diffuse"/>"#,
        "bumpmap" => r#"<texture type="checkerboard"/><bsdf type="diffuse"/>"#,
        "normalmap" => r#"<texture name="normalmap" type="checkerboard"/><bsdf type="diffuse"/>"#,
        "blendbsdf" => {
            r#"<float name="weight" value="0.5"/><bsdf type="diffuse"/><bsdf type="plastic"/>"#
        }
        "mixturebsdf" => r#"<string name="weights" value="1"/><bsdf type="diffuse"/>"#,
        "measured" => r#"<string name="filename" value="a.bsdf"/>"#,
        "envmap" | "bitmap" => r#"<string name="filename" value="grey.png"/>"#,
        "obj" => r#"<string name="filename" value="a.obj"/>"#,
        "ply" => r#"<string name="filename" value="a.ply"/>"#,
        "linearcurve" | "bsplinecurve" => r#"<string name="filename" value="a.txt"/>"#,
        "instance" | "animatedinstance" => {
            r#"<shape type="shapegroup"><shape type="cube"/></shape>"#
        }
        "shapegroup" | "merge" => r#"<shape type="cube"/>"#,
        "thinlens" => r#"<float name="aperture_radius" value="0.1"/>"#,
        "regular" => r#"<string name="values" value="1 2 3"/>"#,
        "irregular" => {
            r#"<string name="values" value="1 2"/><string name="wavelengths" value="400 500"/>"#
        }
        _ => "",
    };
    let plugin = format!("<{class} type=\"{name}\">{nested}</{class}>");
    let cube = r#"<shape type="cube"/>"#;
    let camera = r#"<sensor type="perspective"/>"#;
    let light = r#"<emitter type="constant"/>"#;
    let world = match class {
        "bsdf" => format!("<shape type=\"cube\">{plugin}</shape>{camera}{light}"),
        "emitter" if name.contains("area") => {
            format!("<shape type=\"cube\">{plugin}</shape>{camera}")
        }
        "emitter" => format!("{plugin}{cube}{camera}"),
        "shape" => format!("{plugin}{cube}{camera}{light}"),
        "texture" => {
            let named = plugin.replacen("<texture ", "<texture name=\"reflectance\" ", 1);
            format!(
                "<shape type=\"cube\"><bsdf type=\"diffuse\">{named}</bsdf></shape>{camera}{light}"
            )
        }
        "sensor" => format!("{plugin}{cube}{light}"),
        "film" | "sampler" => {
            format!("<sensor type=\"perspective\">{plugin}</sensor>{cube}{light}")
        }
        "rfilter" => format!(
            "<sensor type=\"perspective\"><film type=\"hdrfilm\">{plugin}</film></sensor>{cube}{light}"
        ),
        "integrator" => format!("{plugin}{cube}{camera}{light}"),
        other => panic!("no scene for the class {other}"),
    };
    // The 0.6 dialect reads all that the new one does.
    format!("<scene version=\"3.0.0\">{world}</scene>")
}

#[test]
fn every_feature_is_treated_as_the_list_says() {
    let folder = Folder::new();
    folder.write("grey.png", include_bytes!("grey.png"));
    folder.write("a.bsdf", super::measured::file());
    folder.write("a.txt", "0 0 0 1\n1 0 0 1\n2 0 0 1\n3 0 0 1\n");
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    );
    for feature in features().iter().filter(|f| f.name != "serialized") {
        let what = format!("{} {}", feature.class, feature.name);
        let found = folder.load(scene(feature));
        match (feature.support, found) {
            (Support::Full, Ok(loaded)) => {
                assert_eq!(loaded.warnings.len(), 0, "{what}: {:?}", loaded.warnings);
            }
            (Support::Approximated(_), Ok(_)) => {}
            (Support::Refused(_), Err(e)) => {
                assert_eq!(e.kind(), ErrorKind::Unsupported, "{what}: {e}");
            }
            (_, Ok(_)) => panic!("{what} should be refused"),
            (_, Err(e)) => panic!("{what}: {e}"),
        }
    }
}

#[test]
fn what_is_not_in_the_list_is_an_error() {
    let folder = Folder::new();
    for class in [
        "bsdf",
        "emitter",
        "shape",
        "texture",
        "sensor",
        "film",
        "rfilter",
        "integrator",
    ] {
        let feature = Feature::full(class, "fancy");
        let error = folder.load(scene(&feature)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported, "{class}: {error}");
        assert!(
            error
                .message()
                .contains(&format!("unknown {class} \"fancy\"")),
            "{error}"
        );
    }
}

#[test]
fn the_list_names_everything_once() {
    for (i, a) in features().iter().enumerate() {
        assert!(
            features()[..i]
                .iter()
                .all(|b| (a.class, a.name) != (b.class, b.name)),
            "{} {}",
            a.class,
            a.name
        );
    }
}
