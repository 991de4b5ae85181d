//! The guide's pictures: each of a scene in `docs/guide/scenes`, or of a sampler's distribution.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use specula_bsdf::vndf::Sampler;
use specula_render::picture::{Display, Picture as Pixels, ToneMap, write_png};
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::Energy;

use super::summary::Summary;
use super::{ball, distribution, markdown, table_of_gold};
use crate::Result;

/// Where the pictures are, from the workspace's root.
const FOLDER: &str = "docs/guide/pictures";
/// Where their scenes are.
const SCENES: &str = "docs/guide/scenes";
/// Folders of the guide of whose pages each shows a picture; their README is an overview.
const SHOWN: [&str; 3] = [
    "docs/guide/materials",
    "docs/guide/samplers",
    "docs/guide/energy",
];
/// Their size in pixels.
const SIZE: [u32; 2] = [720, 180];
/// Most bytes of all pictures together.
const MOST_BYTES: u64 = 4_000_000;

/// A picture that is rendered.
struct Picture {
    /// Its name, without `.png`.
    name: &'static str,
    /// Its scene.
    scene: &'static str,
    /// What differs from a render with the program's defaults.
    options: Options,
}

#[derive(Default)]
struct Options {
    /// `--energy`.
    energy: Option<&'static str>,
    /// `--sampler`.
    sampler: Option<Sampler>,
    /// `--spp`.
    samples: Option<u32>,
}

const fn of(name: &'static str, scene: &'static str) -> Picture {
    Picture {
        name,
        scene,
        options: Options {
            energy: None,
            sampler: None,
            samples: None,
        },
    }
}

const fn with_samples(name: &'static str, scene: &'static str, samples: u32) -> Picture {
    let mut picture = of(name, scene);
    picture.options.samples = Some(samples);
    picture
}

const fn with_energy(name: &'static str, scene: &'static str, energy: &'static str) -> Picture {
    let mut picture = of(name, scene);
    picture.options.energy = Some(energy);
    picture
}

const fn with_sampler(name: &'static str, sampler: Sampler) -> Picture {
    let mut picture = with_samples(name, "sampler_noise.pbrt", 4);
    picture.options.sampler = Some(sampler);
    picture
}

const PICTURES: [Picture; 30] = [
    of("conductor", "conductor.pbrt"),
    of("anisotropic", "anisotropic.pbrt"),
    of("dielectric", "dielectric.pbrt"),
    of("thin_dielectric", "thin_dielectric.pbrt"),
    of("diffuse", "diffuse.xml"),
    of("diffuse_transmission", "diffuse_transmission.pbrt"),
    of("coated_diffuse", "coated_diffuse.pbrt"),
    of("coated_conductor", "coated_conductor.pbrt"),
    of("layered", "layered.pbrt"),
    of("plastic", "plastic.xml"),
    of("principled", "principled.xml"),
    of("principled_lobes", "principled_lobes.xml"),
    of("principled_thin", "principled_thin.xml"),
    with_samples("gltf", "gltf.gltf", 192),
    with_samples("hair", "hair.pbrt", 32),
    of("measured", "measured.pbrt"),
    of("mix", "mix.pbrt"),
    of("bump", "bump.pbrt"),
    with_energy("energy_none", "energy.pbrt", "none"),
    with_energy("energy_turquin", "energy.pbrt", "turquin"),
    with_energy("energy_kulla_conty", "energy.pbrt", "kulla-conty"),
    with_energy("energy_simulated", "energy.pbrt", "multibounce"),
    with_energy("furnace_none", "furnace.pbrt", "none"),
    with_energy("furnace_turquin", "furnace.pbrt", "turquin"),
    with_energy("furnace_kulla_conty", "furnace.pbrt", "kulla-conty"),
    with_energy("furnace_simulated", "furnace.pbrt", "multibounce"),
    with_sampler("noise_heitz", Sampler::Heitz),
    with_sampler("noise_cap", Sampler::Cap),
    with_sampler("noise_bounded", Sampler::Bounded),
    with_sampler("noise_exact", Sampler::Exact),
];

