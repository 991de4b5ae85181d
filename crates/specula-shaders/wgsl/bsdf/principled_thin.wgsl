// Mitsuba 3's `principledthin`: a sheet without thickness, the same from both sides.
//
//     diffuse (1 - spec_trans) shared by both sides + sheen
//       + spec_trans (reflection F + straight transmission (1 - F) base, wider or narrower by 0.65 eta - 0.35)
//
// Straight transmission is reflection, mirrored through the sheet.
//
// Source: Burley 2015, Extending the Disney BRDF to a BSDF; Mitsuba 3's documentation. Known limitations of
// the model: specula-bsdf/src/bsdf/principled/mod.rs.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_of_reflection, bsdf_sample_of_transmission};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d, microfacets_g_over_cos, microfacets_norm, microfacets_sample_reflection};
import package::bsdf::principled_parameters::{PrincipledParameters};
import package::bsdf::principled_terms::{principled_terms_diffuse, principled_terms_facets, principled_terms_hue, principled_terms_normal_reflectance, principled_terms_schlick, principled_terms_schlick_weight, principled_terms_schlick_weight_across, principled_terms_sheen_colour};
import package::fresnel::dielectric::{dielectric};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere};
import package::ndf::masking::{MASKING_SEPARABLE};
import package::vndf::half_vector::{half_vector_unit};
import package::vndf::sampler::{SAMPLER_BOUNDED};

/// `1 / pi`.
const PRINCIPLED_THIN_PER_PI: f32 = 0.31830988618379;

/// The sheet.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin.
struct PrincipledThin {
    /// Facets of reflection.
    reflecting: MicrofacetsModel,
    /// Facets of transmission: alphas scaled by the index.
    passing: MicrofacetsModel,
    /// Base colour.
    base: vec3f,
    /// `F0` of the tinted part of the reflection.
    tinted_normal: vec3f,
    /// Weight times colour.
    sheen: vec3f,
    /// The artist's.
    roughness: f32,
    /// Share of fake subsurface scattering.
    flatness: f32,
    /// Weight of reflection and straight transmission.
    spec_trans: f32,
    /// Share of the tinted part.
    spec_tint: f32,
    /// Weight of diffuse reflection.
    diffuse_reflection: f32,
    /// Weight of diffuse transmission.
    diffuse_transmission: f32,
    /// Index of the sheet.
    eta: f32,
}

/// Probabilities of the sampler's parts.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Shares.
struct PrincipledThinShares {
    /// Facets of reflection.
    reflection: f32,
    /// Facets of transmission.
    transmission: f32,
    /// The cosine on the side of `wo`.
    diffuse_reflection: f32,
    /// The cosine on the other.
    diffuse_transmission: f32,
}

/// The sheet of these parameters.
///
/// * `p`: shares in [0, 1], `diff_trans` in [0, 2]: of `principled_parameters_held`.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::new.
fn principled_thin_new(p: PrincipledParameters) -> PrincipledThin {
    let matte = 1.0 - p.spec_trans;
    let beyond = 0.5 * p.diff_trans;
    let scale = 0.65 * p.eta - 0.35;
    var lobe: PrincipledThin;
    lobe.reflecting = principled_terms_facets(p.roughness, p.anisotropic, MASKING_SEPARABLE, SAMPLER_BOUNDED);
    lobe.passing = principled_terms_facets(scale * p.roughness, p.anisotropic, MASKING_SEPARABLE, SAMPLER_BOUNDED);
    lobe.base = p.base_colour;
    lobe.tinted_normal = principled_terms_hue(p.base_colour) * principled_terms_normal_reflectance(p.eta);
    lobe.sheen = principled_terms_sheen_colour(p.base_colour, p.sheen_tint) * (p.sheen * matte * (1.0 - beyond));
    lobe.roughness = p.roughness;
    lobe.flatness = p.flatness;
    lobe.spec_trans = p.spec_trans;
    lobe.spec_tint = p.spec_tint;
    lobe.diffuse_reflection = matte * (1.0 - beyond);
    lobe.diffuse_transmission = matte * beyond;
    lobe.eta = p.eta;
    return lobe;
}

/// Reflectance, tinted, and transmittance of a facet: (red, green, blue, transmittance).
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::fresnel.
fn principled_thin_fresnel(lobe: PrincipledThin, cosine: f32) -> vec4f {
    let bent = dielectric(cosine, lobe.eta);
    let s = principled_terms_schlick_weight_across(cosine, bent, lobe.eta);
    let plain = vec3f(bent.reflectance);
    let tinted = principled_terms_schlick(lobe.tinted_normal, s);
    return vec4f(plain + (tinted - plain) * lobe.spec_tint, bent.transmittance);
}

