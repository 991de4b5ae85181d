//! What the samplers of rough metal make of the same time: errors, times, and their product.
//!
//! ```text
//! cargo run --release -p specula-render --example exact
//! ```
//!
//! For each scene, caps, bounded caps and the exact sampler take turns. Printed are the root mean
//! square error at equal samples, rays and time per path, and the error relative to that of bounded
//! caps at equal samples, at equal rays, `sqrt(MSE n / (MSE n of bounded))`, and at equal time:
//! medians over the rounds. Sequences are Owen-scrambled Sobol, a new seed in every round; the
//! reference is made half by the bounded and half by the exact sampler.
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::Scene;
use specula_scene::scene::*;

type Outcome<T> = Result<T, Box<dyn Error>>;

const SAMPLERS: [Sampler; 3] = [Sampler::Cap, Sampler::Bounded, Sampler::Exact];
const SAMPLES: u32 = 64;
const REFERENCE_SAMPLES: u32 = 2048;
const ROUNDS: u32 = 5;
const SIZE: u32 = 32;

fn main() -> Outcome<()> {
    println!("{SAMPLES} samples per pixel, median of {ROUNDS} rounds");
    println!(
        "                                                               RMSE / bounded at equal"
    );
    println!("  scene                     sampler     RMSE rays/path ns/path samples  rays  time");
    for (width_x, width_y) in [(0.1, 0.8), (0.3, 0.3), (0.6, 0.6)] {
        let alphas = format!("({width_x}, {width_y})");
        let mut scene = ball(width_x, width_y);
        sky(&mut scene);
        compare(&format!("ball {alphas}, sky"), &scene)?;
        let mut scene = ball(width_x, width_y);
        studio(&mut scene);
        compare(&format!("ball {alphas}, studio"), &scene)?;
        compare(&format!("hall {alphas}, lamp"), &hall(width_x, width_y))?;
    }
    Ok(())
}

fn compare(name: &str, scene: &Scene) -> Outcome<()> {
    let halves = [
        render(scene, Sampler::Bounded, REFERENCE_SAMPLES / 2, 100)?.picture,
        render(scene, Sampler::Exact, REFERENCE_SAMPLES / 2, 101)?.picture,
    ];
    let mut rounds = [const { Vec::new() }; SAMPLERS.len()];
    for round in 0..ROUNDS {
        for (i, sampler) in SAMPLERS.into_iter().enumerate() {
            let run = render(scene, sampler, SAMPLES, round)?;
            let error = mean_square_error(&run.picture, &halves);
            rounds[i].push([error, run.rays, run.time]);
        }
    }
    // Mean square error, rays and time of each sampler.
    let figures = rounds.map(|runs| [0, 1, 2].map(|f| median(runs.iter().map(|r| r[f]).collect())));
    let [bounded_error, bounded_rays, bounded_time] = figures[1];
    for (sampler, [error, rays, time]) in SAMPLERS.into_iter().zip(figures) {
        let paths = f64::from(SIZE * SIZE * SAMPLES);
        let relative = error / bounded_error;
        println!(
            "  {name:<25} {:<8} {:7.5} {:9.2} {:7.0} {:7.3} {:5.3} {:5.3}",
            sampler.to_string(),
            error.sqrt(),
            rays / paths,
            time * 1e9 / paths,
            relative.sqrt(),
            (relative * rays / bounded_rays).sqrt(),
            (relative * time / bounded_time).sqrt(),
        );
    }
    Ok(())
}

/// One pass and what it took.
struct Run {
    picture: Picture,
    rays: f64,
    /// Seconds.
    time: f64,
}

fn render(scene: &Scene, sampler: Sampler, spp: u32, seed: u32) -> Outcome<Run> {
    let options = RenderOptions {
        samples_per_pixel: spp,
        max_depth: 16,
        vndf_sampler: sampler,
        seed,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options)?;
    let mut renderer = Renderer::new(&prepared, options);
    let start = Instant::now();
    let report = renderer.render_pass(spp, &AtomicBool::new(false));
    let time = start.elapsed().as_secs_f64();
    #[allow(clippy::cast_precision_loss, reason = "counts of rays are below 2^52")]
    let rays = report.rays as f64;
    Ok(Run {
        picture: renderer.film().picture(),
        rays,
        time,
    })
}

fn mean_square_error(picture: &Picture, halves: &[Picture; 2]) -> f64 {
    let pixels = picture.colour.iter().zip(&halves[0].colour);
    let errors = pixels.zip(&halves[1].colour).map(|((c, a), b)| {
        let reference = 0.5 * (a.luminance() + b.luminance());
        f64::from(c.luminance() - reference).powi(2)
    });
    errors.sum::<f64>() / f64::from(SIZE * SIZE)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn silver(width_x: f32, width_y: f32) -> Material {
    let grey = |v| ColourParam::Value(Rgb::splat(v));
    Material::new(MaterialKind::Conductor {
        fresnel: ConductorFresnel::Index {
            eta: grey(0.2),
            k: grey(4.0),
        },
        roughness: Roughness {
            v: FloatParam::Value(width_y),
            ..Roughness::isotropic(FloatParam::Value(width_x), RoughnessMapping::Alpha)
        },
        tint: ColourParam::WHITE,
    })
}

fn sphere(radius: f32, centre: [f64; 3]) -> Shape {
    Shape {
        geometry: Geometry::Sphere { radius },
        to_world: DMat4::from_translation(centre.into()),
        material: MaterialId(0),
        emission: None,
        reverse_orientation: false,
        alpha: FloatParam::Value(1.0),
        motion: None,
    }
}

/// A ball of metal that fills the picture, without light.
fn ball(width_x: f32, width_y: f32) -> Scene {
    let mut scene = specula_scene::builtin::orbs();
    scene.film.resolution = [SIZE; 2];
    scene.film.crop = [0, SIZE, 0, SIZE];
    scene.camera.to_world = DMat4::from_translation([0.0, 0.0, -3.5].into());
    scene.camera.projection = Projection::Perspective { fov_deg: 18.0 };
    scene.camera.screen_window = [-1.0, 1.0, -1.0, 1.0];
    scene.camera.lens_radius = 0.0;
    scene.meshes.clear();
    scene.objects.clear();
    scene.instances.clear();
    scene.lights.clear();
    scene.materials = vec![silver(width_x, width_y)];
    scene.shapes = vec![sphere(1.0, [0.0; 3])];
    scene
}

/// The ball in a hall of its metal, under a lamp.
fn hall(width_x: f32, width_y: f32) -> Scene {
    let mut scene = ball(width_x, width_y);
    scene.camera.projection = Projection::Perspective { fov_deg: 50.0 };
    scene.shapes.push(Shape {
        reverse_orientation: true,
        ..sphere(5.0, [0.0; 3])
    });
    scene.shapes.push(Shape {
        emission: Some(Emission {
            radiance: ColourParam::Value(Rgb::splat(10.0)),
            two_sided: false,
        }),
        ..sphere(0.8, [1.5, 2.5, -2.0])
    });
    scene
}

fn sky(scene: &mut Scene) {
    scene.lights.push(Light::Infinite {
        radiance: Rgb::splat(1.0),
        image: None,
        to_world: DMat4::IDENTITY,
    });
}

/// The built-in studio's environment, turned so that its pole is up in the picture.
fn studio(scene: &mut Scene) {
    if let Some(Light::Infinite { image, .. }) = specula_scene::builtin::orbs().lights.first() {
        scene.lights.push(Light::Infinite {
            radiance: Rgb::splat(1.0),
            image: *image,
            to_world: DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2),
        });
    }
}
