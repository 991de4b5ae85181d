//! Metal that reflects everything, in even light: what is darker than the background has lost energy.

use glam::DVec3;
use specula_scene::{Energy, Scene};

use super::build;

/// Alphas of the balls, from left to right.
const ALPHAS: [f32; 6] = [0.1, 0.25, 0.4, 0.6, 0.8, 1.0];

pub(super) fn scene() -> Scene {
    let eye = DVec3::new(0.0, -30.0, 0.0);
    let mut scene = build::scene([960, 240], eye, DVec3::ZERO, 7.0);
    scene.settings.energy = Energy::None;
    for (i, alpha) in (0_u8..).zip(ALPHAS) {
        let metal = build::conductor("", alpha);
        let metal = build::material(&mut scene, &format!("white {alpha}"), metal);
        let x = 2.3 * (f64::from(i) - 2.5);
        build::ball(&mut scene, DVec3::new(x, 0.0, 0.0), metal);
    }
    build::surround(&mut scene, 0.5);
    scene
}
