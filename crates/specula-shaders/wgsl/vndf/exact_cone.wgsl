// The cone of half vectors that reflect a view above the surface: its axis and its area.
//
// With `i` the view (our `wo`, `i.z > 0`), `h = (ax i.x, ay i.y, i.z)` and `m` a unit normal of the
// space of unit roughness, the reflection lies above the surface where
//
//     m^T S m > 0,   S = z h^T + h z^T - i.z diag(ax^2, ay^2, 1)
//
// `S` is an arrowhead matrix with one positive eigenvalue `lambda`, the root of
//
//     f(l) = l - i.z - hx^2/Dx - hy^2/Dy,   Dj = l + i.z aj^2
//
// and the eigenvector `v = (hx/Dx, hy/Dy, 1)`. Because `lambda I - S` has the null vector `v`, the cone
// cuts from the unit sphere what a cylinder along `v` cuts whose section with the plane `z = 0` is the
// ellipse
//
//     Dx x^2 + Dy y^2 < lambda
//
// Source: derived in docs/exact-reflection-sampling.md of Specula.

import package::alpha::{alpha_stretch};

/// The cone of one view above the horizon.
///
/// Twin: specula-bsdf/src/vndf/exact/cone.rs, Cone.
struct ExactCone {
    /// The stretched view, of any length; moved off the normal by a hair, so that the plane of incidence
    /// is defined.
    h: vec3f,
    /// `|h|^2`.
    h_squared: f32,
    /// `i.z aj^2`.
    tilt: vec2f,
    /// The axis, `(hx/Dx, hy/Dy, 1)`, without its last component.
    v: vec2f,
    /// `1 / Dj`.
    inverse_d: vec2f,
    /// Positive eigenvalue of `S`.
    lambda: f32,
    /// `|v|^2`.
    v_squared: f32,
}

/// The cone of `wo`, `wo.z > 0`.
///
/// Twin: specula-bsdf/src/vndf/exact/cone.rs, Cone::new.
fn exact_cone_new(alpha: vec2f, wo: vec3f) -> ExactCone {
    var h = alpha_stretch(alpha, wo);
    h.x = select(1e-9, h.x, h.x * h.x + h.y * h.y > 1e-18);
    let h_squared = dot(h, h);
    let tilt = h.z * alpha * alpha;
    let p = h.xy * h.xy;
    let near = exact_cone_root(p, h.z, tilt, sqrt(h_squared));

    // Newton's step, with the reciprocals carried along to first order.
    let d = near + tilt;
    let e = d.yx * (1.0 / (d.x * d.y));
    let q = p * e;
    let slope = 1.0 + q.x * e.x + q.y * e.y;
    let step = (h.z + q.x + q.y - near) / slope;
    let inverse_d = e - step * e * e;
    let v = h.xy * inverse_d;
    return ExactCone(h, h_squared, tilt, v, inverse_d, near + step, 1.0 + v.x * v.x + v.y * v.y);
}

/// `N = lambda^2 / (|v|^2 sqrt(Dx Dy))`, as numerator and denominator: the integral of
/// `D(wm) (wo . wm)` over the normals that reflect `wo` above the surface.
///
/// Twin: specula-bsdf/src/vndf/exact/cone.rs, Cone::norm.
fn exact_cone_norm(cone: ExactCone) -> vec2f {
    let area = sqrt(cone.inverse_d.x * cone.inverse_d.y);
    return vec2f(cone.lambda * cone.lambda * area, cone.v_squared);
}

/// Near the positive root of `l = z + p.x / (l + tilt.x) + p.y / (l + tilt.y)`.
///
/// The two poles lie close to each other or far from the root: one pole in their place, with their value
/// and slope at the `guess`, leads to a quadratic equation whose root is near. A step of Halley's method
/// follows, multiplied through by the poles, so that each step takes one division.
///
/// Twin: specula-bsdf/src/vndf/exact/cone.rs, root.
fn exact_cone_root(p: vec2f, z: f32, tilt: vec2f, guess: f32) -> f32 {
    let far = guess + tilt;
    let value = p.x * far.y + p.y * far.x;
    let steepness = p.x * far.y * far.y + p.y * far.x * far.x;
    let quotient = value / steepness;
    let d = quotient * far.x * far.y - guess;
    let middle = 0.5 * (z - d);
    let l = middle + sqrt(middle * middle + z * d + quotient * value);

    let near = l + tilt;
    let product = near.x * near.y;
    let f = (l - z) * product - p.x * near.y - p.y * near.x;
    let bent = p * near.yx * near.yx;
    let slope = product * product + bent.x + bent.y;
    let bend = bent.x * near.y + bent.y * near.x;
    return l - f * slope * product / (slope * slope + f * bend);
}
