// A dielectric coat over metal: lacquered brass, clear-coated rims.
//
// Directions are bent at the coat's mean surface, the metal reflects them there, and the bounces between
// metal and coat are summed as a geometric series:
//
//     f cos = f_coat cos + T(wo) T(wi) (f_metal cos)(wo', wi') / (1 - F (R(wo) + R(wi)) / 2)  dwi'/dwi
//     dwi'/dwi = |wi.z| / (eta^2 |wi'.z|)
//
// with `R = 1 - T` the coat's Fresnel reflectance and `F` the metal's under the coat. For a smooth coat over
// smooth metal this is exact, `R + T^2 F / (1 - F R)`. It is reciprocal. A rough coat blurs the metal below
// it: twice refracted slopes add variance, `a'^2 = a^2 + (1 - 1/eta)^2 a_coat^2 / 2` (the first-order
// statistics of Belcour 2018).
//
// Known limits: specula-bsdf/src/bsdf/coated_conductor.rs.

import package::alpha::{ALPHA_SPECULAR_BELOW, alpha_clamped};
import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_delta, bsdf_sample_none, bsdf_sample_of_reflection};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_g_over_cos, microfacets_norm, microfacets_sample_reflection};
import package::bsdf::rough_conductor::{rough_conductor_facet};
import package::fresnel::dielectric::{DielectricRefraction, dielectric};
import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval, reflectance_under};
import package::math::rgb::{rgb_max_channel};

/// A floor of the sum of bounces.
const COATED_CONDUCTOR_EPSILON: f32 = 1.1920929e-7;

/// Metal under a dielectric coat.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor.
struct CoatedConductor {
    /// The coat's facets, of account where `coat_rough` is 1; height-correlated GGX.
    coat: MicrofacetsModel,
    /// The metal's facets, blurred, of account where `metal_rough` is 1; height-correlated GGX.
    metal_facets: MicrofacetsModel,
    /// 1 where the coat has facets.
    coat_rough: u32,
    /// 1 where the metal has facets.
    metal_rough: u32,
    /// Index of the coat over that outside, in [1, 3].
    eta: f32,
    /// Of the metal under the coat.
    reflectance: ReflectanceModel,
}

/// The metal's facets as blurred by a rough coat.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, blurred.
fn coated_conductor_blurred(metal_facets: MicrofacetsModel, metal_rough: bool, coat: MicrofacetsModel, eta: f32) -> MicrofacetsModel {
    let bend = 1.0 - 1.0 / eta;
    let own = select(vec2f(0.0), metal_facets.alpha, metal_rough);
    let width = sqrt(own * own + 0.5 * bend * bend * coat.alpha * coat.alpha);
    var blurred = metal_facets;
    blurred.alpha = alpha_clamped(max(width, vec2f(ALPHA_SPECULAR_BELOW)));
    return blurred;
}

/// The material of these parameters.
///
/// * `coat_rough`, `metal_rough`: whether the surfaces have facets.
/// * `eta`: index of the coat over that outside, clamped to [1, 3].
/// * `reflectance`: of the metal against vacuum; an index is made relative to the coat's.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::new.
fn coated_conductor_new(coat: MicrofacetsModel, coat_rough: bool, eta: f32, metal_facets: MicrofacetsModel, metal_rough: bool, reflectance: ReflectanceModel) -> CoatedConductor {
    var lobe: CoatedConductor;
    lobe.eta = clamp(eta, 1.0, 3.0);
    lobe.coat = coat;
    lobe.metal_facets = metal_facets;
    if coat_rough {
        lobe.metal_facets = coated_conductor_blurred(metal_facets, metal_rough, coat, lobe.eta);
    }
    lobe.coat_rough = select(0u, 1u, coat_rough);
    lobe.metal_rough = select(0u, 1u, metal_rough || coat_rough);
    lobe.reflectance = reflectance_under(reflectance, lobe.eta);
    return lobe;
}

/// The direction below the coat. A view from behind (a backfacing shading normal) enters as its mirror
/// image does, so that the lobe is continuous there.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::below.
fn coated_conductor_below(lobe: CoatedConductor, w: vec3f) -> vec3f {
    let flat_part = w.xy * (1.0 / lobe.eta);
    return vec3f(flat_part, sqrt(max(1.0 - flat_part.x * flat_part.x - flat_part.y * flat_part.y, 0.0)));
}

/// The direction above the coat; (0, 0, 0) for a direction downwards or beyond the critical angle.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::above.
fn coated_conductor_above(lobe: CoatedConductor, w: vec3f) -> vec3f {
    let flat_part = w.xy * lobe.eta;
    let squared = 1.0 - flat_part.x * flat_part.x - flat_part.y * flat_part.y;
    if w.z > 0.0 && squared > 0.0 {
        return vec3f(flat_part, sqrt(squared));
    }
    return vec3f(0.0);
}

