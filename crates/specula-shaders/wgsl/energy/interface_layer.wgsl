// What an absorbing layer under a dielectric interface takes, for coats.
//
// Light that crosses a layer of optical thickness `t` at the cosine `mu` is attenuated to `exp(-t / mu)`. Of light
// that entered at the cosine `mu`, with `<>` the mean over where the interface sends it, and of diffuse
// light that the interface reflects inside, up at `mu_i` and down at `mu_r`:
//
//     crossing(mu) = <exp(-t / mu')>
//     there_and_back = <exp(-t / mu_i - t / mu_r)>
//
// Smooth: `crossing` is `exp(-t / mu')` with the refracted cosine. Rough: tables of the cosine `c` of
// which `exp(-t / c)` is the mean (for `crossing` as a share of the smooth one, refracted from the raised
// cosine `mu_e` of `interface`), linear in that module's coordinates and in `(t / (1 + t))^(1/4)`. The
// means are over single scattering; light that facets pass on to each other is given the same. Errors:
// specula-bsdf/src/energy/interface_layer.rs.

import package::energy::interface::{InterfaceKnot, interface_alpha_knot, interface_cosine_knot, interface_effective_cosine, interface_eta_knot, interface_knot, interface_plane};
import package::fresnel::dielectric::{dielectric};

/// Knots along the index.
const INTERFACE_LAYER_ETAS: u32 = 9u;
/// Knots along the alpha.
const INTERFACE_LAYER_ALPHAS: u32 = 13u;
/// Knots along the cosine.
const INTERFACE_LAYER_MUS: u32 = 13u;
/// Knots along the thickness.
const INTERFACE_LAYER_THICKNESSES: u32 = 7u;
/// Where the cosines of `crossing` by index, alpha, cosine and thickness begin.
const INTERFACE_LAYER_CROSSING_START: u32 = 902476u;
/// Where the cosines of `there_and_back` by index, alpha and thickness begin.
const INTERFACE_LAYER_THERE_AND_BACK_START: u32 = 913123u;

/// A layer that absorbs and does not scatter.
///
/// Twin: specula-bsdf/src/energy/interface_layer.rs, Layer.
struct InterfaceLayer {
    /// Optical thickness, from 0 up.
    thickness: f32,
    /// Its place among the knots.
    place: InterfaceKnot,
}

/// The layer of an optical thickness, from 0 up.
///
/// Twin: specula-bsdf/src/energy/interface_layer.rs, Layer::new.
fn interface_layer_new(thickness: f32) -> InterfaceLayer {
    let held = clamp(thickness, 0.0, 1e6);
    let share = held / (1.0 + held);
    return InterfaceLayer(held, interface_knot(sqrt(sqrt(share)), INTERFACE_LAYER_THICKNESSES));
}

/// `exp(-t / cos)`.
///
/// Twin: specula-bsdf/src/energy/interface_layer.rs, Layer::left.
fn interface_layer_left(layer: InterfaceLayer, cosine: f32) -> f32 {
    // Beyond 100 nothing is left in f32.
    return exp(-min(layer.thickness / max(cosine, 1e-20), 100.0));
}

/// Share that is left of light from outside at the cosine `mu` which entered and crossed.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface_layer.rs, Layer::crossing.
fn interface_layer_crossing(layer: InterfaceLayer, alpha: f32, eta: f32, mu: f32) -> f32 {
    if layer.thickness <= 0.0 {
        return 1.0;
    }
    if alpha <= 0.0 {
        return interface_layer_left(layer, dielectric(mu, eta).cos_t);
    }
    let refracted = dielectric(interface_effective_cosine(mu, alpha), eta).cos_t;
    let e = interface_eta_knot(eta, INTERFACE_LAYER_ETAS);
    let a = interface_alpha_knot(alpha, INTERFACE_LAYER_ALPHAS);
    let m = interface_cosine_knot(mu, INTERFACE_LAYER_MUS);
    let row = INTERFACE_LAYER_MUS * INTERFACE_LAYER_THICKNESSES;
    let start = INTERFACE_LAYER_CROSSING_START + (e.low * INTERFACE_LAYER_ALPHAS + a.low) * row;
    let block = INTERFACE_LAYER_ALPHAS * row;
    let count = INTERFACE_LAYER_THICKNESSES;
    let thin_narrow = interface_plane(start, m, layer.place, count);
    let thin_wide = interface_plane(start + row, m, layer.place, count);
    let dense_narrow = interface_plane(start + block, m, layer.place, count);
    let dense_wide = interface_plane(start + block + row, m, layer.place, count);
    let below = thin_narrow + (thin_wide - thin_narrow) * a.fraction;
    let above = dense_narrow + (dense_wide - dense_narrow) * a.fraction;
    return interface_layer_left(layer, refracted * (below + (above - below) * e.fraction));
}

/// Share that is left of diffuse light which crossed upwards, was reflected, and crossed again.
///
/// * `alpha`: of the coat, 0 for a smooth interface.
/// * `eta`: index inside over outside, in [1, 3].
///
/// Twin: specula-bsdf/src/energy/interface_layer.rs, Layer::there_and_back.
fn interface_layer_there_and_back(layer: InterfaceLayer, alpha: f32, eta: f32) -> f32 {
    if layer.thickness <= 0.0 {
        return 1.0;
    }
    let e = interface_eta_knot(eta, INTERFACE_LAYER_ETAS);
    let a = interface_alpha_knot(alpha, INTERFACE_LAYER_ALPHAS);
    let block = INTERFACE_LAYER_ALPHAS * INTERFACE_LAYER_THICKNESSES;
    let start = INTERFACE_LAYER_THERE_AND_BACK_START + e.low * block;
    let below = interface_plane(start, a, layer.place, INTERFACE_LAYER_THICKNESSES);
    let above = interface_plane(start + block, a, layer.place, INTERFACE_LAYER_THICKNESSES);
    return interface_layer_left(layer, below + (above - below) * e.fraction);
}
