// Where the tables of lost energy have their knots: coordinates in [0, 1] along which the square root
// of a loss is smooth.
//
//     alpha      t(alpha), affine in sqrt(alpha / (alpha + 2)), alpha in [1e-4, 10]
//     azimuth    v = ln(a / l) / ln(h / l),   a^2 = (l^2 x^2 + h^2 y^2) / (x^2 + y^2)
//     cosine     m = 1 - sqrt(1 - sqrt(mu (1 + a) / (mu + a)))
//
// `a` is the alpha along the view, between the alphas `l < h` along x and y. Off a stretched surface
// the loss changes where `tan phi ~ l / h`: the logarithm has room there at every ratio. For narrow
// lobes everything happens at `mu ~ a`, for which `m` has room at every alpha, and the inner root
// makes room for Beckmann's steep loss about normal incidence.
//
// Interfaces seen from the denser side have edges besides, along which light begins to pass: where the
// sine of the view is `eta`, and for a narrow alpha the view's part along it. With the bend
//
//     w = y (1 - e) / (y (1 - 2e) + e),   x = 2w - 1,   bend(y, e) = (1 + x sqrt(3 / (2 x^2 + 1))) / 2
//
// which puts `y = e` in the middle and makes room there, `e = eta^2` (1/2 from the thinner side),
//
//     azimuth    (v + 1 - bend(x^2 / (x^2 + y^2), e)) / 2
//     cosine     (7 m + 3 bend(mu^2, 1 - e)) / 10
//
// so that the edges lie at the same place of the tables for every index.

/// `sqrt(1e-4 / 2.0001)`.
const COORDINATES_ROOT_START: f32 = 0.007070891041799;
/// `1 / (sqrt(10 / 12) - sqrt(1e-4 / 2.0001))`.
const COORDINATES_ROOT_SCALE: f32 = 1.1039964207339;
/// A floor of squared lengths.
const COORDINATES_TINY: f32 = 1.1754944e-38;
/// A floor of logarithms.
const COORDINATES_EPSILON: f32 = 1.1920929e-7;

/// Two alphas, in ascending order, and which axis is the wider.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, AlphaPair.
struct CoordinatesAlphaPair {
    /// The smaller, `l`.
    low: f32,
    /// The larger, `h`.
    high: f32,
    /// `(h / l)^2 - 1`.
    excess: f32,
    /// `1 / ln((h / l)^2)`.
    per_logarithm: f32,
    /// Whether x is the wider axis: 1 or 0.
    swapped: u32,
}

/// A view as the tables see it.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, Azimuth.
struct CoordinatesAzimuth {
    /// Alpha along the view.
    alpha: f32,
    /// Coordinate of the azimuth.
    v: f32,
    /// Share of the squared sine along the narrow axis.
    narrow: f32,
}

/// The coordinate of an alpha.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, alpha_coordinate.
fn coordinates_alpha(alpha: f32) -> f32 {
    let root = sqrt(alpha / (alpha + 2.0));
    return (root - COORDINATES_ROOT_START) * COORDINATES_ROOT_SCALE;
}

/// The coordinate of a cosine at an alpha along the view.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, cosine_coordinate.
fn coordinates_cosine(cosine: f32, alpha: f32) -> f32 {
    let whole = cosine + alpha;
    let share = cosine * (1.0 + alpha) / whole;
    // `1 - sqrt(share)` without cancellation: straight views lie at the end, whatever a GPU's quotients are.
    let rest = alpha * max(1.0 - cosine, 0.0) / (whole * (1.0 + sqrt(share)));
    return 1.0 - sqrt(rest);
}

/// A map of `[0, 1]` to itself that is steepest at `edge` and takes it to the middle.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, bend.
fn coordinates_bend(y: f32, edge: f32) -> f32 {
    let w = y * (1.0 - edge) / (y * (1.0 - 2.0 * edge) + edge);
    let x = 2.0 * w - 1.0;
    return 0.5 + 0.5 * x * sqrt(1.5 / (x * x + 0.5));
}

/// The coordinate of a cosine for an interface.
///
/// * `edge`: see `coordinates_edge`.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, interface_cosine_coordinate.
fn coordinates_interface_cosine(cosine: f32, alpha: f32, edge: f32) -> f32 {
    let bent = coordinates_bend(cosine * cosine, 1.0 - edge);
    return 0.7 * coordinates_cosine(cosine, alpha) + 0.3 * bent;
}

/// The alphas along x and y, in any order.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, AlphaPair::new.
fn coordinates_alpha_pair(x: f32, y: f32) -> CoordinatesAlphaPair {
    let low = min(x, y);
    let high = max(x, y);
    let excess = (high - low) * (high + low) / (low * low);
    // Isotropic alphas have no azimuth; the floor avoids 0 / 0.
    let per_logarithm = 1.0 / max(log(1.0 + excess), COORDINATES_EPSILON);
    return CoordinatesAlphaPair(low, high, excess, per_logarithm, select(0u, 1u, x > y));
}

/// Where a view with the tangential part `(x, y)` lies.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, AlphaPair::azimuth.
fn coordinates_azimuth(alphas: CoordinatesAlphaPair, x: f32, y: f32) -> CoordinatesAzimuth {
    let along_x = x * x;
    let along_y = y * y;
    let length_squared = along_x + along_y;
    let along = select(along_x, along_y, alphas.swapped == 1u);
    // Straight from above, every azimuth has the same value.
    let share = along / max(length_squared, COORDINATES_TINY);
    let narrow = select(0.5, share, length_squared > COORDINATES_TINY);
    let square = 1.0 + alphas.excess * (1.0 - narrow);
    return CoordinatesAzimuth(alphas.low * sqrt(square), log(square) * alphas.per_logarithm, narrow);
}

/// Coordinate of the azimuth for an interface.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, Azimuth::interface.
fn coordinates_interface_azimuth(azimuth: CoordinatesAzimuth, edge: f32) -> f32 {
    return 0.5 * (azimuth.v + (1.0 - coordinates_bend(azimuth.narrow, edge)));
}

/// `e` of an index.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, edge.
fn coordinates_edge(eta: f32) -> f32 {
    return select(0.5, eta * eta, eta < 1.0);
}

/// What the tables of averages are scaled with: smooth, and the quotient varies slowly.
///
/// Twin: specula-bsdf/src/energy/coordinates.rs, average_scale.
fn coordinates_average_scale(x: f32, y: f32) -> f32 {
    let alpha = sqrt((x * x + y * y) * 0.5);
    return alpha / (1.0 + alpha);
}