/// Makes the pictures with `part` in their names.
pub(super) fn make(root: &Path, part: &str) -> Result<()> {
    let folder = root.join(FOLDER);
    fs::create_dir_all(&folder)?;
    ball::write(&root.join(SCENES).join(ball::FILE))?;
    table_of_gold::write(&root.join(SCENES).join(table_of_gold::FILE))?;
    for (name, svg) in distribution::all() {
        if name.contains(part) {
            fs::write(folder.join(format!("{name}.svg")), svg)?;
        }
    }
    for picture in PICTURES.iter().filter(|p| p.name.contains(part)) {
        let start = Instant::now();
        let pixels = picture.render(root, false)?;
        let path = folder.join(format!("{}.png", picture.name));
        let display = Display {
            tone_map: ToneMap::Clamp,
            exposure_stops: 0.0,
        };
        write_png(&path, &pixels, display)?;
        println!("{}: {:.0} s", path.display(), start.elapsed().as_secs_f64());
    }
    Ok(())
}

impl Picture {
    /// Renders it, whole or quickly: at a tenth of the size with one sample per pixel.
    fn render(&self, root: &Path, quick: bool) -> Result<Pixels> {
        let path = root.join(SCENES).join(self.scene);
        let scene = specula_scene::load(&path)?.scene;
        let mut options = RenderOptions::from_scene(&scene);
        if let Some(energy) = self.options.energy {
            options.energy = energy.parse::<Energy>()?;
        }
        if let Some(sampler) = self.options.sampler {
            options.vndf_sampler = sampler;
        }
        if let Some(samples) = self.options.samples {
            options.samples_per_pixel = samples;
        }
        options.resolution = Some(SIZE);
        if quick {
            options.resolution = Some(SIZE.map(|pixels| pixels / 10));
            options.samples_per_pixel = 1;
        }
        let samples = options.samples_per_pixel;
        let prepared = PreparedScene::new(&scene, &options)?;
        let mut renderer = Renderer::new(&prepared, options);
        renderer.render_pass(samples, &AtomicBool::new(false));
        Ok(renderer.film().picture())
    }
}

/// One line for each picture that is missing or not shown, each page without one, and too many bytes.
pub(super) fn find(root: &Path, summary: &Summary) -> Result<Vec<String>> {
    let mut findings = Vec::new();
    let mut shown = Vec::new();
    for (_, page) in &summary.pages {
        let text = fs::read_to_string(root.join(page)).map_err(|e| format!("{page:?}: {e}"))?;
        let links = markdown::read(&text).links;
        let files = links
            .iter()
            .filter_map(|(_, target)| target.split_once("pictures/"));
        let before = shown.len();
        shown.extend(files.map(|(_, file)| file.to_owned()));
        let must_show = SHOWN.iter().any(|folder| page.starts_with(folder))
            && page.file_name().is_some_and(|name| name != "README.md");
        if must_show && shown.len() == before {
            findings.push(format!("{}:1: shows no picture", page.display()));
        }
    }
    let mut bytes = 0;
    let rendered = PICTURES.iter().map(|p| format!("{}.png", p.name));
    let plotted = distribution::NAMES.iter().map(|name| format!("{name}.svg"));
    for file in rendered.chain(plotted) {
        match fs::metadata(root.join(FOLDER).join(&file)) {
            Ok(metadata) => bytes += metadata.len(),
            Err(_) => findings.push(format!(
                "{FOLDER}/{file}: missing: cargo xtask book --pictures"
            )),
        }
        if !shown.contains(&file) {
            findings.push(format!("{FOLDER}/{file}: shown by no page"));
        }
    }
    if bytes > MOST_BYTES {
        findings.push(format!("{FOLDER}: {bytes} bytes, at most {MOST_BYTES}"));
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn the_scene_of_every_picture_renders() {
        let root = workspace::root();
        for picture in &PICTURES {
            let pixels = picture.render(&root, true).unwrap();
            let values = pixels.colour.iter().map(|c| f64::from(c.g));
            let mean = values.sum::<f64>() / pixels.colour.len() as f64;
            assert!((0.05..5.0).contains(&mean), "{}: {mean}", picture.name);
        }
    }
}
