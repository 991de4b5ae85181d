//! Scenes of the tests.

use std::fmt::Write as _;

use specula_render::{PreparedScene, RenderOptions};
use specula_scene::Scene;

/// A scene, ready for rays.
pub(crate) fn prepared(text: &str) -> PreparedScene {
    let scene = loaded(text);
    PreparedScene::new(&scene, &RenderOptions::from_scene(&scene)).unwrap()
}

/// A scene of a pbrt-v4 file with this text after its camera.
pub(crate) fn loaded(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    std::fs::write(&file, format!("Camera \"perspective\"\nWorldBegin\n{text}")).unwrap();
    specula_scene::load(&file).unwrap().scene
}

/// A bumpy ball of triangles, closed, with corners 0.6 to 1.4 from the middle.
fn ball(rows: u32) -> String {
    let columns = 2 * rows;
    let mut points = String::from("0 0 1.2  0 0 -1.1");
    for row in 1..rows {
        for column in 0..columns {
            let theta = f64::from(row) / f64::from(rows) * std::f64::consts::PI;
            let phi = f64::from(column) / f64::from(columns) * std::f64::consts::TAU;
            let r = 1.0 + 0.4 * (7.0 * theta).sin() * (5.0 * phi).cos();
            let (x, y) = (phi.cos() * theta.sin(), phi.sin() * theta.sin());
            let _ = write!(points, "  {} {} {}", r * x, r * y, r * theta.cos());
        }
    }
    let at = |row: u32, column: u32| 2 + (row - 1) * columns + column % columns;
    let mut triangles = String::new();
    for column in 0..columns {
        let (a, b) = (at(1, column), at(1, column + 1));
        let (c, d) = (at(rows - 1, column), at(rows - 1, column + 1));
        let _ = write!(triangles, " 0 {a} {b} 1 {d} {c}");
        for row in 1..rows - 1 {
            let (a, b) = (at(row, column), at(row, column + 1));
            let (c, d) = (at(row + 1, column), at(row + 1, column + 1));
            let _ = write!(triangles, " {a} {c} {b} {b} {c} {d}");
        }
    }
    format!("Shape \"trianglemesh\" \"point3 P\" [{points}] \"integer indices\" [{triangles}]\n")
}

/// The ball in the world, or placed as an instance.
pub(crate) fn closed(placed: &str) -> String {
    if placed.is_empty() {
        return ball(24);
    }
    let ball = ball(24);
    format!("ObjectBegin \"ball\"\n{ball}ObjectEnd\n{placed}ObjectInstance \"ball\"\n")
}

/// Triangles with and without area, spheres and disks, in the world and in instances.
///
/// * `unit`: by which all is scaled, objects where they are placed.
pub(crate) fn instances(unit: f64) -> String {
    let ball = ball(10);
    format!(
        "
ObjectBegin \"mesh\"
{ball}ObjectEnd
ObjectBegin \"both\"
Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  1 -1 0.3  0 1 0  0.2 0.3 1.4]
    \"integer indices\" [0 1 2 1 3 2]
Shape \"sphere\" \"float radius\" 0.5
AttributeBegin Translate 0 0 1 Shape \"disk\" \"float radius\" 0.6 \"float height\" 0.2 AttributeEnd
ObjectEnd
ObjectBegin \"round\"
Shape \"sphere\" \"float radius\" 0.7
ObjectEnd
Scale {unit} {unit} {unit}
Shape \"trianglemesh\" \"point3 P\" [-6 -6 -2  6 -6 -2  6 6 -2  -6 6 -2]
    \"integer indices\" [0 1 2 0 1 1 0 2 3]
AttributeBegin Translate 3 3 0 Scale 1 1.5 0.7 Shape \"sphere\" \"float radius\" 0.8 AttributeEnd
AttributeBegin Translate -3 3 0 Rotate 40 1 1 0 Shape \"disk\" \"float radius\" 1.5 AttributeEnd
AttributeBegin Translate 2 -2 0.5 Rotate 50 1 2 3 ObjectInstance \"mesh\" AttributeEnd
AttributeBegin Translate -3 -3 0 Scale -0.7 1.1 0.6 ObjectInstance \"mesh\" AttributeEnd
AttributeBegin Translate 0 0 2 Rotate 200 3 1 2 Scale 1 -1 1 ObjectInstance \"both\" AttributeEnd
AttributeBegin Translate 0 4 1 Scale 1.6 0.5 0.9 ObjectInstance \"both\" AttributeEnd
AttributeBegin Translate -4 0 1 Rotate 70 0 1 1 Scale 0.4 1 2 ObjectInstance \"round\" AttributeEnd
"
    )
}
