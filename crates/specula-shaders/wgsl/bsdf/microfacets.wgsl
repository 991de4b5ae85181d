// A distribution of normals with its masking and sampler, chosen when the shader runs: WGSL has no
// generics, so that what Rust compiles for each distribution is one branch here.

import package::ndf::beckmann::{beckmann_d, beckmann_g2_over_cos_quotient, beckmann_projected_area};
import package::ndf::distribution::{DISTRIBUTION_BECKMANN};
import package::ndf::ggx::{ggx_d_along, ggx_g2_over_cos_quotient, ggx_projected_area};
import package::ndf::masking::{masking_divided};
import package::vndf::beckmann_visible::{beckmann_visible_sample_wm};
import package::vndf::cap::{cap_sample_wm};
import package::vndf::reflection::{reflection_mirrored, reflection_norm_quotient, reflection_sample_direction};

/// Microfacets of a surface and how they are sampled.
///
/// Twin: specula-bsdf/src/bsdf/conductor.rs, RoughConductor and its `ndf`, `masking` and `sampler`.
struct MicrofacetsModel {
    /// Alphas along the local x and y, each in [1e-4, 10].
    alpha: vec2f,
    /// `DISTRIBUTION_GGX` or `DISTRIBUTION_BECKMANN`.
    distribution: u32,
    /// `MASKING_HEIGHT_CORRELATED` or `MASKING_SEPARABLE`.
    masking: u32,
    /// One of `SAMPLER_HEITZ`, `SAMPLER_CAP`, `SAMPLER_BOUNDED` and `SAMPLER_EXACT`; used for GGX
    /// only, Beckmann has one.
    strategy: u32,
}

/// `D` of the normal along `m`, whose squared length is given: saves normalising a half vector. In 1/sr;
/// 0 where `m.z <= 0`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::d_along.
fn microfacets_d_along(facets: MicrofacetsModel, m: vec3f, length_squared: f32) -> f32 {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_d(facets.alpha, m * (1.0 / sqrt(length_squared)));
    }
    return ggx_d_along(facets.alpha, m, length_squared);
}

/// Density of microfacet normals `D(wm)` in 1/sr; 0 where `wm.z <= 0`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::d.
fn microfacets_d(facets: MicrofacetsModel, wm: vec3f) -> f32 {
    return microfacets_d_along(facets, wm, 1.0);
}

/// Area of the visible microfacets seen from `w`, per unit of the surface's; above 0.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::projected_area.
fn microfacets_projected_area(facets: MicrofacetsModel, w: vec3f) -> f32 {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_projected_area(facets.alpha, w);
    }
    return ggx_projected_area(facets.alpha, w);
}

/// `G2(wo, wi) / |wo.z|` as numerator and denominator; see `microfacets_g_over_cos`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos_quotient.
fn microfacets_g_over_cos_quotient(facets: MicrofacetsModel, wo: vec3f, wi: vec3f) -> vec2f {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_g2_over_cos_quotient(facets.masking, facets.alpha, wo, wi);
    }
    return ggx_g2_over_cos_quotient(facets.masking, facets.alpha, wo, wi);
}

/// `G2(wo, wi) / |wo.z|`, the form in which every lobe needs it: finite at grazing views, and continued
/// through the horizon for backfacing shading normals.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos.
fn microfacets_g_over_cos(facets: MicrofacetsModel, wo: vec3f, wi: vec3f) -> f32 {
    return masking_divided(microfacets_g_over_cos_quotient(facets, wo, wi));
}

/// A visible normal, unit.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, VisibleNormals::sample_wm.
fn microfacets_sample_wm(facets: MicrofacetsModel, wo: vec3f, u: vec2f) -> vec3f {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_visible_sample_wm(facets.alpha, wo, u);
    }
    return cap_sample_wm(facets.alpha, wo, u);
}

/// A reflected direction, perhaps below the horizon (to be rejected).
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, VisibleNormals::sample_reflection_by.
fn microfacets_sample_reflection(facets: MicrofacetsModel, wo: vec3f, u: vec2f) -> vec3f {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return reflection_mirrored(wo, beckmann_visible_sample_wm(facets.alpha, wo, u));
    }
    return reflection_sample_direction(facets.strategy, facets.alpha, wo, u);
}

/// The constant `N` of `pdf(wi) = D(wm) / (4 N)` of reflections above the horizon, as numerator and
/// denominator.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, VisibleNormals::reflection_norm_quotient.
fn microfacets_norm_quotient(facets: MicrofacetsModel, wo: vec3f) -> vec2f {
    if facets.distribution == DISTRIBUTION_BECKMANN {
        return vec2f(beckmann_projected_area(facets.alpha, wo), 1.0);
    }
    return reflection_norm_quotient(facets.strategy, facets.alpha, wo);
}

/// The constant `N` of `pdf(wi) = D(wm) / (4 N)` of reflections above the horizon.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, VisibleNormals::reflection_norm_by.
fn microfacets_norm(facets: MicrofacetsModel, wo: vec3f) -> f32 {
    let quotient = microfacets_norm_quotient(facets, wo);
    return quotient.x / quotient.y;
}
