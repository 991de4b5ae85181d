// glTF 2.0's metallic-roughness material with the extensions ior, specular, anisotropy, transmission, volume
// (its boundary), sheen and clearcoat, as seen from the geometric side of `wo`.
//
//     metal      = (b + (1 - b) s) G2 D / (4 |wo.z| |wi.z|),        s = (1 - wo.wm)^5,  b = base colour
//     dielectric = w F G2 D / (4 |wo.z| |wi.z|) + (1 - w max F) (b (1 - t) g / pi + b t btdf)
//     F  = f0 + (1 - f0) s,    f0 = min(1, specular_colour ((ior - 1) / (ior + 1))^2),  w = specular
//     f  = (1 - c) (sheen + scale (dielectric (1 - metallic) + metal metallic)) + c G2 D_c / (4 ..)
//     c  = clearcoat (0.04 + 0.96 (1 - |wo.nc|)^5),    nc = the coat's normal
//     scale = min over wo, wi of 1 - max(sheen_colour) E
//
// `G2` is height-correlated; that of `btdf`, a reflection mirrored through the sheet, is separable, as the
// extension says. With `volume`, `btdf` is Walter's refraction, and the Fresnel terms from inside take the
// refracted cosine. `g = min(1, (1 - E) / B)` of both directions (`gltf_albedo`) is Specula's: no direction
// reflects more than it receives. Where `compensated`, the metal is multiplied by Turquin's factor
// `1 + b L(wo) / (1 - L(wo))`, with the loss `L` of a white metal.
//
// Sampled by a mixture of visible normals of base and coat, the cosine, and for sheen the uniform hemisphere,
// by the light that each carries from `wo`. Known limitations of the model:
// specula-bsdf/src/bsdf/gltf/mod.rs.
//
// Source: Khronos, glTF 2.0 specification, appendix B, and the extensions' implementation notes; sheen:
// Estevez and Kulla 2017.

import package::alpha::{ALPHA_SPECULAR_BELOW, alpha_clamped};
import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_none, bsdf_sample_of_reflection, bsdf_sample_of_transmission, bsdf_sample_radiance_scale};
import package::bsdf::gltf_albedo::{GltfAlbedoLayer, gltf_albedo_layer, gltf_albedo_limit};
import package::bsdf::gltf_sheen::{GltfSheen, gltf_sheen_charlie_f_cos, gltf_sheen_left, gltf_sheen_new, gltf_sheen_strength};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d, microfacets_g_over_cos, microfacets_norm, microfacets_projected_area, microfacets_sample_reflection, microfacets_sample_wm};
import package::bsdf::principled_terms::{principled_terms_schlick_weight};
import package::energy::albedo::{AlbedoLoss, albedo_directional_loss, albedo_loss};
import package::fresnel::dielectric::{dielectric, dielectric_refract};
import package::math::frame::{frame_from_normal, frame_to_local, frame_to_world};
import package::math::rgb::{rgb_is_black, rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere, warp_uniform_sphere};
import package::ndf::distribution::{DISTRIBUTION_GGX};
import package::ndf::masking::{MASKING_HEIGHT_CORRELATED, MASKING_SEPARABLE};
import package::vndf::half_vector::{half_vector_unit};
import package::vndf::sampler::{SAMPLER_BOUNDED};

/// `1 / pi`.
const GLTF_PER_PI: f32 = 0.31830988618379;
/// `1 / (2 pi)`.
const GLTF_PER_TURN: f32 = 0.15915494309190;

/// What a `GltfLobe` is made of, by the names of the specification; shares are in [0, 1].
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, GltfParameters.
struct GltfParameters {
    /// `baseColor`.
    base_colour: vec3f,
    /// `metallic`.
    metallic: f32,
    /// `roughness`; alpha is its square.
    roughness: f32,
    /// `anisotropyStrength`; its direction is the local x axis.
    anisotropy: f32,
    /// `ior`; 0 stands for a reflectance of 1.
    ior: f32,
    /// `specular`.
    specular: f32,
    /// `specularColor`; may exceed 1.
    specular_colour: vec3f,
    /// `transmission`.
    transmission: f32,
    /// 1 where the surface bounds a volume, so that light bends (`KHR_materials_volume`).
    volume: u32,
    /// 1 where it is seen from outside; used where `volume` is 1.
    outside: u32,
    /// `clearcoat`.
    clearcoat: f32,
    /// `clearcoatRoughness`.
    clearcoat_roughness: f32,
    /// `sheenColor`.
    sheen_colour: vec3f,
    /// `sheenRoughness`.
    sheen_roughness: f32,
    /// 1 where the metal's facets give back what they lose by scattering once.
    compensated: u32,
}

