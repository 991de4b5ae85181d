// Diffuse on both sides.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::DiffuseTransmission.

import tracer::bound::{Bound, Parameters, bound_albedo};
import package::bsdf::diffuse_transmission::{DiffuseTransmission};
import package::bsdf::diffuse_transmission::{diffuse_transmission_eval_pdf};
import package::bsdf::diffuse_transmission::{diffuse_transmission_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `first` the reflectance, `second` the transmittance.
fn material_diffuse_transmission_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = head;
    b.first = bound_albedo(p.values[0]);
    b.second = bound_albedo(p.values[1]);
    return b;
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_diffuse_transmission_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    let lobe = DiffuseTransmission(b.first, b.second);
    return diffuse_transmission_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_diffuse_transmission_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    return diffuse_transmission_sample(DiffuseTransmission(b.first, b.second), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_diffuse_transmission_albedo(b: Bound) -> vec3f {
    return b.first + b.second;
}
