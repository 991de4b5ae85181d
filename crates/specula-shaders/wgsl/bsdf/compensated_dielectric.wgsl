// Rough dielectric interfaces that keep their energy (Kulla and Conty 2017).
//
// Single scattering at a rough interface, and a second lobe on both sides for what it loses. With `L_n`,
// `L_f` the losses of single scattering seen from the side of `wo` and from beyond, and `t` the share of
// the lost light that is transmitted:
//
//     reflection:    f = f_ss + (1 - t_n) L_n(wo) L_n(wi) / (pi L_n,avg)
//     transmission:  f = f_ss + t_n L_n(wo) L_f(wi) / (pi L_f,avg)  [/ eta^2 for radiance]
//     t_n = (1 - F_avg(eta)) min(L_n,avg, L_f,avg) / L_n,avg
//
// Nothing is lost, whichever `t` is. Reciprocity asks that `t_n L_n,avg = eta^2 t_f L_f,avg`; because
// `1 - F_avg(eta) = eta^2 (1 - F_avg(1/eta))`, it holds for the `t` above, which stays in [0, 1] and is the
// averaged Fresnel transmittance on the side that loses less.
//
// Sampled by the single-scattering sampler with probability `1 - L_n(wo)`, else by the cosine on either side,
// with its exact pdf.
//
// Departure: Kulla and Conty ask for the two conditions; this closed form of the split is Specula's. Losses are
// tabulated (`dielectric_albedo`).

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_LARGEST, BSDF_SAMPLE_SPECULAR, BSDF_SAMPLE_TRANSMISSION, BSDF_SAMPLE_VALID, BsdfSample, BSDF_SAMPLE_RADIANCE, bsdf_sample_none, bsdf_sample_radiance_scale};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::rough_dielectric::{RoughDielectric, rough_dielectric_sample, rough_dielectric_eval_pdf, rough_dielectric_is_specular};
import package::bsdf::tints::{TintsPair, tints_on_side};
import package::energy::dielectric_albedo::{DielectricAlbedoLoss, dielectric_albedo_directional_loss, dielectric_albedo_loss};
import package::fresnel::dielectric::{dielectric_average};
import package::math::warp::{warp_cosine_hemisphere};

/// `1 / pi`.
const COMPENSATED_DIELECTRIC_PER_PI: f32 = 0.31830988618379;
/// The largest float below 1.
const COMPENSATED_DIELECTRIC_BELOW_ONE: f32 = 0.99999988079071;

/// A rough interface with a second lobe on both sides.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric.
struct CompensatedDielectric {
    /// The single-scattering lobe.
    single: RoughDielectric,
    /// The energy that it loses, for views from above.
    above: DielectricAlbedoLoss,
    /// The energy that it loses, for views from below, with the inverse index.
    below: DielectricAlbedoLoss,
    /// Transmitted shares, from above and from below.
    transmitted: vec2f,
}

/// The interface from the side of a view.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, Side.
struct CompensatedDielectricSide {
    /// Factor of z that moves the view above the surface.
    turn: f32,
    /// Index beyond over the index on the side of the view.
    eta: f32,
    /// Share of the lost light that is transmitted.
    transmitted: f32,
    /// `L_n(wo)`.
    loss: f32,
}

/// The interface of these facets.
///
/// * `eta`, `two_sided`, `tints`: see `RoughDielectric`; losses are tabulated for indices in [1/3, 3].
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::with_single.
fn compensated_dielectric_new(facets: MicrofacetsModel, eta: f32, two_sided: u32, tints: TintsPair) -> CompensatedDielectric {
    var lobe: CompensatedDielectric;
    let inverse = 1.0 / eta;
    lobe.single = RoughDielectric(facets, eta, two_sided, tints);
    lobe.above = dielectric_albedo_loss(facets.distribution, facets.masking, facets.alpha, eta);
    lobe.below = dielectric_albedo_loss(facets.distribution, facets.masking, facets.alpha, inverse);
    let losses = vec2f(lobe.above.average, lobe.below.average);
    let passing = vec2f(1.0 - dielectric_average(eta), 1.0 - dielectric_average(inverse));
    lobe.transmitted = passing * (min(losses.x, losses.y) / losses);
    return lobe;
}

