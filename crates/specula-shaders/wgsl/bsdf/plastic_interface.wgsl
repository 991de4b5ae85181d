// What Mitsuba 3's plastics let through their coat and reflect below it.
//
//     T(mu) = int (1 - F(wo.wm)) G1(wt) D_visible(wo, wm) dwm                rough: single refraction
//     R_int = 2/64 sum_k mu_k int F(wo.wm) G1(wr) D_visible(wo, wm) dwm      mu_k = k/63, from inside
//
// with `wt`, `wr` the refracted and the reflected direction. `R_int` is the sum that `roughplastic` takes, a
// rectangle rule with both its ends. A smooth coat has `T = 1 - F` and a published fit of `R_int`, as
// `plastic` has.
//
// Rough: tables, cubic in `(eta - 1)/(eta + 1)`, `sqrt(1.1 alpha / (1 + alpha))` and `sqrt(mu)`. Errors:
// specula-bsdf/src/bsdf/plastic/interface.rs. Anisotropic alphas are taken as `sqrt(alpha_x alpha_y)`.
//
// Departure from the Rust source: the table is read at the cosine for each direction, where Rust stores
// the row of an alpha and an index.

import package::energy::energy_table::{energy_table};
import package::energy::stencil::{StencilWeights, stencil_at};
import package::ndf::distribution::{DISTRIBUTION_BECKMANN};

/// Knots along the index.
const PLASTIC_INTERFACE_ETAS: u32 = 9u;
/// Knots along the alpha.
const PLASTIC_INTERFACE_ALPHAS: u32 = 25u;
/// Knots along the cosine.
const PLASTIC_INTERFACE_MUS: u32 = 20u;
/// Where `T` by distribution, index, alpha and cosine begins.
const PLASTIC_INTERFACE_TRANSMITTANCE_START: u32 = 913942u;
/// Where `R_int` by distribution, index and alpha begins.
const PLASTIC_INTERFACE_INTERNAL_START: u32 = 922942u;

/// The tables at an alpha and an index.
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, Interface.
struct PlasticInterface {
    /// First row of the distribution, of rows by index and alpha.
    first: u32,
    /// Neighbours of the index.
    eta: StencilWeights,
    /// Neighbours of the alpha.
    alpha: StencilWeights,
}

/// The tables at an alpha and an index in [1, 3].
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, Interface::rough.
fn plastic_interface_new(distribution: u32, alpha: vec2f, eta: f32) -> PlasticInterface {
    let mean = sqrt(alpha.x * alpha.y);
    let second = distribution == DISTRIBUTION_BECKMANN;
    let first = select(0u, PLASTIC_INTERFACE_ETAS * PLASTIC_INTERFACE_ALPHAS, second);
    let e = stencil_at(2.0 * (eta - 1.0) / (eta + 1.0), PLASTIC_INTERFACE_ETAS);
    let a = stencil_at(sqrt(1.1 * mean / (1.0 + mean)), PLASTIC_INTERFACE_ALPHAS);
    return PlasticInterface(first, e, a);
}

/// `R_int` of a rough coat.
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, Interface::rough.
fn plastic_interface_internal_reflectance(interior: PlasticInterface) -> f32 {
    var sum = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let row = interior.first + (interior.eta.first + i) * PLASTIC_INTERFACE_ALPHAS;
        let place = PLASTIC_INTERFACE_INTERNAL_START + row + interior.alpha.first;
        var along = 0.0;
        for (var j = 0u; j < 4u; j++) {
            along += interior.alpha.weights[j] * energy_table(place + j);
        }
        sum += interior.eta.weights[i] * along;
    }
    return sum;
}

/// `T(mu)` of a rough coat, in [0, 1].
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, Interface::transmittance.
fn plastic_interface_transmittance(interior: PlasticInterface, mu: f32) -> f32 {
    let at = stencil_at(sqrt(max(mu, 0.0)), PLASTIC_INTERFACE_MUS);
    var sum = 0.0;
    for (var n = 0u; n < 16u; n++) {
        let i = n / 4u;
        let j = n % 4u;
        let row = interior.first + (interior.eta.first + i) * PLASTIC_INTERFACE_ALPHAS + interior.alpha.first + j;
        let place = PLASTIC_INTERFACE_TRANSMITTANCE_START + row * PLASTIC_INTERFACE_MUS + at.first;
        let values = vec4f(energy_table(place), energy_table(place + 1u), energy_table(place + 2u), energy_table(place + 3u));
        sum += interior.eta.weights[i] * interior.alpha.weights[j] * dot(at.weights, values);
    }
    return clamp(sum, 0.0, 1.0);
}

/// Mitsuba's fits of the diffuse reflectance of a smooth interface from inside.
///
///     0.0636 eta + 0.6681 + 0.7099 / eta - 1.4399 / eta^2                    eta > 1
///     a polynomial of degree 5 in eta                                        eta <= 1
///
/// * `eta`: index inside over outside.
///
/// Source: Egan and Hilgeman 1973; d'Eon and Irving 2011.
///
/// Twin: specula-bsdf/src/bsdf/plastic/interface.rs, smooth_internal_reflectance.
fn plastic_interface_smooth_internal_reflectance(eta: f32) -> f32 {
    let inverse = 1.0 / eta;
    if eta > 1.0 {
        return 0.0636 * eta + 0.6681 + inverse * (0.7099 - 1.4399 * inverse);
    }
    return ((((-1.36881 * eta + 4.98554) * eta - 7.80989) * eta + 6.75335) * eta - 3.4793) * eta + 0.919317;
}
