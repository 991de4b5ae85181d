// Beckmann: normals of a surface with normally distributed slopes, isotropic and anisotropic.
//
// `alpha` is `(alpha_x, alpha_y)`, each in [1e-4, 10]: `sqrt(2)` times the slopes' standard
// deviations. Directions are unit and local, z up.

import package::alpha::{alpha_stretch};
import package::math::erf::{erf_deficit};
import package::ndf::masking::{masking_divided, masking_g_correlated, masking_g_single, masking_over_cos_quotient};

/// Density of microfacet normals `D(wm)` in 1/sr; 0 where `wm.z <= 0`.
///
///     D(wm) = exp(-((x/ax)^2 + (y/ay)^2) / z^2) / (pi ax ay z^4),   wm = (x, y, z)
///
/// `D(wm) wm.z` integrates to 1 over the hemisphere.
///
/// Source: Heitz 2014, eq. 79.
///
/// Twin: specula-bsdf/src/ndf/beckmann.rs, Beckmann::d.
fn beckmann_d(alpha: vec2f, wm: vec3f) -> f32 {
    if wm.z <= 0.0 {
        return 0.0;
    }
    let slope = wm.xy / (alpha * wm.z);
    let exponent = dot(slope, slope);
    // Where the exponential vanishes the quotient may be 0/0.
    if exponent >= 80.0 {
        return 0.0;
    }
    let cosine = wm.z * wm.z;
    return exp(-exponent) / (3.1415927 * alpha.x * alpha.y * cosine * cosine);
}

/// Area of the visible microfacets seen from `w`, per unit of the surface's; above 0.
///
///     sigma(w) = z erfc(-a) / 2 + h exp(-a^2) / (2 sqrt(pi)),   a = z / h
///
/// * `w`: any unit direction, below the horizon too.
///
/// Source: Heitz 2014, eq. 78, times `z`.
///
/// Twin: specula-bsdf/src/ndf/beckmann.rs, Beckmann::projected_area.
fn beckmann_projected_area(alpha: vec2f, w: vec3f) -> f32 {
    return max(beckmann_lambda_cos(alpha, w) + max(w.z, 0.0), 1e-24);
}

/// `|w.z| Lambda(|w.z|)`: finite at grazing angles, where `Lambda` is not.
///
///     |z| Lambda(w) = h exp(-a^2) / (2 sqrt(pi)) - |z| erfc(a) / 2,   a = |z| / h
///                   = h exp(-a^2) (1 - sqrt(pi) a exp(a^2) erfc(a)) / (2 sqrt(pi))
///
/// Source: Heitz 2014, eq. 78, times `|z|`. Departure: the second form, whose bracket is one function
/// without cancellation.
///
/// Twin: specula-bsdf/src/ndf/beckmann.rs, Beckmann::lambda_cos.
fn beckmann_lambda_cos(alpha: vec2f, w: vec3f) -> f32 {
    let s = alpha_stretch(alpha, w);
    let h = max(sqrt(s.x * s.x + s.y * s.y), 1e-18);
    let a = abs(w.z) / h;
    // Beyond, the exponential is 0 in f32 and the square may be infinite.
    if a > 10.0 {
        return 0.0;
    }
    return h * exp(-(a * a)) * erf_deficit(a) * 0.2820948;
}

/// Smith's `Lambda`, of the upper of the directions `w` and its mirror image; `w.z` is not 0.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::lambda.
fn beckmann_lambda(alpha: vec2f, w: vec3f) -> f32 {
    return beckmann_lambda_cos(alpha, w) / abs(w.z);
}

/// Smith's masking `G1`; 0 where `w.z <= 0`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g1.
fn beckmann_g_single(alpha: vec2f, w: vec3f) -> f32 {
    return masking_g_single(w.z, beckmann_lambda_cos(alpha, w));
}

/// Height-correlated masking and shadowing; 0 unless both directions are above the horizon.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_correlated.
fn beckmann_g_correlated(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    let lambda_cos = vec2f(beckmann_lambda_cos(alpha, wo), beckmann_lambda_cos(alpha, wi));
    return masking_g_correlated(vec2f(wo.z, wi.z), lambda_cos);
}

/// Uncorrelated masking and shadowing, `G1(wo) G1(wi)`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_separable.
fn beckmann_g_separable(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return beckmann_g_single(alpha, wo) * beckmann_g_single(alpha, wi);
}

/// `G2(wo, wi) / |wo.z|` as numerator and denominator; see `masking_over_cos_quotient`.
///
/// * `masking`: `MASKING_HEIGHT_CORRELATED` or `MASKING_SEPARABLE`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos_quotient.
fn beckmann_g2_over_cos_quotient(masking: u32, alpha: vec2f, wo: vec3f, wi: vec3f) -> vec2f {
    let area = beckmann_projected_area(alpha, wo);
    let lambda_cos = beckmann_lambda_cos(alpha, wi);
    return masking_over_cos_quotient(masking, area, vec2f(wo.z, wi.z), lambda_cos);
}

/// `G2(wo, wi) / |wo.z|`, the form in which every lobe needs it.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos.
fn beckmann_g2_over_cos(masking: u32, alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return masking_divided(beckmann_g2_over_cos_quotient(masking, alpha, wo, wi));
}

/// Density of visible normals in 1/sr, for any `wo`.
///
///     D_visible(wo, wm) = D(wm) max(wo . wm, 0) / sigma(wo)
///
/// Source: Heitz and d'Eon 2014, eq. 2; for backfacing views Tokuyoshi 2021.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::d_visible.
fn beckmann_d_visible(alpha: vec2f, wo: vec3f, wm: vec3f) -> f32 {
    return beckmann_d(alpha, wm) * max(dot(wo, wm), 0.0) / beckmann_projected_area(alpha, wo);
}
