//! `Integrator`, `Sampler` and `Accelerator`.

use super::OptionEntities;
use crate::energy::Energy;
use crate::error::{ErrorKind, SceneError};
use crate::num::shorten;
use crate::pbrt::context::{Context, Entity};
use crate::scene::Settings;

/// Integrators of pbrt-v4 with the picture that a path tracer makes.
const SAME_PICTURE: [&str; 4] = ["path", "volpath", "bdpt", "mlt"];

/// Those whose picture differs.
const OTHER_PICTURE: [&str; 7] = [
    "ambientocclusion",
    "function",
    "lightpath",
    "randomwalk",
    "simplepath",
    "simplevolpath",
    "sppm",
];

/// Every sampler gives the same picture in the limit.
const SAMPLERS: [&str; 7] = [
    "halton",
    "independent",
    "paddedsobol",
    "pmj02bn",
    "sobol",
    "stratified",
    "zsobol",
];

/// Most samples per pixel.
const MOST: u32 = 1 << 24;

/// Reads what the file asks of the renderer.
pub(super) fn read(
    context: &mut Context,
    options: &OptionEntities,
) -> Result<Settings, SceneError> {
    let mut settings = Settings {
        max_depth: 5,
        samples_per_pixel: 16,
        hide_emitters: false,
        energy: Energy::None,
    };
    if let Some(entity) = options.get("Integrator") {
        let depth = integrator(context, entity);
        settings.max_depth = entity.or(depth, || 5)?;
    }
    if let Some(entity) = options.get("Sampler") {
        let samples = sampler(context, entity);
        settings.samples_per_pixel = entity.or(samples, || 16)?;
    }
    if let Some(entity) = options.get("Accelerator") {
        // How rays are traced changes no picture.
        let names = ["maxnodeprims", "splitmethod", "intersectcost", "maxprims"];
        entity.params.ignore(&names);
        let names = ["traversalcost", "emptybonus", "maxdepth"];
        entity.params.ignore(&names);
        context.warn_unused(&entity.params);
    }
    Ok(settings)
}

fn unknown(entity: &Entity, what: &str, names: &[&str]) -> SceneError {
    let message = format!("unknown {what} \"{}\"", shorten(&entity.name));
    let error = SceneError::new(ErrorKind::Parameter, &entity.place, message);
    error.with_help(format!("expected one of {}", names.join(", ")))
}

fn integrator(context: &mut Context, entity: &Entity) -> Result<u32, SceneError> {
    let (params, name) = (&entity.params, entity.name.as_str());
    if OTHER_PICTURE.contains(&name) {
        let message = format!("integrator \"{name}\" is not supported: paths are traced");
        context.warn(&entity.place, message);
    } else if !SAME_PICTURE.contains(&name) {
        let all = [SAME_PICTURE.as_slice(), OTHER_PICTURE.as_slice()].concat();
        return Err(unknown(entity, "integrator", &all));
    }
    let max_depth = params.integer_within("maxdepth", 5, 0..=1_000_000)?;
    if params.bool("regularize", false)? {
        let message = "paths are not regularized: caustics stay noisy";
        context.warn(&params.place_of("regularize"), message);
    }
    // How lights are chosen, paths are ended and photons are counted is the renderer's affair.
    params.ignore(&["lightsampler", "rrthreshold", "visualizestrategies"]);
    params.ignore(&["visualizeweights", "bootstrapsamples", "chains"]);
    params.ignore(&["mutationsperpixel", "largestepprobability", "sigma"]);
    params.ignore(&["photonsperiteration", "radius", "seed", "samplelights"]);
    params.ignore(&["samplebsdf", "cossample", "maxdistance", "function"]);
    context.warn_unused(params);
    Ok(max_depth)
}

fn sampler(context: &mut Context, entity: &Entity) -> Result<u32, SceneError> {
    let params = &entity.params;
    if !SAMPLERS.contains(&entity.name.as_str()) {
        return Err(unknown(entity, "sampler", &SAMPLERS));
    }
    let samples = if entity.name == "stratified" {
        let side = |name: &str| params.integer_within(name, 4, 1..=4096);
        side("xsamples")? * side("ysamples")?
    } else {
        params.integer_within("pixelsamples", 16, 1..=MOST)?
    };
    params.ignore(&["seed", "randomization", "jitter"]);
    context.warn_unused(params);
    Ok(samples)
}
