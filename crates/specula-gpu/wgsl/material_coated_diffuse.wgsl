// Lambert under a coat, in closed form.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::CoatedDiffuse.

import tracer::world::{word, number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_roughness};
import package::ndf::distribution::{DISTRIBUTION_GGX};
import package::ndf::masking::{MASKING_HEIGHT_CORRELATED};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::coated_diffuse::{CoatedDiffuse, coated_diffuse_new};
import package::bsdf::coated_diffuse::{coated_diffuse_eval_pdf, coated_diffuse_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `first` the albedo, `eta` the coat's index, `second.x` the thickness of
/// what absorbs, `variant` whether facets lose no light, `energy` the most events.
fn material_coated_diffuse_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_roughness(head, p);
    b.eta = number(p.plain + 3u);
    b.first = bound_albedo(p.values[2]);
    b.variant = word(p.plain + 4u);
    b.second.x = p.values[3].x;
    b.energy = word(p.plain + 5u);
    b.opaque = true;
    return b;
}

/// The lobe. Coats know GGX only, with height-correlated masking: Beckmann's alphas are taken for its.
fn material_coated_diffuse_lobe(b: Bound) -> CoatedDiffuse {
    let facets = MicrofacetsModel(b.alpha, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER);
    let rough = b.alpha.x > 0.0;
    return coated_diffuse_new(facets, rough, b.eta, b.first, b.second.x, b.energy, b.variant);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_coated_diffuse_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    return coated_diffuse_eval_pdf(material_coated_diffuse_lobe(b), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_coated_diffuse_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    return coated_diffuse_sample(material_coated_diffuse_lobe(b), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_coated_diffuse_albedo(b: Bound) -> vec3f {
    return b.first;
}
