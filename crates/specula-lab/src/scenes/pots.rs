//! Three pots of aluminium on a dark floor in the studio's light.

use glam::dvec3;
use specula_scene::Scene;

use super::builder::Builder;
use super::lighting::Lighting;

/// Alphas of the pots, from left to right.
pub(crate) const ALPHAS: [f32; 3] = [0.15, 0.2, 0.1];

/// The scene.
pub(crate) fn pots(resolution: [u32; 2]) -> Scene {
    let target = dvec3(0.0, 0.0, 0.5);
    let mut build = Builder::new(resolution, dvec3(0.0, -6.6, 3.2), target, 17.0);
    let floor = build.diffuse("floor", [0.03; 3]);
    build.quad(
        dvec3(-30.0, -30.0, 0.0),
        dvec3(60.0, 0.0, 0.0),
        dvec3(0.0, 60.0, 0.0),
        floor,
    );
    for (i, alpha) in ALPHAS.into_iter().enumerate() {
        let metal = build.metal("Al", alpha);
        let x = 1.5 * (i as f64 - 1.0);
        build.lathe(dvec3(x, 0.0, 0.0), &POT, metal);
        build.lathe(dvec3(x, 0.0, 0.0), &LID, metal);
    }
    let mut scene = build.finish();
    Lighting::Studio(1.0).add_to(&mut scene);
    scene
}

/// `(distance from the axis, height)`: a body with a rim.
const POT: [[f64; 2]; 12] = [
    [0.001, 0.0],
    [0.42, 0.0],
    [0.5, 0.03],
    [0.58, 0.12],
    [0.62, 0.25],
    [0.63, 0.4],
    [0.62, 0.55],
    [0.6, 0.68],
    [0.6, 0.72],
    [0.65, 0.74],
    [0.65, 0.77],
    [0.6, 0.78],
];
/// A lid with a knob.
const LID: [[f64; 2]; 13] = [
    [0.6, 0.78],
    [0.52, 0.83],
    [0.4, 0.88],
    [0.25, 0.92],
    [0.1, 0.94],
    [0.06, 0.96],
    [0.05, 1.0],
    [0.07, 1.03],
    [0.11, 1.06],
    [0.12, 1.1],
    [0.1, 1.14],
    [0.05, 1.17],
    [0.001, 1.18],
];

#[cfg(test)]
mod tests {
    #[test]
    fn it_is_valid() {
        super::pots([32, 16]).validate().unwrap();
    }
}
