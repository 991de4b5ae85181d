// A density in closed form, close to that of a layered walk's directions, for multiple importance
// sampling.
//
//     p(wi) = p_c D_c(wo + wi) / (4 N_c)                               the coat's reflections
//           + (1 - p_c) (1 - s) (q(wi') |dwi'/dwi| + sqrt(1 - 1/eta^2) q(wt))     the base's
//           + (1 - p_c) s wi.z / pi                                    light that forgot where from
//
// `q` is the density of the base's reflections under the coat, as blurred by a rough one: twice refracted
// slopes add variance, `a'^2 = a^2 + (1 - 1/eta)^2 a_coat^2 / 2` (to the first order of Belcour 2018).
// `wi'` is `wi` bent by the coat's mean surface. Light beyond the critical angle stays below; it is sent
// on in its own azimuth, by the map of the ring `1/eta < sin < 1` to the disc,
// `sin^2 = 1/eta^2 + (1 - 1/eta^2) sin^2 theta_i`, whose Jacobian is the root above. So the whole
// integrates to 1 where `q` does.

import package::alpha::{ALPHA_SPECULAR_BELOW, alpha_clamped};
import package::bsdf::layered::layered_base::{LAYERED_BASE_DIFFUSE};
import package::bsdf::layered::layered_coat::{layered_coat_below};
import package::bsdf::layered::layered_lobe::{LayeredLobe, layered_lobe_is_mirror};
import package::bsdf::layered::layered_medium::{layered_medium_scatters};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d_along, microfacets_norm};
import package::fresnel::dielectric::{dielectric};
import package::math::warp::{warp_cosine_hemisphere_pdf};

/// A floor of divisors.
const LAYERED_DENSITY_TINY: f32 = 1.1754944e-38;

/// The metal's facets as blurred by a rough coat.
///
/// Twin: specula-bsdf/src/bsdf/layered/density.rs, blurred_metal.
fn layered_density_blurred(metal_facets: MicrofacetsModel, metal_rough: bool, coat: MicrofacetsModel, eta: f32) -> MicrofacetsModel {
    let bend = 1.0 - 1.0 / eta;
    let own = select(vec2f(0.0), metal_facets.alpha, metal_rough);
    let alpha = sqrt(own * own + 0.5 * bend * bend * coat.alpha * coat.alpha);
    var blurred = metal_facets;
    blurred.alpha = alpha_clamped(max(alpha, vec2f(ALPHA_SPECULAR_BELOW)));
    return blurred;
}

/// The density (see the module's text), in 1/sr; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/bsdf/layered/density.rs, pdf.
fn layered_density_pdf(lobe: LayeredLobe, wo: vec3f, wi: vec3f) -> f32 {
    if wi.z <= 0.0 || layered_lobe_is_mirror(lobe) {
        return 0.0;
    }
    let eta = lobe.coat.eta;
    let reflected = dielectric(abs(wo.z), eta).reflectance;
    let below = 1.0 - reflected;
    let broad = warp_cosine_hemisphere_pdf(wi);
    let coat = layered_density_coat(lobe, reflected, wo, wi);
    let scattered = layered_density_scattered(lobe);
    if lobe.has_lobe == 0u {
        let share = select(scattered, 1.0, lobe.base.kind == LAYERED_BASE_DIFFUSE);
        return below * share * broad + coat;
    }
    // Of light that meets the metal twice and more.
    let rough = max(lobe.blurred.alpha.x, lobe.blurred.alpha.y);
    let twice = clamp(rough * 0.5, 0.02, 0.3);
    let share = 1.0 - (1.0 - twice) * (1.0 - scattered);
    let mirrored = layered_coat_below(lobe.coat, wo);
    let view = vec3f(-mirrored.x, -mirrored.y, mirrored.z);
    let inverse_squared = 1.0 / (eta * eta);
    let flat_part = wi.xy / eta;
    let height = 1.0 - flat_part.x * flat_part.x - flat_part.y * flat_part.y;
    let bent = vec3f(flat_part, sqrt(max(height, 0.0)));
    let jacobian = wi.z * inverse_squared / bent.z;
    let through = layered_density_quarter(lobe.blurred, view, bent) * jacobian;
    let ring = 1.0 - inverse_squared;
    let sine_squared = 1.0 - wi.z * wi.z;
    let squared = (inverse_squared + ring * sine_squared) / max(sine_squared, LAYERED_DENSITY_TINY);
    let root = sqrt(max(ring, 0.0));
    let projected = vec3f(wi.xy * sqrt(squared), root * wi.z);
    let beyond = layered_density_quarter(lobe.blurred, view, projected) * root;
    let metal_part = (through + beyond) / microfacets_norm(lobe.blurred, view);
    return below * ((1.0 - share) * metal_part + share * broad) + coat;
}

/// Share of light that the medium scatters on its way down and up.
///
/// Twin: specula-bsdf/src/bsdf/layered/density.rs, scattered.
fn layered_density_scattered(lobe: LayeredLobe) -> f32 {
    if layered_medium_scatters(lobe.medium) {
        return 1.0 - exp(-2.0 * lobe.medium.thickness);
    }
    return 0.0;
}

/// The coat's part.
///
/// * `p`: its share.
///
/// Twin: specula-bsdf/src/bsdf/layered/density.rs, coat_pdf.
fn layered_density_coat(lobe: LayeredLobe, p: f32, wo: vec3f, wi: vec3f) -> f32 {
    if lobe.coat.rough == 0u {
        return 0.0;
    }
    var facets = lobe.coat.facets;
    facets.strategy = lobe.strategy;
    return p * layered_density_quarter(facets, wo, wi) / microfacets_norm(facets, wo);
}

/// `D / 4` of the facet that turns `wo` to `wi`.
///
/// Twin: specula-bsdf/src/bsdf/layered/density.rs, quarter_d.
fn layered_density_quarter(facets: MicrofacetsModel, wo: vec3f, wi: vec3f) -> f32 {
    let half_vector = wo + wi;
    return 0.25 * microfacets_d_along(facets, half_vector, dot(half_vector, half_vector));
}
