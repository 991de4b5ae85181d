//! A metal floor with a normal map under the sun, seen from afar: errors of averaged normals and of normals filtered
//! into roughness, and a sheet of pictures.
//!
//! ```text
//! cargo run --release -p specula-render --example normal_maps -- [SHEET.png]
//! ```
//!
//! The scene is `data/filtered/metal.pbrt`. Errors are the root mean square, over the picture, of the difference to
//! 4096 samples that are not filtered, over the root mean square of these. The sheet has, from left to right, the
//! reference, 16 samples of averaged normals, and 16 samples of normals filtered into roughness.
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use specula_bsdf::Rgb;
use specula_render::picture::{Display, Picture, write_png};
use specula_render::{PreparedScene, RenderOptions, Renderer, TextureFilter};
use specula_scene::Scene;

type Outcome<T> = Result<T, Box<dyn Error>>;

const REFERENCE_SAMPLES: u32 = 4096;
/// Samples of a pixel.
const RUNS: [u32; 4] = [1, 4, 16, 256];
/// Those on the sheet.
const SHOWN: u32 = 16;
const GAP: u32 = 4;

fn main() -> Outcome<()> {
    let sheet = std::env::args().nth(1).map(PathBuf::from);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/filtered/metal.pbrt");
    let scene = specula_scene::load(&file)?.scene;
    let reference = render(&scene, TextureFilter::Bilinear, false, REFERENCE_SAMPLES)?;
    let mut pictures = vec![reference];
    println!("| samples | unfiltered | averaged normals | filtered into roughness |");
    println!("|---|---|---|---|");
    for samples in RUNS {
        let mut row = format!("| {samples} |");
        for (filter, normals) in [
            (TextureFilter::Bilinear, false),
            (TextureFilter::Ewa, false),
            (TextureFilter::Ewa, true),
        ] {
            let found = render(&scene, filter, normals, samples)?;
            row += &format!(" {:.3} |", error(&found, &pictures[0]));
            if samples == SHOWN && filter == TextureFilter::Ewa {
                pictures.push(found);
            }
        }
        println!("{row}");
    }
    if let Some(path) = sheet {
        write_png(&path, &tiled(&pictures), Display::default())?;
    }
    Ok(())
}

fn render(scene: &Scene, filter: TextureFilter, normals: bool, spp: u32) -> Outcome<Picture> {
    let options = RenderOptions {
        samples_per_pixel: spp,
        seed: spp,
        texture_filter: filter,
        filter_normal_maps: normals,
        ..RenderOptions::from_scene(scene)
    };
    let prepared = PreparedScene::new(scene, &options)?;
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(spp, &AtomicBool::new(false));
    Ok(renderer.film().picture())
}

fn error(found: &Picture, reference: &Picture) -> f64 {
    let (mut squares, mut size) = (0.0, 0.0);
    for (f, r) in found.colour.iter().zip(&reference.colour) {
        squares += f64::from(f.g - r.g).powi(2);
        size += f64::from(r.g).powi(2);
    }
    (squares / size).sqrt()
}

/// Pictures of one size, side by side.
fn tiled(pictures: &[Picture]) -> Picture {
    let [width, height] = [pictures[0].width, pictures[0].height];
    let count = u32::try_from(pictures.len()).unwrap_or(1);
    let across = count * (width + GAP) - GAP;
    let mut colour = vec![Rgb::WHITE; (across * height) as usize];
    for (i, picture) in (0..).zip(pictures) {
        for y in 0..height {
            let from = (y * width) as usize;
            let to = (y * across + i * (width + GAP)) as usize;
            let row = &picture.colour[from..from + width as usize];
            colour[to..to + width as usize].copy_from_slice(row);
        }
    }
    Picture::from_colour(across, height, colour)
}
