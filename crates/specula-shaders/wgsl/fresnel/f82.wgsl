// Schlick's approximation with a chosen colour at 82 degrees: the "F82-tint" model, Schlick's term less
// a hump that is largest at `cos = 1/7`.
//
//     F = F0 + (1 - F0) (1 - cos)^5 - b cos (1 - cos)^6
//     b = (F_schlick(1/7) (1 - tint)) / ((1/7) (6/7)^6)
//
// A tint of 1 is Schlick's term; metals have tints below 1.
//
// Source: Kutz, Hasan and Edmondson 2021, Novel Aspects of the Adobe Standard Material; Hoffman 2019,
// Fresnel Equations Considered Harmful.

import package::fresnel::schlick::{schlick_eval};

/// The hump `b`.
///
/// * `normal`: reflectance at normal incidence, in [0, 1].
/// * `tint`: factor on Schlick's reflectance at `cos = 1/7` (81.8 degrees), in [0, 1].
///
/// Twin: specula-bsdf/src/fresnel/f82.rs, F82Tint::new.
fn f82_hump(normal: vec3f, tint: vec3f) -> vec3f {
    // 1 / ((1/7) (6/7)^6)
    return schlick_eval(normal, 0.14285715) * (1.0 - tint) * 17.651385;
}

/// Reflectance at `cosine`, in [0, 1].
///
/// * `normal`: reflectance at normal incidence; `hump`: of `f82_hump`.
///
/// Twin: specula-bsdf/src/fresnel/f82.rs, F82Tint::eval.
fn f82_eval(normal: vec3f, hump: vec3f, cosine: f32) -> vec3f {
    let m = clamp(1.0 - cosine, 0.0, 1.0);
    let cube = m * m * m;
    let height = clamp(cosine, 0.0, 1.0) * cube * cube;
    return clamp(schlick_eval(normal, cosine) - hump * height, vec3f(0.0), vec3f(1.0));
}
