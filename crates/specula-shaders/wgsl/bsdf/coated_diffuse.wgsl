// A rough or smooth dielectric coat over Lambert: paint, plastic, polished wood, glazed tiles.
//
// The model is closed form. A Lambertian base forgets where its light came from, so the coat acts on it
// only through two values of the interface: the share `T(w)` of light from direction `w` that enters and
// reaches the base, and the share `R` of diffuse light from the base that the coat reflects to it. With
// `n` bounces off the base at most:
//
//     f = f_interface(wo, wi) + T(wo) T(wi) / eta^2  rho/pi  (1 - q^n) / (1 - q),   q = rho R
//
// The series of bounces between base and coat is the geometric one, summed: the expectation of a stochastic
// walk between the layers (Guo, Hasan and Zhao 2018; pbrt-v4's `coateddiffuse`), without its noise.
//
// `T` and `R` are exact for a smooth coat without absorption, and tables made by quadrature otherwise
// (`interface`, `interface_single`, `interface_layer`).

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_delta, bsdf_sample_of_reflection};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d, microfacets_g_over_cos, microfacets_norm, microfacets_sample_reflection};
import package::energy::interface::{interface_internal_reflectance, interface_transmittance, interface_mean_alpha};
import package::energy::interface_layer::{InterfaceLayer, interface_layer_crossing, interface_layer_new, interface_layer_there_and_back};
import package::energy::interface_single::{interface_single_internal_reflectance, interface_single_reflectance_estimate, interface_single_transmittance};
import package::fresnel::dielectric::{dielectric};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};
import package::vndf::half_vector::{half_vector_unit};

/// Light within a coat that one facet sends to another is lost: each facet scatters once.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatScattering::Single.
const COATED_DIFFUSE_SINGLE: u32 = 0u;
/// It goes on: what does not pass is reflected.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatScattering::Lossless.
const COATED_DIFFUSE_LOSSLESS: u32 = 1u;
/// As many bounces as light makes.
const COATED_DIFFUSE_UNLIMITED: u32 = 0xffffffffu;

/// Lambert under a dielectric coat.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse.
struct CoatedDiffuse {
    /// The coat's facets, used where `mean_alpha` is above 0; height-correlated GGX.
    facets: MicrofacetsModel,
    /// Alpha that stands for the coat's two; 0 for a smooth coat.
    mean_alpha: f32,
    /// Index of the coat over that outside, in [1, 3].
    eta: f32,
    /// Of the base, in [0, 1].
    albedo: vec3f,
    /// Between coat and base.
    layer: InterfaceLayer,
    /// `COATED_DIFFUSE_SINGLE` or `COATED_DIFFUSE_LOSSLESS`.
    scattering: u32,
    /// `rho / eta^2 (1 - q^n) / (1 - q)`: the base with all bounces, before `T(wo) T(wi) / pi`.
    base: vec3f,
}

/// Light from one direction.
///
/// Twin: specula-bsdf/src/energy/interface_coat.rs, Incident.
struct CoatedDiffuseIncident {
    /// Share that the coat reflects; an estimate where its facets scatter singly.
    reflected: f32,
    /// Share that reaches the base.
    arriving: f32,
}

/// `1 - q^n`: the share of the series that a walk of so many events follows, half of them bounces off the
/// base.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, followed.
fn coated_diffuse_followed(q: vec3f, max_depth: u32) -> vec3f {
    if max_depth == COATED_DIFFUSE_UNLIMITED {
        return vec3f(1.0);
    }
    var rest = max_depth / 2u;
    var square = q;
    var power = vec3f(1.0);
    while rest > 0u {
        if rest % 2u == 1u {
            power *= square;
        }
        square *= square;
        rest = rest / 2u;
    }
    return vec3f(1.0) - power;
}

