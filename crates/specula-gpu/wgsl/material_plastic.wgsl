// Mitsuba's plastics.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::Plastic.

import tracer::world::{word, number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_black, bound_distribution, bound_masking, bound_roughness};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::plastic::{PlasticLobe, plastic_smooth, plastic_rough, plastic_eval_pdf, plastic_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `eta`, `first` and `second` the colours of base and coat, `variant` whether
/// the base colours what comes back to it. Its back is black, as Mitsuba's.
fn material_plastic_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    if !outside {
        return bound_black();
    }
    var b = bound_roughness(head, p);
    b.eta = number(p.plain + 3u);
    b.first = bound_albedo(p.values[2]);
    b.second = bound_albedo(p.values[3]);
    b.variant = word(p.plain + 4u);
    b.opaque = true;
    return b;
}

/// The lobe.
fn material_plastic_lobe(b: Bound) -> PlasticLobe {
    let nonlinear = b.variant != 0u;
    if b.alpha.x == 0.0 {
        return plastic_smooth(b.eta, b.first, b.second, nonlinear);
    }
    let facets = MicrofacetsModel(b.alpha, bound_distribution(b), bound_masking(b), SAMPLER);
    return plastic_rough(facets, b.eta, b.first, b.second, nonlinear);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_plastic_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    return plastic_eval_pdf(material_plastic_lobe(b), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_plastic_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    return plastic_sample(material_plastic_lobe(b), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_plastic_albedo(b: Bound) -> vec3f {
    return b.first;
}
