//! GGX (Trowbridge and Reitz 1975; Walter et al. 2007), isotropic and anisotropic.

use super::{LEAST_COS, Masking, Ndf};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};

/// The GGX distribution: normals of an ellipsoid with axes `(1/alpha_x, 1/alpha_y, 1)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<T> {
    alpha: Alpha<T>,
}

impl<T: Real> Ggx<T> {
    /// The distribution of these alphas.
    #[inline(always)]
    pub fn new(alpha: Alpha<T>) -> Self {
        Self { alpha }
    }

    /// `D` of the normal along `m`, whose squared length is given: saves normalising a half vector.
    #[inline(always)]
    pub(crate) fn d_along(&self, m: Vec3<T>, length_squared: T) -> T {
        let Alpha { x: ax, y: ay } = self.alpha;
        // Multiplied through by (ax ay)^4: one division, none by a square of a small alpha.
        let x = m.x * ay;
        let y = m.y * ax;
        let area = ax * ay;
        let z = m.z * area;
        // Squares of the smallest vectors vanish: their quotient is 1, that of the surface's normal.
        let e = z.mad(z, x.mad(x, y.mad(y, T::TINY)));
        let root = (area * area).mad(length_squared, T::TINY) / e;
        T::select(m.z > T::ZERO, root * root * (T::INV_PI / area), T::ZERO)
    }

    /// `sigma` as numerator and denominator, so that callers can save a division.
    #[inline(always)]
    pub(crate) fn projected_area_quotient(&self, w: Vec3<T>) -> (T, T) {
        let (h2, t) = self.stretched_length(w);
        let long = t + w.z.abs();
        let up = w.z >= T::ZERO;
        let top = T::select(up, long, h2);
        (top, T::TWO * T::select(up, T::ONE, long))
    }

    /// `(h2, t)`: `h2 = (alpha_x x)^2 + (alpha_y y)^2` and `t = sqrt(h2 + z^2)`.
    ///
    /// Seen straight from below the projected area is 0; a floor of `h2` makes quotients by it finite.
    #[inline(always)]
    fn stretched_length(&self, w: Vec3<T>) -> (T, T) {
        let s = self.alpha.stretch(w);
        // Written as the samplers write it, so that a kernel computes it once.
        let h2 = (s.x * s.x + s.y * s.y).at_least(T::of(1e-24));
        (h2, (h2 + s.z * s.z).sqrt())
    }
}

impl<T: Real> Ndf<T> for Ggx<T> {
    #[inline(always)]
    fn alpha(&self) -> Alpha<T> {
        self.alpha
    }

    /// ```text
    /// D(wm) = 1 / (pi ax ay ((x/ax)^2 + (y/ay)^2 + z^2)^2),   wm = (x, y, z)
    /// ```
    ///
    /// Source: Tokuyoshi and Eto 2024, eq. 9.
    #[inline(always)]
    fn d(&self, wm: Vec3<T>) -> T {
        self.d_along(wm, T::ONE)
    }

    /// ```text
    /// sigma(w) = (t + z) / 2 = h2 / (2 (t - z))
    /// ```
    ///
    /// Source: Heitz 2014, eq. 72; the second form, for `z < 0`, Tokuyoshi and Eto 2024, app. C.
    #[inline(always)]
    fn projected_area(&self, w: Vec3<T>) -> T {
        let (top, bottom) = self.projected_area_quotient(w);
        top / bottom
    }

    /// ```text
    /// |z| Lambda(w) = (t - |z|) / 2 = h2 / (2 (t + |z|))
    /// ```
    ///
    /// Source: Heitz 2014, eq. 72.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<T>) -> T {
        let (h2, t) = self.stretched_length(w);
        T::HALF * h2 / (t + w.z.abs())
    }

    #[inline(always)]
    fn d_along(&self, m: Vec3<T>, length_squared: T) -> T {
        Self::d_along(self, m, length_squared)
    }

    /// With one division in all: `sigma(wo) = s / b` and `|wi.z| Lambda(wi) = h2 / l` are quotients
    /// themselves.
    #[inline(always)]
    fn g2_over_cos_quotient(&self, masking: Masking, wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
        let cos_i = wi.z.abs();
        let (s, b) = self.projected_area_quotient(wo);
        let (h2, t) = self.stretched_length(wi);
        let l = T::TWO * (t + cos_i);
        let seen = l.mad(cos_i, T::of(LEAST_COS));
        let denominator = match masking {
            Masking::HeightCorrelated => s.mad(seen, wo.z.abs() * (h2 * b)),
            Masking::Separable => s * (seen + h2),
        };
        (seen * b, denominator)
    }
}