/// Whether the view is from inside an interface with both sides.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::side.
fn compensated_dielectric_is_inside(lobe: CompensatedDielectric, wo: vec3f) -> bool {
    return lobe.single.two_sided == 1u && wo.z < 0.0;
}

/// The interface from the side of `wo`.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::side.
fn compensated_dielectric_side(lobe: CompensatedDielectric, wo: vec3f) -> CompensatedDielectricSide {
    var near = lobe.above;
    var side = CompensatedDielectricSide(1.0, lobe.single.eta, lobe.transmitted.x, 0.0);
    if compensated_dielectric_is_inside(lobe, wo) {
        near = lobe.below;
        side = CompensatedDielectricSide(-1.0, 1.0 / lobe.single.eta, lobe.transmitted.y, 0.0);
    }
    // Light passes straight through matched indices: nothing is lost.
    if !rough_dielectric_is_specular(lobe.single) {
        side.loss = dielectric_albedo_directional_loss(near, wo);
    }
    return side;
}

/// Both lobes' value and density, given the side.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::both_lobes.
fn compensated_dielectric_both_lobes(lobe: CompensatedDielectric, side: CompensatedDielectricSide, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    let first = rough_dielectric_eval_pdf(lobe.single, wo, wi, transport);
    let cosine = abs(wi.z) * COMPENSATED_DIELECTRIC_PER_PI;
    let reflects = wi.z * side.turn > 0.0;
    var there = lobe.above;
    if compensated_dielectric_is_inside(lobe, wo) == reflects {
        there = lobe.below;
    }
    let shape = dielectric_albedo_directional_loss(there, wi) / there.average;
    let share = select(side.transmitted, 1.0 - side.transmitted, reflects);
    let scale = select(bsdf_sample_radiance_scale(side.eta, transport), 1.0, reflects);
    let second = share * shape * cosine * scale;
    let f_cos = first.rgb + tints_on_side(lobe.single.tints, reflects) * (side.loss * second);
    return vec4f(f_cos, first.a + side.loss * (share * cosine - first.a));
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::eval_pdf.
fn compensated_dielectric_eval_pdf(lobe: CompensatedDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if wi.z == 0.0 {
        return vec4f(0.0);
    }
    return compensated_dielectric_both_lobes(lobe, compensated_dielectric_side(lobe, wo), wo, wi, transport);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::eval.
fn compensated_dielectric_eval(lobe: CompensatedDielectric, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return compensated_dielectric_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `compensated_dielectric_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::pdf.
fn compensated_dielectric_pdf(lobe: CompensatedDielectric, wo: vec3f, wi: vec3f) -> f32 {
    return compensated_dielectric_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE).a;
}

/// Samples `wi`.
///
/// * `u`: uniform in [0, 1)^3.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, CompensatedDielectric::sample.
fn compensated_dielectric_sample(lobe: CompensatedDielectric, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    let side = compensated_dielectric_side(lobe, wo);
    var sampled: BsdfSample;
    if u.x < side.loss {
        let up = warp_cosine_hemisphere(u.yz);
        let transmits = u.x < side.loss * side.transmitted;
        sampled.wi = vec3f(up.xy, select(up.z, -up.z, transmits) * side.turn);
        sampled.flags = BSDF_SAMPLE_VALID | select(0u, BSDF_SAMPLE_TRANSMISSION, transmits);
        sampled.eta = select(1.0, side.eta, transmits);
    } else {
        // Rounding must not yield 1.
        let rest = min((u.x - side.loss) / (1.0 - side.loss), COMPENSATED_DIELECTRIC_BELOW_ONE);
        sampled = rough_dielectric_sample(lobe.single, wo, vec3f(rest, u.yz), transport);
        if sampled.flags == 0u || (sampled.flags & BSDF_SAMPLE_SPECULAR) != 0u {
            return sampled;
        }
    }
    let value = compensated_dielectric_both_lobes(lobe, side, wo, sampled.wi, transport);
    if value.a > 0.0 && value.a <= BSDF_SAMPLE_LARGEST {
        sampled.weight = value.rgb / value.a;
        sampled.pdf = value.a;
        return sampled;
    }
    return bsdf_sample_none();
}
