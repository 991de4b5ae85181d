// A thin pane.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::ThinDielectric.

import tracer::world::{number};
import tracer::bound::{Bound, Parameters, bound_albedo};
import package::bsdf::tints::{TintsPair};
import package::bsdf::thin_dielectric::{ThinDielectric, thin_dielectric_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `eta`, and the tints of reflection and transmission.
fn material_thin_dielectric_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = head;
    b.eta = number(p.plain);
    b.first = bound_albedo(p.values[0]);
    b.second = bound_albedo(p.values[1]);
    b.specular = true;
    return b;
}

/// Nothing: all of it is a Dirac delta.
fn material_thin_dielectric_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    return vec4f(0.0);
}

/// Samples a direction.
fn material_thin_dielectric_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    let pane = ThinDielectric(b.eta, TintsPair(b.first, b.second));
    return thin_dielectric_sample(pane, wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_thin_dielectric_albedo(b: Bound) -> vec3f {
    return vec3f(1.0);
}
