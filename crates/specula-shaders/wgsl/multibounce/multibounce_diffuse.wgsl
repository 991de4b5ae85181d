// A rough surface of Lambertian facets with all its bounces (Heitz et al. 2016).
//
// Departure from the Rust source: the caller always passes a stream.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_none, bsdf_sample_reflected};
import package::math::frame::{frame_from_normal, frame_to_world};
import package::math::stream::{StreamState};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};
import package::multibounce::heitz2016::{heitz2016_depth, heitz2016_step};
import package::multibounce::normals::{NormalsModel, normals_sample_wm};
import package::multibounce::walk::{WALK_MAX_BOUNCES, walk_flight, walk_pair};

/// Reflection off Lambertian facets with every bounce between them. Values are estimates.
///
/// The density for multiple importance sampling is the cosine's: the walk's is close to it at every
/// roughness.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_diffuse.rs, MultibounceDiffuse.
struct MultibounceDiffuse {
    /// Distribution of its facets.
    normals: NormalsModel,
    /// Of each facet, in [0, 1].
    albedo: vec3f,
}

/// An estimate of `f cos`; black where `wi.z <= 0`. One normal for each collision:
/// `p(d, d') = albedo int D_visible(wm) max(wm . d', 0) / pi dwm`.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, eval_diffuse.
fn multibounce_diffuse_eval(
    lobe: MultibounceDiffuse,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    if wi.z <= 0.0 {
        return vec3f(0.0);
    }
    let leaving = walk_flight(lobe.normals, wi);
    var flight = walk_flight(lobe.normals, -wo);
    var tau = heitz2016_step(flight.rate, stream);
    var weight = vec3f(1.0);
    var sum = vec3f(0.0);
    var u = walk_pair(stream);
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let wm = normals_sample_wm(lobe.normals, -flight.d, u);
        weight *= lobe.albedo;
        let cos_i = max(dot(wm, wi), 0.0);
        sum += weight * (cos_i * 0.31830987 * exp(-(tau * leaving.rate)));
        flight = walk_flight(lobe.normals, multibounce_diffuse_scatter(wm, walk_pair(stream)));
        tau = heitz2016_depth(tau, flight, stream);
        if tau < 0.0 {
            break;
        }
        u = walk_pair(stream);
    }
    return sum;
}

/// A direction off a Lambertian facet.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, diffuse_walk.
fn multibounce_diffuse_scatter(wm: vec3f, u: vec2f) -> vec3f {
    return frame_to_world(frame_from_normal(wm), warp_cosine_hemisphere(u));
}

/// The density for multiple importance sampling, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_diffuse.rs, MultibounceDiffuse::pdf.
fn multibounce_diffuse_pdf(lobe: MultibounceDiffuse, wo: vec3f, wi: vec3f) -> f32 {
    return warp_cosine_hemisphere_pdf(wi);
}

/// An estimate of `f cos` and the density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/multibounce_diffuse.rs, MultibounceDiffuse::eval_pdf_random.
fn multibounce_diffuse_eval_pdf(
    lobe: MultibounceDiffuse,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec4f {
    let value = multibounce_diffuse_eval(lobe, wo, wi, stream);
    return vec4f(value, multibounce_diffuse_pdf(lobe, wo, wi));
}

/// A direction of the walk with the density of multiple importance sampling.
///
/// * `u`: `u.yz` samples the first facet.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_diffuse.rs, MultibounceDiffuse::sample_random.
fn multibounce_diffuse_sample(
    lobe: MultibounceDiffuse,
    wo: vec3f,
    u: vec3f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    var flight = walk_flight(lobe.normals, -wo);
    var tau = heitz2016_step(flight.rate, stream);
    var weight = vec3f(1.0);
    var next = u.yz;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let wm = normals_sample_wm(lobe.normals, -flight.d, next);
        weight *= lobe.albedo;
        flight = walk_flight(lobe.normals, multibounce_diffuse_scatter(wm, walk_pair(stream)));
        tau = heitz2016_depth(tau, flight, stream);
        if tau < 0.0 {
            let pdf = multibounce_diffuse_pdf(lobe, wo, flight.d);
            return bsdf_sample_reflected(flight.d, weight, pdf);
        }
        next = walk_pair(stream);
    }
    return bsdf_sample_none();
}
