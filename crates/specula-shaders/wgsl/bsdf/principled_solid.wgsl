// Mitsuba 3's `principled`: a closed surface, seen from one side; from inside only refraction and its
// reflection are left.
//
//     diffuse (1 - metallic) (1 - spec_trans) + sheen (1 - metallic)
//       + reflection by GGX with a Fresnel term between dielectric and base colour
//       + refraction (1 - metallic) spec_trans sqrt(base)  + clear coat by GTR1
//
// Sampled by a mixture of the cosine, the visible normals and the clear coat's own normals, with
// probabilities of our own, by the light that each carries from `wo`.
//
// Source: Burley 2012, Physically-Based Shading at Disney; Burley 2015, Extending the Disney BRDF to a BSDF;
// Mitsuba 3's documentation. Known limitations of the model: specula-bsdf/src/bsdf/principled/mod.rs.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_none, bsdf_sample_of_reflection, bsdf_sample_radiance_scale, bsdf_sample_transmitted};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d, microfacets_g_over_cos, microfacets_norm, microfacets_projected_area, microfacets_sample_reflection, microfacets_sample_wm};
import package::bsdf::principled_coat::{principled_coat_d, principled_coat_masking, principled_coat_of_gloss, principled_coat_sample_wm};
import package::bsdf::principled_parameters::{PrincipledParameters};
import package::bsdf::principled_terms::{principled_terms_diffuse, principled_terms_facets, principled_terms_hue, principled_terms_normal_reflectance, principled_terms_schlick, principled_terms_schlick_weight, principled_terms_schlick_weight_across, principled_terms_sheen_colour};
import package::fresnel::dielectric::{DielectricRefraction, dielectric, dielectric_refract};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere};
import package::ndf::masking::{MASKING_SEPARABLE};
import package::vndf::half_vector::{half_vector_unit};
import package::vndf::reflection::{reflection_mirrored};
import package::vndf::sampler::{SAMPLER_BOUNDED, SAMPLER_CAP};

/// `1 / pi`.
const PRINCIPLED_SOLID_PER_PI: f32 = 0.31830988618379;

/// The closed surface.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid.
struct PrincipledSolid {
    /// Refraction samples all visible normals; without it the bounded cap does.
    facets: MicrofacetsModel,
    /// Base colour.
    base: vec3f,
    /// `F0` of the tinted part of the dielectric reflection.
    tinted_normal: vec3f,
    /// Weight times colour.
    sheen: vec3f,
    /// The artist's.
    roughness: f32,
    /// Share of fake subsurface scattering.
    flatness: f32,
    /// Weight of the dielectric part of the Fresnel term.
    dielectric_weight: f32,
    /// Weight of its tinted part.
    tinted_weight: f32,
    /// Weight of its metallic part.
    metallic_weight: f32,
    /// Weight of the diffuse part.
    diffuse: f32,
    /// Weight of refraction.
    through: f32,
    /// A quarter of the parameter.
    clearcoat: f32,
    /// `alpha^2` of the clear coat.
    coat_squared: f32,
    /// Index beyond over that on the side of `wo`.
    eta: f32,
}

/// Probabilities of the sampler's parts.
///
/// Twin: specula-bsdf/src/bsdf/principled/opaque.rs, Shares.
struct PrincipledSolidShares {
    /// The cosine.
    diffuse: f32,
    /// The clear coat's normals.
    clearcoat: f32,
    /// The visible normals.
    specular: f32,
}

/// The surface of these parameters.
///
/// * `p`: shares in [0, 1], `eta` not 1: of `principled_parameters_held`.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::new.
fn principled_solid_new(p: PrincipledParameters) -> PrincipledSolid {
    let outside = p.outside == 1u;
    let front = select(0.0, 1.0, outside);
    let opaque = 1.0 - p.metallic;
    let through = opaque * p.spec_trans;
    var lobe: PrincipledSolid;
    lobe.eta = select(1.0 / p.eta, p.eta, outside);
    let strategy = select(SAMPLER_BOUNDED, SAMPLER_CAP, through > 0.0);
    lobe.facets = principled_terms_facets(p.roughness, p.anisotropic, MASKING_SEPARABLE, strategy);
    lobe.base = p.base_colour;
    lobe.tinted_normal = principled_terms_hue(p.base_colour) * principled_terms_normal_reflectance(lobe.eta);
    lobe.sheen = principled_terms_sheen_colour(p.base_colour, p.sheen_tint) * (front * p.sheen * opaque);
    lobe.roughness = p.roughness;
    lobe.flatness = p.flatness;
    lobe.dielectric_weight = select(through, opaque * (1.0 - p.spec_tint), outside);
    lobe.tinted_weight = front * opaque * p.spec_tint;
    lobe.metallic_weight = front * p.metallic;
    lobe.diffuse = front * opaque * (1.0 - p.spec_trans);
    lobe.through = through;
    lobe.clearcoat = front * 0.25 * p.clearcoat;
    lobe.coat_squared = principled_coat_of_gloss(p.clearcoat_gloss);
    return lobe;
}

