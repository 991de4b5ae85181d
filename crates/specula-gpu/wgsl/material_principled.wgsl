// Mitsuba's principled materials, solid and thin.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::Principled.

import tracer::world::{word, number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_store, bound_unit_roughness};
import package::bsdf::principled_parameters::{PrincipledParameters, principled_parameters_held};
import package::bsdf::principled_solid::{principled_solid_new, principled_solid_eval_pdf};
import package::bsdf::principled_solid::{principled_solid_sample};
import package::bsdf::principled_thin::{principled_thin_new, principled_thin_eval_pdf};
import package::bsdf::principled_thin::{principled_thin_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `stored`, `eta`, and `variant`: 1 where it is thin, 2 more where it is seen
/// from its outside, 4 more where it is made rougher.
fn material_principled_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_store(head, p);
    b.eta = number(p.plain);
    b.variant = word(p.plain + 1u) + select(0u, 2u, outside) + 4u * word(p.plain + 2u);
    return b;
}

/// The parameters as lobes take them.
fn material_principled_parameters(b: Bound) -> PrincipledParameters {
    var p: PrincipledParameters;
    p.base_colour = bound_albedo(b.stored[0]);
    let regularized = (b.variant & 4u) != 0u;
    p.roughness = bound_unit_roughness(b.stored[1], regularized);
    p.anisotropic = b.stored[2].x;
    p.metallic = b.stored[3].x;
    p.spec_trans = b.stored[4].x;
    p.eta = b.eta;
    p.spec_tint = b.stored[5].x;
    p.sheen = b.stored[6].x;
    p.sheen_tint = b.stored[7].x;
    p.clearcoat = b.stored[8].x;
    p.clearcoat_gloss = select(b.stored[9].x, 0.0, regularized);
    p.flatness = b.stored[10].x;
    p.diff_trans = b.stored[11].x;
    p.outside = (b.variant >> 1u) & 1u;
    return principled_parameters_held(p);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_principled_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    let p = material_principled_parameters(b);
    if (b.variant & 1u) != 0u {
        return principled_thin_eval_pdf(principled_thin_new(p), wo, wi, BSDF_SAMPLE_RADIANCE);
    }
    return principled_solid_eval_pdf(principled_solid_new(p), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_principled_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    let p = material_principled_parameters(b);
    if (b.variant & 1u) != 0u {
        return principled_thin_sample(principled_thin_new(p), wo, u, BSDF_SAMPLE_RADIANCE);
    }
    return principled_solid_sample(principled_solid_new(p), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_principled_albedo(b: Bound) -> vec3f {
    return bound_albedo(b.stored[0]);
}
