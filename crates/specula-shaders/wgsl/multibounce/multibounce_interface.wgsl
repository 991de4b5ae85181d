// Facets of a dielectric, seen from the side that a walk is on.
//
// Each side has its own frame: inside, z is turned, so that up always leads out on that side. The facets
// seen are then those of the same distribution. The depths of the two sides are
//
//     tau = -ln C1,   tau' = -ln(1 - C1) = -ln(1 - exp(-tau))
//
// (Heitz et al. 2016). Refraction turns z, exchanges the depths and inverts `eta`.

import package::fresnel::dielectric::{dielectric, dielectric_refract};
import package::multibounce::normals::{NormalsModel, normals_d, normals_lambda_cos, normals_sample_wm};
import package::multibounce::walk::{WalkFlight};

/// `ln(2 pi) / 2 - 1`.
const MULTIBOUNCE_INTERFACE_STIRLING: f32 = -0.08106146679532726;
/// A floor of divisors.
const MULTIBOUNCE_INTERFACE_TINY: f32 = 1.1754944e-38;

/// Facets of a dielectric from one side.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface.
struct MultibounceInterface {
    /// Their distribution.
    normals: NormalsModel,
    /// Index beyond over index on this side.
    eta: f32,
}

/// A walk with heights: a flight that meets a facet at `tau`.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Collision.
struct MultibounceInterfaceCollision {
    /// The flight.
    flight: WalkFlight,
    /// Depth on its side.
    tau: f32,
}

/// A direction after a facet.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::bounce.
struct MultibounceInterfaceBent {
    /// In the frame of the side that it runs on.
    d: vec3f,
    /// Whether it has changed sides.
    crosses: bool,
}

/// The vector in the frame of the other side.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, turned.
fn multibounce_interface_turned(w: vec3f) -> vec3f {
    return vec3f(w.x, w.y, -w.z);
}

/// The depth as seen from the other side.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, depth_beyond.
fn multibounce_interface_depth_beyond(tau: f32) -> f32 {
    // Near 0, 1 - exp(-tau) is tau; a ray that touches the top is infinitely deep inside.
    let share = select(tau, 1.0 - exp(-tau), tau > 1e-3);
    return max(-log(max(share, MULTIBOUNCE_INTERFACE_TINY)), 0.0);
}

/// The same facets from the other side.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::beyond.
fn multibounce_interface_beyond(facets: MultibounceInterface) -> MultibounceInterface {
    return MultibounceInterface(facets.normals, 1.0 / facets.eta);
}

/// The next direction, and whether it has changed sides.
///
/// * `u`: samples reflection or refraction (x), and the facet.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::bounce.
fn multibounce_interface_bounce(facets: MultibounceInterface, d: vec3f, u: vec3f) -> MultibounceInterfaceBent {
    let wm = normals_sample_wm(facets.normals, -d, u.yz);
    let cos_m = -dot(d, wm);
    let bent = dielectric(cos_m, facets.eta);
    if u.x < bent.reflectance {
        return MultibounceInterfaceBent(d + wm * (2.0 * cos_m), false);
    }
    let refracted = dielectric_refract(-d, wm, cos_m, bent.cos_t, facets.eta);
    return MultibounceInterfaceBent(multibounce_interface_turned(refracted), true);
}

/// Phase function towards `wi` in this frame, in 1/sr, for light (no `1/eta^2`).
///
///     F D / (4 sigma(-d))    and    (1 - F) D |d.wm| e^2 |wi.wm| / (sigma(-d) (|d.wm| + e wi.wm)^2)
///
/// * `reflects`: the first, or the second.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::phase.
fn multibounce_interface_phase(
    facets: MultibounceInterface,
    flight: WalkFlight,
    wi: vec3f,
    reflects: bool,
) -> f32 {
    let wo = -flight.d;
    let generalised = wo + wi * select(facets.eta, 1.0, reflects);
    let upright = select(1.0, -1.0, generalised.z < 0.0);
    let size = length(generalised);
    if size < 1e-6 {
        return 0.0;
    }
    let wm = generalised * (upright / size);
    let cos_o = dot(wo, wm);
    let cos_i = dot(wi, wm);
    let is_lit = cos_o > 0.0 && select(-cos_i, cos_i, reflects) > 0.0;
    if !is_lit || wm.z <= 0.0 {
        return 0.0;
    }
    let bent = dielectric(cos_o, facets.eta);
    let d = normals_d(facets.normals, wm) / flight.facing;
    if reflects {
        return 0.25 * bent.reflectance * d;
    }
    let sum = cos_o + facets.eta * cos_i;
    let jacobian = facets.eta * facets.eta * abs(cos_i) / max(sum * sum, 1e-12);
    return bent.transmittance * d * cos_o * jacobian;
}

