// Rough metals.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, bsdf_sample_reflected};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d_along, microfacets_g_over_cos, microfacets_g_over_cos_quotient, microfacets_norm, microfacets_norm_quotient, microfacets_sample_reflection};
import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval};

/// Single scattering off a rough metal (Cook and Torrance 1982, with Smith masking):
///
///     f = F(wo . wm) G2(wo, wi) D(wm) / (4 |wo.z| |wi.z|),   wm ~ wo + wi
///
/// Reciprocal above the horizon. For backfacing views (`wo.z < 0`) it is continued as
/// `microfacets_g_over_cos` says.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor.
struct RoughConductor {
    /// Its facets.
    facets: MicrofacetsModel,
    /// What a facet reflects.
    reflectance: ReflectanceModel,
}

/// `D` of the facet that reflects `wo` into `wi`, and the cosine between either and its normal: the
/// normal is `h / |h|` with `h = wo + wi`, and `wo . wm = |h| / 2`.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor::facet.
fn rough_conductor_facet(facets: MicrofacetsModel, wo: vec3f, wi: vec3f) -> vec2f {
    let half_vector = wo + wi;
    let squared = dot(half_vector, half_vector);
    return vec2f(microfacets_d_along(facets, half_vector, squared), 0.5 * sqrt(squared));
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor::evaluate.
fn rough_conductor_eval_pdf(lobe: RoughConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if wi.z <= 0.0 || wo.z + wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let facet = rough_conductor_facet(lobe.facets, wo, wi);
    let quarter = 0.25 * facet.x;
    let norm = microfacets_norm_quotient(lobe.facets, wo);
    let shadowed = microfacets_g_over_cos(lobe.facets, wo, wi);
    let f_cos = reflectance_eval(lobe.reflectance, facet.y) * (quarter * shadowed);
    return vec4f(f_cos, quarter * norm.y / norm.x);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor::eval.
fn rough_conductor_eval(lobe: RoughConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return rough_conductor_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `rough_conductor_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor::pdf.
fn rough_conductor_pdf(lobe: RoughConductor, wo: vec3f, wi: vec3f) -> f32 {
    if wi.z <= 0.0 || wo.z + wi.z <= 0.0 {
        return 0.0;
    }
    let norm = microfacets_norm_quotient(lobe.facets, wo);
    return rough_conductor_facet(lobe.facets, wo, wi).x * norm.y / (4.0 * norm.x);
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor::sample.
fn rough_conductor_sample(lobe: RoughConductor, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    let norm = microfacets_norm(lobe.facets, wo);
    let facet = rough_conductor_facet(lobe.facets, wo, wi);
    // weight = F N G2 / |cos_o| and pdf = D / (4 N) with one division.
    let quotient = microfacets_g_over_cos_quotient(lobe.facets, wo, wi);
    let inverse = 1.0 / max(norm * quotient.y, BSDF_SAMPLE_TINY);
    let weight = reflectance_eval(lobe.reflectance, facet.y) * (norm * norm * quotient.x * inverse);
    return bsdf_sample_reflected(wi, weight, 0.25 * facet.x * quotient.y * inverse);
}
