//! Every material with pbrt-v4's defaults.

use specula_bsdf::Rgb;
use specula_scene::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, Geometry, HairMaterial, HairPigment,
    MaterialKind, Mesh, RoughnessMapping,
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
        ("\"subsurface\" \"string name\" \"Skin1\"", "subsurface"),
        ("\"subsurface\" \"rgb mfp\" [1 1 1]", "subsurface"),
        ("\"diffuse\" \"rgb reflectance\" [2 1 1]", "above 1"),
    ] {
        let loaded = load_world(&format!("Material {text}")).unwrap();
        let all = warnings(&loaded);
        assert!(all.len() == 1 && all[0].contains(part), "{text}: {all:?}");
    }
}

fn number(x: f32) -> FloatParam {
    FloatParam::Value(x)
}

#[test]
fn hair_has_the_defaults_of_pbrt() {
    let pigment = HairPigment::Melanin {
        eumelanin: number(1.3),
        pheomelanin: number(0.0),
    };
    let brown = HairMaterial {
        pigment,
        eta: number(1.55),
        beta_m: number(0.3),
        beta_n: number(0.3),
        alpha_deg: number(2.0),
    };
    assert_eq!(material("\"hair\""), MaterialKind::Hair(brown));
    let red = HairPigment::Melanin {
        eumelanin: number(0.0),
        pheomelanin: number(0.5),
    };
    let text = "\"hair\" \"float pheomelanin\" .5 \"float eta\" 1.4 \"float beta_m\" .1 \
                \"float beta_n\" 1 \"float alpha\" -3";
    let other = HairMaterial {
        pigment: red,
        eta: number(1.4),
        beta_m: number(0.1),
        beta_n: number(1.0),
        alpha_deg: number(-3.0),
    };
    assert_eq!(material(text), MaterialKind::Hair(other));
}

#[test]
fn absorption_of_hair_comes_before_colour_and_colour_before_melanin() {
    let sigma_a = "\"rgb sigma_a\" [1 2 3]";
    let colour = "\"rgb color\" [.5 .4 .3]";
    let melanin = "\"float eumelanin\" 2";
    let value = |r, g, b| ColourParam::Value(Rgb { r, g, b });
    for (text, expected, ignored) in [
        (
            format!("{sigma_a} {colour} {melanin}"),
            HairPigment::Absorption(value(1.0, 2.0, 3.0)),
            2,
        ),
        (
            format!("{colour} {melanin}"),
            HairPigment::Reflectance(value(0.5, 0.4, 0.3)),
            1,
        ),
    ] {
        let loaded = load_world(&format!("Material \"hair\" {text}")).unwrap();
        let all = warnings(&loaded);
        assert_eq!(all.len(), ignored, "{all:?}");
        assert!(all.iter().all(|w| w.contains("no effect")), "{all:?}");
        let MaterialKind::Hair(hair) = loaded.scene.materials[0].kind else {
            panic!()
        };
        assert_eq!(hair.pigment, expected);
    }
    for (text, part) in [
        ("\"float beta_m\" 1.5", "\"beta_m\" is 1.5"),
        ("\"float pheomelanin\" -1", "\"pheomelanin\" is below 0"),
        ("\"texture displacement\" \"bumps\"", "unused parameter"),
    ] {
        let world = format!("Texture \"bumps\" \"float\" \"fbm\" Material \"hair\" {text}");
        let loaded = load_world(&world).unwrap();
        let all = warnings(&loaded);
        assert!(all.len() == 1 && all[0].contains(part), "{text}: {all:?}");
    }
    for text in [
        "\"float eta\" 0",
        "\"float eta\" -1.5",
        "\"float alpha\" \"two\"",
    ] {
        let refused = load_world(&format!("Material \"hair\" {text}"));
        assert!(refused.is_err(), "{text}");
    }
}

/// Triangles of fibres are round tubes with tangents, also in mixes, whichever way they are oriented; ribbons and other
/// materials are what they were.
#[test]
fn curves_of_hair_are_fibres() {
    let curve = |look: &str| {
        format!(
            "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"string type\" \"{look}\" \
             \"normal N\" [0 0 1 0 0 1] \"float width\" .1"
        )
    };
    let mesh = |before: &str, look: &str| -> (Mesh, bool) {
        let loaded = load_world(&format!("{before} {}", curve(look))).unwrap();
        let shape = &loaded.scene.shapes[0];
        let Geometry::Curves(id) = shape.geometry else {
            panic!()
        };
        let curves = &loaded.scene.curve_meshes[id.0];
        (curves.mesh(), shape.reverse_orientation)
    };
    let mix = "MakeNamedMaterial \"a\" \"string type\" \"hair\" \
               MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \
               Material \"mix\" \"string materials\" [\"b\" \"a\"]";
    for before in ["Material \"hair\" ReverseOrientation", mix] {
        for look in ["flat", "cylinder"] {
            let (fibre, reversed) = mesh(before, look);
            assert!(fibre.is_fibre && !reversed);
            assert_eq!(fibre.positions.len() % 13, 0);
            assert_eq!(fibre.tangents.len(), fibre.positions.len());
            for (t, n) in fibre.tangents.iter().zip(&fibre.normals) {
                assert!(
                    (t[0] - 1.0).abs() < 1e-6 && n[0].abs() < 1e-6,
                    "{t:?} {n:?}"
                );
            }
        }
        assert!(!mesh(before, "ribbon").0.is_fibre);
    }
    let (plain, reversed) = mesh("Material \"diffuse\" ReverseOrientation", "flat");
    assert!(!plain.is_fibre && plain.tangents.is_empty() && reversed);
    assert_eq!(plain.positions.len() % 5, 0);
}
