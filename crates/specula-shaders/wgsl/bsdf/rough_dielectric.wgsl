// A rough dielectric interface: reflection and refraction (Walter et al. 2007).
//
//     reflection:    f = F G2 D / (4 |wo.z| |wi.z|),                       wm ~ wo + wi
//     transmission:  f = (1 - F) G2 D |wo.wm| |wi.wm| e^2 / (|wo.z| |wi.z| (wo.wm + e wi.wm)^2)
//                        [/ e^2 for radiance],                             wm ~ +-(wo + e wi)
//
// with `e` the index beyond the interface over that on the side of `wo`.
//
// A visible normal is sampled first (by caps; refraction needs all of them), then the branch by what it
// carries: with `r = F G2(wo, wr)` and `t = (1 - F) G2(wo, wt)` at the two directions of the facet, 0
// where one lies on the wrong side of the surface, reflection has the probability `r / (r + t)` and both
// weigh `(r + t) / G1(wo)`. Where only one direction is valid it is taken.
//
// With bounded caps and the exact sampler the branch is sampled before the normal, with the macroscopic
// reflectance as its probability; the weights then carry `F(wm)` over that probability, which costs more
// variance than it saves: caps are the default.
//
// Departure: transmission uses the `G2` of reflection, as pbrt-v4 does, not the Beta function of Smith's
// model for opposite sides (Heitz et al. 2016).
//
// Indices within 1e-3 of each other are taken as equal: light passes straight on.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_LARGEST, BSDF_SAMPLE_TINY, BSDF_SAMPLE_TRANSMISSION, BSDF_SAMPLE_VALID, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_delta, bsdf_sample_none};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d_along, microfacets_g_over_cos_quotient, microfacets_norm, microfacets_projected_area, microfacets_sample_reflection, microfacets_sample_wm};
import package::bsdf::tints::{TintsPair, tints_on_side};
import package::fresnel::dielectric::{dielectric, dielectric_refract, dielectric_refraction};
import package::vndf::reflection::{reflection_mirrored};
import package::vndf::sampler::{SAMPLER_BOUNDED, SAMPLER_EXACT};

/// Single scattering at a rough interface between two dielectrics.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric.
struct RoughDielectric {
    /// Its facets; the strategy should be `SAMPLER_CAP`.
    facets: MicrofacetsModel,
    /// Index inside over index outside where it has both sides, else index beyond the interface over the
    /// index on the side of `wo`; above 0.
    eta: f32,
    /// 1: `wo.z < 0` views it from inside. 0: `wo.z < 0` is a backfacing shading normal, handled in the
    /// density.
    two_sided: u32,
    /// Factors on its two branches.
    tints: TintsPair,
}

/// The interface from the side of a view.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Side.
struct RoughDielectricSide {
    /// Whether the view is from inside an interface with both sides.
    inside: bool,
    /// Factor of z that moves the view above the surface.
    turn: f32,
    /// Index beyond over the index on the side of the view.
    eta: f32,
    /// `1 / eta`.
    inverse_eta: f32,
}

/// What happens between two directions.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Scatter.
struct RoughDielectricScatter {
    /// `F G2 / |wo.z|`, or `(1 - F) G2 / |wo.z|`.
    value: f32,
    /// Probability of the branch.
    chosen: f32,
    /// `N` of the density of directions `D jacobian |wo.wm| / N`.
    norm: f32,
    /// `D jacobian |wo.wm|`.
    density: f32,
    /// The same, for what the path carries.
    carried: f32,
}

/// Whether nothing is bent, so that the lobe is a Dirac delta alone.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::is_specular.
fn rough_dielectric_is_specular(lobe: RoughDielectric) -> bool {
    return abs(lobe.eta - 1.0) < 1e-3;
}

/// The interface from the side of `wo`.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::side.
fn rough_dielectric_side(lobe: RoughDielectric, wo: vec3f) -> RoughDielectricSide {
    let inverse = 1.0 / lobe.eta;
    if lobe.two_sided == 1u && wo.z < 0.0 {
        return RoughDielectricSide(true, -1.0, inverse, lobe.eta);
    }
    return RoughDielectricSide(false, 1.0, lobe.eta, inverse);
}

