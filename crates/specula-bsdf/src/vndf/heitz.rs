//! Visible GGX normals by the hemisphere's cross section (Heitz 2018).
//!
//! In the space of unit roughness, the hemisphere seen from `wo` covers a half disk and half an
//! ellipse; a point is sampled there and lifted. The paper's V is our `wo`.
//!
//! Departure from the listing: for views below the horizon it takes the difference of nearly equal
//! values (in f32 up to 70 % of its normals face away at 179.9 degrees). With `q` half the chord
//! at `t1`, `s = (1 + z)/2` free of cancellation and `d = s (q - t2)`:
//!
//! ```text
//! t2' = q - d,   t3^2 = 1 - t1^2 - t2'^2 = d (2 q - d)
//! ```

use super::{Stretched, above, reflect, reflection_density};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};
use crate::ndf::{Ggx, Ndf};

/// A visible normal, unit, with `wm.z >= 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in `[0, 1)^2`; `u[0]` is the squared radius on the disk, `u[1]` the azimuth.
#[inline(always)]
pub fn sample_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let i = Stretched::new(alpha, wo);
    let v = i.direction;
    let sine2 = v.x * v.x + v.y * v.y;
    // Below, the plane of incidence is lost to rounding and to squares that vanish.
    let least = T::of(1e-36);
    let across = sine2 > least;
    let inverse_sine = T::ONE / sine2.at_least(least).sqrt();
    let t1_axis = vec3(
        T::select(across, -v.y * inverse_sine, T::ONE),
        T::select(across, v.x * inverse_sine, T::ZERO),
        T::ZERO,
    );
    let t2_axis = v.cross(t1_axis);

    let (sin_phi, cos_phi) = u[1].sin_cos_turns();
    let r = u[0].sqrt();
    let t1 = r * cos_phi;
    let chord = (T::ONE - t1 * t1).safe_sqrt();
    let d = T::HALF * i.one_plus_z * (chord - r * sin_phi);
    let t2 = chord - d;
    let t3 = (d * (T::TWO * chord - d)).safe_sqrt();

    let m = t1_axis * t1 + t2_axis * t2 + v * t3;
    alpha
        .stretch(vec3(m.x, m.y, m.z.at_least(T::ZERO)))
        .normalize()
}

/// Density of [`sample_wm`], `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
#[inline(always)]
pub fn pdf_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wm: Vec3<T>) -> T {
    Ggx::new(alpha).d_visible(wo, wm)
}

/// The reflection of `wo` off a visible normal; `None` below the horizon.
#[inline(always)]
pub fn sample_reflection<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
    above(reflect(wo, sample_wm(alpha, wo, u)))
}

/// Density of [`sample_reflection`] in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where `wi.z <= 0`.
#[inline(always)]
pub fn reflection_pdf<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    reflection_density(alpha, wo, wi, Ggx::new(alpha).projected_area_quotient(wo))
}
