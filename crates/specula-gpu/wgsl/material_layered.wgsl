// A coat over metal, or over Lambert with a cloud between: walks.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::CoatedConductor and CoatedDiffuse.

import tracer::world::{word, number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_store, bound_roughness};
import tracer::metal::{metal_indices, metal_reflectance};
import package::math::stream::{StreamState};
import package::ndf::distribution::{DISTRIBUTION_GGX};
import package::ndf::masking::{MASKING_HEIGHT_CORRELATED};
import package::fresnel::reflectance::{reflectance_constant};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::layered::layered::{layered_new, layered_eval_pdf, layered_sample, layered_albedo};
import package::bsdf::layered::layered_base::{LayeredBase, LAYERED_BASE_DIFFUSE, LAYERED_BASE_METAL};
import package::bsdf::layered::layered_base::{LAYERED_BASE_MIRROR};
import package::bsdf::layered::layered_lobe::{LayeredLobe, LAYERED_LOBE_MOST_EVENTS};
import package::bsdf::layered::layered_lobe::{layered_lobe_is_mirror};
import package::bsdf::layered::layered_medium::{LayeredMedium};
import package::bsdf::bsdf_sample::{BsdfSample};

/// Words of one over metal behind those of one over Lambert.
const MATERIAL_LAYERED_METAL: u32 = 6u;

/// Binds the parameters at a point: `stored` (alphas of the coat, thickness, albedo and asymmetry of the medium, then
/// those of the base), `alpha` of the coat, `eta` its index, `energy` and `masking` the most events and the
/// walks, `variant` 8 where the base is Lambert, else as of `metal_indices`.
fn material_layered_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_store(bound_roughness(head, p), p);
    b.eta = number(p.plain + 3u);
    b.energy = word(p.plain + 4u);
    b.opaque = true;
    b.variant = 8u;
    if p.count > MATERIAL_LAYERED_METAL {
        let at = p.plain + MATERIAL_LAYERED_METAL;
        var base: Bound;
        base.third = vec3f(1.0);
        base = metal_indices(base, word(at + 3u), p.values[7], p.values[8]);
        b.first = base.first;
        b.second = base.second;
        b.third = base.third;
        b.variant = base.variant;
        // Alphas of the base in place of its parameters.
        b.stored[5] = vec3f(bound_alphas(p.values[5].x, p.values[6].x, word(at)), 0.0);
    }
    b.masking = word(p.plain + 5u);
    b.specular = layered_lobe_is_mirror(material_layered_lobe(b));
    return b;
}

/// The lobe. Coats know GGX only, with height-correlated masking.
fn material_layered_lobe(b: Bound) -> LayeredLobe {
    let alphas = b.stored[5].xy;
    let facets = MicrofacetsModel(alphas, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER);
    var base = LayeredBase(LAYERED_BASE_DIFFUSE, facets, reflectance_constant(vec3f(0.0)), vec3f(0.0));
    if b.variant == 8u {
        base.albedo = bound_albedo(b.stored[5]);
    } else {
        base.kind = select(LAYERED_BASE_MIRROR, LAYERED_BASE_METAL, alphas.x > 0.0);
        base.reflectance = metal_reflectance(b);
    }
    let medium = LayeredMedium(b.stored[2].x, bound_albedo(b.stored[3]), b.stored[4].x);
    var lobe = layered_new(b.alpha, b.alpha.x > 0.0, b.eta, base, medium, SAMPLER);
    lobe.max_depth = min(b.energy, LAYERED_LOBE_MOST_EVENTS);
    lobe.walks = clamp(b.masking, 1u, 1024u);
    return lobe;
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_layered_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    var random = StreamState(stream);
    return layered_eval_pdf(material_layered_lobe(b), wo, wi, &random);
}

/// Samples a direction.
fn material_layered_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    var random = StreamState(stream);
    return layered_sample(material_layered_lobe(b), wo, u, &random);
}

/// Albedo, as a feature for denoisers.
fn material_layered_albedo(b: Bound) -> vec3f {
    return layered_albedo(material_layered_lobe(b));
}
