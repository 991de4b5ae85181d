//! Scenes that people render, on the GPU beside the processor: the same samples, pixel by pixel.
//!
//! Those of `data/versus` that need no file made first, and some of `data/scenes`, which are by others.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]
#![allow(clippy::print_stdout, reason = "a suite says how much it checked")]

mod common;
#[path = "common/few.rs"]
mod few;

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use common::gpu;
use few::some;
use specula_gpu::{Gpu, Tracer, missing};
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer};

const SAMPLES: u32 = 2;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Share of the pixels that differ by more than a hundredth of themselves and of the mean, and the quotient
/// of means.
fn apart(a: &Picture, b: &Picture) -> [f64; 2] {
    let mean = |p: &Picture| {
        let sum: f64 = p.colour.iter().map(|c| f64::from(c.luminance())).sum();
        sum / p.colour.len() as f64
    };
    let scale = mean(a);
    assert!(scale > 0.0, "a black picture shows nothing");
    let differ = a.colour.iter().zip(&b.colour).filter(|(a, b)| {
        let difference = f64::from((**a - **b).map(f32::abs).max_channel());
        difference > 1e-2 * (scale + f64::from(a.max_channel()))
    });
    [
        differ.count() as f64 / a.colour.len() as f64,
        mean(b) / scale,
    ]
}

/// Renders a file both ways; `None`: the GPU says what it does not render.
fn compare(gpu: &Gpu, file: &Path) -> Option<[f64; 2]> {
    let scene = specula_scene::load(file).unwrap().scene;
    let [width, height] = scene.film.resolution;
    let most = width.max(height);
    let options = RenderOptions {
        resolution: Some([width, height].map(|n| (n * 48 / most).max(1))),
        crop: None,
        max_depth: scene.settings.max_depth.min(8),
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let unknown = missing(&prepared);
    if !unknown.is_empty() {
        println!("{}: {}", file.display(), unknown.join(", "));
        return None;
    }
    let go = AtomicBool::new(false);
    let mut processor = Renderer::new(&prepared, options.clone());
    processor.render_pass(SAMPLES, &go);
    let mut device = Renderer::new(&prepared, options.clone());
    let mut tracer = Tracer::new(gpu, &prepared, &options).unwrap_or_else(|e| panic!("{e}"));
    tracer.render_pass(&mut device, SAMPLES, &go).unwrap();
    let found = apart(&processor.film().picture(), &device.film().picture());
    println!("{}: {found:?}", file.display());
    Some(found)
}

/// * `most`: share of the pixels that may differ: paths that graze take another way by rounding.
fn check(gpu: &Gpu, file: &Path, most: f64) {
    let Some([differing, quotient]) = compare(gpu, file) else {
        return;
    };
    let name = file.display();
    assert!(differing <= most, "{name}: {differing} of the pixels");
    assert!((quotient - 1.0).abs() < 0.02, "{name}: {quotient}");
}

#[test]
fn scenes_of_the_comparison() {
    let Some(gpu) = gpu("scenes of the comparison") else {
        return;
    };
    for name in some(["glass-and-metal", "metal-room"], 1) {
        check(gpu, &root().join(format!("data/versus/{name}.xml")), 0.02);
    }
}

#[test]
fn real_scenes() {
    let Some(gpu) = gpu("real scenes") else {
        return;
    };
    let names = [
        "veach-mis/veach-mis.pbrt",
        "cornell-box/cornell-box.pbrt",
        "cornell-box/cornell-box-environment-map.pbrt",
        "gltf/boombox.glb",
    ];
    for name in some(names, 2) {
        check(gpu, &specula_testing::scene(name), 0.02);
    }
}
