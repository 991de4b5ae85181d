// Indices, tints and alphas of glass from a material's parameters.
//
// Twin of specula-render/src/material/bind.rs, MaterialKind::Dielectric.

import tracer::world::{number};
import tracer::bound::{Bound, Parameters, bound_albedo, bound_distribution, bound_masking, bound_roughness};
import package::bsdf::tints::{TintsPair};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::smooth_dielectric::{SmoothDielectric};

/// Binds the parameters at a point: `eta` the index beyond the surface over that on the viewer's side,
/// `first` and `second` the tints of reflection and transmission.
fn glass_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    var b = bound_roughness(head, p);
    let eta = number(p.plain + 3u);
    b.eta = select(1.0 / eta, eta, outside);
    b.first = bound_albedo(p.values[2]);
    b.second = bound_albedo(p.values[3]);
    // With equal indices nothing is bent, however rough.
    b.specular = b.alpha.x == 0.0 || abs(b.eta - 1.0) <= 1.0e-4;
    return b;
}

/// The tints of glass that `glass_bind` bound.
fn glass_tints(b: Bound) -> TintsPair {
    return TintsPair(b.first, b.second);
}

/// The facets of glass that `glass_bind` bound. They are sampled by spherical caps, whatever sampler metals
/// have: refraction needs all visible normals.
fn glass_facets(b: Bound) -> MicrofacetsModel {
    return MicrofacetsModel(b.alpha, bound_distribution(b), bound_masking(b), SAMPLER_CAP);
}

/// The smooth surface of glass that `glass_bind` bound, facing the viewer.
fn glass_smooth(b: Bound) -> SmoothDielectric {
    return SmoothDielectric(b.eta, 0u, glass_tints(b));
}