/// The material.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf.
struct GltfLobe {
    /// Base colour.
    base: vec3f,
    /// Facets of reflection; height-correlated.
    facets: MicrofacetsModel,
    /// Facets of transmission, without blur where nothing bends; separable.
    passing: MicrofacetsModel,
    /// What the layer leaves to the diffuse base.
    albedo: GltfAlbedoLayer,
    /// `f0` of the formulas.
    normal: vec3f,
    /// Weight of the dielectric layer.
    specular: f32,
    /// Share of the metal.
    metallic: f32,
    /// 1 where the metal gives back `loss`.
    compensated: u32,
    /// What facets lose by scattering once.
    loss: AlbedoLoss,
    /// Weight of the diffuse base.
    diffuse: f32,
    /// Weight of transmission.
    through: f32,
    /// 1 where light bends.
    bends: u32,
    /// Index beyond over that on the side of `wo`.
    eta: f32,
    /// Weight of the clear coat.
    clearcoat: f32,
    /// Facets of the coat; height-correlated.
    coat: MicrofacetsModel,
    /// The coat's normal, unit, local frame.
    coat_normal: vec3f,
    /// 1 where there is sheen.
    has_sheen: u32,
    /// Fibres.
    sheen: GltfSheen,
}

/// Probabilities of the sampler's parts, and what else depends on the view alone.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Shares.
struct GltfShares {
    /// Factor of the metal's reflectance.
    gain: vec3f,
    /// Visible normals of the coat.
    coat: f32,
    /// The uniform hemisphere.
    sheen: f32,
    /// The cosine.
    diffuse: f32,
    /// Visible normals of the base.
    specular: f32,
    /// Directions through the surface.
    transmission: f32,
}

/// The specification's defaults.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, GltfParameters::default.
fn gltf_parameters_default() -> GltfParameters {
    var p: GltfParameters;
    p.base_colour = vec3f(1.0);
    p.metallic = 1.0;
    p.roughness = 1.0;
    p.ior = 1.5;
    p.specular = 1.0;
    p.specular_colour = vec3f(1.0);
    p.outside = 1u;
    return p;
}

/// Alpha of a roughness, at least what f32 directions resolve.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, alpha_of.
fn gltf_alpha_of(roughness: f32) -> f32 {
    let held = clamp(roughness, 0.0, 1.0);
    return max(held * held, ALPHA_SPECULAR_BELOW);
}

/// Facets of GGX for the bounded cap.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::new.
fn gltf_facets(alpha: vec2f, masking: u32) -> MicrofacetsModel {
    return MicrofacetsModel(alpha_clamped(alpha), DISTRIBUTION_GGX, masking, SAMPLER_BOUNDED);
}

