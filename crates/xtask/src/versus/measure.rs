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
    samplers: Vec<&'static str>,
    against: Option<Pair>,
    engine: Box<dyn Engine>,
}

/// Whom a renderer is compared with.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) specula: &'static str,
    /// Most that the means of the references may differ by, as a share.
    pub(crate) tolerance: f64,
}

impl Contestant {
    pub(crate) fn new(
        name: &'static str,
        samplers: &[&'static str],
        engine: impl Engine + 'static,
    ) -> Self {
        Self {
            name,
            samplers: samplers.to_vec(),
            against: None,
            engine: Box::new(engine),
        }
    }

    /// Names the one of us that it is compared with.
    pub(crate) fn against(self, specula: &'static str, tolerance: f64) -> Self {
        Self {
            against: Some(Pair { specula, tolerance }),
            ..self
        }
    }

    /// Leaves only those of its samplers that are named; all of them where none is.
    pub(crate) fn among(mut self, named: &[String]) -> Self {
        let is_named = |sampler: &&str| named.iter().any(|n| n == sampler);
        if self.samplers.iter().any(is_named) {
            self.samplers.retain(is_named);
        }
        self
    }
}

/// One render of a round.
pub(crate) struct Render {
    /// As the clock of the plan says.
    pub(crate) seconds: f64,
    pub(crate) wall: f64,
    pub(crate) cpu: f64,
    /// Against the renderer's own reference, less its errors.
    pub(crate) errors: Errors,
}

/// What came out for one renderer.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) version: String,
    pub(crate) against: Option<Pair>,
    pub(crate) sampler: &'static str,
    /// As the sampler took them, which may be more than it was asked for.
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
    /// Why the comparison does not hold.
    pub(crate) fault: Option<String>,
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
        width = reference.width;
        references.push(reference);
        rows.push(row);
    }
    compare_means(&mut rows);
    let mut first = Vec::new();
    for round in 1..=plan.rounds {
        for (i, contestant) in contestants.iter_mut().enumerate() {
            let row = &mut rows[i];
            let file = folder.join(format!("{}-{round}.exr", row.name));
            let timing = contestant
                .engine
                .render(row.sampler, row.spp, round, &file)?;
            if timing.spp != row.spp {
                let name = row.name;
                return Err(format!("{name} took {} samples, then {}", row.spp, timing.spp).into());
            }
            let seconds = plan.seconds_of(timing);
            if seconds <= 0.0 {
                // pbrt's are a difference, which another program's work can turn round.
                return Err(format!("{} took less than its loading: try again", row.name).into());
            }
            let picture = colours(&file)?.1;
            let render = Render {
                seconds,
                wall: timing.wall,
                cpu: timing.cpu,
                errors: references[i].errors(&picture)?,
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
        let many = references[i].errors(&colours(&file)?.1)?.trimmed_mse;
        let few = mean_of(row, |e| e.trimmed_mse);
        row.rate = rate((f64::from(row.spp), few), (f64::from(timing.spp), many));
    }
    compare_with_others(&mut rows, &references, &first)?;
    let pictures = references
        .into_iter()
        .zip(first)
        .map(|(r, f)| [r.picture, f]);
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

/// Notes where the means of a pair's references differ too much: one of the two renders another scene.
fn compare_means(rows: &mut [Row]) {
    for i in 0..rows.len() {
        let Some(Pair { specula, tolerance }) = rows[i].against else {
            continue;
        };
        let Some(specula) = rows.iter().find(|r| r.name == specula) else {
            continue;
        };
        let apart = rows[i].reference_mean / specula.reference_mean - 1.0;
        // A mean that is not a number is off, too.
        let close = apart.abs() <= tolerance;
        if !close {
            rows[i].fault = Some(format!(
                "{} has {:+.2} % of the light of {}, more than {:.1} % apart",
                rows[i].name,
                100.0 * apart,
                specula.name,
                100.0 * tolerance
            ));
        }
    }
}

/// Of each pair, the first picture of one against the reference of the other.
fn compare_with_others(
    rows: &mut [Row],
    references: &[Reference],
    first: &[Vec<Rgb<f32>>],
) -> Result<()> {
    for i in 0..rows.len() {
        let Some(Pair { specula, .. }) = rows[i].against else {
            continue;
        };
        let Some(j) = rows.iter().position(|r| r.name == specula) else {
            continue;
        };
        rows[i].rmse_of_other = Some(references[j].errors(&first[i])?.mse.sqrt());
        rows[j].rmse_of_other = Some(references[i].errors(&first[j])?.mse.sqrt());
    }
    Ok(())
}

/// The mean of two renders of different seeds.
struct Reference {
    width: usize,
    picture: Vec<Rgb<f32>>,
    /// Its own.
    errors: Errors,
}

impl Reference {
    fn of(halves: &[PathBuf; 2]) -> Result<Self> {
        let (width, a) = colours(&halves[0])?;
        let (_, b) = colours(&halves[1])?;
        let picture: Vec<_> = a.iter().zip(&b).map(|(&a, &b)| (a + b) * 0.5).collect();
        let errors = Errors::of_mean(&picture, [&a, &b]).ok_or("halves of different sizes")?;
        Ok(Self {
            width,
            picture,
            errors,
        })
    }

    /// The errors of a picture, less those of the reference.
    fn errors(&self, picture: &[Rgb<f32>]) -> Result<Errors> {
        let measured = Errors::of(&self.picture, picture).ok_or("pictures of different sizes")?;
        Ok(measured.less(self.errors))
    }
}

/// Finds a renderer's speed, its best sampler and its reference.
fn prepare(
    plan: &Plan,
    contestant: &mut Contestant,
    folder: &Path,
    key: u64,
) -> Result<(Row, Reference)> {
    let name = contestant.name;
    let trial = folder.join(format!("{name}-trial.exr"));
    let engine = &mut *contestant.engine;
    let start = contestant.samplers[0];
    let cold = engine.render(start, 1, TRIAL_SEED, &trial)?.wall;
    let warm = engine.render(start, FIRST_SPP, TRIAL_SEED, &trial)?;
    let each = |seconds: f64| seconds / f64::from(warm.spp.max(1));
    let wanted = samples_for(plan.seconds, each(plan.seconds_of(warm)));
    let (sampler, spp) = match contestant.samplers.as_slice() {
        [only] => (*only, engine.render(only, wanted, TRIAL_SEED, &trial)?.spp),
        samplers => best_sampler(plan, name, (engine, samplers), wanted, folder)?,
    };
    let half = (plan.reference * spp).div_ceil(2);
    let start = format!("{name}-reference-{key:016x}-{sampler}-");
    let (halves, half_spp) = match stored_reference(folder, &start, half)? {
        Some(found) => found,
        None => {
            let mut taken = 0;
            for seed in [REFERENCE_SEED, REFERENCE_SEED + 1] {
                taken = engine.render(sampler, half, seed, &trial)?.spp;
                let [first, second] = half_files(folder, &start, taken);
                let file = if seed == REFERENCE_SEED {
                    first
                } else {
                    second
                };
                fs::rename(&trial, file)?;
            }
            (half_files(folder, &start, taken), taken)
        }
    };
    let reference = Reference::of(&halves)?;
    println!(
        "  {name}: {spp} samples, {sampler}; reference of {}, RMSE {:.5}",
        2 * half_spp,
        reference.errors.mse.sqrt()
    );
    let row = Row {
        name,
        version: engine.version(),
        against: contestant.against,
        sampler,
        spp,
        pixels: reference.picture.len(),
        reference_spp: 2 * half_spp,
        reference_mean: mean(&reference.picture),
        warm_up: (cold - each(warm.wall)).max(0.0),
        renders: Vec::new(),
        rmse_of_other: None,
        rate: f64::NAN,
        fault: None,
    };
    Ok((row, reference))
}

/// The sampler of least seconds times squared error, found from two renders with each, of which the
/// quicker tells the time, and the samples that it takes where `wanted` are asked for.
fn best_sampler(
    plan: &Plan,
    name: &str,
    (engine, samplers): (&mut dyn Engine, &[&'static str]),
    wanted: u32,
    folder: &Path,
) -> Result<(&'static str, u32)> {
    let trials = [1, 2].map(|i| folder.join(format!("{name}-trial-{i}.exr")));
    let mut best = (f64::INFINITY, samplers[0], wanted);
    for sampler in samplers {
        engine.render(sampler, 1, TRIAL_SEED, &trials[0])?;
        let timing = engine.render(sampler, wanted, TRIAL_SEED, &trials[0])?;
        let again = engine.render(sampler, wanted, TRIAL_SEED + 1, &trials[1])?;
        let [a, b] = [colours(&trials[0])?.1, colours(&trials[1])?.1];
        let apart = Errors::of(&a, &b).ok_or("pictures of different sizes")?;
        // What else the machine does only ever adds to a time.
        let seconds = plan.seconds_of(timing).min(plan.seconds_of(again));
        let cost = seconds * 0.5 * apart.trimmed_mse;
        println!(
            "  {name} {sampler}: {} samples, seconds times squared error {cost:.3e}",
            timing.spp
        );
        if cost < best.0 {
            best = (cost, sampler, timing.spp);
        }
    }
    Ok((best.1, best.2))
}

/// Where the halves of a reference lie.
fn half_files(folder: &Path, start: &str, spp: u32) -> [PathBuf; 2] {
    [1, 2].map(|i| folder.join(format!("{start}{spp}-{i}.exr")))
}

/// The halves of a stored reference of at least `wanted` samples each, and how many they have.
fn stored_reference(
    folder: &Path,
    start: &str,
    wanted: u32,
) -> Result<Option<([PathBuf; 2], u32)>> {
    let mut best = None;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let file = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
        let samples = file
            .strip_prefix(start)
            .and_then(|rest| rest.strip_suffix("-2.exr")?.parse().ok());
        if let Some(samples) = samples.filter(|&s: &u32| s >= wanted) {
            best = best.max(Some(samples));
        }
    }
    Ok(best.map(|spp| (half_files(folder, start, spp), spp)))
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

#[cfg(test)]
mod tests {
    use specula_render::picture::{Metadata, Picture, write_exr};

    use super::super::scenes::SCENES;
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
        let folder = scratch("stored");
        for (key, spp) in [(1, 64), (1, 512), (1, 128), (2, 4096)] {
            for file in half_files(&folder, &format!("a-{key}-"), spp) {
                fs::write(file, "").unwrap();
            }
        }
        let found = |key, wanted| stored_reference(&folder, &format!("a-{key}-"), wanted).unwrap();
        assert_eq!(found(1, 100).unwrap().1, 512);
        assert!(found(1, 1000).is_none());
        assert!(found(3, 1).is_none());
        fs::remove_dir_all(folder).unwrap();
        assert_ne!(key(b"a"), key(b"b"));
    }

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("versus-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    /// Paints noise of variance `1 / spp` around a radiance; its "square" sampler rounds up as
    /// Mitsuba's do, its "bad" one has ten times the variance, and its "held up" one half of it, but ten
    /// times the seconds at its first trial.
    struct Painter {
        radiance: f32,
    }

    const SIDE: u32 = 64;

    impl Engine for Painter {
        fn render(&mut self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
            let spp = match sampler {
                "square" => (1..).map(|i| i * i).find(|&s| s >= spp).unwrap(),
                _ => spp,
            };
            let share = match sampler {
                "bad" => 10.0,
                "held up" => 0.5,
                _ => 1.0,
            };
            let variance = share / f64::from(spp);
            let held_up = sampler == "held up" && seed == TRIAL_SEED;
            let each = if held_up { 0.01 } else { 0.001 };
            // Even in [-1, 1]: variance 1/3.
            let spread = (3.0 * variance).sqrt();
            let pixel = |i: u32| {
                let unit = key(&[i, seed, spp, self.radiance.to_bits()]
                    .map(u32::to_le_bytes)
                    .concat());
                let even = (unit >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
                #[allow(clippy::cast_possible_truncation, reason = "a picture's precision")]
                let noise = (spread * even) as f32;
                Rgb::splat(self.radiance + noise)
            };
            let picture = Picture::from_colour(SIDE, SIDE, (0..SIDE * SIDE).map(pixel).collect());
            write_exr(target, &picture, &Metadata::default())?;
            Ok(Timing {
                wall: each * f64::from(spp),
                cpu: 2.0 * each * f64::from(spp),
                spp,
            })
        }

        fn version(&self) -> String {
            "painter".to_owned()
        }
    }

    fn outcome(name: &str, radiance: f32, samplers: &[&'static str]) -> Outcome {
        let folder = scratch(name);
        let plan = Plan {
            rounds: 3,
            seconds: 0.008,
            reference: 4,
            threads: 2,
            clock: Clock::Wall,
        };
        let contestants = vec![
            Contestant::new("specula", &["sobol"], Painter { radiance: 10.0 }),
            Contestant::new("theirs", samplers, Painter { radiance }).against("specula", 0.005),
        ];
        let outcome = run(&SCENES[0], &plan, contestants, &folder, 1).unwrap();
        fs::remove_dir_all(folder).unwrap();
        outcome
    }

    #[test]
    fn errors_are_those_of_the_picture_alone() {
        // Against a reference of four times the samples a quarter would come on top.
        let found = outcome("alone", 10.0, &["plain"]);
        for row in &found.rows {
            assert_eq!((row.spp, row.reference_spp), (8, 32));
            for render in &row.renders {
                assert!(
                    (8.0 * render.errors.mse - 1.0).abs() < 0.08,
                    "{:?}",
                    render.errors
                );
            }
            assert!((row.rate - 0.5).abs() < 0.06, "{}", row.rate);
            assert_eq!(row.fault, None);
        }
    }

    #[test]
    fn the_best_sampler_makes_the_reference_and_is_charged_with_what_it_took() {
        let found = outcome("sampler", 10.0, &["bad", "square", "bad"]);
        let row = &found.rows[1];
        assert_eq!((row.sampler, row.spp), ("square", 9));
        // Halves of 18, which become 25.
        assert_eq!(row.reference_spp, 50);
        assert!((row.renders[0].seconds - 0.009).abs() < 1e-9);
    }

    #[test]
    fn a_sampler_that_was_held_up_once_is_not_charged_with_it() {
        let found = outcome("held-up", 10.0, &["plain", "held up"]);
        assert_eq!(found.rows[1].sampler, "held up");
    }

    #[test]
    fn samplers_that_are_named_are_all_that_is_left_of_a_renderers() {
        let left = |named: &[&str]| {
            let named: Vec<String> = named.iter().map(ToString::to_string).collect();
            Contestant::new(
                "any",
                &["plain", "square", "bad"],
                Painter { radiance: 1.0 },
            )
            .among(&named)
            .samplers
        };
        assert_eq!(left(&["bad", "plain", "adaptive"]), ["plain", "bad"]);
        assert_eq!(left(&["adaptive"]), ["plain", "square", "bad"]);
        assert_eq!(left(&[]), ["plain", "square", "bad"]);
    }

    #[test]
    fn a_peer_with_one_per_cent_more_light_is_reported() {
        let found = outcome("brighter", 10.1, &["plain"]);
        let fault = found.rows[1].fault.as_ref().unwrap();
        assert!(fault.contains("theirs has +1.0"), "{fault}");
    }
}
