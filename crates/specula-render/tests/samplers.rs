//! The samplers of rough metal against each other in whole renders: equal means, and the variance
//! that the bounded cap saves.

mod common;

use common::*;
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::scene::*;
use std::sync::atomic::AtomicBool;

/// A ball of rough metal in a hall of rough metal, under a lamp.
fn metal_hall(alpha_x: f32, alpha_y: f32) -> Scene {
    let mut scene = empty(look([0.0, 0.0, -3.5], [0.0, 0.0, 0.0], 50.0), 32);
    let roughness = Roughness {
        u: FloatParam::Value(alpha_x),
        v: FloatParam::Value(alpha_y),
        ..alpha(alpha_x)
    };
    let metal = material(
        &mut scene,
        MaterialKind::Conductor {
            fresnel: ConductorFresnel::Index {
                eta: grey(0.2),
                k: grey(4.0),
            },
            roughness,
            tint: ColourParam::WHITE,
        },
    );
    scene.shapes = vec![
        sphere(1.0, [0.0, 0.0, 0.0], metal),
        Shape {
            reverse_orientation: true,
            ..sphere(5.0, [0.0, 0.0, 0.0], metal)
        },
        emitting(sphere(0.8, [1.5, 2.5, -2.0], metal), 10.0),
    ];
    scene.settings.max_depth = 6;
    scene
}

fn picture(scene: &Scene, sampler: Sampler, spp: u32) -> Picture {
    let options = RenderOptions {
        samples_per_pixel: spp,
        max_depth: scene.settings.max_depth,
        vndf_sampler: sampler,
        // Another seed per sampler: the comparison needs independent pictures.
        seed: 1 + sampler as u32,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(spp, &AtomicBool::new(false));
    assert_eq!(report.invalid_samples, 0);
    renderer.film().picture()
}

/// Sums of the green means and of their variances over each 8x8 tile.
fn tiles(picture: &Picture) -> Vec<(f64, f64)> {
    let width = picture.width as usize;
    let mut tiles = vec![(0.0, 0.0); (width / 8) * (picture.height as usize / 8)];
    for (i, (c, v)) in picture.colour.iter().zip(&picture.variance).enumerate() {
        let tile = &mut tiles[(i / width / 8) * (width / 8) + i % width / 8];
        tile.0 += f64::from(c.g);
        tile.1 += f64::from(v.g);
    }
    tiles
}

/// Largest standard score of the difference of two pictures' tiles.
fn largest_score(a: &Picture, b: &Picture) -> f64 {
    tiles(a)
        .iter()
        .zip(tiles(b))
        .map(|(a, b)| (a.0 - b.0).abs() / (a.1 + b.1).sqrt())
        .fold(0.0, f64::max)
}

#[test]
fn samplers_agree_and_reject_less_for_less_variance() {
    // Largest ratio of variances, bounded over cap, that counts as less.
    for (alpha_x, alpha_y, most) in [(0.8, 0.8, 0.95), (0.6, 1.0, 0.97)] {
        let scene = metal_hall(alpha_x, alpha_y);
        let [heitz, cap, bounded, exact] = [
            Sampler::Heitz,
            Sampler::Cap,
            Sampler::Bounded,
            Sampler::Exact,
        ]
        .map(|sampler| picture(&scene, sampler, 256));
        // 16 tiles, three pairs of pictures, three channels' worth of caution.
        for (name, other) in [("heitz", &heitz), ("bounded", &bounded), ("exact", &exact)] {
            let score = largest_score(&cap, other);
            assert!(
                score < 4.5,
                "cap and {name} differ by {score} standard errors"
            );
        }
        let ratio = mean(&bounded).1.powi(2) / mean(&cap).1.powi(2);
        println!("alpha ({alpha_x}, {alpha_y}): variance of bounded over cap {ratio:.3}");
        assert!(ratio < most, "alpha ({alpha_x}, {alpha_y}): {ratio}");
        let ratio = mean(&exact).1.powi(2) / mean(&bounded).1.powi(2);
        println!("alpha ({alpha_x}, {alpha_y}): variance of exact over bounded {ratio:.3}");
        assert!(ratio < 1.0, "alpha ({alpha_x}, {alpha_y}): {ratio}");
    }
}

/// The comparison must see what it is for: 10 % of bias in one tile.
#[test]
fn a_biased_tile_is_seen() {
    let scene = metal_hall(0.8, 0.8);
    let cap = picture(&scene, Sampler::Cap, 1024);
    let mut biased = picture(&scene, Sampler::Bounded, 1024);
    assert!(largest_score(&cap, &biased) < 4.5);
    for row in 0..8 {
        for column in 0..8 {
            let c = &mut biased.colour[row * 32 + column];
            *c *= 1.1;
        }
    }
    assert!(largest_score(&cap, &biased) > 4.5);
}

/// A path tracer that forgot its weights would add both strategies up.
#[test]
fn adding_both_strategies_without_weights_is_seen() {
    let scene = metal_hall(0.5, 0.5);
    let at = |strategy| mean(&render(&scene, 64, 2, strategy));
    let (mis, error) = at(Strategy::Mis);
    let doubled = at(Strategy::LightsOnly).0 + at(Strategy::BsdfOnly).0;
    // The lamp is seen directly by both: even so the sum is far away.
    assert!(
        (doubled - mis).abs() > 20.0 * error,
        "{doubled} {mis} +- {error}"
    );
}