/// The material of these parameters; shares outside [0, 1] are clamped.
///
/// * `coat_normal`: the clear coat's (`clearcoatNormalTexture`), unit, local frame; (0, 0, 1) where it has none
///   of its own.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::new and Gltf::with_coat_normal.
fn gltf_new(p: GltfParameters, coat_normal: vec3f) -> GltfLobe {
    let ior = clamp(p.ior, 0.0, 1e3);
    let r = (ior - 1.0) / (ior + 1.0);
    let bends = p.volume == 1u && abs(ior - 1.0) >= 1e-3 && ior >= 0.1;
    let inside = p.volume == 1u && p.outside == 0u;
    let front = select(1.0, 0.0, inside);
    let alpha = gltf_alpha_of(p.roughness);
    let strength = clamp(p.anisotropy, 0.0, 1.0);
    let alphas = vec2f(alpha + (1.0 - alpha) * strength * strength, alpha);
    let metallic = clamp(p.metallic, 0.0, 1.0);
    let compensated = p.compensated == 1u && metallic > 0.0;
    let transmission = clamp(p.transmission, 0.0, 1.0);
    var lobe: GltfLobe;
    lobe.base = clamp(p.base_colour, vec3f(0.0), vec3f(1.0));
    lobe.facets = gltf_facets(alphas, MASKING_HEIGHT_CORRELATED);
    lobe.passing = gltf_facets(alphas, MASKING_SEPARABLE);
    if p.volume == 1u && !bends {
        lobe.passing = gltf_facets(vec2f(ALPHA_SPECULAR_BELOW), MASKING_SEPARABLE);
    }
    lobe.normal = clamp(p.specular_colour * r * r, vec3f(0.0), vec3f(1.0));
    lobe.specular = clamp(p.specular, 0.0, 1.0);
    lobe.albedo = gltf_albedo_layer(lobe.facets.alpha, lobe.specular * rgb_max_channel(lobe.normal), lobe.specular);
    lobe.metallic = metallic;
    lobe.compensated = select(0u, 1u, compensated);
    if compensated {
        lobe.loss = albedo_loss(DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, lobe.facets.alpha);
    }
    lobe.diffuse = front * (1.0 - metallic) * (1.0 - transmission);
    lobe.through = (1.0 - metallic) * transmission;
    lobe.bends = select(0u, 1u, bends);
    lobe.eta = ior;
    if inside {
        lobe.eta = 1.0 / ior;
    }
    lobe.clearcoat = front * clamp(p.clearcoat, 0.0, 1.0);
    lobe.coat = gltf_facets(vec2f(gltf_alpha_of(p.clearcoat_roughness)), MASKING_HEIGHT_CORRELATED);
    lobe.coat_normal = coat_normal;
    let sheen = front * clamp(p.sheen_colour, vec3f(0.0), vec3f(1.0));
    lobe.has_sheen = select(1u, 0u, rgb_is_black(sheen));
    lobe.sheen = gltf_sheen_new(sheen, clamp(p.sheen_roughness, 0.0, 1.0));
    return lobe;
}

/// The share of the coat, seen from `wo`.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::coat_share.
fn gltf_coat_share(lobe: GltfLobe, wo: vec3f) -> f32 {
    let cosine = min(abs(dot(lobe.coat_normal, wo)), 1.0);
    return lobe.clearcoat * (0.04 + 0.96 * principled_terms_schlick_weight(cosine));
}

/// Factor of the metal's reflectance, seen from `wo`.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::gain.
fn gltf_gain(lobe: GltfLobe, wo: vec3f) -> vec3f {
    if lobe.compensated == 0u {
        return vec3f(1.0);
    }
    let lost = albedo_directional_loss(lobe.loss, wo);
    return vec3f(1.0) + lobe.base * (lost / max(1.0 - lost, 1e-5));
}

/// Reflectance of the facets, metal and dielectric, and what the layer leaves to its base:
/// (red, green, blue, left). Schlick's weight is of the refracted angle where light leaves the denser body.
///
/// * `gain`: factor of the metal's.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::fresnel.
fn gltf_fresnel(lobe: GltfLobe, cosine: f32, gain: vec3f) -> vec4f {
    var angle = cosine;
    if lobe.bends == 1u && lobe.eta < 1.0 {
        angle = dielectric(cosine, lobe.eta).cos_t;
    }
    let s = principled_terms_schlick_weight(angle);
    let layer = lobe.specular * (lobe.normal + (vec3f(1.0) - lobe.normal) * s);
    let metal_part = lobe.base + (vec3f(1.0) - lobe.base) * s;
    return vec4f(metal_part * gain * lobe.metallic + layer * (1.0 - lobe.metallic), 1.0 - rgb_max_channel(layer));
}

/// Probabilities of the sampler's parts for a view.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::shares.
fn gltf_shares(lobe: GltfLobe, wo: vec3f) -> GltfShares {
    let gain = gltf_gain(lobe, wo);
    let fresnel = gltf_fresnel(lobe, abs(wo.z), gain);
    // Facets pass light where the mean surface reflects all of it.
    let left = max(fresnel.a, 0.1) * rgb_max_channel(lobe.base);
    let coat = gltf_coat_share(lobe, wo);
    let under = 1.0 - coat;
    var sheen = 0.0;
    if lobe.has_sheen == 1u {
        sheen = under * gltf_sheen_strength(lobe.sheen, wo);
    }
    let diffuse = under * left * lobe.diffuse;
    let specular = under * rgb_max_channel(fresnel.rgb);
    let transmission = under * left * lobe.through;
    let scale = 1.0 / max(coat + sheen + diffuse + specular + transmission, BSDF_SAMPLE_TINY);
    return GltfShares(gain, coat * scale, sheen * scale, diffuse * scale, specular * scale, transmission * scale);
}

