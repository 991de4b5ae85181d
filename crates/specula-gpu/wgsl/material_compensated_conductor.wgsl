// Metal with compensated energy.
//
// Twin of specula-render/src/material/{bind,rough}.rs.

import tracer::bound::{Bound, Parameters, bound_only};
import tracer::metal::{metal_bind, metal_reflectance, metal_facets, metal_albedo};
import package::bsdf::smooth_conductor::{SmoothConductor, smooth_conductor_sample};
import package::bsdf::compensated::{compensated_new, compensated_eval_pdf, compensated_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: those of `metal_bind`.
fn material_compensated_conductor_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    return metal_bind(head, p, outside);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_compensated_conductor_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    if b.specular {
        return vec4f(0.0);
    }
    let lobe = compensated_new(metal_facets(b), metal_reflectance(b), bound_only(ONLY_COMPENSATION, b.energy));
    return compensated_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_compensated_conductor_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    if b.specular {
        let mirror = SmoothConductor(metal_reflectance(b));
        return smooth_conductor_sample(mirror, wo, u, BSDF_SAMPLE_RADIANCE);
    }
    let lobe = compensated_new(metal_facets(b), metal_reflectance(b), bound_only(ONLY_COMPENSATION, b.energy));
    return compensated_sample(lobe, wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_compensated_conductor_albedo(b: Bound) -> vec3f {
    return metal_albedo(b);
}
