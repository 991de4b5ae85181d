// The distribution of microfacet normals that a walk meets, chosen when the shader runs: WGSL has no
// generics, so that what the Rust compiles for each distribution is one branch here. (`microfacets` has
// masking and samplers, too; a walk needs neither.)

import package::ndf::beckmann::{beckmann_d, beckmann_lambda_cos, beckmann_projected_area};
import package::ndf::distribution::{DISTRIBUTION_BECKMANN};
import package::ndf::ggx::{ggx_d, ggx_lambda_cos, ggx_projected_area};
import package::vndf::beckmann_visible::{beckmann_visible_sample_wm};
import package::vndf::cap::{cap_sample_wm};

/// A distribution of microfacet normals.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf.
struct NormalsModel {
    /// Alphas along the local x and y, each in [1e-4, 10].
    alpha: vec2f,
    /// `DISTRIBUTION_GGX` or `DISTRIBUTION_BECKMANN`.
    distribution: u32,
}

/// Density of microfacet normals `D(wm)` in 1/sr; 0 where `wm.z <= 0`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::d.
fn normals_d(normals: NormalsModel, wm: vec3f) -> f32 {
    if normals.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_d(normals.alpha, wm);
    }
    return ggx_d(normals.alpha, wm);
}

/// `|w.z| Lambda(|w.z|)`: finite at grazing angles, where `Lambda` is not.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::lambda_cos.
fn normals_lambda_cos(normals: NormalsModel, w: vec3f) -> f32 {
    if normals.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_lambda_cos(normals.alpha, w);
    }
    return ggx_lambda_cos(normals.alpha, w);
}

/// Area of the visible microfacets seen from `w`, per unit of the surface's; above 0.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::projected_area.
fn normals_projected_area(normals: NormalsModel, w: vec3f) -> f32 {
    if normals.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_projected_area(normals.alpha, w);
    }
    return ggx_projected_area(normals.alpha, w);
}

/// A visible normal, unit.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, VisibleNormals::sample_wm.
fn normals_sample_wm(normals: NormalsModel, wo: vec3f, u: vec2f) -> vec3f {
    if normals.distribution == DISTRIBUTION_BECKMANN {
        return beckmann_visible_sample_wm(normals.alpha, wo, u);
    }
    return cap_sample_wm(normals.alpha, wo, u);
}
