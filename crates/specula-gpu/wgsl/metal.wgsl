// The reflectance of a metal from a material's parameters.
//
// Twin of specula-render/src/material/metal.rs.

import tracer::world::{word};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_roughness};
import package::fresnel::reflectance::{Reflectance};
import package::bsdf::microfacets::{Microfacets};

/// Widths and reflectance of a metal: `first` and `second` are eta and k, or the reflectance at normal
/// incidence, or white; `variant` says which, plus 4 where it is rough; `third` the tint.
fn metal_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_roughness(head, p);
    let kind = word(p.plain + 3u);
    if kind == 0u {
        b.first = max(p.values[2], vec3f(1.0e-4));
        b.second = max(p.values[3], vec3f(0.0));
    } else if kind == 1u {
        // pbrt-v4: the k that gives this reflectance at normal incidence with eta = 1.
        let r = min(bound_albedo(p.values[2]), vec3f(0.9999));
        b.first = vec3f(1.0);
        b.second = 2.0 * sqrt(r) / sqrt(1.0 - r);
    } else {
        b.first = bound_albedo(p.values[2]);
    }
    b.third = bound_albedo(p.values[4]);
    b.specular = b.alpha.x == 0.0;
    b.variant = kind + select(4u, 0u, b.specular);
    b.opaque = true;
    return b;
}

/// The reflectance of what `metal_bind` made.
fn metal_reflectance(b: Bound) -> Reflectance {
    let kind = b.variant & 3u;
    if kind < 2u {
        return reflectance_tinted(reflectance_conductor(b.first, b.second), b.third);
    }
    if kind == 2u {
        return reflectance_tinted(reflectance_schlick(b.first), b.third);
    }
    return reflectance_constant(b.third);
}

/// The facets of what `metal_bind` made.
fn metal_facets(b: Bound) -> Microfacets {
    return Microfacets(b.alpha, b.distribution, b.masking, SAMPLER);
}

/// A colour for denoisers.
fn metal_albedo(b: Bound) -> vec3f {
    return reflectance_eval(metal_reflectance(b), 2.0 / 3.0);
}