/// The material of these parameters.
///
/// * `rough`: whether the coat has facets.
/// * `eta`: index of the coat over that outside, clamped to [1, 3].
/// * `albedo`: of the base, in [0, 1].
/// * `thickness`: optical, of an absorbing medium, from 0 up: light that crosses it once at the cosine `mu`
///   is attenuated to `exp(-thickness / mu)`.
/// * `max_depth`: events after which light is lost; `COATED_DIFFUSE_UNLIMITED`: no limit.
/// * `scattering`: `COATED_DIFFUSE_SINGLE` or `COATED_DIFFUSE_LOSSLESS`.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse::over_layer.
fn coated_diffuse_new(facets: MicrofacetsModel, rough: bool, eta: f32, albedo: vec3f, thickness: f32, max_depth: u32, scattering: u32) -> CoatedDiffuse {
    var lobe: CoatedDiffuse;
    lobe.facets = facets;
    lobe.mean_alpha = select(0.0, interface_mean_alpha(facets.alpha), rough);
    lobe.eta = clamp(eta, 1.0, 3.0);
    lobe.albedo = albedo;
    lobe.layer = interface_layer_new(thickness);
    lobe.scattering = scattering;
    var internal: f32;
    if scattering == COATED_DIFFUSE_LOSSLESS {
        internal = interface_internal_reflectance(lobe.mean_alpha, lobe.eta);
    } else {
        internal = interface_single_internal_reflectance(lobe.mean_alpha, lobe.eta);
    }
    let q = albedo * (internal * interface_layer_there_and_back(lobe.layer, lobe.mean_alpha, lobe.eta));
    let scale = 1.0 / (lobe.eta * lobe.eta);
    lobe.base = scale * albedo * coated_diffuse_followed(q, max_depth) / (vec3f(1.0) - q);
    return lobe;
}

/// The shares of light from `w` that the coat reflects and transmits.
///
/// Twin: specula-bsdf/src/energy/interface_coat.rs, CoatInterface::incident.
fn coated_diffuse_incident(lobe: CoatedDiffuse, w: vec3f) -> CoatedDiffuseIncident {
    let mu = abs(w.z);
    let crossing = interface_layer_crossing(lobe.layer, lobe.mean_alpha, lobe.eta, mu);
    if lobe.scattering == COATED_DIFFUSE_LOSSLESS {
        let entering = interface_transmittance(lobe.mean_alpha, lobe.eta, mu);
        return CoatedDiffuseIncident(1.0 - entering, entering * crossing);
    }
    let reflected = interface_single_reflectance_estimate(lobe.mean_alpha, lobe.eta, mu);
    return CoatedDiffuseIncident(reflected, interface_single_transmittance(lobe.mean_alpha, lobe.eta, mu) * crossing);
}

/// Probability of sampling the coat's reflection; 0 for a mirror that faces away.
///
/// Twin: specula-bsdf/src/bsdf/under_coat.rs, UnderCoat::coat_probability.
fn coated_diffuse_coat_probability(lobe: CoatedDiffuse, view: CoatedDiffuseIncident, wo: vec3f) -> f32 {
    let diffuse = view.arriving * rgb_max_channel(lobe.albedo);
    let visible = lobe.mean_alpha > 0.0 || wo.z > 0.0;
    let share = view.reflected / max(view.reflected + diffuse, BSDF_SAMPLE_TINY);
    return select(0.0, share, visible);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse::eval_pdf.
fn coated_diffuse_eval_pdf(lobe: CoatedDiffuse, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let view = coated_diffuse_incident(lobe, wo);
    let p = coated_diffuse_coat_probability(lobe, view, wo);
    let cosine = warp_cosine_hemisphere_pdf(wi);
    let arriving = coated_diffuse_incident(lobe, wi).arriving;
    var f_cos = lobe.base * (view.arriving * arriving * cosine);
    var pdf = (1.0 - p) * cosine;
    if lobe.mean_alpha > 0.0 && wo.z + wi.z > 0.0 {
        let wm = half_vector_unit(wo + wi);
        let quarter = 0.25 * microfacets_d(lobe.facets, wm);
        let fresnel = dielectric(dot(wo, wm), lobe.eta).reflectance;
        f_cos += vec3f(fresnel * quarter * microfacets_g_over_cos(lobe.facets, wo, wi));
        pdf += p * quarter / microfacets_norm(lobe.facets, wo);
    }
    return vec4f(f_cos, pdf);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse::eval.
fn coated_diffuse_eval(lobe: CoatedDiffuse, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return coated_diffuse_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `coated_diffuse_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse::pdf.
fn coated_diffuse_pdf(lobe: CoatedDiffuse, wo: vec3f, wi: vec3f) -> f32 {
    return coated_diffuse_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/coated_diffuse.rs, CoatedDiffuse::sample.
fn coated_diffuse_sample(lobe: CoatedDiffuse, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let view = coated_diffuse_incident(lobe, wo);
    let p = coated_diffuse_coat_probability(lobe, view, wo);
    var wi = warp_cosine_hemisphere(u.yz);
    if u.x < p {
        if lobe.mean_alpha <= 0.0 {
            let mirrored = vec3f(-wo.x, -wo.y, wo.z);
            return bsdf_sample_delta(mirrored, vec3f(view.reflected / p), p, 0u, 1.0);
        }
        wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    }
    return bsdf_sample_of_reflection(wi, coated_diffuse_eval_pdf(lobe, wo, wi, transport));
}