/// What sheen and coat leave of the base.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::covers.
fn gltf_covers(lobe: GltfLobe, wo: vec3f, wi: vec3f) -> f32 {
    let under = 1.0 - gltf_coat_share(lobe, wo);
    if lobe.has_sheen == 1u {
        return under * gltf_sheen_left(lobe.sheen, wo, wi);
    }
    return under;
}

/// Value and density of reflection by all but the coat, at facets that are seen.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::base_reflection.
fn gltf_base_reflection(lobe: GltfLobe, shares: GltfShares, wo: vec3f, wi: vec3f) -> vec4f {
    let wm = half_vector_unit(wo + wi);
    let fresnel = gltf_fresnel(lobe, dot(wo, wm), shares.gain);
    let cosine = wi.z * GLTF_PER_PI;
    let quarter = 0.25 * microfacets_d(lobe.facets, wm);
    var pdf = shares.specular * quarter / microfacets_norm(lobe.facets, wo) + shares.diffuse * cosine;
    let shadowed = microfacets_g_over_cos(lobe.facets, wo, wi);
    var f_cos = fresnel.rgb * (quarter * shadowed);
    if lobe.diffuse > 0.0 {
        let limit = gltf_albedo_limit(lobe.albedo, wo) * gltf_albedo_limit(lobe.albedo, wi);
        f_cos += lobe.base * (lobe.diffuse * fresnel.a * limit * cosine);
    }
    f_cos *= gltf_covers(lobe, wo, wi);
    if lobe.has_sheen == 1u {
        let fibres = gltf_sheen_charlie_f_cos(lobe.sheen.roughness, wo, wi, wm);
        f_cos += lobe.sheen.colour * (fibres * (1.0 - gltf_coat_share(lobe, wo)));
        pdf += shares.sheen * GLTF_PER_TURN;
    }
    return vec4f(f_cos, pdf);
}

/// Value and density of reflection.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::reflection.
fn gltf_reflection(lobe: GltfLobe, shares: GltfShares, wo: vec3f, wi: vec3f) -> vec4f {
    var value = vec4f(0.0);
    if wo.z + wi.z > 0.0 {
        value = gltf_base_reflection(lobe, shares, wo, wi);
    }
    if lobe.clearcoat > 0.0 {
        let frame = frame_from_normal(lobe.coat_normal);
        let local_o = frame_to_local(frame, wo);
        let local_i = frame_to_local(frame, wi);
        let half_vector = local_o + local_i;
        if local_i.z > 0.0 && half_vector.z > 0.0 {
            let quarter = 0.25 * microfacets_d(lobe.coat, normalize(half_vector));
            let shadowed = microfacets_g_over_cos(lobe.coat, local_o, local_i);
            let f_cos = vec3f(gltf_coat_share(lobe, wo) * quarter * shadowed);
            value += vec4f(f_cos, shares.coat * quarter / microfacets_norm(lobe.coat, local_o));
        }
    }
    return value;
}

/// Value and density of Walter's refraction.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::refraction.
fn gltf_refraction(lobe: GltfLobe, shares: GltfShares, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let generalised = wo + wi * lobe.eta;
    let squared = dot(generalised, generalised);
    let towards = select(generalised, -generalised, generalised.z < 0.0);
    let wm = towards * (1.0 / sqrt(max(squared, 1e-30)));
    let cos_o = dot(wo, wm);
    let cos_i = dot(wi, wm);
    // Facets seen from behind do not scatter, nor does a half vector of zero length.
    if squared <= 1e-30 || cos_o <= 0.0 || cos_i >= 0.0 {
        return vec4f(0.0);
    }
    let left = gltf_fresnel(lobe, cos_o, shares.gain).a;
    let sum = cos_o + lobe.eta * cos_i;
    let jacobian = lobe.eta * lobe.eta * -cos_i / max(sum * sum, BSDF_SAMPLE_TINY);
    let visible = microfacets_d(lobe.facets, wm) * cos_o * jacobian;
    let shadowed = microfacets_g_over_cos(lobe.facets, wo, wi);
    let scale = bsdf_sample_radiance_scale(lobe.eta, transport);
    let weight = lobe.through * left * scale * gltf_covers(lobe, wo, wi);
    let pdf = shares.transmission * visible / microfacets_projected_area(lobe.facets, wo);
    return vec4f(lobe.base * (weight * visible * shadowed), pdf);
}

