// Directional albedo of single scattering at a rough dielectric interface, both branches.
//
//     E(wo) = int f(wo, wi) |cos theta_i| dwi           reflection and refraction, importance
//
// As in `albedo`, tables hold `sqrt(1 - E)` as coefficients of splines:
//
// * isotropic: 2 x 10 indices x 20 alphas x 22 cosines, cubic;
// * anisotropic: 2 x 6 indices x 12 x 13 / 2 pairs of alphas x 10 azimuths x 14 cosines, quadratic.
//
// The coordinate of an index is `sqrt(|eta - 1| / (eta + 1))`, of indices in [1.041, 3] and of their
// inverses; beyond, the nearest is taken. The others are those of `coordinates`, where total
// reflection has its edges. Errors: specula-bsdf/src/energy/dielectric_albedo.rs.

import package::energy::albedo::{albedo_row, albedo_table_start};
import package::energy::coordinates::{CoordinatesAlphaPair, coordinates_alpha, coordinates_average_scale, coordinates_azimuth, coordinates_edge, coordinates_interface_azimuth, coordinates_interface_cosine, coordinates_alpha_pair};
import package::energy::energy_table::{energy_table};
import package::energy::pairs::{pairs_pair, pairs_row};
import package::energy::spline::{SplineCubic, SplineQuadratic, spline_cubic, spline_quadratic};

/// Indices of the isotropic tables.
const DIELECTRIC_ALBEDO_ETAS: u32 = 20u;
/// Alphas of the isotropic tables.
const DIELECTRIC_ALBEDO_ALPHAS: u32 = 20u;
/// Cosines of the isotropic tables.
const DIELECTRIC_ALBEDO_COSINES: u32 = 22u;
/// Indices of the anisotropic tables.
const DIELECTRIC_ALBEDO_ANISOTROPIC_ETAS: u32 = 12u;
/// Alphas of the anisotropic tables.
const DIELECTRIC_ALBEDO_ANISOTROPIC_ALPHAS: u32 = 12u;
/// Azimuths of the anisotropic tables.
const DIELECTRIC_ALBEDO_ANISOTROPIC_AZIMUTHS: u32 = 10u;
/// Cosines of the anisotropic tables.
const DIELECTRIC_ALBEDO_ANISOTROPIC_COSINES: u32 = 14u;
/// Pairs of alphas of the anisotropic tables.
const DIELECTRIC_ALBEDO_ANISOTROPIC_PAIRS: u32 = 78u;

/// Where `sqrt(1 - E)` by index, alpha and cosine begins.
const DIELECTRIC_ALBEDO_START: u32 = 81468u;
/// Where `sqrt(1 - E_avg)` over its scale, by index and alpha, begins.
const DIELECTRIC_ALBEDO_AVERAGE_START: u32 = 90268u;
/// Where `sqrt(1 - E)` by index, pair of alphas, azimuth and cosine begins.
const DIELECTRIC_ALBEDO_ANISOTROPIC_START: u32 = 90668u;
/// Where `sqrt(1 - E_avg)` over its scale, by index and pair of alphas, begins.
const DIELECTRIC_ALBEDO_ANISOTROPIC_AVERAGE_START: u32 = 221708u;

/// `sqrt(0.02)`: an index of 1.0408.
const DIELECTRIC_ALBEDO_ROOT_START: f32 = 0.1414213562373;
/// `1 / (sqrt(0.5) - sqrt(0.02))`, the first an index of 3.
const DIELECTRIC_ALBEDO_ROOT_SCALE: f32 = 1.7677669529664;

/// The energy that single scattering loses on one side of an interface.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, DielectricLoss.
struct DielectricAlbedoLoss {
    /// Where the tables of the distribution and masking begin.
    table: u32,
    /// First index of the half of the tables: losses differ too much across 1 to be interpolated.
    start: u32,
    /// 1 where the alphas differ: then only the quadratic coefficients count, else only the cubic.
    stretched: u32,
    /// Where total reflection has its edge.
    edge: f32,
    /// The alphas.
    alphas: CoordinatesAlphaPair,
    /// Coefficients about the index, isotropic.
    eta: SplineCubic,
    /// Coefficients about the alpha, isotropic.
    alpha: SplineCubic,
    /// Coefficients about the index, anisotropic.
    anisotropic_eta: SplineQuadratic,
    /// Coefficients about the smaller alpha, anisotropic.
    low: SplineQuadratic,
    /// Coefficients about the larger alpha, anisotropic.
    high: SplineQuadratic,
    /// `1 - E_avg`, in (0, 1].
    average: f32,
}

