//! `MakeNamedMedium` and `MediumInterface`: what absorbs, and what is said of the rest.

use specula_bsdf::Rgb;
use specula_scene::Loaded;
use specula_scene::scene::MaterialKind;

use super::common::{load, load_world, warnings};

const FOG: &str = "\"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0]";

/// Absorption inside and around the shapes, in the file's order.
fn sides(loaded: &Loaded) -> Vec<(f32, Option<f32>)> {
    let scene = &loaded.scene;
    let of = |id: specula_scene::scene::MaterialId| &scene.materials[id.0];
    let materials = scene.shapes.iter().map(|s| of(s.material));
    materials
        .map(|m| (m.absorption.g, m.around.map(|a| a.g)))
        .collect()
}

#[test]
fn media_are_those_of_the_shapes_to_come() {
    let loaded = load_world(&format!(
        "MakeNamedMedium \"a\" {FOG} \"rgb sigma_a\" [1 2 3] \"float scale\" 0.5
         MakeNamedMedium \"b\" {FOG} \"rgb sigma_a\" [0 4 0]
         Material \"dielectric\"
         Shape \"sphere\"
         AttributeBegin MediumInterface \"a\" \"\" Shape \"sphere\"
           MediumInterface \"b\" \"a\" Shape \"sphere\" Material \"interface\" Shape \"sphere\"
           Material \"diffuse\" Shape \"sphere\"
         AttributeEnd
         MediumInterface \"a\""
    ))
    .unwrap();
    let plain = (0.0, None);
    assert_eq!(
        sides(&loaded),
        [
            plain,
            (1.0, Some(0.0)),
            (4.0, Some(1.0)),
            (4.0, Some(1.0)),
            plain,
            // The same on both sides says nothing.
            plain
        ]
    );
    assert!(warnings(&loaded).is_empty(), "{:?}", loaded.warnings);
    let copy = &loaded.scene.materials[loaded.scene.shapes[1].material.0];
    assert_eq!(copy.absorption.to_array(), [0.5, 1.0, 1.5]);
    assert!(matches!(copy.kind, MaterialKind::Dielectric { .. }));
}

#[test]
fn presets_and_defaults_are_pbrts() {
    let absorption = |medium: &str| {
        let loaded = load_world(&format!(
            "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" {medium}
             MediumInterface \"m\" \"\" Material \"dielectric\""
        ))
        .unwrap();
        let material = &loaded.scene.materials[loaded.scene.shapes[0].material.0];
        (material.absorption, warnings(&loaded))
    };
    let (milk, said) = absorption("\"string preset\" \"Wholemilk\" \"float scale\" 10");
    for (found, expected) in milk.to_array().into_iter().zip([0.011, 0.024, 0.14]) {
        assert!((found - expected).abs() < 1e-7, "{milk:?}");
    }
    assert!(said[0].contains("25.5, 32.1, 37.7 per unit"), "{said:?}");
    let (one, said) = absorption("\"float g\" 0.75");
    assert_eq!(one, Rgb::WHITE);
    assert!(said[0].contains("0.25, 0.25, 0.25 per unit"), "{said:?}");
    assert_eq!(said.len(), 1);
}

#[test]
fn what_is_left_out_is_said_once() {
    let with = |before: &str, medium: &str| {
        let file = format!(
            "{before} WorldBegin
             MakeNamedMedium \"m\" \"string type\" {medium}
             MediumInterface \"m\" \"\" Material \"dielectric\" Shape \"sphere\"
             MediumInterface \"m\" \"\" Shape \"sphere\""
        );
        let loaded = load(file).unwrap();
        assert_eq!(sides(&loaded)[0].0, 0.0);
        warnings(&loaded)
    };
    assert_eq!(
        with("Integrator \"path\"", "\"homogeneous\""),
        ["medium \"m\" is empty space, as with pbrt-v4's integrator \"path\""]
    );
    assert_eq!(
        with("", "\"cloud\" \"float density\" 2"),
        ["medium \"m\" varies in space: it is empty space here"]
    );
    let black = "\"homogeneous\" \"rgb sigma_a\" [0 0 0]";
    let said = with("", &format!("{black} \"rgb Le\" [1 1 1]"));
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].contains("own light"), "{said:?}");
}

#[test]
fn the_cameras_medium_is_empty_space() {
    let loaded = load(format!(
        "MakeNamedMedium \"fog\" {FOG} MediumInterface \"fog\" Camera \"perspective\" WorldBegin
         Material \"dielectric\" MediumInterface \"\" \"fog\" Shape \"sphere\""
    ))
    .unwrap();
    assert_eq!(
        warnings(&loaded),
        ["the camera is in medium \"fog\", which is empty space here"]
    );
    assert_eq!(sides(&loaded), [(0.0, None)]);
}

#[test]
fn faults_of_media_are_named() {
    for (medium, message) in [
        ("\"float scale\" 1", "a medium needs its \"string type\""),
        ("\"string type\" \"gas\"", "unknown medium type \"gas\""),
        (
            "\"string type\" \"homogeneous\" \"float scale\" -1",
            "\"scale\"",
        ),
        (
            "\"string type\" \"homogeneous\" \"rgb sigma_a\" [1 -1 0]",
            "\"sigma_a\"",
        ),
    ] {
        let error = load_world(&format!("MakeNamedMedium \"m\" {medium}")).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
    let error = load_world("MediumInterface \"m\" \"\"").unwrap_err();
    assert!(error.to_string().contains("no medium \"m\""), "{error}");
}
