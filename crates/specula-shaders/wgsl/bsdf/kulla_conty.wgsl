// Rough metals by Kulla and Conty, without tables: isotropic GGX of a complex index of refraction.
//
//     f = f_ss + F_avg F_ms L(wo) L(wi) / (pi L_avg)
//
// `L` is `fit_ggx_loss`, polynomials. Albedos are within 2e-3: a white metal's of 1, any other's of what
// `compensated` has by its tables. Single scattering is sampled by bounded caps, the second lobe by the cosine,
// with the probability
//
//     p = F_avg F_ms L / (F_avg F_ms L + F_avg E),   pdf = (1 - p) pdf_ss + p cos / pi
//
// Reciprocal. A view below the horizon sees nothing.

import package::alpha::{alpha_stretch};
import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BSDF_SAMPLE_VALID, BsdfSample};
import package::energy::fit::{fit_ggx_average_loss, fit_ggx_loss};
import package::energy::fresnel_average::{fresnel_average_conductor};
import package::energy::model::{model_further_bounces};
import package::fresnel::conductor::{ConductorIor, conductor_eval};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};
import package::ndf::ggx::{ggx_d_along};
import package::vndf::bounded::{bounded_height, bounded_sample_direction};
import package::vndf::stretched::{stretched_lengths};

/// A rough metal.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty.
struct KullaContyConductor {
    /// Its alpha, in [1e-4, 1].
    alpha: f32,
    /// Its index of refraction.
    conductor: ConductorIor,
    /// Average reflectance of a facet.
    average: vec3f,
    /// `F_avg F_ms`.
    colour: vec3f,
    /// `L_avg`.
    average_loss: f32,
}

/// The metal.
///
/// * `alpha`: in [1e-4, 1]; beyond, the nearest is taken.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::new.
fn kulla_conty_new(alpha: f32, conductor: ConductorIor) -> KullaContyConductor {
    let average = fresnel_average_conductor(conductor);
    let average_loss = fit_ggx_average_loss(alpha);
    let colour = average * model_further_bounces(average, average_loss);
    return KullaContyConductor(clamp(alpha, 1e-4, 1.0), conductor, average, colour, average_loss);
}

/// Probability of sampling the second lobe, given the loss at `wo`.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::second_share.
fn kulla_conty_second_share(lobe: KullaContyConductor, loss: f32) -> f32 {
    let second = rgb_max_channel(lobe.colour) * loss;
    let first = rgb_max_channel(lobe.average) * (1.0 - loss);
    return second / max(second + first, 1.1754944e-38);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::eval_pdf.
fn kulla_conty_eval_pdf(lobe: KullaContyConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if min(wo.z, wi.z) <= 0.0 {
        return vec4f(0.0);
    }
    let alpha = vec2f(lobe.alpha);
    let half_vector = wo + wi;
    let squared = dot(half_vector, half_vector);
    let d = ggx_d_along(alpha, half_vector, squared);
    // G2 / (4 cos_o) = cos_i / (2 (t_o cos_i + t_i cos_o)); the summand: two directions on the horizon leave no 0/0.
    let seen = stretched_lengths(alpha_stretch(alpha, wo));
    let lit = stretched_lengths(alpha_stretch(alpha, wi));
    let single = 0.5 * d * wi.z / (seen.x * wi.z + lit.x * wo.z + 1e-30);
    let first = 0.5 * d / bounded_height(alpha, wo, seen);
    let loss = fit_ggx_loss(lobe.alpha, wo.z);
    let cosine = warp_cosine_hemisphere_pdf(wi);
    let shape = loss * fit_ggx_loss(lobe.alpha, wi.z) * cosine / lobe.average_loss;
    let f_cos = conductor_eval(lobe.conductor, 0.5 * sqrt(squared)) * single + lobe.colour * shape;
    return vec4f(f_cos, first + kulla_conty_second_share(lobe, loss) * (cosine - first));
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::eval.
fn kulla_conty_eval(lobe: KullaContyConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return kulla_conty_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `kulla_conty_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::pdf.
fn kulla_conty_pdf(lobe: KullaContyConductor, wo: vec3f, wi: vec3f) -> f32 {
    return kulla_conty_eval_pdf(lobe, wo, wi, 0u).a;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/kulla_conty.rs, KullaConty::sample.
fn kulla_conty_sample(lobe: KullaContyConductor, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let share = kulla_conty_second_share(lobe, fit_ggx_loss(lobe.alpha, max(wo.z, 0.0)));
    let first = bounded_sample_direction(vec2f(lobe.alpha), wo, u.yz);
    let wi = select(first, warp_cosine_hemisphere(u.yz), u.x < share);
    let value = kulla_conty_eval_pdf(lobe, wo, wi, transport);
    let flags = select(0u, BSDF_SAMPLE_VALID, value.a > 0.0);
    return BsdfSample(wi, value.a, value.rgb / max(value.a, BSDF_SAMPLE_TINY), 1.0, flags);
}