/// Probabilities of the sampler's parts for a view.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::shares.
fn principled_thin_shares(lobe: PrincipledThin, wo: vec3f) -> PrincipledThinShares {
    let fresnel = principled_thin_fresnel(lobe, abs(wo.z));
    let base = rgb_max_channel(lobe.base);
    let reflection = lobe.spec_trans * rgb_max_channel(fresnel.rgb);
    let transmission = lobe.spec_trans * fresnel.a * base;
    let back = lobe.diffuse_reflection * base + 0.1 * rgb_max_channel(lobe.sheen);
    let beyond = lobe.diffuse_transmission * base;
    let scale = 1.0 / max(reflection + transmission + back + beyond, BSDF_SAMPLE_TINY);
    return PrincipledThinShares(reflection * scale, transmission * scale, back * scale, beyond * scale);
}

/// The value and the density, given the direction above the sheet and whether it was there.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::evaluate.
fn principled_thin_evaluate(lobe: PrincipledThin, shares: PrincipledThinShares, wo: vec3f, up: vec3f, reflects: bool) -> vec4f {
    if up.z <= 0.0 || wo.z + up.z <= 0.0 {
        return vec4f(0.0);
    }
    let wm = half_vector_unit(wo + up);
    let cosine_pdf = up.z * PRINCIPLED_THIN_PER_PI;
    let cosine = dot(wo, wm);
    let fresnel = principled_thin_fresnel(lobe, cosine);
    var facets = lobe.passing;
    var colour = lobe.base * fresnel.a;
    var p = shares.transmission;
    if reflects {
        facets = lobe.reflecting;
        colour = fresnel.rgb;
        p = shares.reflection;
    }
    let quarter = 0.25 * microfacets_d(facets, wm);
    let shadowed = microfacets_g_over_cos(facets, wo, up);
    // Mitsuba tests the facet against the direction beyond the sheet, too: where that sees the facet's
    // front, nothing passes.
    let seen = reflects || dot(vec3f(up.xy, -up.z), wm) < 0.0;
    let weight = select(0.0, lobe.spec_trans, seen);
    var f_cos = colour * (weight * quarter * shadowed);
    var pdf = p * quarter / microfacets_norm(facets, wo);
    if reflects {
        let shape = principled_terms_diffuse(abs(wo.z), up.z, cosine, lobe.roughness, lobe.flatness);
        f_cos += lobe.base * (lobe.diffuse_reflection * shape * cosine_pdf);
        f_cos += lobe.sheen * (principled_terms_schlick_weight(cosine) * up.z);
        pdf += shares.diffuse_reflection * cosine_pdf;
    } else {
        f_cos += lobe.base * (lobe.diffuse_transmission * cosine_pdf);
        pdf += shares.diffuse_transmission * cosine_pdf;
    }
    return vec4f(f_cos, pdf);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::eval_pdf.
fn principled_thin_eval_pdf(lobe: PrincipledThin, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let up = vec3f(wi.xy, abs(wi.z));
    return principled_thin_evaluate(lobe, principled_thin_shares(lobe, wo), wo, up, wi.z > 0.0);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, Principled::eval.
fn principled_thin_eval(lobe: PrincipledThin, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return principled_thin_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `principled_thin_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, Principled::pdf.
fn principled_thin_pdf(lobe: PrincipledThin, wo: vec3f, wi: vec3f) -> f32 {
    return principled_thin_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/principled/thin.rs, Thin::sample.
fn principled_thin_sample(lobe: PrincipledThin, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let shares = principled_thin_shares(lobe, wo);
    let first = shares.reflection;
    let second = first + shares.diffuse_reflection;
    let third = second + shares.transmission;
    let reflects = u.x < second;
    var up = warp_cosine_hemisphere(u.yz);
    if u.x < first {
        up = microfacets_sample_reflection(lobe.reflecting, wo, u.yz);
    } else if !reflects && u.x < third {
        up = microfacets_sample_reflection(lobe.passing, wo, u.yz);
    }
    let value = principled_thin_evaluate(lobe, shares, wo, up, reflects);
    if reflects {
        return bsdf_sample_of_reflection(up, value);
    }
    return bsdf_sample_of_transmission(vec3f(up.xy, -up.z), value, 1.0);
}
