// Directional albedo of single scattering off a rough surface whose facets reflect everything.
//
//     E(wo) = int f(wo, wi) cos theta_i dwi,   F = 1        directional albedo
//     E_avg = 1/pi int E(wo) cos theta_o dwo                its cosine average
//
// What is missing to 1 is light that meets another facet. Tables hold `sqrt(1 - E)`, which is smooth
// where `1 - E` vanishes (narrow lobes, the horizon), and cannot turn negative, as coefficients of
// cubic splines (`spline`) along the coordinates of `coordinates`:
//
// * isotropic: 48 alphas x 40 cosines;
// * anisotropic: 24 x 25 / 2 pairs of alphas x 12 azimuths x 22 cosines.
//
// Errors of the tables: specula-bsdf/src/energy/albedo.rs. Departure from the Rust source: coefficients
// are decoded beforehand, where Rust decodes their sum.

import package::energy::coordinates::{CoordinatesAlphaPair, coordinates_alpha, coordinates_average_scale, coordinates_azimuth, coordinates_cosine, coordinates_alpha_pair};
import package::energy::energy_table::{energy_table};
import package::energy::pairs::{pairs_pair, pairs_row};
import package::energy::spline::{SplineCubic, spline_cubic};
import package::ndf::masking::{MASKING_SEPARABLE};
import package::ndf::distribution::{DISTRIBUTION_BECKMANN};

/// Alphas of the isotropic tables.
const ALBEDO_ISOTROPIC_ALPHAS: u32 = 48u;
/// Cosines of the isotropic tables.
const ALBEDO_ISOTROPIC_COSINES: u32 = 40u;
/// Alphas of the anisotropic tables.
const ALBEDO_ANISOTROPIC_ALPHAS: u32 = 24u;
/// Azimuths of the anisotropic tables.
const ALBEDO_ANISOTROPIC_AZIMUTHS: u32 = 12u;
/// Cosines of the anisotropic tables.
const ALBEDO_ANISOTROPIC_COSINES: u32 = 22u;

/// Values of one distribution and masking.
const ALBEDO_TABLES_STRIDE: u32 = 222644u;
/// Where `sqrt(1 - E)` by alpha and cosine begins.
const ALBEDO_ISOTROPIC_START: u32 = 0u;
/// Where `sqrt(1 - E_avg)` over its scale, by alpha, begins.
const ALBEDO_ISOTROPIC_AVERAGE_START: u32 = 1920u;
/// Where `sqrt(1 - E)` by pair of alphas, azimuth and cosine begins.
const ALBEDO_ANISOTROPIC_START: u32 = 1968u;
/// Where `sqrt(1 - E_avg)` over its scale, by pair of alphas, begins.
const ALBEDO_ANISOTROPIC_AVERAGE_START: u32 = 81168u;

/// The energy that single scattering off one surface loses: the tables at its alphas.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, Loss.
struct AlbedoLoss {
    /// Where the tables of the distribution and masking begin.
    table: u32,
    /// 1 where the alphas differ.
    stretched: u32,
    /// The alphas.
    alphas: CoordinatesAlphaPair,
    /// Coefficients about the smaller alpha.
    low: SplineCubic,
    /// Coefficients about the larger alpha.
    high: SplineCubic,
    /// `1 - E_avg`, in (0, 1].
    average: f32,
}

/// Where the tables of a distribution and masking begin.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, table_index.
fn albedo_table_start(distribution: u32, masking: u32) -> u32 {
    let second = select(0u, 2u, distribution == DISTRIBUTION_BECKMANN);
    return (second + select(0u, 1u, masking == MASKING_SEPARABLE)) * ALBEDO_TABLES_STRIDE;
}

