// Lambert's diffuse reflection.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_reflected};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};

/// `f = albedo / pi`.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, Lambert.
struct LambertLobe {
    /// In [0, 1].
    albedo: vec3f,
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, Lambert::eval.
fn lambert_eval(lobe: LambertLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return lobe.albedo * warp_cosine_hemisphere_pdf(wi);
}

/// Density of `lambert_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, Lambert::pdf.
fn lambert_pdf(lobe: LambertLobe, wo: vec3f, wi: vec3f) -> f32 {
    return warp_cosine_hemisphere_pdf(wi);
}

/// `f |cos|` and its density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn lambert_eval_pdf(lobe: LambertLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let pdf = warp_cosine_hemisphere_pdf(wi);
    return vec4f(lobe.albedo * pdf, pdf);
}

/// Samples `wi` by the cosine.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, Lambert::sample.
fn lambert_sample(lobe: LambertLobe, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let wi = warp_cosine_hemisphere(u.yz);
    return bsdf_sample_reflected(wi, lobe.albedo, warp_cosine_hemisphere_pdf(wi));
}
