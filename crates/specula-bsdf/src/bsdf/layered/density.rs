//! A density in closed form, close to that of the walk's directions, for multiple importance
//! sampling.
//!
//! ```text
//! p(wi) = p_c D_c(wo + wi) / (4 N_c)                               the coat's reflections
//!       + (1 - p_c) (1 - s) (q(wi') |dwi'/dwi| + sqrt(1 - 1/eta^2) q(wt))     the base's
//!       + (1 - p_c) s wi.z / pi                                    light that forgot where from
//! ```
//!
//! `q` is the density of the base's reflections under the coat, as blurred by a rough one: twice
//! refracted slopes add variance, `a'^2 = a^2 + (1 - 1/eta)^2 a_coat^2 / 2` (to the first order of
//! Belcour 2018). `wi'` is `wi` bent by the coat's mean surface. Light beyond the critical angle
//! stays below; it is sent on in its own azimuth, by the map of the ring `1/eta < sin < 1` to the
//! disc, `sin^2 = 1/eta^2 + (1 - 1/eta^2) sin^2 theta_i`, whose Jacobian is the root above. So the
//! whole integrates to 1 where `q` does.

use super::{Base, Layered};
use crate::alpha::Alpha;
use crate::fresnel::dielectric;
use crate::math::{Real, Vec3, vec3, warp};
use crate::ndf::{Ggx, Ndf};

/// The base's normals as blurred by the coat; `None` where they are no lobe.
pub(super) fn blurred<T: Real>(base: &Base<T>, coat: Option<Ggx<T>>, eta: T) -> Option<Ggx<T>> {
    match base {
        Base::Mirror(_) => blurred_metal(None, coat, eta),
        Base::Metal(m) => blurred_metal(Some(m.ndf), coat, eta),
        Base::Diffuse(_) => None,
    }
}

/// The metal's normals as blurred by a rough coat.
fn blurred_metal<T: Real>(metal: Option<Ggx<T>>, coat: Option<Ggx<T>>, eta: T) -> Option<Ggx<T>> {
    let Some(coat) = coat else { return metal };
    let bend = T::ONE - T::ONE / eta;
    let alpha = |metal: T, coat: T| (metal * metal + T::HALF * bend * bend * coat * coat).sqrt();
    let own = metal.map_or((T::ZERO, T::ZERO), |m| (m.alpha().x, m.alpha().y));
    let least = T::of(Alpha::<T>::SPECULAR_BELOW);
    let x = alpha(own.0, coat.alpha().x).at_least(least);
    let y = alpha(own.1, coat.alpha().y).at_least(least);
    Some(Ggx::new(Alpha::clamped(x, y)))
}

/// The density (see the module's text), in 1/sr; 0 where `wi.z <= 0`.
#[inline]
pub(super) fn pdf<T: Real>(lobe: &Layered<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    if wi.z <= T::ZERO || lobe.is_mirror() {
        return T::ZERO;
    }
    let coat = &lobe.coat;
    let reflected = dielectric(wo.z.abs(), coat.eta).reflectance;
    let below = T::ONE - reflected;
    let broad = warp::cosine_hemisphere_pdf(wi);
    let Some(base) = lobe.blurred else {
        let share = match lobe.base {
            Base::Diffuse(_) => T::ONE,
            _ => scattered(lobe),
        };
        return below * share * broad + coat_pdf(lobe, reflected, wo, wi);
    };
    let alpha = base.alpha();
    // Of light that meets the metal twice and more.
    let rough = alpha.x.at_least(alpha.y);
    let twice = (rough * T::HALF).within(T::of(0.02), T::of(0.3));
    let share = T::ONE - (T::ONE - twice) * (T::ONE - scattered(lobe));

    let view = coat.below(wo);
    let view = vec3(-view.x, -view.y, view.z);
    let inverse2 = T::ONE / (coat.eta * coat.eta);
    let (x, y) = (wi.x / coat.eta, wi.y / coat.eta);
    let bent = vec3(x, y, (T::ONE - x * x - y * y).safe_sqrt());
    let through = quarter_d(base, view, bent) * wi.z * inverse2 / bent.z;
    let ring = T::ONE - inverse2;
    let sin2 = T::ONE - wi.z * wi.z;
    let stretch = ((inverse2 + ring * sin2) / sin2.at_least(T::TINY)).sqrt();
    let projected = vec3(wi.x * stretch, wi.y * stretch, ring.safe_sqrt() * wi.z);
    let round = quarter_d(base, view, projected) * ring.safe_sqrt();
    let metal = (through + round) / base.reflection_norm(lobe.sampler, view);
    below * ((T::ONE - share) * metal + share * broad) + coat_pdf(lobe, reflected, wo, wi)
}

/// Share of light that the medium scatters on its way down and up.
#[inline(always)]
fn scattered<T: Real>(lobe: &Layered<T>) -> T {
    let left = (-T::TWO * lobe.medium.thickness).exp();
    T::select(lobe.medium.scatters(), T::ONE - left, T::ZERO)
}

#[inline(always)]
fn coat_pdf<T: Real>(lobe: &Layered<T>, p: T, wo: Vec3<T>, wi: Vec3<T>) -> T {
    lobe.coat.ndf.map_or(T::ZERO, |ggx| {
        p * quarter_d(ggx, wo, wi) / ggx.reflection_norm(lobe.sampler, wo)
    })
}

#[inline(always)]
fn quarter_d<T: Real>(ggx: Ggx<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    let half = wo + wi;
    T::of(0.25) * ggx.d_along(half, half.length_squared())
}
