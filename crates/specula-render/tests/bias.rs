//! Options that take noise away at the price of bias: what they change, by how much, and what they leave alone.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::DMat4;
use specula_render::picture::Picture;
use specula_render::{FilmBuffer, PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::*;

/// A floor, a ball of clear glass above it, and a small bright lamp, which only paths from the floor through
/// the glass hit: a caustic.
fn caustic() -> Scene {
    let mut scene = empty(look([0.0, -4.0, 3.0], [0.0, 0.0, 0.3], 45.0), 32);
    let floor = material(&mut scene, diffuse(0.5));
    let pane = material(&mut scene, glass(0.0));
    let ground = square(&mut scene, 4.0, DMat4::IDENTITY, floor);
    scene.shapes.push(ground);
    scene.shapes.push(sphere(0.6, [0.0, 0.0, 1.0], pane));
    scene
        .shapes
        .push(emitting(sphere(0.1, [0.0, 0.0, 4.0], floor), 400.0));
    scene
}

/// Surfaces of every kind that has alphas, none below 0.3.
fn rough() -> Scene {
    let mut scene = empty(look([0.0, -4.0, 2.0], [0.0; 3], 50.0), 40);
    let kinds = [
        mirror_metal(0.3),
        glass(0.4),
        MaterialKind::CoatedDiffuse {
            reflectance: grey(0.6),
            eta: 1.5,
            roughness: alpha(0.35),
            medium: CoatMedium::default(),
            lossless: false,
        },
        diffuse(0.6),
    ];
    let ids = kinds.map(|kind| material(&mut scene, kind));
    let ground = square(&mut scene, 10.0, DMat4::IDENTITY, ids[3]);
    scene.shapes.push(ground);
    for (x, id) in [-1.0, 0.0, 1.0].into_iter().zip(ids) {
        scene.shapes.push(sphere(0.45, [x, 0.0, 0.5], id));
    }
    scene
        .shapes
        .push(emitting(sphere(0.3, [0.0, 0.0, 3.0], ids[3]), 5.0));
    scene.lights.push(constant_sky(0.2));
    scene
}

fn options() -> RenderOptions {
    RenderOptions {
        max_depth: 6,
        ..RenderOptions::default()
    }
}

fn film(scene: &Scene, options: &RenderOptions, passes: &[u32]) -> FilmBuffer {
    let prepared = PreparedScene::new(scene, options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options.clone());
    for &samples in passes {
        let report = renderer.render_pass(samples, &AtomicBool::new(false));
        assert_eq!(report.invalid_samples, 0);
    }
    renderer.film().clone()
}

fn picture(scene: &Scene, options: &RenderOptions, samples: u32) -> Picture {
    film(scene, options, &[samples]).picture()
}

/// The mean of the variances of pixels.
fn variance(picture: &Picture) -> f64 {
    let sum: f64 = picture.variance.iter().map(|v| f64::from(v.g)).sum();
    sum / picture.variance.len() as f64
}

#[test]
fn bounds_that_nothing_reaches_change_nothing() {
    for scene in [caustic(), rough()] {
        for share_paths in [1, 4] {
            let plain = RenderOptions {
                share_paths,
                ..options()
            };
            let clamped = RenderOptions {
                clamp: Some(f32::MAX),
                ..plain.clone()
            };
            let [a, b] = [&plain, &clamped].map(|o| film(&scene, o, &[4]));
            assert!(a == b, "{share_paths}");
        }
    }
}

/// Sample by sample: never more than without, and no more above direct light than every vertex may contribute.
#[test]
fn clamped_samples_are_bounded() {
    const MOST: f32 = 0.05;
    let scene = caustic();
    let mut darker = 0;
    for share_paths in [1, 4] {
        for seed in 0..8 {
            let plain = RenderOptions {
                seed,
                share_paths,
                ..options()
            };
            let clamped = RenderOptions {
                clamp: Some(MOST),
                ..plain.clone()
            };
            // The same random numbers: light of the first surfaces is the same.
            let direct = RenderOptions {
                max_depth: 1,
                share_paths: 1,
                ..plain.clone()
            };
            let [plain, clamped, direct] =
                [&plain, &clamped, &direct].map(|o| picture(&scene, o, 1).colour);
            let vertices = 2.0 * 6.0;
            for ((p, c), d) in plain.iter().zip(&clamped).zip(&direct) {
                assert!(c.g <= p.g * 1.0001, "{c:?} {p:?}");
                assert!(c.g <= d.g + vertices * MOST + 1e-3, "{c:?} {d:?}");
                darker += u32::from(c.g < 0.99 * p.g);
            }
        }
    }
    assert!(darker > 20, "{darker}");
}

/// What it takes, and what that costs: the caustic is most of the noise and little of the light.
#[test]
fn clamping_takes_variance_and_light() {
    let scene = caustic();
    let plain = picture(&scene, &options(), 1024);
    let clamped = RenderOptions {
        clamp: Some(2.0),
        ..options()
    };
    let clamped = picture(&scene, &clamped, 1024);
    let ratio = variance(&clamped) / variance(&plain);
    let ((m, e), (n, f)) = (mean(&plain), mean(&clamped));
    let bias = n / m - 1.0;
    println!(
        "variance {ratio:.4}, bias {bias:.4} +- {:.4}",
        e.hypot(f) / m
    );
    assert!(ratio < 0.05, "{ratio}");
    assert!((-0.5..-0.005).contains(&bias), "{bias}");
    // Nowhere brighter than noise.
    for ((p, c), (v, w)) in
        (plain.colour.iter().zip(&clamped.colour)).zip(plain.variance.iter().zip(&clamped.variance))
    {
        let error = (v.g + w.g).sqrt();
        assert!(c.g <= p.g + 5.0 * error + 1e-4, "{c:?} {p:?} {error}");
    }
}

#[test]
fn rough_scenes_are_not_regularized() {
    let scene = rough();
    for share_paths in [1, 4] {
        let plain = RenderOptions {
            share_paths,
            ..options()
        };
        let regularized = RenderOptions {
            regularize: true,
            ..plain.clone()
        };
        let [a, b] = [&plain, &regularized].map(|o| film(&scene, o, &[8]));
        assert!(a == b, "{share_paths}");
    }
    // The test can fail.
    let mut smooth = scene;
    smooth.materials[0].kind = mirror_metal(0.2);
    let regularized = RenderOptions {
        regularize: true,
        ..options()
    };
    let [a, b] = [&options(), &regularized].map(|o| film(&smooth, o, &[8]));
    assert!(a != b);
}

/// What cameras see directly, or through mirrors and glass only, stays sharp.
#[test]
fn what_is_seen_through_glass_is_not_regularized() {
    let mut scene = caustic();
    scene.shapes.remove(0);
    let regularized = RenderOptions {
        regularize: true,
        ..options()
    };
    let [a, b] = [&options(), &regularized].map(|o| film(&scene, o, &[8]));
    assert!(a == b);
}

/// Lights are sampled through glass that is rough: much less noise; the light is nearly the same, spread.
#[test]
fn regularizing_takes_the_noise_of_caustics() {
    let scene = caustic();
    let plain = picture(&scene, &options(), 4096);
    let regularized = RenderOptions {
        regularize: true,
        ..options()
    };
    let regularized = picture(&scene, &regularized, 1024);
    let ratio = 0.25 * variance(&regularized) / variance(&plain);
    let ((m, e), (n, f)) = (mean(&plain), mean(&regularized));
    let bias = n / m - 1.0;
    println!(
        "variance {ratio:.4}, bias {bias:.4} +- {:.4}",
        e.hypot(f) / m
    );
    assert!(ratio < 0.1, "{ratio}");
    assert!(bias.abs() < 0.1, "{bias}");
}

#[test]
fn biased_renders_are_deterministic() {
    let mut scene = rough();
    scene.materials[0].kind = mirror_metal(0.05);
    scene.materials[1].kind = glass(0.0);
    let mixed = MaterialKind::Mix {
        materials: [MaterialId(0), MaterialId(1)],
        amount: FloatParam::Value(0.5),
    };
    let mixed = material(&mut scene, mixed);
    scene.shapes.push(sphere(0.3, [0.0, -1.0, 0.3], mixed));
    for share_paths in [1, 4] {
        let options = RenderOptions {
            clamp: Some(1.0),
            regularize: true,
            share_paths,
            ..options()
        };
        let run = |threads: usize, passes: &[u32]| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("threads are to be had");
            pool.install(|| film(&scene, &options, passes))
        };
        let whole = run(1, &[8]);
        for (threads, passes) in [(2, &[8][..]), (3, &[1, 2, 5])] {
            assert!(run(threads, passes) == whole, "{threads} {passes:?}");
        }
    }
}

#[test]
fn settings_name_bias() {
    let plain = options();
    assert_eq!(plain.bias(), None);
    let biased = RenderOptions {
        clamp: Some(10.0),
        regularize: true,
        ..options()
    };
    let bias = "indirect light clamped to 10, regularized";
    assert_eq!(biased.bias().as_deref(), Some(bias));
    let [settings, other] = [&plain, &biased].map(RenderOptions::settings);
    assert_eq!(other, format!("{settings}, biased: {bias}"));
    let label = |settings: String| specula_render::Label {
        settings,
        ..specula_render::Label::default()
    };
    let [a, b] = [settings, other].map(label);
    assert!(a.difference(&b).is_some());
    assert_eq!((a.bias(), b.bias()), (None, Some(bias)));
}
