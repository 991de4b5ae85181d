//! Renders before the rounds: they choose a renderer's sampler and its number of samples.

use std::path::Path;

use specula_bsdf::Rgb;

use super::plan::Plan;
use super::reference::colours;
use super::renderers::{Engine, Timing};
use super::statistics::Errors;
use crate::Result;

/// Seed of these renders, and of the one with four times the samples.
pub(crate) const SEED: u32 = 500;
/// Samples of the first render that tells the speed; one goes before it, to warm up.
const FIRST_SPP: u32 = 4;
/// Share of the time that a render should take from which on its speed counts.
const LONG_ENOUGH: f64 = 0.25;
/// Most samples of a render that tells the speed.
const MOST_SPP: u32 = 1 << 12;

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
    let wanted = match wanted {
        Some(wanted) => wanted,
        None => plan.samples(seconds_of_a_sample(plan, engine, (start, warm), &file)?),
    };
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
        warm_up: (cold - warm.wall / f64::from(warm.spp.max(1))).max(0.0),
        wanted,
        picture,
    })
}

/// Seconds that one more sample takes in long renders: a part of a render's time does not depend on its samples, on a
/// GPU the greater part of a short one.
///
/// * `warm`: a render of few samples.
fn seconds_of_a_sample(
    plan: &Plan,
    engine: &mut dyn Engine,
    (sampler, warm): (&'static str, Timing),
    file: &Path,
) -> Result<f64> {
    let (mut few, mut many) = (None, warm);
    while plan.seconds_of(many) < LONG_ENOUGH * plan.seconds && many.spp < MOST_SPP {
        let more = engine.render(sampler, 4 * many.spp.max(1), SEED, file)?;
        few = Some(std::mem::replace(&mut many, more));
    }
    let seconds = plan.seconds_of(many);
    let average = seconds / f64::from(many.spp.max(1));
    let slope = few.map(|few| {
        (seconds - plan.seconds_of(few)) / f64::from(many.spp.saturating_sub(few.spp).max(1))
    });
    // Noise can make the longer render the quicker one.
    Ok(slope.filter(|slope| *slope > 0.0).unwrap_or(average))
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

#[cfg(test)]
mod tests {
    use super::super::Clock;
    use super::*;

    /// Seconds of a render but for its samples, and of a sample.
    struct Steady(f64, f64);

    impl Engine for Steady {
        fn render(&mut self, _: &str, spp: u32, _: u32, _: &Path) -> Result<Timing> {
            let wall = self.0 + self.1 * f64::from(spp);
            Ok(Timing {
                wall,
                cpu: wall,
                spp,
            })
        }

        fn version(&self) -> String {
            String::new()
        }
    }

    #[test]
    fn what_every_render_costs_is_not_counted_as_samples() {
        let plan = Plan {
            rounds: 2,
            seconds: 2.0,
            reference: 8,
            threads: 1,
            clock: Clock::Wall,
        };
        for (fixed, each) in [(0.0, 0.1), (0.4, 1e-3), (0.01, 3e-4), (0.0, 10.0)] {
            let mut engine = Steady(fixed, each);
            let file = Path::new("none");
            let warm = engine.render("", FIRST_SPP, SEED, file).unwrap();
            let found = seconds_of_a_sample(&plan, &mut engine, ("", warm), file).unwrap();
            assert!((found / each - 1.0).abs() < 1e-6, "{fixed} {each}: {found}");
        }
    }
}
