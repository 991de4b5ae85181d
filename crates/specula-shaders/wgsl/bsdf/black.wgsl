// Nothing is reflected and nothing passes: the back of a one-sided material.
//
// Formats whose opaque materials have one side (Mitsuba's without `twosided`) are black from behind.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_none};

/// `f = 0`.
///
/// Twin: specula-bsdf/src/bsdf/black.rs, Black::eval.
fn black_eval(wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return vec3f(0.0);
}

/// 0.
///
/// Twin: specula-bsdf/src/bsdf/black.rs, Black::pdf.
fn black_pdf(wo: vec3f, wi: vec3f) -> f32 {
    return 0.0;
}

/// 0.
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, Bsdf::eval_pdf.
fn black_eval_pdf(wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    return vec4f(0.0);
}

/// No direction is ever sampled.
///
/// Twin: specula-bsdf/src/bsdf/black.rs, Black::sample.
fn black_sample(wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    return bsdf_sample_none();
}