/// `far^2` of the Jacobian of refraction, and the same for what the path carries (`near^2` for radiance,
/// which is divided by `e^2`). With `h = near wo + far wi` of `rough_dielectric_half` and
/// `e = far / near`:
///
///     dwm/dwi = e^2 |wi.wm| / (wo.wm + e wi.wm)^2 = far^2 |wi.wm| / |h|^2
///
/// for the sum is `(wo + e wi) . wm`, the length of `wo + e wi`: its terms, of opposite signs, cancel, but
/// a length does not.
///
/// Source: Walter et al. 2007, eq. 17.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::stretches.
fn rough_dielectric_stretches(lobe: RoughDielectric, side: RoughDielectricSide, transport: u32) -> vec2f {
    let squared = lobe.eta * lobe.eta;
    let near = select(1.0, squared, side.inside);
    let far = select(squared, 1.0, side.inside);
    return vec2f(far, select(far, near, transport == BSDF_SAMPLE_RADIANCE));
}

/// `other factor + one` with the product as it is: factors are split in halves of 12 bits, whose products
/// are exact, and the largest meets `one` first.
///
/// Twin: specula-bsdf/src/math/real.rs, Real::mad_exact_product.
fn rough_dielectric_sum(other: vec3f, factor: f32, one: vec3f) -> vec3f {
    let other_high = bitcast<vec3f>(bitcast<vec3u>(other) & vec3u(0xfffff000u));
    let other_low = other - other_high;
    let factor_high = bitcast<f32>(bitcast<u32>(factor) & 0xfffff000u);
    let factor_low = factor - factor_high;
    let first = other_high * factor_high + one;
    return first + (other_high * factor_low + other_low * factor_high + other_low * factor_low);
}

/// A vector along the normal of the facet that sends `wo` to `wi`: `wo + wi`, or `wo + e wi` times a
/// factor.
///
/// Near the mirrored and the straight direction its x and y cancel, and narrow distributions ask for them
/// to be right to a share of themselves. So products are not rounded; and from inside, where `e = 1/eta` is
/// rounded, `eta wo + wi` takes the place of `wo + e wi`.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::half.
fn rough_dielectric_half(lobe: RoughDielectric, side: RoughDielectricSide, wo: vec3f, wi: vec3f, reflects: bool) -> vec3f {
    let factor = select(lobe.eta, 1.0, reflects);
    let one = select(wo, wi, side.inside);
    let other = select(wi, wo, side.inside);
    let half_vector = rough_dielectric_sum(other, factor, one);
    return select(half_vector, -half_vector, half_vector.z < 0.0);
}

/// Probability of reflection where the branch is sampled before the normal.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::branch_probability.
fn rough_dielectric_branch_probability(wo: vec3f, eta: f32) -> f32 {
    return clamp(dielectric(abs(wo.z), eta).reflectance, 0.1, 0.9);
}

/// Whether the branch is sampled before the normal.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::is_branch_first.
fn rough_dielectric_is_branch_first(lobe: RoughDielectric) -> bool {
    return lobe.facets.strategy == SAMPLER_BOUNDED || lobe.facets.strategy == SAMPLER_EXACT;
}

/// `F G2 / |wo.z|` or `(1 - F) G2 / |wo.z|` of one of a facet's directions, as numerator and denominator.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Carried::new.
fn rough_dielectric_carried(lobe: RoughDielectric, fresnel: f32, wo: vec3f, wi: vec3f) -> vec2f {
    let quotient = microfacets_g_over_cos_quotient(lobe.facets, wo, wi);
    return vec2f(fresnel * quotient.x, quotient.y);
}

/// The value of a quotient; 0 where its denominator is.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Carried::value.
fn rough_dielectric_value(carried: vec2f) -> f32 {
    if carried.y > 0.0 {
        return carried.x / carried.y;
    }
    return 0.0;
}

