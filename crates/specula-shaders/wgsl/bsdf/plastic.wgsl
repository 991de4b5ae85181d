// Mitsuba 3's `plastic` and `roughplastic`: a dielectric coat over Lambert, by their formulas.
//
//     f = specular F G2 D / (4 |wo.z| |wi.z|)  +  T(wo) T(wi) / eta^2  base / pi
//     base = diffuse / (1 - r R_int),   r = diffuse where nonlinear, else 1
//
// A smooth coat has a Dirac delta of strength `specular F` for its first part. `T` and `R_int` are those of
// `plastic_interface`.
//
// Reciprocal above the horizon; a backfacing view (`wo.z < 0`) is continued as `microfacets_g_over_cos` says,
// with `T` of its mirror image. Known limitations of the model: specula-bsdf/src/bsdf/plastic/mod.rs.
//
// Source: Mitsuba 3's documentation of the two plugins.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TINY, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_delta, bsdf_sample_of_reflection};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d, microfacets_g_over_cos, microfacets_norm, microfacets_sample_reflection};
import package::bsdf::plastic_interface::{PlasticInterface, plastic_interface_internal_reflectance, plastic_interface_new, plastic_interface_smooth_internal_reflectance, plastic_interface_transmittance};
import package::fresnel::dielectric::{dielectric};
import package::math::rgb::{rgb_max_channel};
import package::math::warp::{warp_cosine_hemisphere, warp_cosine_hemisphere_pdf};
import package::vndf::half_vector::{half_vector_unit};

/// Lambert under a dielectric coat, as Mitsuba 3 has it.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic.
struct PlasticLobe {
    /// The coat's facets, used where `rough` is 1; Mitsuba's masking is separable.
    facets: MicrofacetsModel,
    /// 1 where the coat has facets.
    rough: u32,
    /// Index of the coat over that outside.
    eta: f32,
    /// Factor on the coat's reflection.
    specular: vec3f,
    /// Albedo of the base.
    diffuse: vec3f,
    /// `diffuse / (eta^2 (1 - r R_int))`.
    base: vec3f,
    /// What a rough coat lets through.
    interior: PlasticInterface,
}

/// With the sum of the bounces between base and coat.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::over.
fn plastic_base(diffuse: vec3f, eta: f32, internal: f32, nonlinear: bool) -> vec3f {
    let back = select(vec3f(1.0), diffuse, nonlinear);
    return (1.0 / (eta * eta)) * diffuse / (vec3f(1.0) - back * internal);
}

/// Mitsuba's `plastic`: a smooth coat.
///
/// * `eta`: index of the coat over that outside, clamped to [1/3, 3].
/// * `diffuse`: albedo of the base, in [0, 1].
/// * `specular`: factor on the coat's reflection, 1 in nature.
/// * `nonlinear`: whether light between coat and base takes the base's colour at every bounce.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::smooth.
fn plastic_smooth(eta: f32, diffuse: vec3f, specular: vec3f, nonlinear: bool) -> PlasticLobe {
    var lobe: PlasticLobe;
    lobe.eta = clamp(eta, 1.0 / 3.0, 3.0);
    lobe.specular = specular;
    lobe.diffuse = diffuse;
    let internal = plastic_interface_smooth_internal_reflectance(lobe.eta);
    lobe.base = plastic_base(diffuse, lobe.eta, internal, nonlinear);
    return lobe;
}

/// Mitsuba's `roughplastic`: a coat of facets.
///
/// * `eta`: index of the coat over that outside, clamped to [1, 3].
/// * `diffuse`, `specular`, `nonlinear`: see `plastic_smooth`.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::rough.
fn plastic_rough(facets: MicrofacetsModel, eta: f32, diffuse: vec3f, specular: vec3f, nonlinear: bool) -> PlasticLobe {
    var lobe: PlasticLobe;
    lobe.facets = facets;
    lobe.rough = 1u;
    lobe.eta = clamp(eta, 1.0, 3.0);
    lobe.specular = specular;
    lobe.diffuse = diffuse;
    lobe.interior = plastic_interface_new(facets.distribution, facets.alpha, lobe.eta);
    let internal = plastic_interface_internal_reflectance(lobe.interior);
    lobe.base = plastic_base(diffuse, lobe.eta, internal, nonlinear);
    return lobe;
}

/// Share of light from `w` that enters the coat.
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, RoughEntrance::incident.
fn plastic_transmittance(lobe: PlasticLobe, w: vec3f) -> f32 {
    if lobe.rough == 1u {
        return plastic_interface_transmittance(lobe.interior, abs(w.z));
    }
    return dielectric(abs(w.z), lobe.eta).transmittance;
}

/// Probability of sampling the coat's reflection; 0 for a mirror that faces away.
///
/// Twin: specula-bsdf/src/bsdf/under_coat.rs, UnderCoat::coat_probability.
fn plastic_coat_probability(lobe: PlasticLobe, entering: f32, wo: vec3f) -> f32 {
    let reflected = dielectric(abs(wo.z), lobe.eta).reflectance * rgb_max_channel(lobe.specular);
    let diffuse = entering * rgb_max_channel(lobe.diffuse);
    let visible = lobe.rough == 1u || wo.z > 0.0;
    return select(0.0, reflected / max(reflected + diffuse, BSDF_SAMPLE_TINY), visible);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::eval_pdf.
fn plastic_eval_pdf(lobe: PlasticLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let entering = plastic_transmittance(lobe, wo);
    let p = plastic_coat_probability(lobe, entering, wo);
    let cosine = warp_cosine_hemisphere_pdf(wi);
    var f_cos = lobe.base * (entering * plastic_transmittance(lobe, wi) * cosine);
    var pdf = (1.0 - p) * cosine;
    if lobe.rough == 1u && wo.z + wi.z > 0.0 {
        let wm = half_vector_unit(wo + wi);
        let quarter = 0.25 * microfacets_d(lobe.facets, wm);
        let fresnel = dielectric(dot(wo, wm), lobe.eta).reflectance;
        f_cos += lobe.specular * (fresnel * quarter * microfacets_g_over_cos(lobe.facets, wo, wi));
        pdf += p * quarter / microfacets_norm(lobe.facets, wo);
    }
    return vec4f(f_cos, pdf);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::eval.
fn plastic_eval(lobe: PlasticLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return plastic_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `plastic_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::pdf.
fn plastic_pdf(lobe: PlasticLobe, wo: vec3f, wi: vec3f) -> f32 {
    return plastic_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/plastic/mod.rs, Plastic::sample.
fn plastic_sample(lobe: PlasticLobe, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let entering = plastic_transmittance(lobe, wo);
    let p = plastic_coat_probability(lobe, entering, wo);
    var wi = warp_cosine_hemisphere(u.yz);
    if u.x < p {
        if lobe.rough == 0u {
            let reflected = dielectric(abs(wo.z), lobe.eta).reflectance;
            let mirrored = vec3f(-wo.x, -wo.y, wo.z);
            return bsdf_sample_delta(mirrored, lobe.specular * (reflected / p), p, 0u, 1.0);
        }
        wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    }
    return bsdf_sample_of_reflection(wi, plastic_eval_pdf(lobe, wo, wi, transport));
}
