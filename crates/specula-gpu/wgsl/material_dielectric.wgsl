// Glass with single scattering.
//
// Twin of specula-render/src/material/{bind,rough}.rs.

import tracer::bound::{Bound, Parameters};
import tracer::glass::{glass_bind, glass_tints, glass_facets, glass_smooth};
import package::bsdf::rough_dielectric::{RoughDielectric, rough_dielectric_eval_pdf};
import package::bsdf::rough_dielectric::{rough_dielectric_sample};
import package::bsdf::smooth_dielectric::{smooth_dielectric_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: those of `glass_bind`.
fn material_dielectric_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    return glass_bind(head, p, outside);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_dielectric_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    if b.specular {
        return vec4f(0.0);
    }
    let lobe = RoughDielectric(glass_facets(b), b.eta, 0u, glass_tints(b));
    return rough_dielectric_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_dielectric_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    if b.specular {
        return smooth_dielectric_sample(glass_smooth(b), wo, u, BSDF_SAMPLE_RADIANCE);
    }
    let lobe = RoughDielectric(glass_facets(b), b.eta, 0u, glass_tints(b));
    return rough_dielectric_sample(lobe, wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_dielectric_albedo(b: Bound) -> vec3f {
    return vec3f(1.0);
}