/// The sum of two quotients, as numerator and denominator.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Carried::plus.
fn rough_dielectric_plus(one: vec2f, other: vec2f) -> vec2f {
    return vec2f(one.x * other.y + other.x * one.y, one.y * other.y);
}

/// `one / (one + other)`; 0 where both vanish.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, Carried::share.
fn rough_dielectric_share(one: vec2f, other: vec2f) -> f32 {
    let sum = rough_dielectric_plus(one, other).x;
    if sum > 0.0 {
        return one.x * other.y / sum;
    }
    return 0.0;
}

/// What happens between `wo`, on its own side, and `wi`.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::scatter.
fn rough_dielectric_scatter(lobe: RoughDielectric, wo: vec3f, wi: vec3f, side: RoughDielectricSide, transport: u32) -> RoughDielectricScatter {
    let reflects = wi.z > 0.0;
    let half_vector = rough_dielectric_half(lobe, side, wo, wi, reflects);
    let squared = dot(half_vector, half_vector);
    // Facets seen from behind do not scatter, nor does a half vector of zero length.
    let inverse_squared = 1.0 / max(squared, 1e-30);
    let wm = half_vector * sqrt(inverse_squared);
    let cos_o = dot(wo, wm);
    let cos_i = dot(wi, wm);
    let seen = squared > 1e-30 && cos_o > 0.0 && select(-cos_i, cos_i, reflects) > 0.0;
    if !seen || wi.z == 0.0 {
        return RoughDielectricScatter(0.0, 0.0, 1.0, 0.0, 0.0);
    }
    // The refracted cosine of Snell's law cancels at the critical angle; here it is known.
    let sine_squared = (1.0 - cos_o) * (1.0 + cos_o);
    let snell = 1.0 - sine_squared * (side.inverse_eta * side.inverse_eta);
    let bent = dielectric_refraction(cos_o, select(cos_i * cos_i, snell, reflects), side.eta);

    // The facet's other direction, which shares its samples.
    let along = select(2.0 * cos_o, side.inverse_eta * cos_o - bent.cos_t, reflects);
    let back = select(1.0, side.inverse_eta, reflects);
    let other = wm * along - wo * back;
    let is_other_valid = select(other.z, -other.z, reflects) > 0.0;
    let rest = select(0.0, select(bent.reflectance, bent.transmittance, reflects), is_other_valid);
    let share = select(bent.transmittance, bent.reflectance, reflects);
    let here = rough_dielectric_carried(lobe, share, wo, wi);
    let there = rough_dielectric_carried(lobe, rest, wo, other);

    var chosen = rough_dielectric_share(here, there);
    var norm = microfacets_projected_area(lobe.facets, wo);
    if rough_dielectric_is_branch_first(lobe) {
        let p = rough_dielectric_branch_probability(wo, side.eta);
        chosen = select(1.0 - p, p, reflects);
        norm = select(norm, microfacets_norm(lobe.facets, wo), reflects);
    }
    let stretches = rough_dielectric_stretches(lobe, side, transport);
    let d = microfacets_d_along(lobe.facets, half_vector, squared);
    let bend = cos_o * abs(cos_i) * inverse_squared;
    let density = d * select(stretches.x * bend, 0.25, reflects);
    let carried = d * select(stretches.y * bend, 0.25, reflects);
    return RoughDielectricScatter(rough_dielectric_value(here), chosen, norm, density, carried);
}

/// The sample of one of the branches, on the side where `wo` is; none on the wrong side, or where the
/// density is no positive number.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::scattered.
fn rough_dielectric_scattered(lobe: RoughDielectric, wi: vec3f, weight: f32, pdf: f32, reflects: bool, side: RoughDielectricSide) -> BsdfSample {
    let height = select(-wi.z, wi.z, reflects);
    if height > 0.0 && pdf > 0.0 && pdf <= BSDF_SAMPLE_LARGEST {
        let turned = vec3f(wi.xy, wi.z * side.turn);
        let tinted = tints_on_side(lobe.tints, reflects) * weight;
        let flags = BSDF_SAMPLE_VALID | select(BSDF_SAMPLE_TRANSMISSION, 0u, reflects);
        return BsdfSample(turned, pdf, tinted, select(side.eta, 1.0, reflects), flags);
    }
    return bsdf_sample_none();
}

