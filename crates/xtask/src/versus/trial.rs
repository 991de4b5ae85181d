//! Renders before the rounds: they choose a renderer's sampler and its number of samples.

use std::path::Path;

use specula_bsdf::Rgb;

use super::plan::Plan;
use super::reference::colours;
use super::renderers::Engine;
use super::statistics::Errors;
use crate::Result;

/// Seed of these renders, and of the one with four times the samples.
pub(crate) const SEED: u32 = 500;
/// Samples of the render that tells the speed; one goes before it, to warm up.
const FIRST_SPP: u32 = 4;

/// With what a renderer goes into the rounds.
pub(crate) struct Choice {
    pub(crate) sampler: &'static str,
    /// As the sampler takes them.
    pub(crate) spp: u32,
    /// Wall seconds that the first render took beyond the samples: kernels, transfer of the scene.
    pub(crate) warm_up: f64,
    /// Samples that were asked for.
    pub(crate) wanted: u32,
    /// What it renders with them, of seed [`SEED`].
    pub(crate) picture: Vec<Rgb<f32>>,
}

/// Finds a renderer's speed, where it is not told the number of samples, and its best sampler.
pub(crate) fn choose(
    plan: &Plan,
    name: &str,
    (engine, samplers): (&mut dyn Engine, &[&'static str]),
    wanted: Option<u32>,
    folder: &Path,
) -> Result<Choice> {
    let file = folder.join(format!("{name}-trial.exr"));
    let start = samplers[0];
    let cold = engine.render(start, 1, SEED, &file)?.wall;
    let warm = engine.render(start, FIRST_SPP, SEED, &file)?;
    let each = |seconds: f64| seconds / f64::from(warm.spp.max(1));
    let wanted = wanted.unwrap_or_else(|| plan.samples(each(plan.seconds_of(warm))));
    let (sampler, spp, picture) = match samplers {
        [only] => {
            let spp = engine.render(only, wanted, SEED, &file)?.spp;
            (*only, spp, colours(&file)?.1)
        }
        samplers => best_sampler(plan, name, (engine, samplers), wanted, folder)?,
    };
    Ok(Choice {
        sampler,
        spp,
        warm_up: (cold - each(warm.wall)).max(0.0),
        wanted,
        picture,
    })
}

/// The sampler of least seconds times squared error, found from two renders with each, of which the
/// quicker tells the time; the samples that it takes where `wanted` are asked for; its first picture.
fn best_sampler(
    plan: &Plan,
    name: &str,
    (engine, samplers): (&mut dyn Engine, &[&'static str]),
    wanted: u32,
    folder: &Path,
) -> Result<(&'static str, u32, Vec<Rgb<f32>>)> {
    let files = [1, 2].map(|i| folder.join(format!("{name}-trial-{i}.exr")));
    let mut best = (f64::INFINITY, samplers[0], wanted, Vec::new());
    for sampler in samplers {
        engine.render(sampler, 1, SEED, &files[0])?;
        let timing = engine.render(sampler, wanted, SEED, &files[0])?;
        let again = engine.render(sampler, wanted, SEED + 1, &files[1])?;
        let (width, a) = colours(&files[0])?;
        let (_, b) = colours(&files[1])?;
        let errors = Errors::of_pair(&a, [&a, &b], width).ok_or("pictures of different sizes")?;
        // What else the machine does only ever adds to a time.
        let seconds = plan.seconds_of(timing).min(plan.seconds_of(again));
        let cost = seconds * errors.trimmed_mse;
        println!(
            "  {name} {sampler}: {} samples, seconds times squared error {cost:.3e}",
            timing.spp
        );
        if cost < best.0 {
            best = (cost, sampler, timing.spp, a);
        }
    }
    let (_, sampler, spp, picture) = best;
    Ok((sampler, spp, picture))
}
