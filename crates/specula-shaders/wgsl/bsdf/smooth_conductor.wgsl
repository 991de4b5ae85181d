// Mirrors.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_delta, bsdf_sample_none};
import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval};

/// A mirror.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, SmoothConductor.
struct SmoothConductor {
    /// What it reflects.
    reflectance: ReflectanceModel,
}

/// `f |cos|` without its Dirac delta: 0.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, SmoothConductor::eval.
fn smooth_conductor_eval(lobe: SmoothConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return vec3f(0.0);
}

/// Density without its Dirac delta: 0.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, SmoothConductor::pdf.
fn smooth_conductor_pdf(lobe: SmoothConductor, wo: vec3f, wi: vec3f) -> f32 {
    return 0.0;
}

/// `f |cos|` and its density without their Dirac deltas: 0.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, SmoothConductor::eval_pdf.
fn smooth_conductor_eval_pdf(lobe: SmoothConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(0.0);
}

/// The mirrored direction; none for a view below the horizon.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, SmoothConductor::sample.
fn smooth_conductor_sample(lobe: SmoothConductor, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    if wo.z <= 0.0 {
        return bsdf_sample_none();
    }
    let weight = reflectance_eval(lobe.reflectance, wo.z);
    return bsdf_sample_delta(vec3f(-wo.x, -wo.y, wo.z), weight, 1.0, 0u, 1.0);
}