/// A sample for `wo` on its own side: the normal, then the branch.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::sample_normal_first.
fn rough_dielectric_sample_normal_first(lobe: RoughDielectric, wo: vec3f, u: vec3f, side: RoughDielectricSide, transport: u32) -> BsdfSample {
    let wm = microfacets_sample_wm(lobe.facets, wo, u.yz);
    let cos_o = max(dot(wo, wm), 0.0);
    let sine_squared = (1.0 - cos_o) * (1.0 + cos_o);
    let snell = 1.0 - sine_squared * (side.inverse_eta * side.inverse_eta);
    let bent = dielectric_refraction(cos_o, snell, side.eta);
    let wr = reflection_mirrored(wo, wm);
    let wt = wm * (side.inverse_eta * cos_o - bent.cos_t) - wo * side.inverse_eta;
    let up = select(0.0, bent.reflectance, wr.z > 0.0);
    let down = select(0.0, bent.transmittance, wt.z < 0.0);
    let reflected = rough_dielectric_carried(lobe, up, wo, wr);
    let transmitted = rough_dielectric_carried(lobe, down, wo, wt);

    let both = rough_dielectric_plus(reflected, transmitted);
    let shares = 1.0 / max(both.x, BSDF_SAMPLE_TINY);
    let reflection = reflected.x * transmitted.y * shares;
    let reflects = u.x < reflection;
    // The half vector of the direction as it was rounded, as evaluation will see it.
    let wi = select(wt, wr, reflects);
    let half_vector = rough_dielectric_half(lobe, side, wo, wi, reflects);
    let squared = dot(half_vector, half_vector);
    var top = reflection;
    var bottom = 4.0;
    var scale = 1.0;
    if !reflects {
        let transmission = transmitted.x * reflected.y * shares;
        let stretches = rough_dielectric_stretches(lobe, side, transport);
        top = transmission * stretches.x * dot(wo, half_vector) * abs(dot(wt, half_vector));
        bottom = squared * squared;
        scale = select(1.0, side.inverse_eta * side.inverse_eta, transport == BSDF_SAMPLE_RADIANCE);
    }
    let sigma = microfacets_projected_area(lobe.facets, wo);
    let d = microfacets_d_along(lobe.facets, half_vector, squared);
    let pdf = d * top / max(sigma * bottom, BSDF_SAMPLE_TINY);
    let weight = sigma * both.x / max(both.y, BSDF_SAMPLE_TINY);
    return rough_dielectric_scattered(lobe, wi, weight * scale, pdf, reflects, side);
}

