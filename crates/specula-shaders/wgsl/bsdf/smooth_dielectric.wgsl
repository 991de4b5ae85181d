// A smooth interface between two dielectrics.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TRANSMISSION, BsdfSample, bsdf_sample_delta, bsdf_sample_none, bsdf_sample_radiance_scale};
import package::bsdf::tints::{TintsPair};
import package::fresnel::dielectric::{dielectric, dielectric_refract};

/// A smooth interface.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, SmoothDielectric.
struct SmoothDielectric {
    /// Index inside over index outside where it has both sides, else index beyond the interface over the
    /// index on the side of `wo`; above 0.
    eta: f32,
    /// 1: `wo.z < 0` views it from inside. 0: `wo.z < 0` is a backfacing shading normal and gives no
    /// sample.
    two_sided: u32,
    /// Factors on its two branches.
    tints: TintsPair,
}

/// `f |cos|` without its Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, SmoothDielectric::eval.
fn smooth_dielectric_eval(lobe: SmoothDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return vec3f(0.0);
}

/// Density without its Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, SmoothDielectric::pdf.
fn smooth_dielectric_pdf(lobe: SmoothDielectric, wo: vec3f, wi: vec3f) -> f32 {
    return 0.0;
}

/// `f |cos|` and its density without their Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn smooth_dielectric_eval_pdf(lobe: SmoothDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(0.0);
}

/// The mirrored or the refracted direction, by Fresnel's reflectance.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, SmoothDielectric::sample.
fn smooth_dielectric_sample(lobe: SmoothDielectric, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let inside = wo.z < 0.0;
    if wo.z == 0.0 || (inside && lobe.two_sided == 0u) {
        return bsdf_sample_none();
    }
    let eta = select(lobe.eta, 1.0 / lobe.eta, inside);
    let bent = dielectric(abs(wo.z), eta);
    if u.x < bent.reflectance {
        let mirrored = vec3f(-wo.x, -wo.y, wo.z);
        return bsdf_sample_delta(mirrored, lobe.tints.reflection, bent.reflectance, 0u, 1.0);
    }
    let normal = vec3f(0.0, 0.0, select(1.0, -1.0, inside));
    let wi = dielectric_refract(wo, normal, abs(wo.z), bent.cos_t, eta);
    let weight = lobe.tints.transmission * bsdf_sample_radiance_scale(eta, transport);
    return bsdf_sample_delta(wi, weight, bent.transmittance, BSDF_SAMPLE_TRANSMISSION, eta);
}
