// The reflectance of a metal from a material's parameters.
//
// Twin of specula-render/src/material/metal.rs.

import tracer::world::{word};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_distribution, bound_masking, bound_only, bound_roughness};
import package::fresnel::reflectance::{ReflectanceModel};
import package::bsdf::microfacets::{MicrofacetsModel};

/// Binds the reflectance of a metal: `first` and `second` become eta and k, or `first` the reflectance at normal
/// incidence; `variant` is `kind`.
///
/// * `kind`: what the two colours are, one of METAL_*.
fn metal_indices(b: Bound, kind: u32, one: vec3f, other: vec3f) -> Bound {
    var m = b;
    if kind == METAL_INDEX {
        m.first = max(one, vec3f(1.0e-4));
        m.second = max(other, vec3f(0.0));
    } else if kind == METAL_REFLECTANCE {
        // pbrt-v4: the k that gives this reflectance at normal incidence with eta = 1.
        let r = min(bound_albedo(one), vec3f(0.9999));
        m.first = vec3f(1.0);
        m.second = 2.0 * sqrt(r) / sqrt(1.0 - r);
    } else {
        m.first = bound_albedo(one);
    }
    m.variant = kind;
    return m;
}

/// Binds alphas and reflectance of a metal, as `metal_indices` does; `variant` is 4 more where it is rough, `third`
/// is the tint.
fn metal_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    let kind = bound_only(ONLY_METAL, word(p.plain + 3u));
    var b = metal_indices(bound_roughness(head, p), kind, p.values[2], p.values[3]);
    b.third = bound_albedo(p.values[4]);
    b.specular = b.alpha.x == 0.0;
    b.variant += select(4u, 0u, b.specular);
    b.opaque = true;
    return b;
}

/// The reflectance of a metal that `metal_bind` bound.
fn metal_reflectance(b: Bound) -> ReflectanceModel {
    let kind = bound_only(ONLY_METAL, b.variant & 3u);
    if kind <= METAL_REFLECTANCE {
        return reflectance_tinted(reflectance_conductor(b.first, b.second), b.third);
    }
    if kind == METAL_SCHLICK {
        return reflectance_tinted(reflectance_schlick(b.first), b.third);
    }
    return reflectance_constant(b.third);
}

/// The facets of a metal that `metal_bind` bound.
fn metal_facets(b: Bound) -> MicrofacetsModel {
    return MicrofacetsModel(b.alpha, bound_distribution(b), bound_masking(b), SAMPLER);
}

/// Albedo, as a feature for denoisers.
fn metal_albedo(b: Bound) -> vec3f {
    return reflectance_eval(metal_reflectance(b), 2.0 / 3.0);
}