/// A sample for `wo` on its own side: the branch, then the normal.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::sample_branch_first.
fn rough_dielectric_sample_branch_first(lobe: RoughDielectric, wo: vec3f, u: vec3f, side: RoughDielectricSide, transport: u32) -> BsdfSample {
    let reflects = u.x < rough_dielectric_branch_probability(wo, side.eta);
    var wi: vec3f;
    if reflects {
        wi = microfacets_sample_reflection(lobe.facets, wo, u.yz);
    } else {
        let wm = microfacets_sample_wm(lobe.facets, wo, u.yz);
        let cos_o = dot(wo, wm);
        let bent = dielectric(cos_o, side.eta);
        if bent.transmittance <= 0.0 {
            return bsdf_sample_none();
        }
        wi = dielectric_refract(wo, wm, cos_o, bent.cos_t, side.eta);
    }
    let scatter = rough_dielectric_scatter(lobe, wo, wi, side, transport);
    let divisor = max(scatter.density * scatter.chosen, BSDF_SAMPLE_TINY);
    let weight = scatter.value * scatter.norm * (scatter.carried / divisor);
    let pdf = scatter.chosen * scatter.density / scatter.norm;
    return rough_dielectric_scattered(lobe, wi, weight, pdf, reflects, side);
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::sample.
fn rough_dielectric_sample(lobe: RoughDielectric, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    if rough_dielectric_is_specular(lobe) {
        return bsdf_sample_delta(-wo, lobe.tints.transmission, 1.0, BSDF_SAMPLE_TRANSMISSION, 1.0);
    }
    let side = rough_dielectric_side(lobe, wo);
    let upright = vec3f(wo.xy, wo.z * side.turn);
    if rough_dielectric_is_branch_first(lobe) {
        return rough_dielectric_sample_branch_first(lobe, upright, u, side, transport);
    }
    return rough_dielectric_sample_normal_first(lobe, upright, u, side, transport);
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::eval_pdf.
fn rough_dielectric_eval_pdf(lobe: RoughDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if rough_dielectric_is_specular(lobe) {
        return vec4f(0.0);
    }
    let side = rough_dielectric_side(lobe, wo);
    let turned = vec3f(wi.xy, wi.z * side.turn);
    let scatter = rough_dielectric_scatter(lobe, vec3f(wo.xy, wo.z * side.turn), turned, side, transport);
    let f_cos = tints_on_side(lobe.tints, turned.z > 0.0) * (scatter.value * scatter.carried);
    return vec4f(f_cos, scatter.chosen * scatter.density / scatter.norm);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::eval.
fn rough_dielectric_eval(lobe: RoughDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return rough_dielectric_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `rough_dielectric_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::pdf.
fn rough_dielectric_pdf(lobe: RoughDielectric, wo: vec3f, wi: vec3f) -> f32 {
    return rough_dielectric_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// A sample of one branch alone, by all visible normals. The weight is of that branch: for walks that
/// follow reflection and refraction one by one.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::sample_branch.
fn rough_dielectric_sample_branch(lobe: RoughDielectric, view: vec3f, u: vec2f, reflects: bool, transport: u32) -> BsdfSample {
    let side = rough_dielectric_side(lobe, view);
    let wo = vec3f(view.xy, view.z * side.turn);
    let wm = microfacets_sample_wm(lobe.facets, wo, u);
    let cos_o = max(dot(wo, wm), 0.0);
    let bent = dielectric(cos_o, side.eta);
    let wr = reflection_mirrored(wo, wm);
    let wt = wm * (side.inverse_eta * cos_o - bent.cos_t) - wo * side.inverse_eta;
    let wi = select(wt, wr, reflects);
    let fresnel = select(bent.transmittance, bent.reflectance, reflects);
    let half_vector = rough_dielectric_half(lobe, side, wo, wi, reflects);
    let squared = dot(half_vector, half_vector);
    let stretches = rough_dielectric_stretches(lobe, side, transport);
    let bend = dot(wo, half_vector) * abs(dot(wi, half_vector)) / max(squared * squared, BSDF_SAMPLE_TINY);
    let sigma = microfacets_projected_area(lobe.facets, wo);
    let d = microfacets_d_along(lobe.facets, half_vector, squared);
    let pdf = d * select(stretches.x * bend, 0.25, reflects) / sigma;
    let scale = select(stretches.y / stretches.x, 1.0, reflects);
    let weight = rough_dielectric_value(rough_dielectric_carried(lobe, fresnel, wo, wi)) * sigma;
    return rough_dielectric_scattered(lobe, wi, weight * scale, pdf, reflects, side);
}

/// `f |cos|` without tints, and the density of `rough_dielectric_sample_branch` for the branch of `wi`.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::eval_branch.
fn rough_dielectric_eval_branch(lobe: RoughDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec2f {
    let side = rough_dielectric_side(lobe, wo);
    let turned = vec3f(wi.xy, wi.z * side.turn);
    let scatter = rough_dielectric_scatter(lobe, vec3f(wo.xy, wo.z * side.turn), turned, side, transport);
    if scatter.value > 0.0 {
        return vec2f(scatter.value * scatter.carried, scatter.density / scatter.norm);
    }
    return vec2f(0.0);
}
