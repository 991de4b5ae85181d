// Rough metals that keep their energy.
//
//     Turquin            f = f_ss (1 + F_ms L(wo) / E(wo)),     E = 1 - L
//     Kulla and Conty    f = f_ss + F_avg F_ms L(wo) L(wi) / (pi L_avg)
//
// `L` is the loss of the white surface by azimuth and elevation, so that anisotropic surfaces conserve
// energy too. For views below the horizon (`wo.z < 0`) `L` is that of the mirror image: finite and
// continuous.
//
// Turquin's lobe is sampled as the single-scattering lobe is. Kulla and Conty's second lobe is sampled by the
// cosine with the probability of its share of the light:
//
//     p = F_avg F_ms L / (F_avg F_ms L + F_avg E),   pdf = (1 - p) pdf_ss + p cos / pi
//
// Kulla and Conty's lobe is reciprocal above the horizon; Turquin's is not.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_of_reflection};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::rough_conductor::{RoughConductor, rough_conductor_sample, rough_conductor_eval_pdf, rough_conductor_pdf};
import package::energy::albedo::{AlbedoLoss, albedo_directional_loss, albedo_loss};
import package::energy::fresnel_average::{fresnel_average_of};
import package::energy::model::{MODEL_KULLA_CONTY, MODEL_TURQUIN, model_further_bounces};
import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};

/// Single scattering off a rough metal, and what replaces the further bounces (`model`).
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated.
struct CompensatedConductor {
    /// The single-scattering lobe.
    single: RoughConductor,
    /// The energy that it loses.
    loss: AlbedoLoss,
    /// `MODEL_TURQUIN`, `MODEL_TURQUIN_SERIES` or `MODEL_KULLA_CONTY`.
    model: u32,
    /// Average reflectance of a facet.
    average: vec3f,
    /// Factor of the light given back: `F_ms` (Turquin), `F_avg F_ms` (Kulla and Conty).
    colour: vec3f,
}

/// The metal of these facets.
///
/// * `model`: `MODEL_TURQUIN`, `MODEL_TURQUIN_SERIES` or `MODEL_KULLA_CONTY`.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::new.
fn compensated_new(facets: MicrofacetsModel, reflectance: ReflectanceModel, model: u32) -> CompensatedConductor {
    var lobe: CompensatedConductor;
    lobe.single = RoughConductor(facets, reflectance);
    lobe.loss = albedo_loss(facets.distribution, facets.masking, facets.alpha);
    lobe.model = model;
    if model == MODEL_TURQUIN {
        lobe.average = vec3f(0.0);
        lobe.colour = reflectance_eval(reflectance, 1.0);
        return lobe;
    }
    lobe.average = fresnel_average_of(reflectance);
    let series = model_further_bounces(lobe.average, lobe.loss.average);
    lobe.colour = series * select(vec3f(1.0), lobe.average, model == MODEL_KULLA_CONTY);
    return lobe;
}

/// `1 + F_ms L / E`.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::turquin_factor.
fn compensated_turquin_factor(lobe: CompensatedConductor, wo: vec3f) -> vec3f {
    let loss = albedo_directional_loss(lobe.loss, wo);
    return vec3f(1.0) + lobe.colour * (loss / max(1.0 - loss, 1e-5));
}

/// Probability of sampling Kulla and Conty's second lobe.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::second_share.
fn compensated_second_share(lobe: CompensatedConductor, loss: f32) -> f32 {
    let second = rgb_max_channel(lobe.colour) * loss;
    let first = rgb_max_channel(lobe.average) * (1.0 - loss);
    if second > 0.0 {
        return second / (second + first);
    }
    return 0.0;
}

/// Kulla and Conty's sum and its density, given the loss at `wo`.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::both_lobes.
fn compensated_both_lobes(lobe: CompensatedConductor, wo: vec3f, wi: vec3f, loss: f32, transport: u32) -> vec4f {
    if wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let first = rough_conductor_eval_pdf(lobe.single, wo, wi, transport);
    let cosine = warp_cosine_hemisphere_pdf(wi);
    let shape = loss * albedo_directional_loss(lobe.loss, wi) * cosine / lobe.loss.average;
    let p = compensated_second_share(lobe, loss);
    return vec4f(first.rgb + lobe.colour * shape, first.a + p * (cosine - first.a));
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::eval_pdf.
fn compensated_eval_pdf(lobe: CompensatedConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if lobe.model == MODEL_KULLA_CONTY {
        let loss = albedo_directional_loss(lobe.loss, wo);
        return compensated_both_lobes(lobe, wo, wi, loss, transport);
    }
    let first = rough_conductor_eval_pdf(lobe.single, wo, wi, transport);
    return vec4f(first.rgb * compensated_turquin_factor(lobe, wo), first.a);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::eval.
fn compensated_eval(lobe: CompensatedConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return compensated_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `compensated_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::pdf.
fn compensated_pdf(lobe: CompensatedConductor, wo: vec3f, wi: vec3f) -> f32 {
    let first = rough_conductor_pdf(lobe.single, wo, wi);
    if lobe.model == MODEL_KULLA_CONTY {
        let p = compensated_second_share(lobe, albedo_directional_loss(lobe.loss, wo));
        return first + p * (warp_cosine_hemisphere_pdf(wi) - first);
    }
    return first;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/compensated.rs, Compensated::sample.
fn compensated_sample(lobe: CompensatedConductor, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    if lobe.model != MODEL_KULLA_CONTY {
        var sampled = rough_conductor_sample(lobe.single, wo, u, transport);
        sampled.weight *= compensated_turquin_factor(lobe, wo);
        return sampled;
    }
    let loss = albedo_directional_loss(lobe.loss, wo);
    var wi = warp_cosine_hemisphere(u.yz);
    if u.x >= compensated_second_share(lobe, loss) {
        let first = rough_conductor_sample(lobe.single, wo, u, transport);
        if first.flags == 0u {
            return first;
        }
        wi = first.wi;
    }
    return bsdf_sample_of_reflection(wi, compensated_both_lobes(lobe, wo, wi, loss, transport));
}
