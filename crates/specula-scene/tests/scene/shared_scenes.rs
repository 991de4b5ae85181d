//! Scenes by others, where their folder lies beside the project.

use std::path::{Path, PathBuf};
use std::time::Instant;

use specula_scene::{Summary, load};

/// File, triangles shown, materials, warnings.
const EXPECTED: &[(&str, u64, usize, usize)] = &[
    ("bmw-m6/bmw-m6.pbrt", 792_582, 28, 2),
    ("material-testball/material-testball.pbrt", 80_642, 4, 1),
    ("staircase2/staircase2.pbrt", 28_495, 22, 2),
    ("cornell-box/cornell-box.pbrt", 32, 3, 0),
    ("veach-mis/veach-mis.pbrt", 12, 10, 0),
    (
        "material-testball/material-testball-sequence.pbrt",
        1_209_602,
        23,
        1,
    ),
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
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes");
    let mut skipped = 0;
    let mut wrong = Vec::new();
    for &(name, triangles, materials, warnings) in EXPECTED {
        let path: PathBuf = folder.join(name);
        if !path.exists() {
            skipped += 1;
            continue;
        }
        let start = Instant::now();
        let loaded = load(&path).unwrap_or_else(|e| panic!("{}: {e}", e.place()));
        let summary = Summary::of(&loaded.scene);
        let found = (
            summary.triangles_shown,
            loaded.scene.materials.len(),
            loaded.warnings.len(),
        );
        println!("{name}: {found:?}, {:.2} s", start.elapsed().as_secs_f64());
        if found != (triangles, materials, warnings) {
            wrong.push(format!("{name}: found {found:?}: {:#?}", loaded.warnings));
        }
    }
    println!(
        "{skipped} of {} scenes skipped (those that ../shared/scenes lacks)",
        EXPECTED.len()
    );
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
