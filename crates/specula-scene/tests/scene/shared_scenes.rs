//! Scenes by others, of `data/scenes`.

use specula_scene::{Summary, load};
use specula_testing::scene;

/// File, triangles shown, materials, warnings.
const EXPECTED: &[(&str, u64, usize, usize)] = &[
    ("staircase2/staircase2.pbrt", 28_495, 22, 2),
    ("cornell-box/cornell-box.pbrt", 32, 3, 0),
    ("veach-mis/veach-mis.pbrt", 12, 10, 0),
    ("cornell-box/cornell-box-environment-map.pbrt", 2, 4, 0),
    ("cornell-box/cornell-box-silver.pbrt", 32, 4, 0),
    ("cornell-box/cornell-box-specular-volume.pbrt", 22, 5, 1),
    ("cornell-box/cornell-box-specular.pbrt", 22, 5, 0),
    ("cornell-box/cornell-box-volume.pbrt", 32, 3, 1),
    ("cornell-box/smallpt.pbrt", 10, 5, 0),
    ("cornell-box/volumetric-caustic.pbrt", 12, 4, 1),
    ("veach-mis/veach-mis-colorized.pbrt", 12, 10, 0),
    ("volumetric-caustic/volumetric-caustic.pbrt", 14, 8, 1),
];

#[test]
fn scenes_by_others_load_as_counted() {
    let mut wrong = Vec::new();
    for &(name, triangles, materials, warnings) in EXPECTED {
        let loaded = load(&scene(name)).unwrap_or_else(|e| panic!("{}: {e}", e.place()));
        let summary = Summary::of(&loaded.scene);
        let counts = (
            summary.triangles_shown,
            loaded.scene.materials.len(),
            loaded.warnings.len(),
        );
        if counts != (triangles, materials, warnings) {
            wrong.push(format!("{name}: {counts:?}: {:#?}", loaded.warnings));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
