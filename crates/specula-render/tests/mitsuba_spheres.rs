//! Mitsuba's scenes of `data/scenes`, rendered here, against reference pictures by Mitsuba 3.
//!
//! For each scene the picture's mean, its 8 x 8 tiles and its pixels must agree with the reference within the
//! noise of both. `SPECULA_SPHERES_SPP` sets the samples per pixel, and `SPECULA_SPHERES` selects scenes whose
//! name contains it.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use specula_bsdf::Rgb;
use specula_render::picture::{Picture, read_exr};
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::{Format, LoadOptions, Scene, load_as};
use specula_stat::Report;
use specula_stat::image::{NoisyImage, compare};

/// Samples per pixel of the references. Their variances are those of one sample.
const REFERENCE_SAMPLES: f64 = 16_384.0;
/// Chance of a false alarm over the whole test.
const SIGNIFICANCE: f64 = 0.01;

#[test]
fn mitsubas_references_are_met() {
    let root = specula_testing::scene("mitsuba");
    let files = std::fs::read_dir(&root).expect("a folder");
    let wanted = std::env::var("SPECULA_SPHERES").unwrap_or_default();
    let mut scenes: Vec<PathBuf> = files
        .map(|f| f.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "xml") && name_of(p).contains(&wanted))
        .collect();
    scenes.sort();
    let samples = std::env::var("SPECULA_SPHERES_SPP")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(64);
    println!(
        "{:44} {:>8} {:>8} {:>8}  {samples} samples",
        "scene", "mean", "tiles", "pixels"
    );
    let failing: Vec<String> = scenes
        .iter()
        .filter(|path| {
            let (line, passes) = compared(&root, path, samples);
            println!("{line}");
            !passes
        })
        .map(|path| name_of(path))
        .collect();
    assert!(failing.is_empty(), "not as in the references: {failing:?}");
}

/// `bumpmap` of `.../bumpmap.xml`.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// Renders a scene and compares it: a line with the least p-values, and whether all pass.
fn compared(root: &Path, path: &Path, samples: u32) -> (String, bool) {
    let name = name_of(path);
    let picture = render(&load(path), samples);
    if let Ok(folder) = std::env::var("SPECULA_SPHERES_OUT") {
        let file = Path::new(&folder).join(format!("{name}.exr"));
        specula_render::picture::write_exr(&file, &picture, &Default::default()).expect("writable");
    }
    let reports = against_reference(root, &name, &picture, f64::from(samples));
    let mut least = [1.0_f64; 3];
    let mut details = String::new();
    for (channel, report) in reports.iter().enumerate() {
        for (least, check) in least.iter_mut().zip(&report.checks) {
            *least = least.min(check.p_value.unwrap_or(0.0));
        }
        for check in report.checks.iter().filter(|c| !c.is_pass) {
            details += &format!("\n    channel {channel}, {}: {}", check.name, check.detail);
        }
    }
    let passes = reports.iter().all(Report::is_pass);
    let verdict = if passes { "" } else { "  FAILS" };
    let [mean, tiles, pixels] = least;
    let line = format!("{name:44} {mean:8.1e} {tiles:8.1e} {pixels:8.1e}{verdict}{details}");
    (line, passes)
}

/// What is found when a picture's channels are compared with the reference's.
fn against_reference(root: &Path, name: &str, picture: &Picture, samples: f64) -> Vec<Report> {
    let reference = |suffix: &str| {
        let file = format!("references/{name}{suffix}.exr");
        read_exr(&root.join(file)).expect("a reference")
    };
    let (mean, variance) = (reference(""), reference("-variance"));
    assert_eq!([mean.width, mean.height], [picture.width, picture.height]);
    let one_sample: Vec<f64> = variance.colour.iter().map(|v| one_sample(*v)).collect();
    let their_noise: Vec<f64> = one_sample.iter().map(|v| v / REFERENCE_SAMPLES).collect();
    let compare_channel = |channel: usize| {
        let of = |layer: &[Rgb<f32>]| -> Vec<f64> {
            let value = |c: &Rgb<f32>| f64::from(c.to_array()[channel]);
            layer.iter().map(value).collect()
        };
        let specula = of(&picture.colour);
        let theirs = of(&mean.colour);
        // Few samples may miss what is rare, and then know nothing of its noise; the reference does.
        let our_noise: Vec<f64> = of(&picture.variance)
            .into_iter()
            .zip(&one_sample)
            .map(|(v, one)| v.max(one / samples))
            .collect();
        let a = NoisyImage {
            width: picture.width as usize,
            mean: &specula,
            variance: &our_noise,
        };
        let b = NoisyImage {
            mean: &theirs,
            variance: &their_noise,
            ..a
        };
        compare(&a, &b, 8, SIGNIFICANCE / 48.0)
    };
    (0..3).map(compare_channel).collect()
}

fn load(path: &Path) -> Scene {
    let loaded = load_as(path, Format::Mitsuba, &LoadOptions::default());
    let loaded = loaded.unwrap_or_else(|e| panic!("{}: {e}", e.place()));
    loaded.scene
}

/// Pictures that are wrong in a small way are told apart: mirrored, 3 % too bright, one pixel.
#[test]
fn wrong_pictures_are_told_apart() {
    let root = specula_testing::scene("mitsuba");
    let name = "textured-diffuse";
    let good = render(&load(&root.join(format!("{name}.xml"))), 64);
    let passes = |picture: &Picture| {
        against_reference(&root, name, picture, 64.0)
            .iter()
            .all(Report::is_pass)
    };
    assert!(passes(&good));
    let mut mirrored = good.clone();
    for row in mirrored.colour.chunks_mut(good.width as usize) {
        row.reverse();
    }
    assert!(!passes(&mirrored), "mirrored");
    let mut bright = good.clone();
    bright.colour.iter_mut().for_each(|c| *c *= 1.03);
    assert!(!passes(&bright), "3 % too bright");
    let mut dotted = good;
    dotted.colour[30 * 48 + 20] = Rgb::splat(9.0);
    assert!(!passes(&dotted), "one pixel");
}

/// Variance of one sample of a pixel of a reference: the largest channel's, and at least what Mitsuba's own
/// test takes for least.
fn one_sample(variance: Rgb<f32>) -> f64 {
    f64::from(variance.max_channel()).max(1e-4)
}

fn render(scene: &Scene, samples: u32) -> Picture {
    let options = RenderOptions::from_scene(scene);
    let prepared = PreparedScene::new(scene, &options).expect("a scene that can be prepared");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(samples, &AtomicBool::new(false));
    assert_eq!(report.invalid_samples, 0, "samples that are not finite");
    renderer.film().picture()
}
