//! Path sharing gives the same picture, with less noise, however the work is cut.

mod common;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use common::*;
use glam::DMat4;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::*;

fn options(share_paths: u32, seed: u32) -> RenderOptions {
    RenderOptions {
        share_paths,
        seed,
        max_depth: 8,
        resolution: Some([48, 48]),
        ..RenderOptions::default()
    }
}

fn render_passes(scene: &Scene, options: &RenderOptions, passes: &[u32]) -> Picture {
    let prepared = PreparedScene::new(scene, options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options.clone());
    let go = AtomicBool::new(false);
    for &samples in passes {
        assert_eq!(renderer.render_pass(samples, &go).invalid_samples, 0);
    }
    renderer.film().picture()
}

/// Of a file in `data/versus`.
fn versus(name: &str) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../data/versus")
        .join(name);
    specula_scene::load(&file).expect("it is specula").scene
}

/// Rough and smooth glass, brushed metal, coloured walls without some channels, a lamp and a sky.
fn mixture() -> Scene {
    let mut scene = empty(look([0.0, 1.5, -5.0], [0.0, 0.8, 0.0], 45.0), 48);
    let red = MaterialKind::Diffuse {
        reflectance: ColourParam::Value(specula_bsdf::math::rgb(0.8, 0.0, 0.1)),
        roughness: FloatParam::Value(0.0),
    };
    let red = material(&mut scene, red);
    let pale = material(&mut scene, diffuse(0.7));
    let metal = material(&mut scene, mirror_metal(0.25));
    let smooth = material(&mut scene, glass(0.0));
    let rough = material(&mut scene, glass(0.3));
    let floor = square(
        &mut scene,
        8.0,
        DMat4::from_rotation_x(-core::f64::consts::FRAC_PI_2),
        pale,
    );
    scene.shapes.push(floor);
    let wall = DMat4::from_translation(glam::DVec3::new(0.0, 0.0, 2.5));
    let wall = square(&mut scene, 8.0, wall, red);
    scene.shapes.push(wall);
    scene.shapes.push(sphere(0.7, [-1.6, 0.7, 0.4], metal));
    scene.shapes.push(sphere(0.6, [0.0, 0.6, -0.6], smooth));
    scene.shapes.push(sphere(0.7, [1.5, 0.7, 0.3], rough));
    scene
        .shapes
        .push(emitting(sphere(0.4, [0.5, 3.5, -1.0], pale), 6.0));
    scene.lights.push(constant_sky(0.3));
    scene
}

/// Means of squares of 8 x 8 pixels.
fn squares(picture: &Picture) -> Vec<f64> {
    let (width, height) = (picture.width, picture.height);
    let mut sums = vec![0.0; ((width / 8) * (height / 8)) as usize];
    for (i, pixel) in (0..).zip(&picture.colour) {
        let (x, y) = (i % width, i / width);
        sums[((y / 8) * (width / 8) + x / 8) as usize] += f64::from(pixel.mean()) / 64.0;
    }
    sums
}

/// Mean and squared error of the mean of each square over renders of different seeds.
fn means(scene: &Scene, share_paths: u32, samples: u32) -> Vec<[f64; 2]> {
    const SEEDS: u32 = 12;
    let renders: Vec<Vec<f64>> = (0..SEEDS)
        .map(|seed| {
            let options = options(share_paths, seed + 100 * share_paths);
            squares(&render_passes(scene, &options, &[samples]))
        })
        .collect();
    (0..renders[0].len())
        .map(|k| {
            let n = f64::from(SEEDS);
            let mean = renders.iter().map(|r| r[k]).sum::<f64>() / n;
            let spread = renders.iter().map(|r| (r[k] - mean).powi(2)).sum::<f64>();
            [mean, spread / (n * (n - 1.0))]
        })
        .collect()
}

/// Largest `|z|` of the squares, and the difference of the whole in units of its error.
fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> [f64; 2] {
    let mut largest = 0.0_f64;
    let (mut difference, mut variance) = (0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let v = a[1] + b[1];
        largest = largest.max((a[0] - b[0]).abs() / v.sqrt().max(1e-6));
        difference += a[0] - b[0];
        variance += v;
    }
    [largest, difference.abs() / variance.sqrt()]
}

/// A picture that is 3 % darker is noticed.
#[test]
fn sharing_keeps_the_picture() {
    let darker = |mut scene: Scene| {
        scene.film.exposure *= 0.97;
        scene
    };
    for (name, scene) in [
        ("metal-room", versus("metal-room.xml")),
        ("glass-and-metal", versus("glass-and-metal.xml")),
        ("mixture", mixture()),
    ] {
        let alone = means(&scene, 1, 64);
        for share_paths in [3, 16] {
            let shared = means(&scene, share_paths, 64);
            let [largest, whole] = apart(&alone, &shared);
            assert!(largest < 5.5, "{name}, {share_paths}: a square {largest}");
            assert!(whole < 4.0, "{name}, {share_paths}: the whole {whole}");
        }
        let [_, whole] = apart(&alone, &means(&darker(scene), 16, 64));
        assert!(whole > 6.0, "{name}: darker {whole}");
    }
}

/// Squared error, from the differences of renders of two seeds.
fn squared_error(scene: &Scene, share_paths: u32) -> f64 {
    let mut sum = 0.0;
    for seed in 0..3 {
        let pictures = [0, 1].map(|k| {
            let options = RenderOptions {
                resolution: Some([128, 128]),
                ..options(share_paths, 2 * seed + k)
            };
            render_passes(scene, &options, &[4])
        });
        let pixels = pictures[0].colour.iter().zip(&pictures[1].colour);
        let squares = pixels.map(|(a, b)| f64::from((a.mean() - b.mean()).powi(2)));
        sum += squares.sum::<f64>() / 2.0;
    }
    sum
}

/// By more than it costs.
#[test]
fn sharing_takes_noise_from_rooms_of_rough_metal() {
    let scene = versus("metal-room.xml");
    let alone = squared_error(&scene, 1);
    let shared = [4, 16].map(|n| squared_error(&scene, n) / alone);
    assert!(shared[0] < 0.7 && shared[1] < 0.5, "{shared:?}");
}

#[test]
fn threads_and_passes_do_not_change_what_is_shared() {
    let scene = mixture();
    let run = |threads: usize, passes: &[u32]| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads are to be had");
        pool.install(|| render_passes(&scene, &options(5, 0), passes))
    };
    let whole = run(1, &[8]);
    assert_eq!(run(2, &[8]), whole);
    assert_eq!(run(2, &[1, 2, 5]), whole);
    let alone = render_passes(&scene, &options(1, 0), &[8]);
    assert_ne!(alone.colour, whole.colour);
    // What a checkpoint goes by.
    assert_ne!(options(1, 0).settings(), options(5, 0).settings());
}