/// First row of an index's half of `count` rows.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, half.
fn dielectric_albedo_half_start(eta: f32, count: u32) -> u32 {
    return select(count / 2u, 0u, eta < 1.0);
}

/// The coordinate of an index in its half of the tables.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, eta_coordinate.
fn dielectric_albedo_eta_coordinate(eta: f32) -> f32 {
    let root = sqrt(abs((eta - 1.0) / (eta + 1.0)));
    return (root - DIELECTRIC_ALBEDO_ROOT_START) * DIELECTRIC_ALBEDO_ROOT_SCALE;
}

/// `sqrt(1 - E_avg)` over its scale, isotropic: by the first row of the half, index and alpha.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, DielectricLoss::new.
fn dielectric_albedo_isotropic_average(table: u32, start: u32, eta: SplineCubic, alpha: SplineCubic) -> f32 {
    let first = table + DIELECTRIC_ALBEDO_AVERAGE_START;
    var root = 0.0;
    for (var e = 0u; e < 4u; e++) {
        let row = start + eta.first + e;
        root += eta.weights[e] * albedo_row(first + row * DIELECTRIC_ALBEDO_ALPHAS, alpha);
    }
    return root;
}

/// `sqrt(1 - E_avg)` over its scale, anisotropic: by the first row of the half, index and alphas.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, DielectricLoss::new.
fn dielectric_albedo_anisotropic_average(table: u32, start: u32, eta: SplineQuadratic, low: SplineQuadratic, high: SplineQuadratic) -> f32 {
    let first = table + DIELECTRIC_ALBEDO_ANISOTROPIC_AVERAGE_START;
    var root = 0.0;
    for (var n = 0u; n < 27u; n++) {
        let e = n / 9u;
        let i = (n / 3u) % 3u;
        let j = n % 3u;
        let row = (start + eta.first + e) * DIELECTRIC_ALBEDO_ANISOTROPIC_PAIRS + pairs_pair(low.first + i, high.first + j);
        root += eta.weights[e] * low.weights[i] * high.weights[j] * energy_table(first + row);
    }
    return root;
}

/// The loss seen from the side where the index is 1, with `eta` beyond.
///
/// * `distribution`: `DISTRIBUTION_GGX` or `DISTRIBUTION_BECKMANN`.
/// * `alpha`: alphas in [1e-4, 10].
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, DielectricLoss::new.
fn dielectric_albedo_loss(distribution: u32, masking: u32, alpha: vec2f, eta: f32) -> DielectricAlbedoLoss {
    var loss: DielectricAlbedoLoss;
    loss.table = albedo_table_start(distribution, masking);
    loss.edge = coordinates_edge(clamp(eta, 1.0 / 3.0, 3.0));
    loss.alphas = coordinates_alpha_pair(alpha.x, alpha.y);
    let place = dielectric_albedo_eta_coordinate(eta);
    let low = coordinates_alpha(loss.alphas.low);
    let high = coordinates_alpha(loss.alphas.high);
    var root: f32;
    if alpha.x == alpha.y {
        loss.stretched = 0u;
        loss.start = dielectric_albedo_half_start(eta, DIELECTRIC_ALBEDO_ETAS);
        loss.eta = spline_cubic(place, DIELECTRIC_ALBEDO_ETAS / 2u);
        loss.alpha = spline_cubic(low, DIELECTRIC_ALBEDO_ALPHAS);
        root = dielectric_albedo_isotropic_average(loss.table, loss.start, loss.eta, loss.alpha);
    } else {
        loss.stretched = 1u;
        loss.start = dielectric_albedo_half_start(eta, DIELECTRIC_ALBEDO_ANISOTROPIC_ETAS);
        loss.anisotropic_eta = spline_quadratic(place, DIELECTRIC_ALBEDO_ANISOTROPIC_ETAS / 2u);
        loss.low = spline_quadratic(low, DIELECTRIC_ALBEDO_ANISOTROPIC_ALPHAS);
        loss.high = spline_quadratic(high, DIELECTRIC_ALBEDO_ANISOTROPIC_ALPHAS);
        root = dielectric_albedo_anisotropic_average(loss.table, loss.start, loss.anisotropic_eta, loss.low, loss.high);
    }
    let scaled = root * coordinates_average_scale(alpha.x, alpha.y);
    loss.average = clamp(scaled * scaled, 1e-18, 1.0);
    return loss;
}

