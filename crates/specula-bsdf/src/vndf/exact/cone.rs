//! The cone of half vectors that reflect a view above the surface: its axis and its area.
//!
//! With `i` the view (our `wo`, `i.z > 0`), `h = (ax i.x, ay i.y, i.z)` and `m` a unit normal of
//! the space of unit roughness, the reflection lies above the surface where
//!
//! ```text
//! m^T S m > 0,   S = z h^T + h z^T - i.z diag(ax^2, ay^2, 1)
//! ```
//!
//! `S` is an arrowhead matrix with one positive eigenvalue `lambda`, the root of
//!
//! ```text
//! f(l) = l - i.z - hx^2/Dx - hy^2/Dy,   Dj = l + i.z aj^2
//! ```
//!
//! and the eigenvector `v = (hx/Dx, hy/Dy, 1)`. Because `lambda I - S` has the null vector `v`, the
//! cone cuts from the unit sphere what a cylinder along `v` cuts whose section with the plane
//! `z = 0` is the ellipse
//!
//! ```text
//! Dx x^2 + Dy y^2 < lambda
//! ```
//!
//! Source: our own derivation, `docs/exact-reflection-sampling.md`.

use crate::alpha::Alpha;
use crate::math::{Real, Vec3};

/// The cone of one view above the horizon.
#[derive(Clone, Copy, Debug)]
pub(in crate::vndf) struct Cone<T> {
    /// The stretched view, of any length; never along the normal, so that the plane of incidence is
    /// defined.
    pub(super) h: Vec3<T>,
    /// `|h|^2`.
    pub(super) h2: T,
    /// `i.z aj^2`.
    pub(super) tilt: [T; 2],
    /// Positive eigenvalue of `S`.
    pub(super) lambda: T,
    /// `1 / Dj`.
    pub(super) inverse_d: [T; 2],
    /// The axis, `(hx/Dx, hy/Dy, 1)`.
    pub(super) v: [T; 2],
    /// `|v|^2`.
    pub(super) v2: T,
}

impl<T: Real> Cone<T> {
    /// The cone of `wo`, `wo.z > 0`.
    #[inline(always)]
    pub(in crate::vndf) fn new(alpha: Alpha<T>, wo: Vec3<T>) -> Self {
        let mut h = alpha.stretch(wo);
        let tilted = h.x * h.x + h.y * h.y > T::of(1e-18);
        h.x = T::select(tilted, h.x, T::of(1e-9));
        let h2 = h.length_squared();
        let tilt = [h.z * alpha.x * alpha.x, h.z * alpha.y * alpha.y];
        let p = [h.x * h.x, h.y * h.y];
        let near = root(p, h.z, tilt, h2.sqrt());

        // Newton's step, with the reciprocals carried along to first order.
        let [x, y] = [near + tilt[0], near + tilt[1]];
        let inverse = T::ONE / (x * y);
        let [x, y] = [y * inverse, x * inverse];
        let [px, py] = [p[0] * x, p[1] * y];
        let slope = T::ONE + px * x + py * y;
        let step = (h.z + px + py - near) / slope;
        let inverse_d = [x - step * x * x, y - step * y * y];
        let v = [h.x * inverse_d[0], h.y * inverse_d[1]];
        Self {
            h,
            h2,
            tilt,
            lambda: near + step,
            inverse_d,
            v,
            v2: T::ONE + v[0] * v[0] + v[1] * v[1],
        }
    }

    /// `N = lambda^2 / (|v|^2 sqrt(Dx Dy))`, as numerator and denominator: the integral of
    /// `D(wm) (wo . wm)` over the normals that reflect `wo` above the surface.
    #[inline(always)]
    pub(in crate::vndf) fn norm(&self) -> (T, T) {
        let area = (self.inverse_d[0] * self.inverse_d[1]).sqrt();
        (self.lambda * self.lambda * area, self.v2)
    }
}

/// Near the positive root of `l = z + p[0] / (l + tilt[0]) + p[1] / (l + tilt[1])`.
///
/// The two poles lie close to each other or far from the root: one pole in their place, with their
/// value and slope at the `guess`, leads to a quadratic equation whose root is near. A step of
/// Halley's method follows, multiplied through by the poles, so that each step takes one division.
/// With Newton's step in [`Cone::new`] the relative error of `N` is at most 1e-12 for alphas in
/// `[1e-3, 2]` and 1e-7 up to 8 (test `the_exact_norm_has_its_root`).
#[inline(always)]
fn root<T: Real>(p: [T; 2], z: T, tilt: [T; 2], guess: T) -> T {
    let [x, y] = [guess + tilt[0], guess + tilt[1]];
    let value = p[0] * y + p[1] * x;
    let slope = p[0] * y * y + p[1] * x * x;
    let quotient = value / slope;
    let d = quotient * x * y - guess;
    let half = T::HALF * (z - d);
    let l = half + (half * half + z * d + quotient * value).sqrt();

    let [x, y] = [l + tilt[0], l + tilt[1]];
    let product = x * y;
    let f = (l - z) * product - p[0] * y - p[1] * x;
    let [px, py] = [p[0] * y * y, p[1] * x * x];
    let slope = product * product + px + py;
    let bend = px * y + py * x;
    l - f * slope * product / (slope * slope + f * bend)
}
