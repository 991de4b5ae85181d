// Many reflections of one view: what does not depend on the sample is computed once.
//
// All samplers share the density `D(wm) / (4 N(wo))`. With `N` stored, a density costs `D` alone: no square
// root and one division. For anisotropic alphas the cone of `exact` is stored as well, which is most of a sample's
// cost. Worth it from the second use of a view on: several light samples at a shading point,
// resampling, mixtures with guided distributions.

import package::vndf::exact_chords::{exact_chords_half_vector};
import package::vndf::exact_cone::{ExactCone, exact_cone_new, exact_cone_norm};
import package::vndf::half_vector::{half_vector_density, half_vector_mirrored};
import package::vndf::reflection::{reflection_norm_quotient, reflection_sample_direction};
import package::vndf::sampler::{SAMPLER_EXACT};

/// The reflections of one view off visible GGX normals.
///
/// Twin: specula-bsdf/src/vndf/reflections.rs, Reflections.
struct ReflectionsSampler {
    /// The alphas.
    alpha: vec2f,
    /// One of the samplers of `sampler`.
    strategy: u32,
    /// `N`, in which the samplers differ.
    norm: f32,
    /// The view, unit.
    wo: vec3f,
    /// Whether samples use the cone.
    has_cone: bool,
    /// The valid half vectors, where a sample needs them.
    cone: ExactCone,
}

/// The reflections of `wo`.
///
/// * `wo`: unit, any hemisphere; below the horizon all samplers sample by the whole cap.
///
/// Twin: specula-bsdf/src/vndf/reflections.rs, Reflections::new.
fn reflections_new(alpha: vec2f, wo: vec3f, strategy: u32) -> ReflectionsSampler {
    var reflections: ReflectionsSampler;
    reflections.alpha = alpha;
    reflections.strategy = strategy;
    reflections.wo = wo;
    reflections.has_cone = strategy == SAMPLER_EXACT && wo.z > 0.0 && alpha.x != alpha.y;
    var norm: vec2f;
    if reflections.has_cone {
        reflections.cone = exact_cone_new(alpha, wo);
        norm = exact_cone_norm(reflections.cone);
    } else {
        norm = reflection_norm_quotient(strategy, alpha, wo);
    }
    reflections.norm = norm.x / norm.y;
    return reflections;
}

/// A reflection, perhaps below the horizon (never, but for rounding, with `SAMPLER_EXACT`).
///
/// * `u`: uniform in [0, 1)^2, as the sampler's own function takes it.
///
/// Twin: specula-bsdf/src/vndf/reflections.rs, Reflections::sample_direction.
fn reflections_sample_direction(reflections: ReflectionsSampler, u: vec2f) -> vec3f {
    if reflections.has_cone {
        let m = exact_chords_half_vector(reflections.alpha, reflections.cone, u);
        return half_vector_mirrored(reflections.wo, m);
    }
    return reflection_sample_direction(reflections.strategy, reflections.alpha, reflections.wo, u);
}

/// Density of `reflections_sample_direction` in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/reflections.rs, Reflections::pdf.
fn reflections_pdf(reflections: ReflectionsSampler, wi: vec3f) -> f32 {
    return half_vector_density(reflections.alpha, reflections.wo, wi, vec2f(reflections.norm, 1.0));
}
