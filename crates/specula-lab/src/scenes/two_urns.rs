//! Two urns on a table: one of rough metal, one of rough glass.
//!
//! In the place of the picture of Dupuy and Benyoub 2023, fig. 1.

use glam::{DVec3, dvec3};
use specula_scene::Scene;

use super::builder::Builder;

/// Alpha of the metal.
pub(crate) const METAL_ALPHA: f32 = 0.4;
/// Alpha of the glass.
pub(crate) const GLASS_ALPHA: f32 = 0.25;

/// The scene, 16:9.
#[must_use]
pub(crate) fn two_urns() -> Scene {
    let mut scene = Builder::new(
        [512, 288],
        dvec3(0.0, -4.2, 1.75),
        dvec3(0.0, 0.0, 0.62),
        26.0,
    );
    let cloth = scene.diffuse("table", [0.34, 0.32, 0.30]);
    let wall = scene.diffuse("wall", [0.30, 0.38, 0.45]);
    let stripe = scene.diffuse("stripe", [0.70, 0.55, 0.28]);
    scene.quad(
        dvec3(-4.0, -3.0, 0.0),
        DVec3::X * 8.0,
        DVec3::Y * 5.0,
        cloth,
    );
    scene.quad(dvec3(-4.0, 2.0, 0.0), DVec3::X * 8.0, DVec3::Z * 4.0, wall);
    for i in 0..5_u32 {
        let x = -1.75 + 0.8 * f64::from(i);
        scene.cuboid(dvec3(x, 1.96, 0.0), dvec3(x + 0.28, 2.0, 4.0), stripe);
    }
    let black = scene.diffuse("lamp", [0.0; 3]);
    scene.quad(
        dvec3(-3.6, -2.6, 2.2),
        dvec3(0.0, 4.0, 0.0),
        dvec3(3.2, 0.0, 1.9),
        black,
    );
    scene.glow([2.6, 2.45, 2.2]);
    scene.quad(dvec3(2.9, -2.4, 0.2), DVec3::Z * 2.6, DVec3::Y * 4.0, black);
    scene.glow([0.9, 1.05, 1.25]);
    let urn = [
        [0.001, 0.0],
        [0.26, 0.005],
        [0.27, 0.04],
        [0.12, 0.12],
        [0.12, 0.16],
        [0.34, 0.36],
        [0.44, 0.58],
        [0.42, 0.76],
        [0.26, 0.92],
        [0.2, 1.02],
        [0.3, 1.12],
        [0.28, 1.14],
        [0.001, 1.16],
    ];
    let profile = smooth(&urn);
    let gold = scene.metal("Au", METAL_ALPHA);
    scene.lathe(dvec3(-0.62, 0.0, 0.0), &profile, gold);
    let glass = scene.glass("glass", GLASS_ALPHA);
    scene.lathe(dvec3(0.62, 0.0, 0.0005), &profile, glass);
    scene.finish()
}

/// A curve through the points (Catmull and Rom 1974), five to a part.
fn smooth(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const PARTS: u32 = 5;
    let last = points.len() - 1;
    let at = |i: usize| points[i.min(last)];
    let mut curve = Vec::new();
    for i in 0..last {
        let around = [at(i.saturating_sub(1)), at(i), at(i + 1), at(i + 2)];
        for part in 0..PARTS {
            let t = f64::from(part) / f64::from(PARTS);
            curve.push([0, 1].map(|axis| {
                let [a, b, c, d] = around.map(|p| p[axis]);
                let cubic = (c - a) * t
                    + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
                    + (3.0 * (b - c) + d - a) * t * t * t;
                let value = b + 0.5 * cubic;
                if axis == 0 { value.max(0.001) } else { value }
            }));
        }
    }
    curve.push(points[last]);
    curve
}
