//! Mitsuba 3's hair and its fibres.

use specula_bsdf::Rgb;
use specula_scene::scene::*;

use super::common::{Folder, REST, warnings};

fn hair(loaded: &specula_scene::Loaded) -> HairMaterial {
    let scene = &loaded.scene;
    let MaterialKind::Hair(hair) = scene.materials[scene.shapes[0].material.0].kind else {
        panic!("no hair")
    };
    hair
}

fn number(x: f32) -> FloatParam {
    FloatParam::Value(x)
}

/// A shape of a file of curves.
fn curve(plugin: &str, version: &str, bsdf: &str) -> specula_scene::Loaded {
    let folder = Folder::new();
    folder.write("a.txt", "0 0 0 .1\n1 0 0 .1\n2 0 0 .1\n3 0 0 .1\n");
    let scene = format!(
        "<scene version=\"{version}\"><shape type=\"{plugin}\"><string name=\"filename\" value=\"a.txt\"/>\
         <boolean name=\"flip_normals\" value=\"true\"/>{bsdf}</shape>{REST}</scene>"
    );
    folder.load(scene).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn hair_has_the_defaults_of_mitsuba() {
    let loaded = curve("bsplinecurve", "3.0.0", r#"<bsdf type="hair"/>"#);
    assert_eq!(warnings(&loaded), [""; 0]);
    let brown = HairMaterial {
        pigment: HairPigment::Melanin {
            eumelanin: number(1.3),
            pheomelanin: number(0.2),
        },
        // Mitsuba 3's amber in its air.
        eta: number((1.55_f64 / 1.000_277) as f32),
        beta_m: number(0.3),
        beta_n: number(0.3),
        alpha_deg: number(2.0),
    };
    assert_eq!(hair(&loaded), brown);
    let other = r#"<bsdf type="twosided"><bsdf type="hair"><rgb name="sigma_a" value="0.2, 0.3, 0.7"/>
        <float name="scale" value="2"/><float name="longitudinal_roughness" value="0.1"/>
        <float name="azimuthal_roughness" value="1"/><float name="scale_tilt" value="-3"/>
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></bsdf>"#;
    let loaded = curve("bsplinecurve", "3.0.0", other);
    let found = hair(&loaded);
    let HairPigment::Absorption(ColourParam::Value(sigma_a)) = found.pigment else {
        panic!("{found:?}")
    };
    let apart = sigma_a - Rgb::from([0.4_f32, 0.6, 1.4]);
    assert!(apart.map(f32::abs).max_channel() < 1e-6, "{sigma_a:?}");
    assert_eq!((found.eta, found.beta_m), (number(1.5), number(0.1)));
    assert_eq!((found.beta_n, found.alpha_deg), (number(1.0), number(-3.0)));
}

/// B-splines of hair are fibres with their direction as tangents. Other shapes, and the 0.6 dialect, are told.
#[test]
fn curves_of_hair_are_fibres() {
    let bsdf = r#"<bsdf type="hair"/>"#;
    let loaded = curve("bsplinecurve", "3.0.0", bsdf);
    let mesh = &loaded.scene.meshes[0];
    assert!(mesh.is_fibre && !loaded.scene.shapes[0].reverse_orientation);
    assert_eq!(mesh.tangents.len(), mesh.positions.len());
    assert!(mesh.tangents.iter().all(|t| (t[0] - 1.0).abs() < 1e-6));
    let diffuse = curve("bsplinecurve", "3.0.0", r#"<bsdf type="diffuse"/>"#);
    let mesh = &diffuse.scene.meshes[0];
    assert!(!mesh.is_fibre && mesh.tangents.is_empty());
    assert!(diffuse.scene.shapes[0].reverse_orientation);
    for (plugin, version, part) in [
        (
            "linearcurve",
            "3.0.0",
            "is meant for shape \"bsplinecurve\"",
        ),
        ("bsplinecurve", "0.6.0", "\"hair\" is not supported"),
    ] {
        let loaded = curve(plugin, version, bsdf);
        assert!(!loaded.scene.meshes[0].is_fibre);
        let all = warnings(&loaded);
        assert!(all.iter().any(|w| w.contains(part)), "{plugin}: {all:?}");
    }
}

#[test]
fn bad_hair_is_an_error() {
    for (inside, part) in [
        (
            r#"<float name="longitudinal_roughness" value="1.1"/>"#,
            "from 0 to 1",
        ),
        (r#"<float name="eumelanin" value="-1"/>"#, "not negative"),
        (
            r#"<float name="eumelanin" value="1"/><rgb name="sigma_a" value="1"/>"#,
            "exclude each other",
        ),
    ] {
        let shape = format!(r#"<shape type="sphere"><bsdf type="hair">{inside}</bsdf></shape>"#);
        let error = super::common::load(&shape).map(|_| ()).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
    }
}
