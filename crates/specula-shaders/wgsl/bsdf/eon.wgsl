// Energy-preserving Oren-Nayar diffuse reflection (EON).
//
// Source: Portsmouth, Kutz and Hill 2025, EON: A practical energy-preserving rough diffuse BRDF, JCGT
// 14(1). With `r` the roughness, `s = wi . wo - mu_i mu_o` and `t = max(mu_i, mu_o)` where `s > 0`, else 1:
//
//     f = rho/pi A (1 + r s/t) + rho_ms/pi (1 - E(mu_o)) (1 - E(mu_i)) / (1 - Eavg)
//     A = 1 / (1 + (1/2 - 2/(3 pi)) r)
//     E(mu) = A (1 + r G(mu)/pi)
//     G(mu) = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin)
//     Eavg = A (1 + (2/3 - 28/(15 pi)) r)
//     rho_ms = rho^2 Eavg / (1 - rho (1 - Eavg))
//
// Departure: directions are sampled with density `cos / pi`, not from the paper's fitted clipped
// transform; weights stay below 2.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_reflected};
import package::math::arccosine::{arccosine};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};

/// `pi`.
const EON_PI: f32 = 3.14159265358979;
/// `1 / pi`.
const EON_PER_PI: f32 = 0.31830988618379;
/// `1/2 - 2 / (3 pi)`.
const EON_SCALE: f32 = 0.28779340921080643;
/// `2/3 - 28 / (15 pi)`.
const EON_AVERAGE: f32 = 0.07248821245692394;
/// A floor of the average loss.
const EON_EPSILON: f32 = 1.1920929e-7;

/// Rough diffuse reflection; roughness 0 is Lambert.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon.
struct EonLobe {
    /// In [0, 1], the `rho` of the formulas.
    albedo: vec3f,
    /// In [0, 1].
    roughness: f32,
}

/// `A` of the formulas.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::scale.
fn eon_scale(roughness: f32) -> f32 {
    return 1.0 / (1.0 + EON_SCALE * roughness);
}

/// Directional albedo `E(mu)` of the single-scattering part for a white surface.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::single_scatter_albedo.
fn eon_single_scatter_albedo(roughness: f32, cosine: f32) -> f32 {
    let mu = clamp(cosine, 0.0, 1.0);
    let sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    let theta = arccosine(mu);
    // tan (1 - sin^3) without its division by a vanishing cosine.
    let tail = sine * mu * (1.0 + sine + sine * sine) / (1.0 + sine);
    let g = sine * (theta - sine * mu) + (2.0 / 3.0) * (tail - sine);
    return eon_scale(roughness) * (1.0 + roughness * g * EON_PER_PI);
}

/// `f(wo, wi)` in 1/sr; both above the horizon.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::f.
fn eon_f(lobe: EonLobe, wo: vec3f, wi: vec3f) -> vec3f {
    // A backfacing shading normal is treated as grazing.
    let mu_o = clamp(wo.z, 0.0, 1.0);
    let mu_i = min(wi.z, 1.0);
    let s = dot(wo, wi) - wo.z * wi.z;
    var s_over_t = s;
    if s > 0.0 {
        s_over_t = s / max(mu_i, mu_o);
    }
    let scale = eon_scale(lobe.roughness);
    let single = scale * (1.0 + lobe.roughness * s_over_t);

    let average = scale * (1.0 + EON_AVERAGE * lobe.roughness);
    let loss = 1.0 - average;
    let multiple = max(1.0 - eon_single_scatter_albedo(lobe.roughness, mu_o), 0.0)
        * max(1.0 - eon_single_scatter_albedo(lobe.roughness, mu_i), 0.0)
        * (1.0 / max(loss, EON_EPSILON));
    let rho = lobe.albedo;
    let rho_multiple = rho * rho * average / (vec3f(1.0) - rho * loss);
    return max(rho * single + rho_multiple * multiple, vec3f(0.0)) * EON_PER_PI;
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::eval.
fn eon_eval(lobe: EonLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    if wi.z <= 0.0 {
        return vec3f(0.0);
    }
    return eon_f(lobe, wo, wi) * wi.z;
}

/// Density of `eon_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::pdf.
fn eon_pdf(lobe: EonLobe, wo: vec3f, wi: vec3f) -> f32 {
    return warp_cosine_hemisphere_pdf(wi);
}

/// `f |cos|` and its density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn eon_eval_pdf(lobe: EonLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(eon_eval(lobe, wo, wi, transport), warp_cosine_hemisphere_pdf(wi));
}

/// Samples `wi` by the cosine.
///
/// Twin: specula-bsdf/src/bsdf/eon.rs, Eon::sample.
fn eon_sample(lobe: EonLobe, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let wi = warp_cosine_hemisphere(u.yz);
    return bsdf_sample_reflected(wi, eon_f(lobe, wo, wi) * EON_PI, warp_cosine_hemisphere_pdf(wi));
}
