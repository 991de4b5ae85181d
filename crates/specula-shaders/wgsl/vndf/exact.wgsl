// Reflections off visible GGX normals, none of them below the surface.
//
// The half vectors whose reflection lies above the surface form a quadratic cone (`exact_cone`), whose
// projection along the view has an area in closed form. That area is sampled from uniformly by a walk along
// chords (`exact_chords`). Where the alphas are equal, `exact_isotropic` gives the same with less work. The
// density is the visible normals' over the cone:
//
//     pdf(wi) = D(wm) / (4 N),   N = int D(wm) max(wo . wm, 0) [wi.z > 0] dwm
//
// Source: derived in docs/exact-reflection-sampling.md of Specula. Its ingredients: visible normals as
// half vectors of a spherical cap (Dupuy and Benyoub 2023), the bound of that cap (Tokuyoshi and Eto
// 2024), the vector irradiance of an ellipse.

import package::alpha::{alpha_stretch};
import package::vndf::cap::{cap_sample_direction};
import package::vndf::exact_chords::{exact_chords_half_vector};
import package::vndf::exact_cone::{exact_cone_new, exact_cone_norm};
import package::vndf::half_vector::{half_vector_density, half_vector_mirrored};
import package::vndf::stretched::{stretched_lengths};

/// The reflection of `wo`, above the horizon but for rounding (less than one in 10^6).
///
/// * `wo`: unit, any hemisphere; below the horizon all visible normals reflect upwards, and `cap` samples
///   them.
/// * `u`: uniform in [0, 1)^2, a point of the disk: `u.x` the squared radius, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, sample_direction.
fn exact_sample_direction(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    if wo.z <= 0.0 {
        return cap_sample_direction(alpha, wo, u);
    }
    return half_vector_mirrored(wo, exact_chords_half_vector(alpha, exact_cone_new(alpha, wo), u));
}

/// Density of `exact_sample_direction` in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, reflection_pdf.
fn exact_reflection_pdf(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(alpha, wo, wi, exact_norm_quotient(alpha, wo));
}

/// `N` of `pdf = D(wm) / (4 N)`:
///
///     N = lambda^2 / (|v|^2 sqrt(Dx Dy))   for z > 0,   sigma(wo) else
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, norm.
fn exact_norm(alpha: vec2f, wo: vec3f) -> f32 {
    let quotient = exact_norm_quotient(alpha, wo);
    return quotient.x / quotient.y;
}

/// `exact_norm` as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, norm_quotient.
fn exact_norm_quotient(alpha: vec2f, wo: vec3f) -> vec2f {
    if wo.z <= 0.0 {
        return vec2f(stretched_lengths(alpha_stretch(alpha, wo)).y, 2.0);
    }
    return exact_cone_norm(exact_cone_new(alpha, wo));
}
