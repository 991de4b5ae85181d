//! Attenuation: how much light takes each way through the fibre.
//!
//! With `F` the reflectance of the fibre's surface where the view hits it and `T` the transmittance of one passage:
//!
//! ```text
//! A0 = F,   A1 = (1 - F)^2 T,   A2 = A1 F T,   A3 = A2 F T / (1 - F T)
//! T = exp(-sigma_a 2 cos(gamma_t) / cos(theta_t)),   sin(theta_t) = sin(theta_o) / eta
//! sin(gamma_t) = h / eta',   eta' = sqrt(eta^2 - sin^2(theta_o)) / cos(theta_o)
//! ```
//!
//! A3 is all that is left: without absorption the four sum to 1.
//!
//! Source: Chiang et al. 2016, section 3.2; the modified index by Marschner et al. 2003, appendix B. `F` is exact for
//! the angle in space, as in pbrt-v4.

use super::longitudinal::Inclination;
use super::{LOBES, RESIDUE};
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb};

/// What a view has of a cross section of the fibre.
pub(super) struct Section<T> {
    /// Angle between the normal and the view, within the cross section.
    pub(super) gamma_o: T,
    /// Angle of the refracted view.
    pub(super) gamma_t: T,
    /// Attenuation of each lobe.
    pub(super) attenuation: [Rgb<T>; LOBES],
    /// Probability of each lobe: its share of the mean attenuation of the three channels.
    pub(super) probability: [T; LOBES],
}

impl<T: Real> Section<T> {
    /// * `[h, cos_gamma_o]`: sine and cosine of `gamma_o`; the sine is the offset of the view across the fibre, over
    ///   its radius, in `[-1, 1]`.
    pub(super) fn new(
        [h, cos_gamma_o]: [T; 2],
        o: Inclination<T>,
        eta: T,
        sigma_a: Rgb<T>,
    ) -> Self {
        let index = ((eta - o.sin) * (eta + o.sin))
            .safe_sqrt()
            .at_least(T::TINY);
        let sin_gamma_t = (h * o.cos / index).within(-T::ONE, T::ONE);
        let cos_gamma_t = ((T::ONE - sin_gamma_t) * (T::ONE + sin_gamma_t)).safe_sqrt();
        // cos(theta_t) = index / eta.
        let length = T::TWO * cos_gamma_t * eta / index;
        let surface = dielectric(o.cos * cos_gamma_o, eta);
        let (f, passes) = (surface.reflectance, surface.transmittance);
        let once = sigma_a.map(|sigma| (-sigma * length).exp());
        let taken = sigma_a.map(|sigma| -(-sigma * length).exp_m1());
        let direct = once * passes.squared();
        let after_one = direct * once * f;
        // 1 - F T = (1 - T) + T (1 - F).
        let rest = (after_one * once * f).zip(taken + once * passes, |light, left| {
            light / left.at_least(T::TINY)
        });
        let attenuation = [Rgb::splat(f), direct, after_one, rest];
        let means = attenuation.map(Rgb::mean);
        let all = (means[0] + means[1] + means[2] + means[RESIDUE]).at_least(T::TINY);
        Self {
            gamma_o: h.atan2(cos_gamma_o),
            gamma_t: sin_gamma_t.atan2(cos_gamma_t),
            attenuation,
            probability: means.map(|mean| mean / all),
        }
    }
}
