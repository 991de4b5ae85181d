//! Mitsuba's scenes of `data/scenes`.

use specula_scene::scene::{Bump, BumpRules, EnvironmentMapping, Light, MaterialKind};
use specula_scene::{Format, LoadOptions, Loaded, load_as};

/// Scene, shapes, materials, lights that are no shapes, textures.
const EXPECTED: [(&str, usize, usize, usize, usize); 16] = [
    ("arealight", 13, 13, 0, 3),
    ("bumpmap", 2, 2, 2, 3),
    ("constant", 12, 12, 1, 3),
    ("envmap", 12, 12, 1, 3),
    ("normalmap", 2, 2, 2, 1),
    ("normalmap-roughconductor", 2, 2, 2, 1),
    ("pointlight", 12, 12, 1, 3),
    ("principled", 2, 2, 2, 12),
    ("principled-glass", 2, 2, 2, 9),
    ("principled-thin", 2, 2, 2, 9),
    ("roughconductor", 2, 2, 2, 0),
    ("roughdielectric", 2, 2, 2, 0),
    ("roughplastic-linear", 5, 5, 2, 0),
    ("roughplastic-nonlinear", 5, 5, 2, 0),
    ("textured-diffuse", 2, 2, 2, 1),
    ("textured-roughconductor", 2, 2, 2, 7),
];

fn load(name: &str) -> Loaded {
    let path = specula_testing::scene(&format!("mitsuba/{name}.xml"));
    let loaded = load_as(&path, Format::Mitsuba, &LoadOptions::default());
    loaded.unwrap_or_else(|e| panic!("{}: {e}", e.place()))
}

#[test]
fn scenes_load_as_counted() {
    let mut wrong = Vec::new();
    for (name, shapes, materials, lights, textures) in EXPECTED {
        let loaded = load(name);
        let scene = &loaded.scene;
        let counts = (
            scene.shapes.len(),
            scene.materials.len(),
            scene.lights.len(),
            scene.textures.len(),
        );
        if counts != (shapes, materials, lights, textures) {
            wrong.push(format!("{name}: {counts:?}"));
        }
        assert_eq!(scene.film.resolution, [48, 48]);
        assert_eq!(scene.settings.max_depth, 1, "{name}");
        assert_eq!(scene.settings.samples_per_pixel, 128);
        let messages: Vec<_> = loaded.warnings.iter().map(|w| w.message()).collect();
        assert!(messages.is_empty(), "{name}: {messages:#?}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_the_scenes_are_about_is_there() {
    let is_map = |l: &Light| {
        let Light::Infinite { image, .. } = l else {
            return false;
        };
        image.is_some_and(|i| i.1 == EnvironmentMapping::LatitudeLongitudePoles)
    };
    assert!(load("envmap").scene.lights.iter().all(is_map));
    let bumpy = &load("bumpmap").scene.materials[0];
    assert_eq!(bumpy.bump_rules, BumpRules::Mitsuba { fades: true });
    assert!(matches!(bumpy.bump, Some(Bump::Height(_))) && bumpy.one_sided);
    let loaded = load("roughplastic-nonlinear");
    let nonlinear = loaded.scene.materials.iter().filter(|m| {
        matches!(
            m.kind,
            MaterialKind::Plastic {
                nonlinear: true,
                ..
            }
        )
    });
    assert_eq!(nonlinear.count(), 4);
}
