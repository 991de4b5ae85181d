//! Facets of a dielectric, seen from the side that a walk is on.
//!
//! Each side has its own frame: inside, z is turned, so that up always leads out on that side. The
//! facets seen are then those of the same distribution. The depths of the two sides are
//!
//! ```text
//! tau = -ln C1,   tau' = -ln(1 - C1) = -ln(1 - exp(-tau))
//! ```
//!
//! (Heitz et al. 2016). Refraction turns z, exchanges the depths and inverts `eta`.

use super::walk::{Flight, LEAST_COS};
use crate::fresnel::{dielectric, refract};
use crate::math::{Real, Vec3};
use crate::vndf::VisibleNormals;

/// Facets of a dielectric from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interface<T, N> {
    pub(crate) ndf: N,
    /// Index beyond over index on this side.
    pub(crate) eta: T,
}

/// The vector in the frame of the other side.
#[inline(always)]
pub(crate) fn turned<T: Real>(w: Vec3<T>) -> Vec3<T> {
    Vec3 { z: -w.z, ..w }
}

/// The depth as seen from the other side.
#[inline(always)]
pub(crate) fn depth_beyond<T: Real>(tau: T) -> T {
    // A ray that touches the top is infinitely deep inside.
    let share = -(-tau).exp_m1();
    (-share.at_least(T::TINY).ln()).at_least(T::ZERO)
}

/// A walk with heights: a flight that meets a facet at `tau`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision<T> {
    pub(crate) flight: Flight<T>,
    pub(crate) tau: T,
}

/// What follows a bounce.
pub(crate) enum Next<T, N> {
    /// A collision, on this side.
    Meets(Interface<T, N>, Collision<T>),
    /// The ray leaves, in the frame of its side.
    Leaves(Vec3<T>),
}

impl<T: Real, N: VisibleNormals<T>> Interface<T, N> {
    #[inline(always)]
    pub(crate) fn beyond(&self) -> Self {
        Self {
            ndf: self.ndf,
            eta: T::ONE / self.eta,
        }
    }

    /// The next direction, and whether it has changed sides (it is then in the frame beyond).
    ///
    /// * `u`: samples reflection or refraction, and the facet.
    #[inline(always)]
    pub(crate) fn bounce(&self, d: Vec3<T>, u: [T; 3]) -> (Vec3<T>, bool) {
        let wm = self.ndf.sample_wm(-d, [u[1], u[2]]);
        let cos = -d.dot(wm);
        let bent = dielectric(cos, self.eta);
        if u[0] < bent.reflectance {
            (d + wm * (T::TWO * cos), false)
        } else {
            let refracted = refract(-d, wm, cos, bent.cos_t, self.eta);
            (turned(refracted), true)
        }
    }

    /// Phase function towards `wi` in this frame, in 1/sr: reflection and refraction together, for
    /// light (no `1/eta^2`).
    ///
    /// ```text
    /// F D / (4 sigma(-d))    and    (1 - F) D |d.wm| e^2 |wi.wm| / (sigma(-d) (|d.wm| + e wi.wm)^2)
    /// ```
    #[inline]
    pub(crate) fn phase(&self, flight: &Flight<T>, wi: Vec3<T>, reflects: bool) -> T {
        let wo = -flight.d;
        let generalised = if reflects {
            wo + wi
        } else {
            wo + wi * self.eta
        };
        let upright = T::ONE.copysign(generalised.z);
        let length = generalised.length();
        if length < T::of(1e-6) {
            return T::ZERO;
        }
        let wm = generalised * (upright / length);
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        let lit = cos_o > T::ZERO && T::select(reflects, cos_i, -cos_i) > T::ZERO;
        if !lit || wm.z <= T::ZERO {
            return T::ZERO;
        }
        let bent = dielectric(cos_o, self.eta);
        let d = self.ndf.d(wm) / flight.facing;
        if reflects {
            T::of(0.25) * bent.reflectance * d
        } else {
            let sum = cos_o + self.eta * cos_i;
            let jacobian = self.eta * self.eta * cos_i.abs() / (sum * sum).at_least(T::of(1e-12));
            bent.transmittance * d * cos_o * jacobian
        }
    }

    /// Phase function times the probability of leaving along `wi`, from a known depth.
    #[inline]
    pub(crate) fn connection(&self, at: &Collision<T>, wi: Vec3<T>) -> T {
        let reflects = wi.z > T::ZERO;
        let phase = self.phase(&at.flight, wi, reflects);
        if phase <= T::ZERO {
            return T::ZERO;
        }
        phase * self.leaves(at.tau, wi)
    }

    /// Probability of leaving along `wi`, on either side, from the depth `tau`.
    #[inline]
    pub(crate) fn leaves(&self, tau: T, wi: Vec3<T>) -> T {
        let depth = if wi.z > T::ZERO {
            tau
        } else {
            depth_beyond(tau)
        };
        let lambda = self.ndf.lambda_cos(wi) / wi.z.abs().at_least(T::of(LEAST_COS));
        (-(depth * lambda)).exp()
    }

    /// Mean of [`leaves`](Self::leaves) over `tau` of `Exp(l)`, for `wi` beyond:
    ///
    /// ```text
    /// int l C^(l-1) (1 - C)^L dC = l B(l, L + 1) = G(l + 1) G(L + 1) / G(l + L + 1)
    /// ```
    ///
    /// Source: Walter's refraction with Smith's heights, as in Heitz et al. 2016.
    pub(crate) fn leaves_beyond(l: T, lambda: T) -> T {
        let (l, lambda) = (l.to_f64(), lambda.to_f64());
        // Beyond 1e8 the differences of logarithms lose their digits: one factor is a power then.
        let (small, large) = if l < lambda { (l, lambda) } else { (lambda, l) };
        let log = if large > 1e8 {
            libm::lgamma(small + 1.0) - small * large.ln()
        } else {
            libm::lgamma(l + 1.0) + libm::lgamma(lambda + 1.0) - libm::lgamma(l + lambda + 1.0)
        };
        T::of(log.min(0.0).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ndf::Ggx;

    #[test]
    fn masking_of_refraction_is_the_mean_over_depths() {
        for l in [1.0, 1.5, 4.0] {
            for lambda in [0.0, 0.3, 2.0] {
                let n = 400_000_u32;
                let mut sum = 0.0;
                for i in 0..n {
                    let u = (f64::from(i) + 0.5) / f64::from(n);
                    let tau: f64 = -u.ln() / l;
                    sum += (-depth_beyond(tau) * lambda).exp();
                }
                let mean = sum / f64::from(n);
                let exact = Interface::<f64, Ggx<f64>>::leaves_beyond(l, lambda);
                assert!((mean - exact).abs() < 1e-4, "{l} {lambda}: {mean} {exact}");
            }
        }
        // The two forms meet.
        let below = Interface::<f64, Ggx<f64>>::leaves_beyond(0.99e8, 0.3);
        let above = Interface::<f64, Ggx<f64>>::leaves_beyond(1.01e8, 0.3);
        assert!((below / above - 1.0).abs() < 0.01);
    }

    #[test]
    fn depths_of_the_two_sides_are_complements() {
        for tau in [1e-6_f64, 1e-3, 0.1, 1.0, 5.0] {
            let both = (-tau).exp() + (-depth_beyond(tau)).exp();
            assert!((both - 1.0).abs() < 1e-6, "{tau}: {both}");
        }
        assert!(depth_beyond(0.0_f32).is_finite());
    }
}
