//! Directions that are sampled and rejected, as passes count them.

mod common;

use common::*;
use glam::DMat4;
use specula_bsdf::vndf::Sampler;
use specula_render::{PreparedScene, RenderOptions, Renderer, ScatterCounts, Strategy};
use specula_scene::scene::*;
use std::sync::atomic::AtomicBool;

/// Metal of alpha 1 seen along its normal under a constant sky, where each path samples once.
fn furnace() -> Scene {
    let mut scene = empty(look([0.0, 0.0, 3.0], [0.0; 3], 0.05), 32);
    let metal = material(&mut scene, mirror_metal(1.0));
    let floor = square(&mut scene, 50.0, DMat4::IDENTITY, metal);
    scene.shapes.push(floor);
    scene.lights.push(constant_sky(1.0));
    scene
}

fn scattered(scene: &Scene, options: &RenderOptions, passes: u32) -> ScatterCounts {
    let prepared = PreparedScene::new(scene, options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options.clone());
    (0..passes)
        .map(|_| renderer.render_pass(16, &AtomicBool::new(false)))
        .map(|report| report.scattered.expect("the processor counts"))
        .fold(ScatterCounts::default(), ScatterCounts::and)
}

/// Half of the spherical cap's reflections lie below the horizon, none of the bounded cap's and of the
/// exact sampler's; with [`Strategy::Balance`] the vertices are dealt with one by one.
#[test]
fn a_sampler_rejects_what_lies_below_the_horizon() {
    let scene = furnace();
    for strategy in [Strategy::Mis, Strategy::Balance] {
        for (vndf_sampler, expected) in [
            (Sampler::Heitz, 0.5),
            (Sampler::Cap, 0.5),
            (Sampler::Bounded, 0.0),
            (Sampler::Exact, 0.0),
        ] {
            let options = RenderOptions {
                max_depth: 1,
                vndf_sampler,
                strategy,
                ..RenderOptions::default()
            };
            let found = scattered(&scene, &options, 2);
            assert_eq!(found.sampled, 32 * 32 * 32);
            let n = found.sampled as f64;
            // The view is along the normal but for the camera's field of view.
            let slack = 4.5 * (expected * (1.0 - expected) / n).sqrt() + 2e-4;
            let share = found.rejected_share();
            assert!(
                (share - expected).abs() < slack,
                "{vndf_sampler}, {strategy:?}: {share}"
            );
        }
    }
}

/// Many bounces: in batches and one by one, counts agree within what chance and rounding do.
#[test]
fn batches_count_as_single_vertices_do() {
    let mut scene = furnace();
    scene.camera = look([0.0, 0.5, 3.0], [0.0; 3], 40.0);
    let metal = material(&mut scene, mirror_metal(0.6));
    let glass = material(&mut scene, glass(0.4));
    scene.shapes.push(sphere(0.5, [0.4, 0.0, 0.5], metal));
    scene.shapes.push(sphere(0.5, [-0.7, 0.0, 0.6], glass));
    let options = |strategy| RenderOptions {
        vndf_sampler: Sampler::Cap,
        strategy,
        ..RenderOptions::default()
    };
    let batches = scattered(&scene, &options(Strategy::Mis), 1);
    let single = scattered(&scene, &options(Strategy::Balance), 1);
    assert!(batches.rejected > 3000, "{batches:?}");
    let sampled = batches.sampled as f64 / single.sampled as f64;
    let rejected = batches.rejected as f64 / single.rejected as f64;
    assert!((sampled - 1.0).abs() < 0.02, "{batches:?}, {single:?}");
    assert!((rejected - 1.0).abs() < 0.05, "{batches:?}, {single:?}");
}

/// The counts are sums over tiles, whoever renders them, and over passes.
#[test]
fn counts_do_not_depend_on_threads_or_passes() {
    let scene = furnace();
    let options = RenderOptions {
        vndf_sampler: Sampler::Cap,
        ..RenderOptions::default()
    };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads start");
        pool.install(|| scattered(&scene, &options, 1))
    };
    assert_eq!(on(1), on(3));
    let two_passes = scattered(&scene, &options, 2);
    let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
    let report = Renderer::new(&prepared, options).render_pass(32, &AtomicBool::new(false));
    assert_eq!(report.scattered, Some(two_passes));
}
