// Neighbouring coefficients of a uniform B-spline, and their weights.
//
// Weights are positive and sum to 1, so that rounded coefficients leave no larger error than one of
// them.

/// Four coefficients: error of the fourth order, two continuous derivatives.
///
/// Twin: specula-bsdf/src/energy/spline.rs, Cubic.
struct SplineCubic {
    /// Index of the first coefficient.
    first: u32,
    /// Weights of the coefficients from the first on.
    weights: vec4f,
}

/// Three coefficients: error of the third order, one continuous derivative.
///
/// Twin: specula-bsdf/src/energy/spline.rs, Quadratic.
struct SplineQuadratic {
    /// Index of the first coefficient.
    first: u32,
    /// Weights of the coefficients from the first on.
    weights: vec3f,
}

/// The interval among `cells` that holds `x`, clamped to `[0, 1]`, and the place in it.
///
/// Returns: index of the interval as a float; place in `[0, 1]`.
///
/// Twin: specula-bsdf/src/energy/spline.rs, cell.
fn spline_cell(x: f32, cells: u32) -> vec2f {
    let end = f32(cells);
    let place = clamp(x * end, 0.0, end);
    let first = min(floor(place), end - 1.0);
    return vec2f(first, place - first);
}

/// The coefficients about `x`, clamped to `[0, 1]`, among `count >= 4` coefficients.
///
/// Twin: specula-bsdf/src/energy/spline.rs, Spline::cubic.
fn spline_cubic(x: f32, count: u32) -> SplineCubic {
    let cell = spline_cell(x, count - 3u);
    let t = cell.y;
    let u = 1.0 - t;
    let t_squared = t * t;
    let u_squared = u * u;
    let sixth = 1.0 / 6.0;
    let two_thirds = 2.0 / 3.0;
    let weights = vec4f(
        u_squared * u * sixth,
        two_thirds - t_squared * (1.0 - 0.5 * t),
        two_thirds - u_squared * (1.0 - 0.5 * u),
        t_squared * t * sixth,
    );
    return SplineCubic(u32(cell.x), weights);
}

/// The coefficients about `x`, clamped to `[0, 1]`, among `count >= 3` coefficients.
///
/// Twin: specula-bsdf/src/energy/spline.rs, Spline::quadratic.
fn spline_quadratic(x: f32, count: u32) -> SplineQuadratic {
    let cell = spline_cell(x, count - 2u);
    let t = cell.y;
    let u = 1.0 - t;
    return SplineQuadratic(u32(cell.x), vec3f(0.5 * u * u, 0.5 + t * u, 0.5 * t * t));
}
