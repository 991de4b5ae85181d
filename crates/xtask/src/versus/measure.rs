//! Renders in turn, and what they tell.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use specula_bsdf::Rgb;
use specula_render::picture::read_exr;

use super::Clock;
use super::renderers::{Engine, Timing};
use super::scenes::SceneFile;
use super::statistics::{Errors, mean, rate};
use crate::Result;

/// Seed of the references; the rounds have 1, 2, 3 and so on.
const REFERENCE_SEED: u32 = 1000;
/// Seed of the renders that choose a sampler, and of the one with four times the samples.
const TRIAL_SEED: u32 = 500;
/// Samples of the render that tells the speed; one goes before it, to warm up.
const FIRST_SPP: u32 = 4;

/// How much is rendered.
pub(crate) struct Plan {
    pub(crate) rounds: u32,
    pub(crate) seconds: f64,
    pub(crate) reference: u32,
    pub(crate) threads: u32,
    pub(crate) clock: Clock,
}

impl Plan {
    /// The seconds that are compared.
    fn seconds_of(&self, timing: Timing) -> f64 {
        match self.clock {
            Clock::Wall => timing.wall,
            Clock::Cpu => timing.cpu / f64::from(self.threads),
        }
    }
}

/// A renderer with its scene.
pub(crate) struct Contestant {
    name: &'static str,
    samplers: &'static [&'static str],
    against: Option<&'static str>,
    engine: Box<dyn Engine>,
}

impl Contestant {
    pub(crate) fn new(
        name: &'static str,
        samplers: &'static [&'static str],
        engine: impl Engine + 'static,
    ) -> Self {
        Self {
            name,
            samplers,
            against: None,
            engine: Box::new(engine),
        }
    }

    /// Names the one of us that it is compared with.
    pub(crate) fn against(self, ours: &'static str) -> Self {
        Self {
            against: Some(ours),
            ..self
        }
    }
}

/// One render of a round.
pub(crate) struct Render {
    /// As the clock of the plan says.
    pub(crate) seconds: f64,
    pub(crate) wall: f64,
    pub(crate) cpu: f64,
    /// Against the renderer's own reference.
    pub(crate) errors: Errors,
}

/// What came out for one renderer.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) version: String,
    pub(crate) against: Option<&'static str>,
    pub(crate) sampler: &'static str,
    pub(crate) spp: u32,
    pub(crate) pixels: usize,
    pub(crate) reference_spp: u32,
    pub(crate) reference_mean: f64,
    /// Wall seconds that the first render took beyond the samples: kernels, transfer of the scene.
    pub(crate) warm_up: f64,
    pub(crate) renders: Vec<Render>,
    /// Of the first round, against the reference of the other of the pair.
    pub(crate) rmse_of_other: Option<f64>,
    /// The exponent of the error's fall, to four times the samples.
    pub(crate) rate: f64,
}

/// A scene's rows and pictures.
pub(crate) struct Outcome {
    pub(crate) scene: &'static SceneFile,
    pub(crate) rows: Vec<Row>,
    /// Width, and for each row its reference and its picture of the first round.
    pub(crate) width: usize,
    pub(crate) pictures: Vec<[Vec<Rgb<f32>>; 2]>,
}

