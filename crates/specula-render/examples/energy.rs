//! Rough metal with and without its lost energy: pictures and figures.
//!
//! ```text
//! cargo run --release -p specula-render --example energy [FOLDER]
//! ```
//!
//! writes `furnace.png` (a row of balls, alpha 0.1 to 1, in a uniform sky: what reflects all light
//! is invisible) and `studio.png` (the same under lamps), each with a strip per treatment, and
//! prints (1) the mean of every ball in the furnace, (2) caps against bounded caps under Turquin's
//! compensation (Tokuyoshi and Eto 2024, fig. 10), (3) the noise of three densities of multiple
//! importance sampling (Cui et al. 2023, fig. 7).
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use glam::DMat4;
use specula_bsdf::multibounce::MisPdf;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Rgb, metals};
use specula_render::picture::{Display, Picture, ToneMap, write_png};
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::*;
use specula_scene::{Energy, Scene};

const TREATMENTS: [&str; 4] = ["none", "turquin", "kulla-conty", "multibounce"];
const ROW: [f32; 7] = [0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0];

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out".into()));
    std::fs::create_dir_all(&folder)?;
    furnace(&folder)?;
    studio(&folder)?;
    caps_under_turquin()?;
    densities()
}

/// A row of balls over an empty floor, seen from the front.
fn row(alphas: &[f32], metal: ConductorFresnel, pixels: u32) -> Scene {
    let mut scene = specula_scene::builtin::orbs();
    let count = alphas.iter().map(|_| 1_u32).sum::<u32>();
    scene.film.resolution = [pixels * count, pixels];
    scene.film.crop = [0, pixels * count, 0, pixels];
    scene.camera.to_world = DMat4::from_translation([0.0, 0.0, -40.0].into());
    scene.camera.projection = Projection::Perspective {
        fov_deg: 2.0 * (1.15_f64 / 40.0).atan().to_degrees(),
    };
    let aspect = f64::from(count);
    scene.camera.screen_window = [-aspect, aspect, -1.0, 1.0];
    scene.camera.lens_radius = 0.0;
    scene.materials.clear();
    scene.shapes.clear();
    scene.meshes.clear();
    scene.lights.clear();
    for (i, alpha) in alphas.iter().enumerate() {
        let alpha = FloatParam::Value(*alpha);
        let metal = MaterialKind::Conductor {
            fresnel: metal,
            roughness: Roughness::isotropic(alpha, RoughnessMapping::Alpha),
            tint: ColourParam::WHITE,
        };
        scene.materials.push(Material::new(metal));
        let x = 2.3 * (i as f64 - 0.5 * (f64::from(count) - 1.0));
        scene.shapes.push(Shape {
            geometry: Geometry::Sphere { radius: 1.0 },
            to_world: DMat4::from_translation([x, 0.0, 0.0].into()),
            material: MaterialId(i),
            emission: None,
            reverse_orientation: false,
            alpha: FloatParam::Value(1.0),
            motion: None,
        });
    }
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
fn environment(scene: &mut Scene) {
    if let Some(Light::Infinite { image, .. }) = specula_scene::builtin::orbs().lights.first() {
        scene.lights.push(Light::Infinite {
            radiance: Rgb::splat(1.0),
            image: *image,
            to_world: DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2),
        });
    }
}

fn white() -> ConductorFresnel {
    let grey = |v| ColourParam::Value(Rgb::splat(v));
    ConductorFresnel::Index {
        eta: grey(1.0),
        k: grey(1000.0),
    }
}

fn measured(symbol: &str) -> Outcome<ConductorFresnel> {
    let metal = metals::by_symbol(symbol).ok_or("not a measured metal")?;
    let colour = |v: [f64; 3]| ColourParam::Value(Rgb::from(v).cast());
    Ok(ConductorFresnel::Index {
        eta: colour(metal.eta),
        k: colour(metal.k),
    })
}

fn render(scene: &Scene, options: RenderOptions) -> Outcome<Picture> {
    let spp = options.samples_per_pixel;
    let prepared = PreparedScene::new(scene, &options)?;
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(spp, &AtomicBool::new(false));
    Ok(renderer.film().picture())
}

fn treated(name: &str, spp: u32) -> Outcome<RenderOptions> {
    Ok(RenderOptions {
        samples_per_pixel: spp,
        energy: name.parse::<Energy>()?,
        ..RenderOptions::default()
    })
}

/// Strips under each other, as a screen shows them.
fn write_strips(path: &Path, strips: Vec<Picture>) -> Outcome<()> {
    let mut strips = strips.into_iter();
    let mut all = strips.next().ok_or("no strips")?;
    for strip in strips {
        all.height += strip.height;
        all.full_resolution[1] += strip.height;
        all.colour.extend(strip.colour);
        all.albedo.extend(strip.albedo);
        all.normal.extend(strip.normal);
        all.depth.extend(strip.depth);
        all.sample_count.extend(strip.sample_count);
        all.variance.extend(strip.variance);
    }
    let display = Display {
        tone_map: ToneMap::Clamp,
        exposure_stops: 0.0,
    };
    write_png(path, &all, display)?;
    println!("wrote {}", path.display());
    Ok(())
}

