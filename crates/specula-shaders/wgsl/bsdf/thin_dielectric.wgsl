// A pane so thin that light leaves it where it entered: both interfaces with all reflections between
// them, `R = 2 F / (1 + F)`, and transmission straight on.
//
// Source: Stokes 1862 (the pile of plates), as in pbrt-v4's `thindielectric`.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TRANSMISSION, BsdfSample, bsdf_sample_delta};
import package::bsdf::tints::{TintsPair};
import package::fresnel::dielectric::{dielectric};

/// A thin pane.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, ThinDielectric.
struct ThinDielectric {
    /// Index of the pane over that around it, above 0.
    eta: f32,
    /// Factors on its two branches.
    tints: TintsPair,
}

/// `f |cos|` without its Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, ThinDielectric::eval.
fn thin_dielectric_eval(lobe: ThinDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return vec3f(0.0);
}

/// Density without its Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, ThinDielectric::pdf.
fn thin_dielectric_pdf(lobe: ThinDielectric, wo: vec3f, wi: vec3f) -> f32 {
    return 0.0;
}

/// `f |cos|` and its density without their Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn thin_dielectric_eval_pdf(lobe: ThinDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(0.0);
}

/// The mirrored direction or straight on, by the pane's reflectance.
///
/// Twin: specula-bsdf/src/bsdf/smooth_dielectric.rs, ThinDielectric::sample.
fn thin_dielectric_sample(lobe: ThinDielectric, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let single = dielectric(abs(wo.z), lobe.eta).reflectance;
    let reflectance = 2.0 * single / (1.0 + single);
    if u.x < reflectance {
        let mirrored = vec3f(-wo.x, -wo.y, wo.z);
        return bsdf_sample_delta(mirrored, lobe.tints.reflection, reflectance, 0u, 1.0);
    }
    return bsdf_sample_delta(-wo, lobe.tints.transmission, 1.0 - reflectance, BSDF_SAMPLE_TRANSMISSION, 1.0);
}
