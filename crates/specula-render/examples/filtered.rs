//! Filtered textures on a checkered floor to the horizon: bias and noise, and a sheet of pictures.
//!
//! ```text
//! cargo run --release -p specula-render --example filtered -- [SHEET.png] [--peer NAME FILE.exr...]...
//! ```
//!
//! The scene is `data/filtered/floor.pbrt`. For each filter and number of samples: the root mean square, over the
//! pixels of the floor, of the difference between the mean of some renders with different seeds and a reference of
//! 4096 unfiltered samples, less what noise adds to it; and that of the noise of one render. `--peer` adds the renders
//! of another program, of one number of samples. The sheet has a row of pictures for each number of samples, and in it
//! the filters bilinear, trilinear and EWA, each with the part next to the horizon enlarged below; the reference is
//! last.
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use specula_bsdf::Rgb;
use specula_render::picture::{Display, Picture, read_exr, write_png};
use specula_render::{PreparedScene, RenderOptions, Renderer, TextureFilter};
use specula_scene::Scene;

type Outcome<T> = Result<T, Box<dyn Error>>;

const REFERENCE_SAMPLES: u32 = 4096;
/// Samples of a pixel, and how many renders.
const RUNS: [[u32; 2]; 2] = [[16, 8], [1024, 2]];
const FILTERS: [TextureFilter; 3] = [
    TextureFilter::Bilinear,
    TextureFilter::Trilinear,
    TextureFilter::Ewa,
];
/// Rows of the horizon's part, from the first row of the floor on.
const NEAR_HORIZON: u32 = 24;
const ENLARGED: u32 = 3;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1).peekable();
    let sheet = arguments.next_if(|a| a != "--peer").map(PathBuf::from);
    let mut peers: Vec<(String, Vec<PathBuf>)> = Vec::new();
    for argument in arguments {
        match (argument.as_str(), peers.last_mut()) {
            ("--peer", _) => peers.push((String::new(), Vec::new())),
            (name, Some((peer, _))) if peer.is_empty() => name.clone_into(peer),
            (file, Some((_, files))) => files.push(file.into()),
            (other, None) => return Err(format!("unexpected {other:?}").into()),
        }
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/filtered");
    let scene = specula_scene::load(&folder.join("floor.pbrt"))?.scene;
    let reference = render(&scene, TextureFilter::Bilinear, REFERENCE_SAMPLES, 1000)?;
    let first_row = first_row(&reference);
    println!("| | samples | bias | noise |\n|---|---|---|---|");
    let mut pictures = Vec::new();
    for [samples, count] in RUNS {
        for filter in FILTERS {
            let renders = (1..=count).map(|seed| render(&scene, filter, samples, seed));
            let renders: Vec<Picture> = renders.collect::<Outcome<_>>()?;
            let [bias, noise] = bias_and_noise(&renders, &reference)?;
            println!("| {filter} | {samples} | {bias:.5} | {noise:.5} |");
            pictures.extend(renders.into_iter().next());
        }
    }
    for (name, files) in &peers {
        let renders = files.iter().map(|file| read_exr(file));
        let renders: Vec<Picture> = renders.collect::<Result<_, _>>()?;
        let [bias, noise] = bias_and_noise(&renders, &reference)?;
        println!("| {name} | | {bias:.5} | {noise:.5} |");
    }
    if let Some(path) = sheet {
        pictures.push(reference);
        write_png(&path, &tiled(&pictures, first_row), Display::default())?;
    }
    Ok(())
}

fn render(scene: &Scene, filter: TextureFilter, spp: u32, seed: u32) -> Outcome<Picture> {
    let options = RenderOptions {
        samples_per_pixel: spp,
        seed,
        texture_filter: filter,
        ..RenderOptions::from_scene(scene)
    };
    let prepared = PreparedScene::new(scene, &options)?;
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(spp, &AtomicBool::new(false));
    Ok(renderer.film().picture())
}

/// The first row that the floor fills.
fn first_row(picture: &Picture) -> u32 {
    let lit = |row: &[Rgb<f32>]| row.iter().all(|c| c.g > 0.0);
    let mut rows = picture.colour.chunks(picture.width as usize);
    let row = rows.position(lit).unwrap_or(0);
    u32::try_from(row).unwrap_or(0)
}

/// Over the pixels that the reference lights.
fn bias_and_noise(renders: &[Picture], reference: &Picture) -> Outcome<[f64; 2]> {
    if renders.len() < 2
        || renders
            .iter()
            .any(|r| r.colour.len() != reference.colour.len())
    {
        return Err("noise is that of two renders or more, of the reference's size".into());
    }
    let n = f64::from(u32::try_from(renders.len())?);
    let (mut bias, mut noise, mut pixels) = (0.0, 0.0, 0.0);
    for (i, expected) in reference.colour.iter().enumerate() {
        let expected = f64::from(expected.g);
        if expected <= 0.0 {
            continue;
        }
        let values = || renders.iter().map(|r| f64::from(r.colour[i].g));
        let mean = values().sum::<f64>() / n;
        let variance = values().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
        bias += (mean - expected).powi(2) - variance / n;
        noise += variance;
        pixels += 1.0;
    }
    Ok([bias, noise].map(|sum: f64| (sum.max(0.0) / pixels).sqrt()))
}

/// Rows of three pictures, and below each its part next to the horizon, enlarged.
fn tiled(pictures: &[Picture], first_row: u32) -> Picture {
    const GAP: u32 = 4;
    let [width, height] = [pictures[0].width, pictures[0].height];
    let across = width / ENLARGED;
    let below = NEAR_HORIZON * ENLARGED;
    let (step_x, step_y) = (width + GAP, height + below + 2 * GAP);
    let rows = u32::try_from(pictures.len().div_ceil(3)).unwrap_or(1);
    let [w, h] = [3 * step_x - GAP, rows * step_y - GAP];
    let mut colour = vec![Rgb::WHITE; (w * h) as usize];
    for (i, picture) in (0..).zip(pictures) {
        let (x0, y0) = (i % 3 * step_x, i / 3 * step_y);
        let at = |x: u32, y: u32| picture.colour[(y * width + x) as usize];
        for y in 0..height {
            for x in 0..width {
                colour[((y0 + y) * w + x0 + x) as usize] = at(x, y);
            }
        }
        for y in 0..below {
            for x in 0..width {
                let from = at(
                    (width - across) / 2 + x / ENLARGED,
                    first_row + y / ENLARGED,
                );
                colour[((y0 + height + GAP + y) * w + x0 + x) as usize] = from;
            }
        }
    }
    Picture::from_colour(w, h, colour)
}
