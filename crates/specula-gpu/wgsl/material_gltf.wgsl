// glTF's metallic-roughness with its extensions.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::Gltf.

import tracer::world::{word, number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_store, bound_unit};
import tracer::bound::{bound_unit_roughness};
import package::bsdf::gltf::{GltfLobe, GltfParameters, gltf_new, gltf_eval_pdf, gltf_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: `stored`, `eta`, and `variant`: 1 where it bounds a volume, 2 more where its
/// metal is compensated, 4 more where it is seen from its outside, 8 more where it is made rougher. `first` is the
/// normal of the clear coat, local, which the vertex sets.
fn material_gltf_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_store(head, p);
    b.eta = number(p.plain);
    b.variant = word(p.plain + 1u) + select(0u, 4u, outside) + 8u * word(p.plain + 2u);
    b.first = vec3f(0.0, 0.0, 1.0);
    return b;
}

/// The lobe.
fn material_gltf_lobe(b: Bound) -> GltfLobe {
    var p: GltfParameters;
    p.base_colour = bound_albedo(b.stored[0]);
    p.specular_colour = max(b.stored[1], vec3f(0.0));
    p.sheen_colour = bound_albedo(b.stored[2]);
    p.metallic = bound_unit(b.stored[3]);
    let regularized = (b.variant & 8u) != 0u;
    p.roughness = bound_unit_roughness(b.stored[4], regularized);
    p.anisotropy = bound_unit(b.stored[5]);
    p.specular = bound_unit(b.stored[6]);
    p.transmission = bound_unit(b.stored[7]);
    p.clearcoat = bound_unit(b.stored[8]);
    p.clearcoat_roughness = bound_unit_roughness(b.stored[9], regularized);
    p.sheen_roughness = bound_unit(b.stored[10]);
    p.ior = b.eta;
    p.volume = b.variant & 1u;
    p.compensated = (b.variant >> 1u) & 1u;
    p.outside = (b.variant >> 2u) & 1u;
    return gltf_new(p, b.first);
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_gltf_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    return gltf_eval_pdf(material_gltf_lobe(b), wo, wi, BSDF_SAMPLE_RADIANCE);
}

/// Samples a direction.
fn material_gltf_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    return gltf_sample(material_gltf_lobe(b), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Albedo, as a feature for denoisers.
fn material_gltf_albedo(b: Bound) -> vec3f {
    return bound_albedo(b.stored[0]);
}
