// GGX (Trowbridge and Reitz 1975; Walter et al. 2007), isotropic and anisotropic: normals of an
// ellipsoid with axes `(1/alpha_x, 1/alpha_y, 1)`.
//
// `alpha` is `(alpha_x, alpha_y)`, each in [1e-4, 10]; directions are unit and local, z up.

import package::alpha::{alpha_stretch};
import package::ndf::masking::{MASKING_SEPARABLE, masking_divided, masking_g_correlated, masking_g_single};

/// Density of microfacet normals `D(wm)` in 1/sr; 0 where `wm.z <= 0`.
///
///     D(wm) = 1 / (pi ax ay ((x/ax)^2 + (y/ay)^2 + z^2)^2),   wm = (x, y, z)
///
/// `D(wm) wm.z` integrates to 1 over the hemisphere.
///
/// Source: Tokuyoshi and Eto 2024, eq. 9.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::d.
fn ggx_d(alpha: vec2f, wm: vec3f) -> f32 {
    return ggx_d_along(alpha, wm, 1.0);
}

/// `D` of the normal along `m`, whose squared length is given: saves normalising a half vector.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::d_along.
fn ggx_d_along(alpha: vec2f, m: vec3f, length_squared: f32) -> f32 {
    if m.z <= 0.0 {
        return 0.0;
    }
    // Multiplied through by (ax ay)^4: one division, none by a square of a small alpha.
    let area = alpha.x * alpha.y;
    let x = m.x * alpha.y;
    let y = m.y * alpha.x;
    let z = m.z * area;
    // Squares of the smallest vectors vanish: their quotient is 1, that of the surface's normal.
    let tiny = 1.17549435e-38;
    let root = (area * area * length_squared + tiny) / (z * z + (x * x + (y * y + tiny)));
    return root * root * (0.31830987 / area);
}

/// `(h2, t)`: `h2 = (alpha_x x)^2 + (alpha_y y)^2` and `t = sqrt(h2 + z^2)`.
///
/// A view straight from below sees nothing; with a floor of `h2` quotients by sigma are finite.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::stretched_length.
fn ggx_stretched_length(alpha: vec2f, w: vec3f) -> vec2f {
    let s = alpha_stretch(alpha, w);
    let radius = max(s.x * s.x + s.y * s.y, 1e-24);
    return vec2f(radius, sqrt(radius + s.z * s.z));
}

/// `sigma` as numerator and denominator, so that callers can save a division.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::projected_area_quotient.
fn ggx_projected_area_quotient(alpha: vec2f, w: vec3f) -> vec2f {
    let length = ggx_stretched_length(alpha, w);
    let long = length.y + abs(w.z);
    if w.z >= 0.0 {
        return vec2f(long, 2.0);
    }
    return vec2f(length.x, 2.0 * long);
}

/// Area of the visible microfacets seen from `w`, per unit of the surface's; above 0.
///
///     sigma(w) = int D(wm) max(w . wm, 0) dwm = (t + z) / 2 = h2 / (2 (t - z))
///
/// * `w`: any unit direction, below the horizon too.
///
/// Source: Heitz 2014, eq. 72; the second form, for `z < 0`, Tokuyoshi and Eto 2024, app. C.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::projected_area.
fn ggx_projected_area(alpha: vec2f, w: vec3f) -> f32 {
    let quotient = ggx_projected_area_quotient(alpha, w);
    return quotient.x / quotient.y;
}

/// `|w.z| Lambda(|w.z|)`: finite at grazing angles, where `Lambda` is not.
///
///     |z| Lambda(w) = (t - |z|) / 2 = h2 / (2 (t + |z|))
///
/// Source: Heitz 2014, eq. 72.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::lambda_cos.
fn ggx_lambda_cos(alpha: vec2f, w: vec3f) -> f32 {
    let length = ggx_stretched_length(alpha, w);
    return 0.5 * length.x / (length.y + abs(w.z));
}

/// Smith's `Lambda`, of the upper of the directions `w` and its mirror image; `w.z` is not 0.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::lambda.
fn ggx_lambda(alpha: vec2f, w: vec3f) -> f32 {
    return ggx_lambda_cos(alpha, w) / abs(w.z);
}

/// Smith's masking `G1`; 0 where `w.z <= 0`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g1.
fn ggx_g_single(alpha: vec2f, w: vec3f) -> f32 {
    return masking_g_single(w.z, ggx_lambda_cos(alpha, w));
}

/// Height-correlated masking and shadowing; 0 unless both directions are above the horizon.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_correlated.
fn ggx_g_correlated(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    let lambda_cos = vec2f(ggx_lambda_cos(alpha, wo), ggx_lambda_cos(alpha, wi));
    return masking_g_correlated(vec2f(wo.z, wi.z), lambda_cos);
}

/// Uncorrelated masking and shadowing, `G1(wo) G1(wi)`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_separable.
fn ggx_g_separable(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return ggx_g_single(alpha, wo) * ggx_g_single(alpha, wi);
}

/// `G2(wo, wi) / |wo.z|` as numerator and denominator; see `masking_over_cos_quotient`. With one division
/// in all: `sigma(wo) = s / b` and `|wi.z| Lambda(wi) = h2 / l` are quotients themselves.
///
/// * `masking`: `MASKING_HEIGHT_CORRELATED` or `MASKING_SEPARABLE`.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx::g2_over_cos_quotient.
fn ggx_g2_over_cos_quotient(masking: u32, alpha: vec2f, wo: vec3f, wi: vec3f) -> vec2f {
    let cosine = abs(wi.z);
    let area = ggx_projected_area_quotient(alpha, wo);
    let length = ggx_stretched_length(alpha, wi);
    // The summand: two directions on the horizon leave no 0/0.
    let seen = 2.0 * (length.y + cosine) * cosine + 1e-30;
    let correlated = area.x * seen + abs(wo.z) * (length.x * area.y);
    let separable = area.x * (seen + length.x);
    let denominator = select(correlated, separable, masking == MASKING_SEPARABLE);
    return vec2f(seen * area.y, denominator);
}

/// `G2(wo, wi) / |wo.z|`, the form in which every lobe needs it.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos.
fn ggx_g2_over_cos(masking: u32, alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return masking_divided(ggx_g2_over_cos_quotient(masking, alpha, wo, wi));
}

/// Density of visible normals in 1/sr, for any `wo`.
///
///     D_visible(wo, wm) = D(wm) max(wo . wm, 0) / sigma(wo)
///
/// Source: Heitz and d'Eon 2014, eq. 2; for backfacing views Tokuyoshi 2021.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::d_visible.
fn ggx_d_visible(alpha: vec2f, wo: vec3f, wm: vec3f) -> f32 {
    return ggx_d(alpha, wm) * max(dot(wo, wm), 0.0) / ggx_projected_area(alpha, wo);
}