fn furnace(folder: &Path) -> Outcome<()> {
    let mut scene = row(&ROW, white(), 96);
    sky(&mut scene);
    println!("white furnace, mean over the middle of each ball (1 is right), F = 1");
    println!(
        "  alpha        {}",
        ROW.map(|a| format!("{a:7.2}")).join("")
    );
    let mut strips = Vec::new();
    for name in TREATMENTS {
        let picture = render(&scene, treated(name, 64)?)?;
        let means = (0..)
            .zip(ROW)
            .map(|(i, _)| format!("{:7.3}", centre_mean(&picture, i)));
        println!("  {name:<12} {}", means.collect::<String>());
        strips.push(picture);
    }
    write_strips(&folder.join("furnace.png"), strips)
}

/// Mean green of the middle ninth of the `i`-th square.
fn centre_mean(picture: &Picture, i: u32) -> f64 {
    let side = picture.height;
    let mut sum = 0.0;
    let mut count = 0.0;
    for y in side / 3..2 * side / 3 {
        for x in i * side + side / 3..i * side + 2 * side / 3 {
            sum += f64::from(picture.colour[(y * picture.width + x) as usize].g);
            count += 1.0;
        }
    }
    sum / count
}

fn studio(folder: &Path) -> Outcome<()> {
    let mut scene = row(&ROW, measured("Au")?, 128);
    environment(&mut scene);
    let strips = TREATMENTS
        .iter()
        .map(|name| render(&scene, treated(name, 96)?))
        .collect::<Outcome<Vec<_>>>()?;
    write_strips(&folder.join("studio.png"), strips)
}

/// Balls close to each other and to a floor of the same metal, under Turquin's compensation.
fn caps_under_turquin() -> Outcome<()> {
    let mut scene = row(&[0.6, 0.8, 1.0], measured("Ag")?, 64);
    environment(&mut scene);
    // A hall of the roughest metal: bounces between surfaces make the fireflies.
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere { radius: 60.0 },
        to_world: DMat4::from_translation([0.0, -61.1, 0.0].into()),
        material: MaterialId(2),
        emission: None,
        reverse_orientation: false,
        alpha: FloatParam::Value(1.0),
        motion: None,
    });
    let at = |sampler, spp, seed| {
        render(
            &scene,
            RenderOptions {
                vndf_sampler: sampler,
                max_depth: 32,
                seed,
                ..treated("turquin", spp)?
            },
        )
    };
    let reference = at(Sampler::Bounded, 2048, 9)?;
    println!("Turquin, errors at 64 samples per pixel");
    for sampler in [Sampler::Heitz, Sampler::Cap, Sampler::Bounded] {
        let errors = absolute_errors(&at(sampler, 64, 1)?, &reference);
        let (rmse, tail) = rmse_and_tail(errors, 0.9999);
        println!("  {sampler:<8} RMSE {rmse:.5}   99.99th percentile {tail:.4}");
    }
    Ok(())
}

fn densities() -> Outcome<()> {
    let mut scene = row(&[0.1, 0.15, 0.2], measured("Al")?, 64);
    environment(&mut scene);
    let at = |mis_pdf, spp, seed| {
        render(
            &scene,
            RenderOptions {
                mis_pdf,
                seed,
                ..treated("multibounce", spp)?
            },
        )
    };
    let reference = at(MisPdf::Normalised, 2048, 9)?;
    println!("multiple bounces, aluminium, alpha 0.1, 0.15, 0.2, 64 samples per pixel");
    for mis_pdf in MisPdf::ALL {
        let errors = absolute_errors(&at(mis_pdf, 64, 1)?, &reference);
        let (rmse, tail) = rmse_and_tail(errors, 0.9999);
        println!(
            "  {:<11} RMSE {rmse:.5}   99.99th percentile {tail:.4}",
            mis_pdf.name()
        );
    }
    Ok(())
}

fn absolute_errors(picture: &Picture, reference: &Picture) -> Vec<f64> {
    picture
        .colour
        .iter()
        .zip(&reference.colour)
        .map(|(a, b)| f64::from((a.luminance() - b.luminance()).abs()))
        .collect()
}

fn rmse_and_tail(mut errors: Vec<f64>, quantile: f64) -> (f64, f64) {
    errors.sort_by(f64::total_cmp);
    let squares: f64 = errors.iter().map(|e| e * e).sum();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "an index within the list"
    )]
    let at = ((errors.len() - 1) as f64 * quantile) as usize;
    ((squares / errors.len() as f64).sqrt(), errors[at])
}
