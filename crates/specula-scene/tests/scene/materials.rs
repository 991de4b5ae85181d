//! Every material with pbrt-v4's defaults.

use specula_bsdf::Rgb;
use specula_scene::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, MaterialKind, RoughnessMapping,
};

use super::common::{load_world, warnings};

#[track_caller]
fn material(text: &str) -> MaterialKind {
    let loaded = load_world(&format!("Material {text}")).unwrap();
    assert!(warnings(&loaded).is_empty(), "{:?}", warnings(&loaded));
    loaded.scene.materials[loaded.scene.shapes[0].material.0].kind
}

const HALF: ColourParam = ColourParam::Value(Rgb {
    r: 0.5,
    g: 0.5,
    b: 0.5,
});
const SMOOTH: FloatParam = FloatParam::Value(0.0);

#[test]
fn diffuse() {
    assert_eq!(
        material("\"diffuse\""),
        MaterialKind::Diffuse {
            reflectance: HALF,
            roughness: SMOOTH
        }
    );
    let quarter = ColourParam::Value(Rgb::splat(0.25));
    assert_eq!(
        material("\"diffusetransmission\" \"float scale\" 0.5 \"rgb transmittance\" [.5 .5 .5]"),
        MaterialKind::DiffuseTransmission {
            reflectance: ColourParam::Value(Rgb::splat(0.125)),
            transmittance: quarter
        }
    );
}

#[test]
fn dielectrics() {
    let MaterialKind::Dielectric { eta, roughness, .. } = material("\"dielectric\"") else {
        panic!()
    };
    assert_eq!((eta, roughness.u, roughness.v), (1.5, SMOOTH, SMOOTH));
    assert_eq!(roughness.mapping, RoughnessMapping::Sqrt);
    let MaterialKind::Dielectric { eta, .. } =
        material("\"dielectric\" \"spectrum eta\" \"glass-BK7\"")
    else {
        panic!()
    };
    assert!((eta - 1.5168).abs() < 1e-3, "{eta}");
    assert_eq!(
        material("\"thindielectric\" \"float eta\" 1.3"),
        MaterialKind::ThinDielectric {
            eta: 1.3,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        }
    );
    let MaterialKind::Dielectric { roughness, .. } = material(
        "\"dielectric\" \"float uroughness\" 0.1 \"float roughness\" 0.2 \"bool remaproughness\" false",
    ) else {
        panic!()
    };
    assert_eq!(
        (roughness.u, roughness.v),
        (FloatParam::Value(0.1), FloatParam::Value(0.2))
    );
    assert_eq!(roughness.mapping, RoughnessMapping::Alpha);
}

#[test]
fn conductors() {
    let copper = material("\"conductor\"");
    assert_eq!(
        copper,
        material("\"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"spectrum k\" \"metal-Cu-k\"")
    );
    let MaterialKind::Conductor {
        fresnel:
            ConductorFresnel::Index {
                eta: ColourParam::Value(eta),
                ..
            },
        ..
    } = copper
    else {
        panic!()
    };
    assert!(eta.r < eta.b, "copper is red: {eta:?}");
    let given = material("\"conductor\" \"rgb eta\" [.2 .9 1.1] \"rgb k\" [3.9 2.5 2.1]");
    let MaterialKind::Conductor {
        fresnel:
            ConductorFresnel::Index {
                k: ColourParam::Value(k),
                ..
            },
        ..
    } = given
    else {
        panic!()
    };
    assert_eq!([k.r, k.g, k.b], [3.9, 2.5, 2.1]);
    let by_colour = material("\"conductor\" \"rgb reflectance\" [.5 .5 .5]");
    assert!(matches!(
        by_colour,
        MaterialKind::Conductor {
            fresnel: ConductorFresnel::Reflectance(HALF),
            ..
        }
    ));
    assert!(
        load_world("Material \"conductor\" \"rgb reflectance\" [.5 .5 .5] \"rgb k\" [1 1 1]")
            .is_err()
    );
}

#[test]
fn coated() {
    let MaterialKind::CoatedDiffuse {
        reflectance,
        eta,
        roughness,
        medium,
        lossless,
    } = material("\"coateddiffuse\" \"float thickness\" 0.02")
    else {
        panic!()
    };
    assert_eq!((reflectance, eta, roughness.u), (HALF, 1.5, SMOOTH));
    let expected = CoatMedium {
        thickness: FloatParam::Value(0.02),
        max_depth: Some(10),
        ..CoatMedium::default()
    };
    assert_eq!((medium, lossless), (expected, false));
    let MaterialKind::CoatedConductor {
        coat_eta,
        coat_roughness,
        roughness,
        medium,
        ..
    } = material(
        "\"coatedconductor\" \"float interface.roughness\" 0.01 \"float conductor.vroughness\" 0.3
         \"integer maxdepth\" 7 \"integer nsamples\" 3 \"rgb albedo\" [.5 .5 .5] \"float g\" -0.4",
    )
    else {
        panic!()
    };
    assert_eq!(coat_eta, 1.5);
    assert_eq!(
        (coat_roughness.u, coat_roughness.v),
        (FloatParam::Value(0.01), FloatParam::Value(0.01))
    );
    assert_eq!((roughness.u, roughness.v), (SMOOTH, FloatParam::Value(0.3)));
    let expected = CoatMedium {
        thickness: FloatParam::Value(0.01),
        max_depth: Some(7),
        samples: 3,
        albedo: HALF,
        g: FloatParam::Value(-0.4),
    };
    assert_eq!(medium, expected);
}

#[test]
fn mixed_and_named() {
    let loaded = load_world(
        "NamedMaterial \"late\" Shape \"disk\"
         MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"b\" \"string type\" \"conductor\"
         Texture \"t\" \"float\" \"constant\" \"float value\" 0.3
         MakeNamedMaterial \"late\" \"string type\" \"mix\" \"string materials\" [\"a\" \"b\"] \"texture amount\" \"t\"
         Material \"diffuse\" \"float unused\" 1",
    )
    .unwrap();
    let scene = &loaded.scene;
    let MaterialKind::Mix { materials, amount } = scene.materials[scene.shapes[0].material.0].kind
    else {
        panic!()
    };
    assert_eq!(
        materials.map(|m| scene.materials[m.0].name.as_deref()),
        [Some("a"), Some("b")]
    );
    assert!(matches!(amount, FloatParam::Texture(_)));
    assert_eq!(scene.materials.len(), 4);
    assert_eq!(warnings(&loaded), ["unused parameter \"float unused\""]);
}

#[test]
fn interfaces_and_stand_ins() {
    assert_eq!(material("\"interface\""), MaterialKind::Interface);
    for (text, part) in [
        ("\"\"", "deprecated"),
        ("\"hair\"", "hair"),
        ("\"subsurface\" \"string name\" \"Skin1\"", "subsurface"),
        ("\"subsurface\" \"rgb mfp\" [1 1 1]", "subsurface"),
        ("\"diffuse\" \"rgb reflectance\" [2 1 1]", "above 1"),
    ] {
        let loaded = load_world(&format!("Material {text}")).unwrap();
        let all = warnings(&loaded);
        assert!(all.len() == 1 && all[0].contains(part), "{text}: {all:?}");
    }
}
