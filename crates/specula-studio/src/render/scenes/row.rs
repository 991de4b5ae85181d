//! A row of balls, from smooth to rough: what roughness does.

use glam::DVec3;
use specula_bsdf::math::rgb;
use specula_scene::Scene;

use super::build;

/// Alphas of the balls, from left to right.
const ALPHAS: [f32; 6] = [0.01, 0.1, 0.25, 0.5, 0.75, 1.0];

pub(super) fn scene() -> Scene {
    let eye = DVec3::new(0.0, -15.0, 5.0);
    let target = DVec3::new(0.0, 0.0, 0.9);
    let mut scene = build::scene([960, 320], eye, target, 15.5);
    let floor = build::material(&mut scene, "floor", build::diffuse(0.25));
    let lamp = build::material(&mut scene, "lamp", build::diffuse(0.0));
    for (i, alpha) in (0_u8..).zip(ALPHAS) {
        let metal = build::conductor("Au", alpha);
        let metal = build::material(&mut scene, &format!("Au {alpha}"), metal);
        let x = 2.3 * (f64::from(i) - 2.5);
        build::ball(&mut scene, DVec3::new(x, 0.0, 1.0), metal);
    }
    build::floor(&mut scene, floor);
    let middle = DVec3::new(0.0, 0.0, 1.0);
    let key = [DVec3::new(-5.0, -7.0, 8.0), middle];
    build::lamp(&mut scene, lamp, key, [3.5, 1.4], rgb(10.0, 9.6, 9.0));
    let rim = [DVec3::new(2.0, 6.0, 6.0), middle];
    build::lamp(&mut scene, lamp, rim, [6.0, 0.4], rgb(8.0, 8.6, 9.6));
    build::surround(&mut scene, 0.15);
    scene
}
