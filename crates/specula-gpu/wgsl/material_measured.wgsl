// A measured material.
//
// Twin of specula-render/src/material/point_lobe.rs, PointLobe::Measured.

import tracer::world::{word};
import tracer::bound::{Bound, Parameters};
import package::measured::measured::{measured_of, measured_eval_pdf, measured_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `masking` is the place of its tables.
fn material_measured_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = head;
    b.masking = word(p.plain);
    b.opaque = true;
    return b;
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_measured_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    return measured_eval_pdf(measured_of(b.masking), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_measured_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    return measured_sample(measured_of(b.masking), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_measured_albedo(b: Bound) -> vec3f {
    return measured_of(b.masking).albedo;
}
