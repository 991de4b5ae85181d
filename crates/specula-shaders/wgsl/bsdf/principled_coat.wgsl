// The distribution of normals of the principled clear coat: a generalised Trowbridge and Reitz of exponent
// 1 (GTR1).
//
// Source: Burley 2012, appendix B.2.

import package::math::turns::{turns_sin_cos};

/// `pi`.
const PRINCIPLED_COAT_PI: f32 = 3.14159265358979;

/// `alpha^2` of the clear coat of a gloss in [0, 1]: alpha from 0.1 down to 0.001.
///
/// Twin: specula-bsdf/src/bsdf/principled/gtr1.rs, Gtr1::of_gloss.
fn principled_coat_of_gloss(gloss: f32) -> f32 {
    let alpha = 0.1 + (0.001 - 0.1) * gloss;
    return alpha * alpha;
}

/// Density of normals in 1/sr:
///
///     D(wm) = (a^2 - 1) / (pi ln(a^2) (sin^2 + a^2 cos^2))
///
/// with `1 + (a^2 - 1) cos^2` written without its cancellation at the peak.
///
/// * `squared`: `a^2`, in (0, 1).
///
/// Twin: specula-bsdf/src/bsdf/principled/gtr1.rs, Gtr1::d.
fn principled_coat_d(squared: f32, wm: vec3f) -> f32 {
    if wm.z <= 0.0 {
        return 0.0;
    }
    let denominator = wm.x * wm.x + wm.y * wm.y + squared * wm.z * wm.z;
    return (squared - 1.0) / (PRINCIPLED_COAT_PI * log(squared)) / denominator;
}

/// A normal of density `D(wm) wm.z`.
///
/// Twin: specula-bsdf/src/bsdf/principled/gtr1.rs, Gtr1::sample_wm.
fn principled_coat_sample_wm(squared: f32, u: vec2f) -> vec3f {
    let sin_cos = turns_sin_cos(u.y);
    // a^2 to the power of 1 - u.
    let power = exp((1.0 - u.x) * log(squared));
    let scale = 1.0 / (1.0 - squared);
    let sine = sqrt(max((power - squared) * scale, 0.0));
    let cosine = sqrt(max((1.0 - power) * scale, 0.0));
    return vec3f(sine * sin_cos.y, sine * sin_cos.x, cosine);
}

/// Masking of one direction by GGX with alpha 1/4, whatever the gloss.
///
/// Twin: specula-bsdf/src/bsdf/principled/gtr1.rs, Gtr1::masking.
fn principled_coat_masking_of(w: vec3f) -> f32 {
    let cosine = abs(w.z);
    return 2.0 * cosine / (cosine + sqrt(cosine * cosine + 0.0625 * (w.x * w.x + w.y * w.y)));
}

/// Masking of the clear coat: separable Smith.
///
/// Twin: specula-bsdf/src/bsdf/principled/gtr1.rs, Gtr1::masking.
fn principled_coat_masking(wo: vec3f, wi: vec3f) -> f32 {
    return principled_coat_masking_of(wo) * principled_coat_masking_of(wi);
}