/// The Fresnel term of the main reflection.
///
/// Twin: specula-bsdf/src/bsdf/principled/opaque.rs, Opaque::fresnel.
fn principled_solid_fresnel(lobe: PrincipledSolid, cosine: f32, bent: DielectricRefraction) -> vec3f {
    let s = principled_terms_schlick_weight_across(cosine, bent, lobe.eta);
    return vec3f(lobe.dielectric_weight * bent.reflectance)
        + principled_terms_schlick(lobe.base, s) * lobe.metallic_weight
        + principled_terms_schlick(lobe.tinted_normal, s) * lobe.tinted_weight;
}

/// The clear coat's Fresnel term times its weight.
///
/// Twin: specula-bsdf/src/bsdf/principled/opaque.rs, Opaque::coat_fresnel.
fn principled_solid_coat_fresnel(lobe: PrincipledSolid, cosine: f32, bent: DielectricRefraction) -> f32 {
    let s = principled_terms_schlick_weight_across(cosine, bent, lobe.eta);
    return lobe.clearcoat * (0.04 + 0.96 * s);
}

/// Colour of refraction.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::passing.
fn principled_solid_passing(lobe: PrincipledSolid) -> vec3f {
    return sqrt(lobe.base) * lobe.through;
}

/// Probabilities of the sampler's parts for a view.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::shares.
fn principled_solid_shares(lobe: PrincipledSolid, wo: vec3f) -> PrincipledSolidShares {
    let cosine = abs(wo.z);
    let bent = dielectric(cosine, lobe.eta);
    let passing = rgb_max_channel(principled_solid_passing(lobe)) * bent.transmittance;
    let specular = rgb_max_channel(principled_solid_fresnel(lobe, cosine, bent)) + passing;
    let diffuse = lobe.diffuse * rgb_max_channel(lobe.base) + 0.1 * rgb_max_channel(lobe.sheen);
    // Without the factor 1 / (4 cos cos) the coat's light falls with the square of the cosine.
    let clearcoat = 4.0 * principled_solid_coat_fresnel(lobe, cosine, bent) * cosine * cosine;
    let scale = 1.0 / max(specular + diffuse + clearcoat, BSDF_SAMPLE_TINY);
    return PrincipledSolidShares(diffuse * scale, clearcoat * scale, specular * scale);
}

/// Probability of reflection at a facet.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::reflection_share.
fn principled_solid_reflection_share(lobe: PrincipledSolid, cosine: f32, bent: DielectricRefraction) -> f32 {
    if lobe.through <= 0.0 {
        return 1.0;
    }
    let reflecting = rgb_max_channel(principled_solid_fresnel(lobe, cosine, bent));
    let passing = rgb_max_channel(principled_solid_passing(lobe)) * bent.transmittance;
    return reflecting / max(reflecting + passing, BSDF_SAMPLE_TINY);
}

/// Value and density of reflection.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::reflection.
fn principled_solid_reflection(lobe: PrincipledSolid, shares: PrincipledSolidShares, wo: vec3f, wi: vec3f) -> vec4f {
    if wo.z + wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let wm = half_vector_unit(wo + wi);
    let cosine = dot(wo, wm);
    let bent = dielectric(cosine, lobe.eta);
    let quarter = 0.25 * microfacets_d(lobe.facets, wm);
    let shadowed = microfacets_g_over_cos(lobe.facets, wo, wi);
    var f_cos = principled_solid_fresnel(lobe, cosine, bent) * (quarter * shadowed);
    let share = shares.specular * principled_solid_reflection_share(lobe, cosine, bent);
    var pdf = share * quarter / microfacets_norm(lobe.facets, wo);
    if lobe.diffuse > 0.0 {
        let shape = principled_terms_diffuse(abs(wo.z), wi.z, cosine, lobe.roughness, lobe.flatness);
        f_cos += lobe.base * (lobe.diffuse * shape * wi.z * PRINCIPLED_SOLID_PER_PI);
    }
    f_cos += lobe.sheen * (principled_terms_schlick_weight(cosine) * wi.z);
    pdf += shares.diffuse * wi.z * PRINCIPLED_SOLID_PER_PI;
    if lobe.clearcoat > 0.0 {
        let d = principled_coat_d(lobe.coat_squared, wm);
        let coat = principled_solid_coat_fresnel(lobe, cosine, bent) * d * principled_coat_masking(wo, wi) * wi.z;
        f_cos += vec3f(coat);
        pdf += shares.clearcoat * d * wm.z / (4.0 * cosine);
    }
    return vec4f(f_cos, pdf);
}