/// The loss of a distribution of normals.
///
/// * `distribution`: `DISTRIBUTION_GGX` or `DISTRIBUTION_BECKMANN`.
/// * `alpha`: alphas in [1e-4, 10].
///
/// Twin: specula-bsdf/src/energy/albedo.rs, Loss::new.
fn albedo_loss(distribution: u32, masking: u32, alpha: vec2f) -> AlbedoLoss {
    let table = albedo_table_start(distribution, masking);
    let stretched = alpha.x != alpha.y;
    let alphas = coordinates_alpha_pair(alpha.x, alpha.y);
    let count = select(ALBEDO_ISOTROPIC_ALPHAS, ALBEDO_ANISOTROPIC_ALPHAS, stretched);
    let low = spline_cubic(coordinates_alpha(alphas.low), count);
    let high = spline_cubic(coordinates_alpha(alphas.high), count);
    var root = 0.0;
    for (var i = 0u; i < 4u; i++) {
        if stretched {
            var sum = 0.0;
            for (var j = 0u; j < 4u; j++) {
                let pair = pairs_pair(low.first + i, high.first + j);
                sum += high.weights[j] * energy_table(table + ALBEDO_ANISOTROPIC_AVERAGE_START + pair);
            }
            root += low.weights[i] * sum;
        } else {
            let place = table + ALBEDO_ISOTROPIC_AVERAGE_START + low.first + i;
            root += low.weights[i] * energy_table(place);
        }
    }
    let scaled = root * coordinates_average_scale(alpha.x, alpha.y);
    let average = clamp(scaled * scaled, 1e-18, 1.0);
    return AlbedoLoss(table, select(0u, 1u, stretched), alphas, low, high, average);
}

/// The sum of a row of coefficients that begins at `start`.
///
/// Twin: specula-bsdf/src/energy/rows.rs, Rows::sum.
fn albedo_row(start: u32, cosine: SplineCubic) -> f32 {
    let place = start + cosine.first;
    return cosine.weights.x * energy_table(place)
        + cosine.weights.y * energy_table(place + 1u)
        + cosine.weights.z * energy_table(place + 2u)
        + cosine.weights.w * energy_table(place + 3u);
}

/// `sqrt(1 - E)` of an isotropic table at the coordinate of a cosine.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, isotropic.
fn albedo_isotropic(table: u32, alpha: SplineCubic, m: f32) -> f32 {
    let cosine = spline_cubic(m, ALBEDO_ISOTROPIC_COSINES);
    let start = table + ALBEDO_ISOTROPIC_START;
    var root = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let row = alpha.first + i;
        root += alpha.weights[i] * albedo_row(start + row * ALBEDO_ISOTROPIC_COSINES, cosine);
    }
    return root;
}

/// `sqrt(1 - E)` of an anisotropic table at the coordinates of an azimuth and a cosine.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, anisotropic.
fn albedo_anisotropic(table: u32, low: SplineCubic, high: SplineCubic, v: f32, m: f32) -> f32 {
    let azimuth = spline_cubic(v, ALBEDO_ANISOTROPIC_AZIMUTHS);
    let cosine = spline_cubic(m, ALBEDO_ANISOTROPIC_COSINES);
    let start = table + ALBEDO_ANISOTROPIC_START;
    var root = 0.0;
    // One loop, so that compilers do not write it out 64 times.
    for (var n = 0u; n < 64u; n++) {
        let i = n / 16u;
        let j = (n / 4u) % 4u;
        let k = n % 4u;
        let row = pairs_row(low.first + i, high.first + j, azimuth.first + k, ALBEDO_ANISOTROPIC_AZIMUTHS);
        let weight = low.weights[i] * high.weights[j] * azimuth.weights[k];
        root += weight * albedo_row(start + row * ALBEDO_ANISOTROPIC_COSINES, cosine);
    }
    return root;
}

/// `1 - E(wo)`, in [0, 1], of `wo` or its mirror image above the horizon.
///
/// * `wo`: unit, local frame.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, Loss::directional.
fn albedo_directional_loss(loss: AlbedoLoss, wo: vec3f) -> f32 {
    let cosine = min(abs(wo.z), 1.0);
    var root: f32;
    if loss.stretched == 1u {
        let azimuth = coordinates_azimuth(loss.alphas, wo.x, wo.y);
        let m = coordinates_cosine(cosine, azimuth.alpha);
        root = albedo_anisotropic(loss.table, loss.low, loss.high, azimuth.v, m);
    } else {
        let m = coordinates_cosine(cosine, loss.alphas.low);
        root = albedo_isotropic(loss.table, loss.low, m);
    }
    return min(root * root, 1.0);
}
