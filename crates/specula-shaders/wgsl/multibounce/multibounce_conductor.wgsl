// A rough metal with all its bounces, by one of the models.
//
// Values are estimates from a stream of random numbers. Samples are the walk's; their true density is not
// known, and that of `mis_pdf` takes its place for the weights of multiple importance sampling (any
// positive function serves there: the weights of two strategies sum to 1 whatever it is).
//
// Departure from the Rust source: the caller always passes a stream.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_reflected};
import package::math::stream::{StreamState};
import package::multibounce::bitterli2022::{bitterli2022_eval};
import package::multibounce::cui2023::{cui2023_sample, cui2023_eval, cui2023_eval_bidirectional};
import package::multibounce::heitz2016::{heitz2016_sample, heitz2016_eval};
import package::multibounce::mis_pdf::{mis_pdf_reflection};
import package::multibounce::multibounce_model::{MULTIBOUNCE_MODEL_BITTERLI, MULTIBOUNCE_MODEL_CUI, MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL, MULTIBOUNCE_MODEL_HEITZ, MULTIBOUNCE_MODEL_WANG, MULTIBOUNCE_MODEL_WANG_UNCORRELATED};
import package::multibounce::stratified_bidirectional::{stratified_bidirectional_sample, stratified_bidirectional_eval};
import package::multibounce::walk::{WalkFacets};
import package::multibounce::wang2022::{wang2022_sample, wang2022_eval};

/// Reflection off a rough metal with every bounce between its facets.
///
/// Backfacing views (`wo.z < 0`) are continued: the first collision is `Exp(sigma(wo) / |wo.z|)` deep.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor.
struct MultibounceConductor {
    /// Its facets.
    facets: WalkFacets,
    /// One of the `MULTIBOUNCE_MODEL` constants.
    model: u32,
    /// One of the `MIS_PDF` constants.
    mis: u32,
}

/// An estimate of the model's `f cos` alone, without the density of multiple importance sampling; black
/// where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor::estimate.
fn multibounce_conductor_eval(
    lobe: MultibounceConductor,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    if wi.z <= 0.0 {
        return vec3f(0.0);
    }
    switch lobe.model {
        case MULTIBOUNCE_MODEL_HEITZ: {
            return heitz2016_eval(lobe.facets, true, wo, wi, stream);
        }
        case MULTIBOUNCE_MODEL_BITTERLI: {
            return bitterli2022_eval(lobe.facets, wo, wi, stream);
        }
        case MULTIBOUNCE_MODEL_WANG, MULTIBOUNCE_MODEL_WANG_UNCORRELATED: {
            let correlated = lobe.model == MULTIBOUNCE_MODEL_WANG;
            return wang2022_eval(lobe.facets, correlated, wo, wi, stream);
        }
        case MULTIBOUNCE_MODEL_CUI, MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL: {
            if lobe.model == MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL && wo.z > 0.0 {
                return cui2023_eval_bidirectional(lobe.facets, wo, wi, stream);
            }
            return cui2023_eval(lobe.facets, wo, wi, stream);
        }
        default: {
            return stratified_bidirectional_eval(lobe.facets, wo, wi, stream);
        }
    }
}

/// The density for multiple importance sampling, in 1/sr; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor::pdf.
fn multibounce_conductor_pdf(lobe: MultibounceConductor, wo: vec3f, wi: vec3f) -> f32 {
    return mis_pdf_reflection(lobe.mis, lobe.facets.normals, wo, wi);
}

/// An estimate of `f cos` and the density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor::eval_pdf_random.
fn multibounce_conductor_eval_pdf(
    lobe: MultibounceConductor,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec4f {
    let value = multibounce_conductor_eval(lobe, wo, wi, stream);
    return vec4f(value, multibounce_conductor_pdf(lobe, wo, wi));
}

/// A direction of the model's walk and its weight, without the density of multiple importance sampling
/// (`pdf` is 0); none for a walk that was given up.
///
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor::sample_walk.
fn multibounce_conductor_walk(
    lobe: MultibounceConductor,
    wo: vec3f,
    u: vec2f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    switch lobe.model {
        case MULTIBOUNCE_MODEL_HEITZ, MULTIBOUNCE_MODEL_BITTERLI: {
            return heitz2016_sample(lobe.facets, wo, u, stream);
        }
        case MULTIBOUNCE_MODEL_WANG, MULTIBOUNCE_MODEL_WANG_UNCORRELATED: {
            let correlated = lobe.model == MULTIBOUNCE_MODEL_WANG;
            return wang2022_sample(lobe.facets, correlated, wo, u, stream);
        }
        case MULTIBOUNCE_MODEL_CUI, MULTIBOUNCE_MODEL_CUI_BIDIRECTIONAL: {
            return cui2023_sample(lobe.facets, wo, u, stream);
        }
        default: {
            return stratified_bidirectional_sample(lobe.facets, wo, u, stream);
        }
    }
}

/// A direction of the model's walk with the density of multiple importance sampling.
///
/// * `u`: `u.yz` samples the first facet.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_conductor.rs, MultibounceConductor::sample_random.
fn multibounce_conductor_sample(
    lobe: MultibounceConductor,
    wo: vec3f,
    u: vec3f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    let left = multibounce_conductor_walk(lobe, wo, u.yz, stream);
    if left.flags == 0u {
        return left;
    }
    let pdf = multibounce_conductor_pdf(lobe, wo, left.wi);
    return bsdf_sample_reflected(left.wi, left.weight, pdf);
}
