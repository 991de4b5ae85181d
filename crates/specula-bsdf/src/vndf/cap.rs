//! Visible GGX normals by spherical caps (Dupuy and Benyoub 2023).
//!
//! In the space of unit roughness the visible normals are half vectors between the view `i` and
//! directions uniform on the cap `z > -i.z`. The paper's i is our `wo`.
//!
//! Departures from the listing: its line 8 must warp back the sampled normal (as printed it
//! returns a constant), and it computes `sin theta` as `sqrt(1 - z^2)`, which in f32 is wrong by
//! up to 0.5 for views below the horizon. With `t = 1 + i.z` and `v = u t`:
//!
//! ```text
//! z = 1 - v,   sin theta = sqrt(v (2 - v)),   h.z = z + i.z = t - v
//! ```
//!
//! which needs no clamp and cancels nowhere.

use super::{Stretched, above, reflect_unnormalised, reflection_density};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};
use crate::ndf::{Ggx, Ndf};

/// A visible normal, unit, with `wm.z >= 0` and `wo . wm >= 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in `[0, 1)^2`; `u[0]` is the height on the cap, `u[1]` the azimuth.
#[inline(always)]
pub fn sample_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    half_vector(alpha, wo, u).normalize()
}

/// Density of [`sample_wm`], `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
#[inline(always)]
pub fn pdf_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wm: Vec3<T>) -> T {
    Ggx::new(alpha).d_visible(wo, wm)
}

/// The reflection of `wo` off a visible normal, perhaps below the horizon.
#[inline(always)]
pub fn sample_direction<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    reflect_unnormalised(wo, half_vector(alpha, wo, u))
}

/// The reflection of `wo` off a visible normal; `None` below the horizon.
#[inline(always)]
pub fn sample_reflection<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
    above(sample_direction(alpha, wo, u))
}

/// Density of [`sample_reflection`] in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where `wi.z <= 0`.
///
/// Source: Tokuyoshi and Eto 2024, eq. 8 times the Jacobian; appendix C for `wo.z < 0`.
#[inline(always)]
pub fn reflection_pdf<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    reflection_density(alpha, wo, wi, Ggx::new(alpha).projected_area_quotient(wo))
}

/// A visible normal of any length.
#[inline(always)]
fn half_vector<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let i = Stretched::new(alpha, wo);
    let v = u[0] * i.one_plus_z;
    half_vector_on_cap(alpha, &i, v, u[1])
}

/// The half vector towards the point of the cap `v` below its apex at the azimuth `turn`, back in
/// the surface's space, of any length.
#[inline(always)]
pub(super) fn half_vector_on_cap<T: Real>(
    alpha: Alpha<T>,
    i: &Stretched<T>,
    v: T,
    turn: T,
) -> Vec3<T> {
    let (sin_phi, cos_phi) = turn.sin_cos_turns();
    let sin_theta = (v * (T::TWO - v)).sqrt();
    alpha.stretch(vec3(
        sin_theta.mad(cos_phi, i.direction.x),
        sin_theta.mad(sin_phi, i.direction.y),
        i.one_plus_z - v,
    ))
}
