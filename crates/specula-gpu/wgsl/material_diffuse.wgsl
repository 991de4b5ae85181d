// Lambert, and Oren-Nayar where it is rough.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::Diffuse.

import tracer::bound::{Bound, Parameters, bound_albedo};
import package::bsdf::lambert::{LambertLobe, lambert_eval_pdf, lambert_sample};
import package::bsdf::eon::{EonLobe, eon_eval_pdf, eon_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `first` the albedo, `eta` the roughness.
fn material_diffuse_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = head;
    b.first = bound_albedo(p.values[0]);
    b.eta = clamp(p.values[1].x, 0.0, 1.0);
    b.variant = select(0u, 1u, b.eta > 0.0);
    b.opaque = true;
    return b;
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_diffuse_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    if b.variant == 1u {
        return eon_eval_pdf(EonLobe(b.first, b.eta), wo, wi, BSDF_SAMPLE_RADIANCE);
    }
    return lambert_eval_pdf(LambertLobe(b.first), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_diffuse_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    if b.variant == 1u {
        return eon_sample(EonLobe(b.first, b.eta), wo, u, BSDF_SAMPLE_RADIANCE);
    }
    return lambert_sample(LambertLobe(b.first), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_diffuse_albedo(b: Bound) -> vec3f {
    return b.first;
}
