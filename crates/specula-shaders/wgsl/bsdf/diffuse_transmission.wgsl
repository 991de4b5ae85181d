// The thin sheet that scatters like Lambert on both sides.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_reflected, bsdf_sample_transmitted};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere};

/// `1 / pi`.
const DIFFUSE_TRANSMISSION_PER_PI: f32 = 0.31830988618379;

/// A thin sheet: Lambert on the side of the viewer and on the other.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, DiffuseTransmission.
struct DiffuseTransmission {
    /// In [0, 1].
    reflectance: vec3f,
    /// In [0, 1]; the sum of both at most 1 for a passive sheet.
    transmittance: vec3f,
}

/// Probability of the reflected side.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, DiffuseTransmission::reflection_probability.
fn diffuse_transmission_reflection_probability(lobe: DiffuseTransmission) -> f32 {
    let r = rgb_max_channel(lobe.reflectance);
    let t = rgb_max_channel(lobe.transmittance);
    if r + t > 0.0 {
        return r / (r + t);
    }
    return 1.0;
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, DiffuseTransmission::eval.
fn diffuse_transmission_eval(lobe: DiffuseTransmission, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return select(lobe.transmittance, lobe.reflectance, wi.z > 0.0) * (abs(wi.z) * DIFFUSE_TRANSMISSION_PER_PI);
}

/// Density of `diffuse_transmission_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, DiffuseTransmission::pdf.
fn diffuse_transmission_pdf(lobe: DiffuseTransmission, wo: vec3f, wi: vec3f) -> f32 {
    let p = diffuse_transmission_reflection_probability(lobe);
    return select(1.0 - p, p, wi.z > 0.0) * abs(wi.z) * DIFFUSE_TRANSMISSION_PER_PI;
}

/// `f |cos|` and its density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn diffuse_transmission_eval_pdf(lobe: DiffuseTransmission, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(diffuse_transmission_eval(lobe, wo, wi, transport), diffuse_transmission_pdf(lobe, wo, wi));
}

/// Samples `wi` by the cosine on either side.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, DiffuseTransmission::sample.
fn diffuse_transmission_sample(lobe: DiffuseTransmission, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let p = diffuse_transmission_reflection_probability(lobe);
    let w = warp_cosine_hemisphere(u.yz);
    if u.x < p {
        return bsdf_sample_reflected(w, lobe.reflectance / p, diffuse_transmission_pdf(lobe, wo, w));
    }
    let wi = vec3f(w.x, w.y, -w.z);
    let weight = lobe.transmittance / (1.0 - p);
    return bsdf_sample_transmitted(wi, weight, diffuse_transmission_pdf(lobe, wo, wi), 1.0);
}