/// Value and density of refraction.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::transmission.
fn principled_solid_transmission(lobe: PrincipledSolid, shares: PrincipledSolidShares, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let generalised = wo + wi * lobe.eta;
    let squared = dot(generalised, generalised);
    // Facets seen from behind do not scatter, nor does a half vector of zero length.
    let towards = select(generalised, -generalised, generalised.z < 0.0);
    let wm = towards * (1.0 / sqrt(max(squared, 1e-30)));
    let cos_o = dot(wo, wm);
    let cos_i = dot(wi, wm);
    if squared <= 1e-30 || cos_o <= 0.0 || cos_i >= 0.0 {
        return vec4f(0.0);
    }
    let bent = dielectric(cos_o, lobe.eta);
    let sum = cos_o + lobe.eta * cos_i;
    let jacobian = lobe.eta * lobe.eta * -cos_i / max(sum * sum, BSDF_SAMPLE_TINY);
    let visible = microfacets_d(lobe.facets, wm) * cos_o * jacobian;
    let shadowed = microfacets_g_over_cos(lobe.facets, wo, wi);
    let scale = bsdf_sample_radiance_scale(lobe.eta, transport) * bent.transmittance;
    let p = shares.specular * (1.0 - principled_solid_reflection_share(lobe, cos_o, bent));
    let f_cos = principled_solid_passing(lobe) * (scale * visible * shadowed);
    return vec4f(f_cos, p * visible / microfacets_projected_area(lobe.facets, wo));
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::eval_pdf.
fn principled_solid_eval_pdf(lobe: PrincipledSolid, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let shares = principled_solid_shares(lobe, wo);
    if wi.z > 0.0 {
        return principled_solid_reflection(lobe, shares, wo, wi);
    }
    if wi.z < 0.0 && lobe.through > 0.0 {
        return principled_solid_transmission(lobe, shares, wo, wi, transport);
    }
    return vec4f(0.0);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, Principled::eval.
fn principled_solid_eval(lobe: PrincipledSolid, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return principled_solid_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `principled_solid_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, Principled::pdf.
fn principled_solid_pdf(lobe: PrincipledSolid, wo: vec3f, wi: vec3f) -> f32 {
    return principled_solid_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// Refraction at the facet `wm`, its weight in the cancelled form.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::transmitted.
fn principled_solid_transmitted(lobe: PrincipledSolid, shares: PrincipledSolidShares, wo: vec3f, wm: vec3f, transport: u32) -> BsdfSample {
    let cos_o = dot(wo, wm);
    let bent = dielectric(cos_o, lobe.eta);
    if bent.transmittance <= 0.0 {
        return bsdf_sample_none();
    }
    let wi = dielectric_refract(wo, wm, cos_o, bent.cos_t, lobe.eta);
    let p = shares.specular * (1.0 - principled_solid_reflection_share(lobe, cos_o, bent));
    let sum = cos_o - lobe.eta * bent.cos_t;
    let jacobian = lobe.eta * lobe.eta * bent.cos_t / max(sum * sum, BSDF_SAMPLE_TINY);
    let sigma = microfacets_projected_area(lobe.facets, wo);
    let pdf = p * microfacets_d(lobe.facets, wm) * cos_o * jacobian / sigma;
    let shadowed = sigma * microfacets_g_over_cos(lobe.facets, wo, wi);
    let scale = bsdf_sample_radiance_scale(lobe.eta, transport) * bent.transmittance;
    let weight = principled_solid_passing(lobe) * (scale * shadowed / max(p, BSDF_SAMPLE_TINY));
    return bsdf_sample_transmitted(wi, weight, pdf, lobe.eta);
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/principled/solid.rs, Solid::sample.
fn principled_solid_sample(lobe: PrincipledSolid, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let shares = principled_solid_shares(lobe, wo);
    let before = shares.diffuse + shares.clearcoat;
    var wi: vec3f;
    if u.x < shares.diffuse {
        wi = warp_cosine_hemisphere(u.yz);
    } else if u.x < before {
        wi = reflection_mirrored(wo, principled_coat_sample_wm(lobe.coat_squared, u.yz));
    } else if lobe.through > 0.0 {
        let wm = microfacets_sample_wm(lobe.facets, wo, u.yz);
        let cosine = dot(wo, wm);
        let rest = (u.x - before) / max(shares.specular, BSDF_SAMPLE_TINY);
        if rest >= principled_solid_reflection_share(lobe, cosine, dielectric(cosine, lobe.eta)) {
            return principled_solid_transmitted(lobe, shares, wo, wm, transport);
        }
        wi = reflection_mirrored(wo, wm);
    } else {
        wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    }
    if wi.z <= 0.0 {
        return bsdf_sample_none();
    }
    return bsdf_sample_of_reflection(wi, principled_solid_reflection(lobe, shares, wo, wi));
}
