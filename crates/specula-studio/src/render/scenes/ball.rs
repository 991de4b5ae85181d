//! One ball on a floor under two lamps: what a material looks like.

use glam::DVec3;
use specula_bsdf::math::rgb;
use specula_scene::Scene;

use super::build;

pub(super) fn scene() -> Scene {
    let eye = DVec3::new(0.0, -6.0, 2.6);
    let target = DVec3::new(0.0, 0.0, 0.95);
    let mut scene = build::scene([512, 512], eye, target, 28.0);
    let gold = build::material(&mut scene, "ball", build::conductor("Au", 0.2));
    let floor = build::material(&mut scene, "floor", build::diffuse(0.35));
    let lamp = build::material(&mut scene, "lamp", build::diffuse(0.0));
    build::ball(&mut scene, DVec3::new(0.0, 0.0, 1.0), gold);
    build::floor(&mut scene, floor);
    let middle = DVec3::new(0.0, 0.0, 1.0);
    let key = [DVec3::new(-4.0, -4.0, 5.5), middle];
    build::lamp(&mut scene, lamp, key, [1.6, 1.1], rgb(11.0, 10.4, 9.6));
    let rim = [DVec3::new(3.5, 3.0, 4.0), middle];
    build::lamp(&mut scene, lamp, rim, [0.4, 1.6], rgb(9.0, 10.0, 12.0));
    build::surround(&mut scene, 0.12);
    scene
}
