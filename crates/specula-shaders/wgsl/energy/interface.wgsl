// Directional transmittance and internal reflectance of a dielectric interface, for coats.
//
//     T(mu) = int (1 - F(wo.wm)) D_visible(wo, wm) dwm              light from outside that enters
//     R_int = 1 - int_0^1 T(mu) 2 mu dmu / eta^2                    diffuse light reflected inside
//
// `T` is what the facets seen from `wo` let through. Light refracted downwards stays below: what
// masking takes from the single-scattering transmission lobe is not lost but refracted again, so that
// here, where only the amount counts, no masking term belongs. `R_int` follows by reciprocity.
//
// Smooth: closed forms. Rough: tables of `T / (1 - F(mu_e))` and of `R_int`, linear in
// `(eta - 1)/(eta + 1)`, `sqrt(1.1 alpha / (1 + alpha))` and `sqrt(mu)`, where `mu_e` is a cosine raised
// by the roughness so that the quotient is smooth. Errors: specula-bsdf/src/energy/interface.rs.
//
// Departure from the Rust source: a coat is given by its alpha, `sqrt(alpha_x alpha_y)`, 0 where it is
// smooth.

import package::energy::energy_table::{energy_table};
import package::fresnel::dielectric::{dielectric, dielectric_average};

/// Knots along the index.
const INTERFACE_ETAS: u32 = 9u;
/// Knots along the alpha.
const INTERFACE_ALPHAS: u32 = 25u;
/// Knots along the cosine.
const INTERFACE_MUS: u32 = 25u;
/// Where `T / (1 - F(mu_e))` by index, alpha and cosine begins.
const INTERFACE_TRANSMITTANCE_START: u32 = 890576u;
/// Where `R_int` by index and alpha begins.
const INTERFACE_INTERNAL_START: u32 = 896201u;

/// A place between two knots of a uniform axis.
///
/// Twin: specula-bsdf/src/energy/interface.rs, Knot.
struct InterfaceKnot {
    /// Index of the lower knot.
    low: u32,
    /// Share of the upper one.
    fraction: f32,
}

/// `x` on the axis [0, 1] of `count` knots, clamped.
///
/// Twin: specula-bsdf/src/energy/interface.rs, Knot::new.
fn interface_knot(x: f32, count: u32) -> InterfaceKnot {
    let end = f32(count - 1u);
    let place = clamp(x * end, 0.0, end);
    let low = min(floor(place), end - 1.0);
    return InterfaceKnot(u32(low), place - low);
}

/// The place of an index in [1, 3], along `(eta - 1) / (eta + 1)` up to 1/2.
///
/// Twin: specula-bsdf/src/energy/interface.rs, eta_knot.
fn interface_eta_knot(eta: f32, count: u32) -> InterfaceKnot {
    return interface_knot(2.0 * ((eta - 1.0) / (eta + 1.0)), count);
}

/// The knot of an alpha in [0, 10], along `sqrt(1.1 alpha / (1 + alpha))`.
///
/// Twin: specula-bsdf/src/energy/interface.rs, alpha_knot.
fn interface_alpha_knot(alpha: f32, count: u32) -> InterfaceKnot {
    return interface_knot(sqrt(alpha / ((1.0 + alpha) * (10.0 / 11.0))), count);
}

/// The place of a cosine, along `sqrt(mu)`.
///
/// Twin: specula-bsdf/src/energy/interface.rs, cosine_knot.
fn interface_cosine_knot(mu: f32, count: u32) -> InterfaceKnot {
    return interface_knot(sqrt(clamp(mu, 0.0, 1.0)), count);
}

/// The value at `start` and the next one, interpolated.
///
/// Twin: specula-bsdf/src/energy/interface.rs, Knot::lerp.
fn interface_along(start: u32, knot: InterfaceKnot) -> f32 {
    let below = energy_table(start + knot.low);
    let above = energy_table(start + knot.low + 1u);
    return below + (above - below) * knot.fraction;
}

/// A table of rows of `count` values, along two axes.
///
/// Twin: specula-bsdf/src/energy/interface.rs, Knot::lerp, twice.
fn interface_plane(start: u32, rows: InterfaceKnot, columns: InterfaceKnot, count: u32) -> f32 {
    let below = interface_along(start + rows.low * count, columns);
    let above = interface_along(start + (rows.low + 1u) * count, columns);
    return below + (above - below) * rows.fraction;
}

/// The alpha that stands for a coat's two.
///
/// Twin: specula-bsdf/src/energy/interface.rs, mean_alpha.
fn interface_mean_alpha(alpha: vec2f) -> f32 {
    return sqrt(alpha.x * alpha.y);
}

/// The raised cosine at which the smooth transmittance is factored out of the table.
///
/// Twin: specula-bsdf/src/energy/interface.rs, effective_cosine.
fn interface_effective_cosine(mu: f32, alpha: f32) -> f32 {
    let squared = alpha * alpha;
    return sqrt((mu * mu + squared) / (1.0 + squared));
}

/// `T / (1 - F(mu_e))` of the table that begins at `start`.
///
/// Twin: specula-bsdf/src/energy/interface.rs, transmittance.
fn interface_quotient(start: u32, alpha: f32, eta: f32, mu: f32) -> f32 {
    let e = interface_eta_knot(eta, INTERFACE_ETAS);
    let a = interface_alpha_knot(alpha, INTERFACE_ALPHAS);
    let m = interface_cosine_knot(mu, INTERFACE_MUS);
    let block = INTERFACE_ALPHAS * INTERFACE_MUS;
    let below = interface_plane(start + e.low * block, a, m, INTERFACE_MUS);
    let above = interface_plane(start + (e.low + 1u) * block, a, m, INTERFACE_MUS);
    return below + (above - below) * e.fraction;
}

/// Share of the light from outside at the cosine `mu` that enters.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface.rs, transmittance.
fn interface_transmittance(alpha: f32, eta: f32, mu: f32) -> f32 {
    if alpha <= 0.0 {
        return dielectric(mu, eta).transmittance;
    }
    let unhindered = dielectric(interface_effective_cosine(mu, alpha), eta).transmittance;
    let quotient = interface_quotient(INTERFACE_TRANSMITTANCE_START, alpha, eta, mu);
    return clamp(unhindered * quotient, 0.0, 1.0);
}

/// Share of diffuse light from inside that is reflected.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface.rs, internal_reflectance.
fn interface_internal_reflectance(alpha: f32, eta: f32) -> f32 {
    if alpha <= 0.0 {
        return dielectric_average(1.0 / eta);
    }
    let e = interface_eta_knot(eta, INTERFACE_ETAS);
    let a = interface_alpha_knot(alpha, INTERFACE_ALPHAS);
    return interface_plane(INTERFACE_INTERNAL_START, e, a, INTERFACE_ALPHAS);
}
