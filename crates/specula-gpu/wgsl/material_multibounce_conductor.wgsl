// Metal whose bounces are simulated.
//
// Twin of specula-render/src/material/{bind,rough}.rs.

import tracer::bound::{Bound, Parameters, bound_distribution, bound_only};
import tracer::metal::{metal_bind, metal_reflectance, metal_facets, metal_albedo};
import package::bsdf::smooth_conductor::{SmoothConductor, smooth_conductor_sample};
import package::math::stream::{StreamState};
import package::multibounce::normals::{NormalsModel};
import package::multibounce::walk::{WalkFacets};
import package::multibounce::multibounce_conductor::{MultibounceConductor};
import package::multibounce::multibounce_conductor::{multibounce_conductor_eval_pdf};
import package::multibounce::multibounce_conductor::{multibounce_conductor_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: those of `metal_bind`.
fn material_multibounce_conductor_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    return metal_bind(head, p, outside);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_multibounce_conductor_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    if b.specular {
        return vec4f(0.0);
    }
    let facets = WalkFacets(NormalsModel(b.alpha, bound_distribution(b)), metal_reflectance(b));
    var random = StreamState(stream);
    let lobe = MultibounceConductor(facets, bound_only(ONLY_CONDUCTOR_BOUNCES, b.energy), BOUNCES_PDF);
    return multibounce_conductor_eval_pdf(lobe, wo, wi, &random);
}

/// Samples a direction.
fn material_multibounce_conductor_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    if b.specular {
        let mirror = SmoothConductor(metal_reflectance(b));
        return smooth_conductor_sample(mirror, wo, u, BSDF_SAMPLE_RADIANCE);
    }
    let facets = WalkFacets(NormalsModel(b.alpha, bound_distribution(b)), metal_reflectance(b));
    var random = StreamState(stream);
    let lobe = MultibounceConductor(facets, bound_only(ONLY_CONDUCTOR_BOUNCES, b.energy), BOUNCES_PDF);
    return multibounce_conductor_sample(lobe, wo, u, &random);
}

/// Albedo, as a feature for denoisers.
fn material_multibounce_conductor_albedo(b: Bound) -> vec3f {
    return metal_albedo(b);
}