/// A short name of a scene's text, so that references of another are not taken for its.
pub(crate) fn key(text: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

/// Everything about one scene.
pub(crate) fn run(
    scene: &'static SceneFile,
    plan: &Plan,
    mut contestants: Vec<Contestant>,
    folder: &Path,
    key: u64,
) -> Result<Outcome> {
    fs::create_dir_all(folder)?;
    let (mut rows, mut references, mut width) = (Vec::new(), Vec::new(), 0);
    for contestant in &mut contestants {
        let (row, reference) = prepare(plan, contestant, folder, key)?;
        width = reference.0;
        references.push(reference.1);
        rows.push(row);
    }
    let mut first = Vec::new();
    for round in 1..=plan.rounds {
        for (i, contestant) in contestants.iter_mut().enumerate() {
            let row = &mut rows[i];
            let file = folder.join(format!("{}-{round}.exr", row.name));
            let timing = contestant
                .engine
                .render(row.sampler, row.spp, round, &file)?;
            let picture = colours(&file)?.1;
            let render = Render {
                seconds: plan.seconds_of(timing),
                wall: timing.wall,
                cpu: timing.cpu,
                errors: errors(&references[i], &picture)?,
            };
            println!(
                "{round} {:<13} {:6.2} s wall, {:6.2} s CPU, RMSE {:.4}",
                row.name,
                timing.wall,
                timing.cpu,
                render.errors.mse.sqrt()
            );
            row.renders.push(render);
            if round == 1 {
                first.push(picture);
            }
        }
    }
    for (i, contestant) in contestants.iter_mut().enumerate() {
        let row = &mut rows[i];
        let file = folder.join(format!("{}-x4.exr", row.name));
        let timing = contestant
            .engine
            .render(row.sampler, 4 * row.spp, TRIAL_SEED, &file)?;
        let many = errors(&references[i], &colours(&file)?.1)?.trimmed_mse;
        let few = mean_of(row, |e| e.trimmed_mse);
        row.rate = rate(
            (f64::from(row.spp), few),
            (f64::from(timing.spp), many),
            f64::from(row.reference_spp),
        );
    }
    compare_with_others(&mut rows, &references, &first)?;
    let pictures = references.into_iter().zip(first).map(|(r, f)| [r, f]);
    Ok(Outcome {
        scene,
        rows,
        width,
        pictures: pictures.collect(),
    })
}

/// The mean of an error over the rounds.
fn mean_of(row: &Row, of: impl Fn(&Errors) -> f64) -> f64 {
    row.renders.iter().map(|r| of(&r.errors)).sum::<f64>() / row.renders.len() as f64
}

/// Of each pair, the first picture of one against the reference of the other.
fn compare_with_others(
    rows: &mut [Row],
    references: &[Vec<Rgb<f32>>],
    first: &[Vec<Rgb<f32>>],
) -> Result<()> {
    for i in 0..rows.len() {
        let Some(ours) = rows[i].against else {
            continue;
        };
        let Some(j) = rows.iter().position(|r| r.name == ours) else {
            continue;
        };
        rows[i].rmse_of_other = Some(errors(&references[j], &first[i])?.mse.sqrt());
        rows[j].rmse_of_other = Some(errors(&references[i], &first[j])?.mse.sqrt());
    }
    Ok(())
}

type Reference = (usize, Vec<Rgb<f32>>);

/// Finds a renderer's speed, its reference and its best sampler.
fn prepare(
    plan: &Plan,
    contestant: &mut Contestant,
    folder: &Path,
    key: u64,
) -> Result<(Row, Reference)> {
    let name = contestant.name;
    let trial = folder.join(format!("{name}-trial.exr"));
    let engine = &mut contestant.engine;
    let start = contestant.samplers[0];
    let cold = engine.render(start, 1, TRIAL_SEED, &trial)?.wall;
    let warm = engine.render(start, FIRST_SPP, TRIAL_SEED, &trial)?;
    let each = |seconds: f64| seconds / f64::from(FIRST_SPP);
    let spp = samples_for(plan.seconds, each(plan.seconds_of(warm)));
    let wanted = plan.reference * spp;
    let (file, reference_spp) = match kept_reference(folder, name, key, wanted)? {
        Some(found) => found,
        None => {
            let file = folder.join(format!("{name}-reference-{key:016x}-{wanted}.exr"));
            engine.render(start, wanted, REFERENCE_SEED, &trial)?;
            fs::rename(&trial, &file)?;
            (file, wanted)
        }
    };
    let reference = colours(&file)?;
    let mut best = (f64::INFINITY, start, spp);
    let samplers = contestant.samplers;
    for sampler in samplers.iter().take(if samplers.len() > 1 {
        samplers.len()
    } else {
        0
    }) {
        engine.render(sampler, 1, TRIAL_SEED, &trial)?;
        let timing = engine.render(sampler, spp, TRIAL_SEED, &trial)?;
        let error = errors(&reference.1, &colours(&trial)?.1)?;
        let cost = plan.seconds_of(timing) * error.trimmed_mse;
        println!("  {name} {sampler}: seconds times squared error {cost:.5}");
        if cost < best.0 {
            best = (cost, sampler, timing.spp);
        }
    }
    println!(
        "  {name}: {} samples, {}; reference {reference_spp}",
        best.2, best.1
    );
    let row = Row {
        name,
        version: engine.version(),
        against: contestant.against,
        sampler: best.1,
        spp: best.2,
        pixels: reference.1.len(),
        reference_spp,
        reference_mean: mean(&reference.1),
        warm_up: (cold - each(warm.wall)).max(0.0),
        renders: Vec::new(),
        rmse_of_other: None,
        rate: f64::NAN,
    };
    Ok((row, reference))
}

/// A kept reference of at least `wanted` samples, and how many it has.
fn kept_reference(
    folder: &Path,
    name: &str,
    key: u64,
    wanted: u32,
) -> Result<Option<(PathBuf, u32)>> {
    let start = format!("{name}-reference-{key:016x}-");
    let mut best = None;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let file = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
        let samples = file
            .strip_prefix(&start)
            .and_then(|rest| rest.strip_suffix(".exr")?.parse().ok());
        if let Some(samples) = samples.filter(|&s: &u32| s >= wanted) {
            best = best.max(Some((samples, path)));
        }
    }
    Ok(best.map(|(samples, path)| (path, samples)))
}

/// The power of two whose time is nearest by ratio.
fn samples_for(seconds: f64, seconds_per_sample: f64) -> u32 {
    let exponent = (seconds / seconds_per_sample.max(1e-9)).log2().round();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=14"
    )]
    let exponent = exponent.clamp(0.0, 14.0) as u32;
    1 << exponent
}

fn colours(path: &Path) -> Result<(usize, Vec<Rgb<f32>>)> {
    let picture = read_exr(path)?;
    Ok((picture.width as usize, picture.colour))
}

fn errors(reference: &[Rgb<f32>], picture: &[Rgb<f32>]) -> Result<Errors> {
    Errors::of(reference, picture).ok_or_else(|| "pictures of different sizes".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_the_time() {
        assert_eq!(samples_for(3.0, 0.1), 32);
        assert_eq!(samples_for(3.0, 0.15), 16);
        assert_eq!(samples_for(3.0, 100.0), 1);
        assert_eq!(samples_for(3.0, 0.0), 1 << 14);
    }

    #[test]
    fn references_of_another_scene_or_too_few_samples_are_not_taken() {
        let folder = std::env::temp_dir().join(format!("versus-kept-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        for (key, spp) in [(1, 64), (1, 512), (1, 128), (2, 4096)] {
            fs::write(folder.join(format!("a-reference-{key:016x}-{spp}.exr")), "").unwrap();
        }
        let found = |key, wanted| kept_reference(&folder, "a", key, wanted).unwrap();
        assert_eq!(found(1, 100).unwrap().1, 512);
        assert_eq!(found(1, 1000), None);
        assert_eq!(found(3, 1), None);
        fs::remove_dir_all(folder).unwrap();
        assert_ne!(key(b"a"), key(b"b"));
    }
}