/// `sqrt(1 - E)` of an isotropic table at the coordinate of a cosine.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, isotropic.
fn dielectric_albedo_isotropic(loss: DielectricAlbedoLoss, m: f32) -> f32 {
    let cosine = spline_cubic(m, DIELECTRIC_ALBEDO_COSINES);
    let first = loss.table + DIELECTRIC_ALBEDO_START;
    var root = 0.0;
    for (var n = 0u; n < 16u; n++) {
        let e = n / 4u;
        let i = n % 4u;
        let row = (loss.start + loss.eta.first + e) * DIELECTRIC_ALBEDO_ALPHAS + loss.alpha.first + i;
        let weight = loss.eta.weights[e] * loss.alpha.weights[i];
        root += weight * albedo_row(first + row * DIELECTRIC_ALBEDO_COSINES, cosine);
    }
    return root;
}

/// The sum of a row of coefficients that begins at `start`.
///
/// Twin: specula-bsdf/src/energy/rows.rs, Rows::sum.
fn dielectric_albedo_row(start: u32, cosine: SplineQuadratic) -> f32 {
    let place = start + cosine.first;
    return cosine.weights.x * energy_table(place)
        + cosine.weights.y * energy_table(place + 1u)
        + cosine.weights.z * energy_table(place + 2u);
}

/// `sqrt(1 - E)` of an anisotropic table at the coordinates of an azimuth and a cosine.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, anisotropic.
fn dielectric_albedo_anisotropic(loss: DielectricAlbedoLoss, v: f32, m: f32) -> f32 {
    let azimuth = spline_quadratic(v, DIELECTRIC_ALBEDO_ANISOTROPIC_AZIMUTHS);
    let cosine = spline_quadratic(m, DIELECTRIC_ALBEDO_ANISOTROPIC_COSINES);
    let each = DIELECTRIC_ALBEDO_ANISOTROPIC_PAIRS * DIELECTRIC_ALBEDO_ANISOTROPIC_AZIMUTHS;
    let first = loss.table + DIELECTRIC_ALBEDO_ANISOTROPIC_START;
    var root = 0.0;
    // One loop, so that compilers do not write it out 81 times.
    for (var n = 0u; n < 81u; n++) {
        let e = n / 27u;
        let i = (n / 9u) % 3u;
        let j = (n / 3u) % 3u;
        let k = n % 3u;
        let of_pair = pairs_row(loss.low.first + i, loss.high.first + j, azimuth.first + k, DIELECTRIC_ALBEDO_ANISOTROPIC_AZIMUTHS);
        let row = (loss.start + loss.anisotropic_eta.first + e) * each + of_pair;
        let weight = loss.anisotropic_eta.weights[e] * loss.low.weights[i] * loss.high.weights[j] * azimuth.weights[k];
        root += weight * dielectric_albedo_row(first + row * DIELECTRIC_ALBEDO_ANISOTROPIC_COSINES, cosine);
    }
    return root;
}

/// `1 - E(wo)` of `wo` or its mirror image above the horizon.
///
/// * `wo`: unit, local frame.
///
/// Twin: specula-bsdf/src/energy/dielectric_albedo.rs, DielectricLoss::directional.
fn dielectric_albedo_directional_loss(loss: DielectricAlbedoLoss, wo: vec3f) -> f32 {
    let cosine = min(abs(wo.z), 1.0);
    var root: f32;
    if loss.stretched == 1u {
        let azimuth = coordinates_azimuth(loss.alphas, wo.x, wo.y);
        let m = coordinates_interface_cosine(cosine, azimuth.alpha, loss.edge);
        root = dielectric_albedo_anisotropic(loss, coordinates_interface_azimuth(azimuth, loss.edge), m);
    } else {
        let m = coordinates_interface_cosine(cosine, loss.alphas.low, loss.edge);
        root = dielectric_albedo_isotropic(loss, m);
    }
    return min(root * root, 1.0);
}
