//! Anisotropic alphas: a walk along the chords of the cone's projection.
//!
//! Seen along its axis `v`, the cone's section is an ellipse, uniform under the cosine to the axis;
//! the cosine to the view is wanted. Chords across `k = h x v` are chords in both projections. The
//! one at `Y` (across) of the unit disk has the ends
//!
//! ```text
//! K(Y, +-) = Y s1 +- c s2 + rho(+-),   c = sqrt(1 - Y^2)
//! ```
//!
//! in the projection along the view, where `rho` lifts the ends to the sphere. `rho` makes the chord
//! at `Y` longer by as much as that at `-Y` is shorter, so the disk's density of `Y` is right for
//! the pair. A point `(X, Y)` of the disk therefore walks the length `(c + X) s2` from one end of
//! its chord; if the chord ends before, the point lies as far from the end of the opposite chord as
//! it had left to go. Both chords are covered uniformly: two values, no rejection, no root.
//!
//! Source: our own derivation, `docs/exact-reflection-sampling.md`.

use super::cone::Cone;
use super::radius;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};

/// A half vector back in the surface's space, of any length.
#[inline(always)]
pub(in crate::vndf) fn half_vector<T: Real>(alpha: Alpha<T>, cone: &Cone<T>, u: [T; 2]) -> Vec3<T> {
    let Cone {
        h,
        h2,
        tilt,
        lambda,
        inverse_d,
        v,
        v2,
    } = *cone;

    // k = h x v and t = k x h, free of cancellation; |t| = |k| |h| and t . v = |k|^2.
    let rise = h.x * v[0] + h.y * v[1];
    let k = vec3(
        v[1] * (rise + tilt[1]),
        -v[0] * (rise + tilt[0]),
        v[0] * v[1] * (tilt[0] - tilt[1]),
    );
    let t = k.cross(h);
    let k2 = k.length_squared();

    // Conjugate half axes of the ellipse: across and along the chords.
    let [gx, gy] = [k.x * inverse_d[0], k.y * inverse_d[1]];
    let g = k.x * gx + k.y * gy;
    let axis = (lambda / g).sqrt();
    let thin = axis * (inverse_d[0] * inverse_d[1]).sqrt();
    let across = [axis * gx, axis * gy];
    let along = [k.y * thin, -k.x * thin];

    let (sin_phi, cos_phi) = u[1].sin_cos_turns();
    let disk = radius(u[0]);
    // The sense of rotation that the map of isotropic alphas has.
    let (x, y) = (disk * cos_phi, -disk * sin_phi);
    let c = (T::ONE - y * y).safe_sqrt();

    // Ends of the chord along t, in units of |k| |h|.
    let lever = k2 / v2;
    let curve = v2 / lambda;
    let slide = |w: [T; 2]| {
        let b = v[0] * w[0] + v[1] * w[1];
        t.x * w[0] + t.y * w[1] - b * lever
    };
    let lift = |w: [T; 2]| {
        let b = v[0] * w[0] + v[1] * w[1];
        let curved = tilt[0] * w[0] * w[0] + tilt[1] * w[1] * w[1];
        (b * b + curve * curved).sqrt() * lever
    };
    let (s1, s2) = (slide(across), slide(along));
    let centre = [y * across[0], y * across[1]];
    let reach = [c * along[0], c * along[1]];
    let far = lift([centre[0] + reach[0], centre[1] + reach[1]]);
    let near = lift([centre[0] - reach[0], centre[1] - reach[1]]);

    // The opposite chord ends at the mirror image of this one's start, lifted as that is.
    let shift = y * s1;
    let walked = x * s2 + near;
    let beyond = walked - c * s2 > far;
    let sign = T::select(beyond, -T::ONE, T::ONE);
    let on_t = sign * shift + walked;
    let on_k = sign * y * axis * g;

    // The lengths of k and t h out of the coordinates, and the rest along h.
    let inverse = T::ONE / (k2 * h2);
    let [on_k, on_t] = [on_k * h2 * inverse, on_t * inverse];
    let height = (T::ONE - on_k * on_k * k2 - on_t * on_t * k2 * h2).safe_sqrt();
    let on_h = height * h2.sqrt() * (k2 * inverse);
    alpha.stretch(k * on_k + t * on_t + h * on_h)
}
