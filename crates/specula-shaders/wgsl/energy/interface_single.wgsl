// Transmittance and internal reflectance of a dielectric interface whose facets scatter once, for
// coats.
//
//     T(mu) = int (1 - F(wo.wm)) G2(wo, wi) / G1(wo) D_visible(wo, wm) dwm,   wi refracted, below
//     R_int = int_0^1 int F(wo.wm) G2(wo, wi) / G1(wo) D_visible(wo, wm) dwm 2 mu dmu,
//                                                     wo, wi inside, wi reflected, still inside
//
// In contrast to `interface`, what masking takes and what leaves on the wrong side is lost, as in a
// path tracer whose rough interfaces scatter singly (pbrt-v4's layered materials). `T` is reciprocal:
// the share of diffuse light from below that leaves is `int T(mu) 2 mu dmu / eta^2`.
//
// Tables of `T / (1 - F(mu_e))` and of `R_int / (1 - 1/eta^2)` on the coordinates of `interface`.
// Errors: specula-bsdf/src/energy/interface_single.rs.

import package::energy::interface::{interface_alpha_knot, interface_effective_cosine, interface_eta_knot, interface_plane, interface_quotient};
import package::fresnel::dielectric::{dielectric, dielectric_average};

/// Knots along the index, of the internal reflectance.
const INTERFACE_SINGLE_INTERNAL_ETAS: u32 = 17u;
/// Knots along the alpha.
const INTERFACE_SINGLE_ALPHAS: u32 = 25u;
/// Where `T / (1 - F(mu_e))` by index, alpha and cosine begins.
const INTERFACE_SINGLE_TRANSMITTANCE_START: u32 = 896426u;
/// Where `R_int / (1 - 1/eta^2)` by index and alpha begins.
const INTERFACE_SINGLE_INTERNAL_START: u32 = 902051u;

/// Share of the light from outside at the cosine `mu` that enters by one scattering.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface_single.rs, transmittance.
fn interface_single_transmittance(alpha: f32, eta: f32, mu: f32) -> f32 {
    if alpha <= 0.0 {
        return dielectric(mu, eta).transmittance;
    }
    let unhindered = dielectric(interface_effective_cosine(mu, alpha), eta).transmittance;
    let quotient = interface_quotient(INTERFACE_SINGLE_TRANSMITTANCE_START, alpha, eta, mu);
    return clamp(unhindered * quotient, 0.0, 1.0);
}

/// Share of the light from outside at the cosine `mu` that the interface reflects, roughly: Fresnel's
/// factor at a cosine raised by the roughness. Good enough to choose between strategies.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
///
/// Twin: specula-bsdf/src/energy/interface_single.rs, reflectance_estimate.
fn interface_single_reflectance_estimate(alpha: f32, eta: f32, mu: f32) -> f32 {
    let raised = interface_effective_cosine(mu, alpha);
    return dielectric(select(mu, raised, alpha > 0.0), eta).reflectance;
}

/// Share of diffuse light from inside that is reflected by one scattering.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface_single.rs, internal_reflectance.
fn interface_single_internal_reflectance(alpha: f32, eta: f32) -> f32 {
    if alpha <= 0.0 {
        return dielectric_average(1.0 / eta);
    }
    let e = interface_eta_knot(eta, INTERFACE_SINGLE_INTERNAL_ETAS);
    let a = interface_alpha_knot(alpha, INTERFACE_SINGLE_ALPHAS);
    let quotient = interface_plane(INTERFACE_SINGLE_INTERNAL_START, e, a, INTERFACE_SINGLE_ALPHAS);
    return quotient * (1.0 - 1.0 / (eta * eta));
}
