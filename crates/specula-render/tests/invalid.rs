//! Samples that are not finite: counted, named, and never in a picture.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use specula_bsdf::Rgb;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::*;

/// A floor under 64 lights as strong as `f32` allows, of which one stands for all.
#[test]
fn overflowing_samples_are_counted_and_named() {
    let mut scene = lit_floor();
    scene.materials[0].name = Some("floor".to_owned());
    for i in 0..64 {
        scene.lights.push(Light::Point {
            position: [0.0, 0.01 * f64::from(i), 1.0],
            intensity: Rgb::splat(2e37),
        });
    }
    let options = RenderOptions::default();
    let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(64, &AtomicBool::new(false));
    assert!(report.invalid_samples > 0, "nothing overflows");
    let one = report.invalid.expect("one is named");
    assert!(
        one.sample < 64 && one.pixel.iter().all(|&p| p < 8),
        "{one:?}"
    );
    let name = prepared.material_name(one.material.expect("at a surface"));
    assert_eq!(name, Some("floor"));
    let picture = renderer.film().picture();
    assert!(picture.colour.iter().all(|c: &Rgb<f32>| c.is_finite()));
}

/// In an ordinary scene there are none.
#[test]
fn ordinary_samples_are_finite() {
    let mut scene = lit_floor();
    scene.lights.push(constant_sky(1.0));
    let options = RenderOptions::default();
    let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
    let report = Renderer::new(&prepared, options).render_pass(16, &AtomicBool::new(false));
    assert_eq!((report.invalid_samples, report.invalid), (0, None));
}