/// Value and density of transmission.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::transmission.
fn gltf_transmission(lobe: GltfLobe, shares: GltfShares, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if lobe.bends == 1u {
        return gltf_refraction(lobe, shares, wo, wi, transport);
    }
    let up = vec3f(wi.xy, -wi.z);
    if wo.z + up.z <= 0.0 {
        return vec4f(0.0);
    }
    let wm = half_vector_unit(wo + up);
    let left = gltf_fresnel(lobe, dot(wo, wm), shares.gain).a;
    let quarter = 0.25 * microfacets_d(lobe.passing, wm);
    let shadowed = microfacets_g_over_cos(lobe.passing, wo, up);
    let weight = lobe.through * left * gltf_covers(lobe, wo, wi);
    let pdf = shares.transmission * quarter / microfacets_norm(lobe.passing, wo);
    return vec4f(lobe.base * (weight * quarter * shadowed), pdf);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::eval_pdf.
fn gltf_eval_pdf(lobe: GltfLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let shares = gltf_shares(lobe, wo);
    if wi.z > 0.0 {
        return gltf_reflection(lobe, shares, wo, wi);
    }
    if wi.z < 0.0 && lobe.through > 0.0 {
        return gltf_transmission(lobe, shares, wo, wi, transport);
    }
    return vec4f(0.0);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::eval.
fn gltf_eval(lobe: GltfLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return gltf_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `gltf_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::pdf.
fn gltf_pdf(lobe: GltfLobe, wo: vec3f, wi: vec3f) -> f32 {
    return gltf_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// A direction through the surface; upwards, to be rejected, where light is totally reflected.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::sample_transmission.
fn gltf_sample_transmission(lobe: GltfLobe, wo: vec3f, u: vec2f) -> vec3f {
    if lobe.bends == 0u {
        let up = microfacets_sample_reflection(lobe.passing, wo, u);
        return vec3f(up.xy, -up.z);
    }
    let wm = microfacets_sample_wm(lobe.facets, wo, u);
    let cosine = dot(wo, wm);
    let bent = dielectric(cosine, lobe.eta);
    if bent.cos_t <= 0.0 {
        return vec3f(0.0, 0.0, 1.0);
    }
    return dielectric_refract(wo, wm, cosine, bent.cos_t, lobe.eta);
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/gltf/mod.rs, Gltf::sample.
fn gltf_sample(lobe: GltfLobe, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let shares = gltf_shares(lobe, wo);
    if u.x < shares.transmission {
        let below = gltf_sample_transmission(lobe, wo, u.yz);
        if below.z >= 0.0 {
            return bsdf_sample_none();
        }
        let passed = gltf_transmission(lobe, shares, wo, below, transport);
        return bsdf_sample_of_transmission(below, passed, select(1.0, lobe.eta, lobe.bends == 1u));
    }
    let specular = shares.transmission + shares.specular;
    let coat = specular + shares.coat;
    let from_coat = u.x >= specular && u.x < coat;
    var wi = warp_cosine_hemisphere(u.yz);
    if u.x < specular {
        wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    } else if from_coat {
        let frame = frame_from_normal(lobe.coat_normal);
        let local_i = microfacets_sample_reflection(lobe.coat, frame_to_local(frame, wo), u.yz);
        if local_i.z <= 0.0 {
            return bsdf_sample_none();
        }
        wi = frame_to_world(frame, local_i);
    } else if u.x < coat + shares.sheen {
        let w = warp_uniform_sphere(u.yz);
        wi = vec3f(w.xy, abs(w.z));
    }
    // Only the coat scatters where the base's facets are seen from behind.
    if wi.z <= 0.0 || (!from_coat && wo.z + wi.z <= 0.0) {
        return bsdf_sample_none();
    }
    return bsdf_sample_of_reflection(wi, gltf_reflection(lobe, shares, wo, wi));
}
