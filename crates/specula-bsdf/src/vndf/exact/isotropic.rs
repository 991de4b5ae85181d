//! Isotropic alpha: a map from the disk in closed form.
//!
//! Planes across the plane of incidence cut the cone's projection along the view in chords whose
//! lengths are a disk's, so that a uniform point `(X, Y)` of the disk needs a scale across and
//! a scale and a shift along them. With `p = a^2`, `q = i.z (1 - a^2)`:
//!
//! ```text
//! Delta = sqrt(q^2 + 4 p),  lambda = (q + Delta)/2,  kappa = p/lambda,  B = lambda + i.z a^2
//! y = sqrt(lambda/B) Y
//! K = (1/L) (lambda sqrt(lambda B)/Delta X + r kappa/(Delta B) R)
//! R = sqrt((1 - Y^2) kappa B + Y^2 i.z a^2 Delta)
//! m = y T1 + K T2 + sqrt(1 - y^2 - K^2) h/L
//! ```
//!
//! with `r = |(hx, hy)|`, `L = |h|`, `T1` across the plane of incidence and `T2 = h/L x T1` (towards
//! the surface's normal). Nothing in it cancels.

use super::radius;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};

/// `(Delta, lambda, kappa)` for the alpha `a` and a view at height `z > 0`.
#[inline(always)]
fn roots<T: Real>(a: T, z: T) -> (T, T, T) {
    let p = a * a;
    let q = z * (T::ONE - p);
    let delta = (q * q + T::of(4.0) * p).sqrt();
    let big = T::HALF * (q.abs() + delta);
    let small = p / big;
    let narrow = q >= T::ZERO;
    (
        delta,
        T::select(narrow, big, small),
        T::select(narrow, small, big),
    )
}

/// `N = lambda^2 / Delta` as numerator and denominator.
#[inline(always)]
pub(super) fn norm<T: Real>(a: T, z: T) -> (T, T) {
    let (delta, lambda, _) = roots(a, z);
    (lambda * lambda, delta)
}

/// A half vector back in the surface's space, of any length.
///
/// * `wo`: `wo.z > 0`; `alpha.x` is the alpha.
#[inline(always)]
pub(super) fn half_vector<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let a = alpha.x;
    let z = wo.z;
    let (delta, lambda, kappa) = roots(a, z);
    let tilt = z * a * a;
    let b = lambda + tilt;
    let scale = T::ONE / (delta * b);
    let root = (lambda * b).sqrt();

    // The plane of incidence, defined at the normal too.
    let sine2 = wo.x * wo.x + wo.y * wo.y;
    let across = sine2 > T::of(1e-24);
    let sine = sine2.at_least(T::of(1e-24)).sqrt();
    let (x, y) = (
        T::select(across, wo.x, sine),
        T::select(across, wo.y, T::ZERO),
    );
    let r = a * sine;
    let inverse = T::ONE / (sine * (r * r + z * z).sqrt());
    let (to_sine, to_length) = (inverse * (r * r + z * z).sqrt(), inverse * sine);

    let (sin_phi, cos_phi) = u[1].sin_cos_turns();
    let disk = radius(u[0]);
    let (disk_x, disk_y) = (disk * cos_phi, disk * sin_phi);
    let y2 = disk_y * disk_y;
    let middle = ((T::ONE - y2) * kappa * b + y2 * tilt * delta).safe_sqrt();
    let ty = root * scale * delta * disk_y;
    let tk = to_length * scale * (lambda * root * b * disk_x + r * kappa * middle);
    let height = (T::ONE - ty * ty - tk * tk).safe_sqrt();

    let radial = to_length * (height * r - z * tk);
    let up = to_length * (height * z + r * tk);
    let (x, y) = (x * to_sine, y * to_sine);
    vec3(a * (radial * x - ty * y), a * (radial * y + ty * x), up)
}
