// A coat with a medium over a base, by random walks between the two: lacquered metal, painted wood with a
// cloudy varnish.
//
// Position-free transport between parallel interfaces (Guo, Hasan and Zhao 2018), as in pbrt-v4's
// `LayeredBxDF` (Pharr, Jakob and Humphreys 2023, 14.3): light passes the coat or is reflected; below,
// it crosses a slab of optical thickness `t`, attenuated to `exp(-t / |cos|)` or scattered in it, meets base
// and coat in turn, and ends after a number of events. Each surface scatters singly (Cook and Torrance),
// so what a rough one scatters twice is lost.
//
// Values are unbiased estimates. Departure from the Rust source: the caller always passes a stream.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_SPECULAR, BsdfSample, bsdf_sample_delta, bsdf_sample_none, bsdf_sample_reflected};
import package::bsdf::layered::layered_base::{LAYERED_BASE_DIFFUSE, LAYERED_BASE_METAL, LayeredBase, layered_base_reflectance};
import package::bsdf::layered::layered_coat::{LayeredCoat, layered_coat_reflection};
import package::bsdf::layered::layered_density::{layered_density_blurred, layered_density_pdf};
import package::bsdf::layered::layered_lobe::{LAYERED_LOBE_MOST_EVENTS, LayeredLobe, layered_lobe_is_mirror, layered_lobe_mirrored};
import package::bsdf::layered::layered_medium::{LayeredMedium};
import package::bsdf::layered::layered_walk::{layered_walk_sample, layered_walk_eval};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::fresnel::reflectance::{reflectance_under};
import package::math::stream::{StreamState};
import package::ndf::distribution::{DISTRIBUTION_GGX};
import package::ndf::masking::{MASKING_HEIGHT_CORRELATED};
import package::vndf::sampler::{SAMPLER_CAP};

/// A coat over a base, of values that are one walk each and followed until they leave: set `max_depth` and
/// `walks` for others.
///
/// * `coat`: alphas of the coat's normals (GGX); `rough`: whether it has any.
/// * `eta`: index of the coat over that outside, clamped to [1, 3].
/// * `base`: its reflectance against vacuum; an index is made relative to the coat's.
/// * `medium`: between them; thickness 0 where there is none.
/// * `strategy`: one of `SAMPLER_HEITZ`, `SAMPLER_CAP`, `SAMPLER_BOUNDED` and `SAMPLER_EXACT`, by which the
///   metal's reflections are sampled.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::new.
fn layered_new(
    coat: vec2f,
    rough: bool,
    eta: f32,
    base: LayeredBase,
    medium: LayeredMedium,
    strategy: u32,
) -> LayeredLobe {
    var lobe: LayeredLobe;
    let index = clamp(eta, 1.0, 3.0);
    // With equal indices nothing is bent, however rough.
    let is_rough = rough && index > 1.001;
    let facets = MicrofacetsModel(coat, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_CAP);
    lobe.coat = LayeredCoat(facets, select(0u, 1u, is_rough), index);
    lobe.base = base;
    lobe.base.reflectance = reflectance_under(base.reflectance, index);
    lobe.base.facets.strategy = strategy;
    lobe.medium = LayeredMedium(
        clamp(medium.thickness, 0.0, 1e6),
        clamp(medium.albedo, vec3f(0.0), vec3f(1.0)),
        clamp(medium.g, -0.99, 0.99),
    );
    let is_metal = base.kind == LAYERED_BASE_METAL;
    lobe.blurred = lobe.base.facets;
    if is_rough {
        lobe.blurred = layered_density_blurred(lobe.base.facets, is_metal, facets, index);
    }
    lobe.blurred.strategy = strategy;
    lobe.has_lobe = select(0u, 1u, base.kind != LAYERED_BASE_DIFFUSE && (is_metal || is_rough));
    lobe.max_depth = LAYERED_LOBE_MOST_EVENTS;
    lobe.walks = 1u;
    lobe.strategy = strategy;
    return lobe;
}

/// An estimate of `f |cos|`, without Dirac deltas.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::eval_pdf_random.
fn layered_eval(lobe: LayeredLobe, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    if wi.z <= 0.0 || layered_lobe_is_mirror(lobe) {
        return vec3f(0.0);
    }
    var sum = vec3f(0.0);
    for (var k = 0u; k < lobe.walks; k++) {
        sum += layered_walk_eval(lobe, wo, wi, stream);
    }
    let share = 1.0 / f32(lobe.walks);
    return vec3f(layered_coat_reflection(lobe.coat, wo, wi)) + sum * share;
}

/// The density for multiple importance sampling, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::pdf.
fn layered_pdf(lobe: LayeredLobe, wo: vec3f, wi: vec3f) -> f32 {
    return layered_density_pdf(lobe, wo, wi);
}

/// An estimate of `f |cos|` and the density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::eval_pdf_random.
fn layered_eval_pdf(lobe: LayeredLobe, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec4f {
    let value = layered_eval(lobe, wo, wi, stream);
    return vec4f(value, layered_density_pdf(lobe, wo, wi));
}

/// A direction of the walk with the density for multiple importance sampling.
///
/// * `u`: samples what happens at the coat first.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::sample_random.
fn layered_sample(lobe: LayeredLobe, wo: vec3f, u: vec3f, stream: ptr<function, StreamState>) -> BsdfSample {
    if layered_lobe_is_mirror(lobe) {
        if wo.z <= 0.0 {
            return bsdf_sample_none();
        }
        let mirrored = vec3f(-wo.x, -wo.y, wo.z);
        return bsdf_sample_delta(mirrored, layered_lobe_mirrored(lobe, wo), 1.0, 0u, 1.0);
    }
    let left = layered_walk_sample(lobe, wo, u, stream);
    if left.flags == 0u || left.wi.z <= 0.0 {
        return bsdf_sample_none();
    }
    if (left.flags & BSDF_SAMPLE_SPECULAR) != 0u {
        return bsdf_sample_delta(left.wi, left.weight, 1.0, 0u, 1.0);
    }
    return bsdf_sample_reflected(left.wi, left.weight, layered_density_pdf(lobe, wo, left.wi));
}

/// Hemispherical colour, in [0, 1]; an approximation.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::albedo.
fn layered_albedo(lobe: LayeredLobe) -> vec3f {
    return layered_base_reflectance(lobe.base, 2.0 / 3.0);
}