/// What the coat's mean surface reflects and lets through from `w`.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::at_coat.
fn coated_conductor_at_coat(lobe: CoatedConductor, w: vec3f) -> DielectricRefraction {
    return dielectric(abs(w.z), lobe.eta);
}

/// Probability of drawing the coat's reflection; 0 for a mirror that faces away.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::coat_probability.
fn coated_conductor_coat_probability(lobe: CoatedConductor, coat: DielectricRefraction, wo: vec3f) -> f32 {
    let metal_part = rgb_max_channel(reflectance_eval(lobe.reflectance, coated_conductor_below(lobe, wo).z));
    let visible = lobe.coat_rough == 1u || wo.z > 0.0;
    let below = coat.transmittance * metal_part;
    let share = coat.reflectance / max(coat.reflectance + below, BSDF_SAMPLE_TINY);
    return select(0.0, share, visible);
}

/// Transmission both ways with the series of bounces, times the metal's reflectance.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::through.
fn coated_conductor_through(coat_o: DielectricRefraction, coat_i: DielectricRefraction, metal_part: vec3f) -> vec3f {
    let passed = coat_o.transmittance * coat_i.transmittance;
    let back = 0.5 * (coat_o.reflectance + coat_i.reflectance);
    return passed * metal_part / max(vec3f(1.0) - metal_part * back, vec3f(COATED_CONDUCTOR_EPSILON));
}

/// `f |cos|` and its density, of a rough metal.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::eval_pdf.
fn coated_conductor_eval_pdf(lobe: CoatedConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if lobe.metal_rough == 0u || wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let coat_o = coated_conductor_at_coat(lobe, wo);
    let p = coated_conductor_coat_probability(lobe, coat_o, wo);
    let below_o = coated_conductor_below(lobe, wo);
    let below_i = coated_conductor_below(lobe, wi);
    let bend = wi.z / (lobe.eta * lobe.eta * below_i.z);
    let facet = rough_conductor_facet(lobe.metal_facets, below_o, below_i);
    let quarter = 0.25 * facet.x * bend;
    let fresnel = reflectance_eval(lobe.reflectance, facet.y);
    let passed = coated_conductor_through(coat_o, coated_conductor_at_coat(lobe, wi), fresnel);
    var f_cos = passed * (quarter * microfacets_g_over_cos(lobe.metal_facets, below_o, below_i));
    var pdf = (1.0 - p) * quarter / microfacets_norm(lobe.metal_facets, below_o);
    if lobe.coat_rough == 1u {
        let upper = rough_conductor_facet(lobe.coat, wo, wi);
        let upper_quarter = 0.25 * upper.x;
        let reflected = dielectric(upper.y, lobe.eta).reflectance;
        f_cos += vec3f(reflected * upper_quarter * microfacets_g_over_cos(lobe.coat, wo, wi));
        pdf += p * upper_quarter / microfacets_norm(lobe.coat, wo);
    }
    return vec4f(f_cos, pdf);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::eval.
fn coated_conductor_eval(lobe: CoatedConductor, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return coated_conductor_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `coated_conductor_draw`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::pdf.
fn coated_conductor_pdf(lobe: CoatedConductor, wo: vec3f, wi: vec3f) -> f32 {
    return coated_conductor_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// The mirrored direction, where the view is above the horizon.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, `delta` in CoatedConductor::sample.
fn coated_conductor_mirrored(wo: vec3f, weight: vec3f, p: f32) -> BsdfSample {
    if wo.z > 0.0 {
        return bsdf_sample_delta(vec3f(-wo.x, -wo.y, wo.z), weight, p, 0u, 1.0);
    }
    return bsdf_sample_none();
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/coated_conductor.rs, CoatedConductor::sample.
fn coated_conductor_draw(lobe: CoatedConductor, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let coat = coated_conductor_at_coat(lobe, wo);
    let below = coated_conductor_below(lobe, wo);
    if lobe.metal_rough == 0u {
        let metal_part = coated_conductor_through(coat, coat, reflectance_eval(lobe.reflectance, below.z));
        return coated_conductor_mirrored(wo, vec3f(coat.reflectance) + metal_part, 1.0);
    }
    let p = coated_conductor_coat_probability(lobe, coat, wo);
    var wi: vec3f;
    if u.x < p {
        if lobe.coat_rough == 0u {
            return coated_conductor_mirrored(wo, vec3f(coat.reflectance / p), p);
        }
        wi = microfacets_sample_reflection(lobe.coat, wo, u.yz);
    } else {
        wi = coated_conductor_above(lobe, microfacets_sample_reflection(lobe.metal_facets, below, u.yz));
    }
    return bsdf_sample_of_reflection(wi, coated_conductor_eval_pdf(lobe, wo, wi, transport));
}
