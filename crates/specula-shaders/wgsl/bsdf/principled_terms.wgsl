// Terms that both principled materials share, by the formulas of Mitsuba 3.

import package::alpha::{alpha_clamped};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::fresnel::dielectric::{DielectricRefraction};
import package::math::rgb::{rgb_luminance};
import package::ndf::distribution::{DISTRIBUTION_GGX};

/// `(1 - cos)^5`, Schlick's weight of the reflectance at grazing angles.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, schlick_weight.
fn principled_terms_schlick_weight(cosine: f32) -> f32 {
    let m = clamp(1.0 - cosine, 0.0, 1.0);
    let squared = m * m;
    return squared * squared * m;
}

/// Schlick's weight at the larger of the two angles: the transmitted one where light leaves the denser
/// medium.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, schlick_weight_across.
fn principled_terms_schlick_weight_across(cosine: f32, bent: DielectricRefraction, eta: f32) -> f32 {
    return principled_terms_schlick_weight(select(bent.cos_t, cosine, eta > 1.0));
}

/// `F0 + (F90 - F0) s` with `F90 = 1`.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, schlick.
fn principled_terms_schlick(normal: vec3f, s: f32) -> vec3f {
    return normal + (vec3f(1.0) - normal) * s;
}

/// Reflectance at normal incidence, `((eta - 1) / (eta + 1))^2`.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, normal_reflectance.
fn principled_terms_normal_reflectance(eta: f32) -> f32 {
    let r = (eta - 1.0) / (eta + 1.0);
    return r * r;
}

/// The base colour at luminance 1; white where it is black.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, hue.
fn principled_terms_hue(base: vec3f) -> vec3f {
    let luminance = rgb_luminance(base);
    if luminance > 0.0 {
        return base / luminance;
    }
    return vec3f(1.0);
}

/// The sheen's colour: white, or towards the base's hue.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, sheen_colour.
fn principled_terms_sheen_colour(base: vec3f, tint: f32) -> vec3f {
    return vec3f(1.0) + (principled_terms_hue(base) - vec3f(1.0)) * tint;
}

/// Facets of the specular lobe: `alpha = roughness^2`, stretched by `sqrt(1 - 0.9 anisotropic)`.
///
/// Source: Burley 2012, section 5.4; the floor of 1e-3 is Mitsuba's.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, distribution.
fn principled_terms_facets(roughness: f32, anisotropic: f32, masking: u32, strategy: u32) -> MicrofacetsModel {
    let alpha = roughness * roughness;
    let aspect = sqrt(1.0 - 0.9 * anisotropic);
    let alphas = max(vec2f(alpha / aspect, alpha * aspect), vec2f(1e-3));
    return MicrofacetsModel(alpha_clamped(alphas), DISTRIBUTION_GGX, masking, strategy);
}

/// Diffuse reflection with retro-reflection and fake subsurface scattering, as a factor on `base / pi`.
///
///     diffuse = (1 - Fo/2) (1 - Fi/2) + R (Fo + Fi + Fo Fi (R - 1)),     R = 2 roughness cos_d^2
///     flat    = 1.25 (S (1 / (cos_o + cos_i) - 1/2) + 1/2)
///     S       = (1 + (R/2 - 1) Fo) (1 + (R/2 - 1) Fi)
///
/// with Schlick's weights `Fo`, `Fi` at the two cosines.
///
/// * `cos_d`: between either direction and the half vector.
///
/// Source: Burley 2012, section 5.3; Burley 2015, section 4.
///
/// Twin: specula-bsdf/src/bsdf/principled/terms.rs, diffuse.
fn principled_terms_diffuse(cos_o: f32, cos_i: f32, cos_d: f32, roughness: f32, flatness: f32) -> f32 {
    let fo = principled_terms_schlick_weight(cos_o);
    let fi = principled_terms_schlick_weight(cos_i);
    let retro = 2.0 * roughness * cos_d * cos_d;
    let burley = (1.0 - 0.5 * fo) * (1.0 - 0.5 * fi) + retro * (fo + fi + fo * fi * (retro - 1.0));
    let grazing = 0.5 * retro - 1.0;
    let through = (1.0 + grazing * fo) * (1.0 + grazing * fi);
    let inverse = 1.0 / max(cos_o + cos_i, 1e-6);
    let flattened = 1.25 * (through * (inverse - 0.5) + 0.5);
    return burley + (flattened - burley) * flatness;
}
