//! Treatments of multiple scattering in whole renders: metal that absorbs nothing vanishes in a
//! uniform sky with every one of them, and darkens without.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use specula_bsdf::{energy, multibounce};
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::Energy;
use specula_scene::scene::*;

/// A ball of metal that fills the picture, in a sky of radiance 1.
fn furnace(alpha_x: f32, alpha_y: f32) -> Scene {
    let mut scene = empty(look([0.0, 0.0, -3.0], [0.0, 0.0, 0.0], 20.0), 16);
    let mut kind = mirror_metal(alpha_x);
    if let MaterialKind::Conductor { roughness, .. } = &mut kind {
        roughness.v = FloatParam::Value(alpha_y);
    }
    let metal = material(&mut scene, kind);
    scene.shapes = vec![sphere(1.0, [0.0; 3], metal)];
    scene.lights = vec![constant_sky(1.0)];
    scene
}

fn with_energy(scene: &Scene, energy: Energy, spp: u32) -> Picture {
    let options = RenderOptions {
        samples_per_pixel: spp,
        energy,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(spp, &AtomicBool::new(false));
    assert_eq!(report.invalid_samples, 0, "{energy}");
    renderer.film().picture()
}

fn treatments() -> Vec<Energy> {
    let compensations = ["turquin", "turquin-series", "kulla-conty"];
    compensations
        .iter()
        .map(|name| Energy::Compensated(name.parse::<energy::EnergyModel>().expect("a known name")))
        .chain(multibounce::MultibounceModel::ALL.map(Energy::Multibounce))
        .collect()
}

/// Wang's model is not energy preserving; the others are.
fn keeps_all_light(treatment: Energy) -> bool {
    !matches!(treatment, Energy::Multibounce(model) if !model.is_unbiased())
}

#[test]
fn metal_without_absorption_vanishes_in_a_uniform_sky() {
    for (alpha_x, alpha_y) in [(0.2, 0.2), (1.0, 1.0), (0.2, 0.8)] {
        let scene = furnace(alpha_x, alpha_y);
        for treatment in treatments().into_iter().filter(|t| keeps_all_light(*t)) {
            let what = format!("alpha ({alpha_x}, {alpha_y}), {treatment}");
            // The metal is not quite without absorption: 4e-5 per bounce.
            assert_mean(&what, &with_energy(&scene, treatment, 256), 1.0, 3e-3);
        }
    }
}

#[test]
fn without_treatment_rough_metal_darkens() {
    let (mean, error) = mean(&with_energy(&furnace(1.0, 1.0), Energy::None, 64));
    assert!(mean < 0.6 && error < 0.01, "{mean} +- {error}");
}

#[test]
fn a_material_can_choose_for_itself() {
    let mut scene = furnace(1.0, 1.0);
    scene.materials[0].energy = Some("kulla-conty".parse().expect("a known name"));
    assert_mean(
        "own choice",
        &with_energy(&scene, Energy::None, 256),
        1.0,
        3e-3,
    );
}

#[test]
fn rough_glass_keeps_its_light() {
    let mut scene = furnace(0.5, 0.5);
    scene.materials[0].kind = glass(0.5);
    for name in ["kulla-conty", "multibounce=heitz", "multibounce"] {
        let treatment = name.parse().expect("a known name");
        let options = RenderOptions {
            samples_per_pixel: 256,
            max_depth: 64,
            energy: treatment,
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
        let mut renderer = Renderer::new(&prepared, options);
        renderer.render_pass(256, &AtomicBool::new(false));
        assert_mean(name, &renderer.film().picture(), 1.0, 5e-3);
    }
}
