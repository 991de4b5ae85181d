//! Scenes of Mitsuba's test-suite, where their folder lies beside the project.

use std::path::Path;

use specula_scene::scene::{Bump, BumpRules, EnvironmentMapping, Light, MaterialKind};
use specula_scene::{Format, LoadOptions, Loaded, load_as};

/// Scene, shapes, materials, lights that are no shapes, textures.
const EXPECTED: [(&str, usize, usize, usize, usize); 16] = [
    ("test_arealight", 13, 13, 0, 3),
    ("test_bumpmap", 2, 2, 2, 3),
    ("test_constant", 12, 12, 1, 3),
    ("test_envmap", 12, 12, 1, 3),
    ("test_normalmap_identity_roughconductor", 2, 2, 2, 1),
    ("test_normalmap", 2, 2, 2, 1),
    ("test_normalmap_roughconductor", 2, 2, 2, 1),
    ("test_pointlight", 12, 12, 1, 3),
    ("test_roughdielectric", 2, 2, 2, 0),
    ("test_roughplastic_linear", 5, 5, 2, 0),
    ("test_roughplastic_nonlinear", 5, 5, 2, 0),
    ("test_textured_diffuse", 2, 2, 2, 1),
    ("test_textured_roughconductor", 2, 2, 2, 6),
    ("test_texturedprincipled1", 2, 2, 2, 12),
    ("test_texturedprincipled2", 2, 2, 2, 12),
    ("test_texturedprincipledthin", 2, 2, 2, 12),
];

fn load(name: &str) -> Option<Loaded> {
    let root =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes/mitsuba-bsdf-spheres");
    let path = root.join(format!("bsdf_spheres/{name}_path.xml"));
    if !path.exists() {
        return None;
    }
    let mut options = LoadOptions::default();
    options.folders = vec![root.join("common")];
    let loaded = load_as(&path, Format::Mitsuba, &options);
    Some(loaded.unwrap_or_else(|e| panic!("{}: {e}", e.place())))
}

#[test]
fn scenes_of_the_test_suite_load_as_counted() {
    let mut wrong = Vec::new();
    for (name, shapes, materials, lights, textures) in EXPECTED {
        let Some(loaded) = load(name) else {
            println!("skipped: {name} is not there");
            continue;
        };
        let scene = &loaded.scene;
        let found = (
            scene.shapes.len(),
            scene.materials.len(),
            scene.lights.len(),
            scene.textures.len(),
        );
        if found != (shapes, materials, lights, textures) {
            wrong.push(format!("{name}: found {found:?}"));
        }
        assert_eq!(scene.film.resolution, [48, 48]);
        assert_eq!(scene.settings.max_depth, 1, "{name}");
        assert_eq!(scene.settings.samples_per_pixel, 128);
        // The folder that they name lies elsewhere here.
        let messages: Vec<_> = loaded.warnings.iter().map(|w| w.message()).collect();
        let expected = |m: &&str| m.contains("does not exist");
        assert!(messages.iter().all(expected), "{name}: {messages:#?}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_the_scenes_are_about_is_there() {
    if let Some(loaded) = load("test_envmap") {
        let map = |l: &Light| {
            let Light::Infinite { image, .. } = l else {
                return false;
            };
            image.is_some_and(|i| i.1 == EnvironmentMapping::LatitudeLongitudePoles)
        };
        assert!(loaded.scene.lights.iter().all(map));
    }
    if let Some(m) = load("test_bumpmap").map(|l| l.scene.materials[0].clone()) {
        assert_eq!(m.bump_rules, BumpRules::Mitsuba { fades: true });
        assert!(matches!(m.bump, Some(Bump::Height(_))) && m.one_sided);
    }
    if let Some(loaded) = load("test_roughplastic_nonlinear") {
        let nonlinear = |m: &specula_scene::scene::Material| {
            matches!(
                m.kind,
                MaterialKind::Plastic {
                    nonlinear: true,
                    ..
                }
            )
        };
        assert_eq!(
            loaded
                .scene
                .materials
                .iter()
                .filter(|m| nonlinear(m))
                .count(),
            4
        );
    }
}