/// Phase function times the probability of leaving along `wi`, from a known depth.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::connection.
fn multibounce_interface_connection(facets: MultibounceInterface, at: MultibounceInterfaceCollision, wi: vec3f) -> f32 {
    let phase = multibounce_interface_phase(facets, at.flight, wi, wi.z > 0.0);
    if phase <= 0.0 {
        return 0.0;
    }
    return phase * multibounce_interface_leaves(facets, at.tau, wi);
}

/// Probability of leaving along `wi`, on either side, from the depth `tau`.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::leaves.
fn multibounce_interface_leaves(facets: MultibounceInterface, tau: f32, wi: vec3f) -> f32 {
    var depth = tau;
    if wi.z <= 0.0 {
        depth = multibounce_interface_depth_beyond(tau);
    }
    return exp(-(depth * multibounce_interface_lambda(facets, wi)));
}

/// Smith's `Lambda` of the upper of `wi` and its mirror image.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::leaves.
fn multibounce_interface_lambda(facets: MultibounceInterface, wi: vec3f) -> f32 {
    return normals_lambda_cos(facets.normals, wi) / max(abs(wi.z), 1e-12);
}

/// Mean of `multibounce_interface_leaves` over `tau` of `Exp(l)`, for `wi` beyond:
///
///     int l C^(l-1) (1 - C)^L dC = l B(l, L + 1) = G(l + 1) G(L + 1) / G(l + L + 1)
///
/// Source: Walter's refraction with Smith's heights, as in Heitz et al. 2016. Departure: Stirling's
/// series with its differences of logarithms taken together, so that f32 is enough (the Rust subtracts
/// logarithms of gamma functions in f64):
///
///     ln = -l ln(1 + L/(l+1)) - L ln(1 + l/(L+1)) + ln((l+1) (L+1) / (l+L+1)) / 2 + ln(2 pi) / 2 - 1
///          + J(l+1) + J(L+1) - J(l+L+1)
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Interface::leaves_beyond.
fn multibounce_interface_leaves_beyond(l: f32, lambda: f32) -> f32 {
    let a = l + 1.0;
    let b = lambda + 1.0;
    let c = l + b;
    let powers = l * multibounce_interface_log_above(lambda / a)
        + lambda * multibounce_interface_log_above(l / b);
    let rest = multibounce_interface_binet(a) + multibounce_interface_binet(b)
        - multibounce_interface_binet(c);
    let whole = 0.5 * log(a / c * b) - powers + (rest + MULTIBOUNCE_INTERFACE_STIRLING);
    return exp(min(whole, 0.0));
}

/// `ln(1 + x)` for `x >= 0`, precise where it is small.
///
/// Twin: f64::ln_1p.
fn multibounce_interface_log_above(x: f32) -> f32 {
    if x > 0.5 {
        return log(1.0 + x);
    }
    // 2 artanh(x / (2 + x)).
    let t = x / (2.0 + x);
    let s = t * t;
    let series = 1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * (1.0 / 9.0))));
    return 2.0 * t * series;
}

/// Binet's function, what Stirling's formula leaves of the logarithm of the gamma function:
/// `ln G(x) = (x - 1/2) ln x - x + ln(2 pi) / 2 + J(x)`, for `x >= 1`; absolute error below 3e-7.
///
/// Source: the continued fraction of Stieltjes (Abramowitz and Stegun 1964, 6.1.48) from 2 on, and
/// `J(x) = J(x + 1) + (x + 1/2) ln(1 + 1/x) - 1` below.
///
/// Twin: libm::lgamma, less Stirling's formula.
fn multibounce_interface_binet(x: f32) -> f32 {
    let is_low = x < 2.0;
    let y = select(x, x + 1.0, is_low);
    var tail = y + 1.0115230681268417;
    tail = y + 0.5256064690026954 / tail;
    tail = y + 0.25238095238095237 / tail;
    tail = y + 0.03333333333333333 / tail;
    let high = 0.08333333333333333 / tail;
    if is_low {
        return high + ((x + 0.5) * multibounce_interface_log_above(1.0 / x) - 1.0);
    }
    return high;
}
