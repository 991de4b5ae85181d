//! Beckmann: normals of a surface with normally distributed slopes, isotropic and anisotropic.

use super::Ndf;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};

/// The Beckmann distribution; `alpha` is `sqrt(2)` times the slopes' standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beckmann<T> {
    alpha: Alpha<T>,
}

impl<T: Real> Beckmann<T> {
    /// The distribution of these alphas.
    #[inline(always)]
    pub fn new(alpha: Alpha<T>) -> Self {
        Self { alpha }
    }

    /// `(h, a)`: `h = sqrt((alpha_x x)^2 + (alpha_y y)^2)` and `a = |z| / h`.
    #[inline(always)]
    fn slope(&self, w: Vec3<T>) -> (T, T) {
        let s = self.alpha.stretch(w);
        let h = ((s.x * s.x + s.y * s.y).sqrt()).at_least(T::of(1e-18));
        (h, w.z.abs() / h)
    }
}

impl<T: Real> Ndf<T> for Beckmann<T> {
    #[inline(always)]
    fn alpha(&self) -> Alpha<T> {
        self.alpha
    }

    /// ```text
    /// D(wm) = exp(-((x/ax)^2 + (y/ay)^2) / z^2) / (pi ax ay z^4),   wm = (x, y, z)
    /// ```
    ///
    /// Source: Heitz 2014, eq. 79.
    #[inline(always)]
    fn d(&self, wm: Vec3<T>) -> T {
        let Alpha { x: ax, y: ay } = self.alpha;
        let sx = wm.x / (ax * wm.z);
        let sy = wm.y / (ay * wm.z);
        let exponent = sx * sx + sy * sy;
        let z2 = wm.z * wm.z;
        let d = (-exponent).exp() / (T::PI * ax * ay * z2 * z2);
        // Where the exponential vanishes the quotient may be 0/0.
        let vanishes = T::of(if T::MAX.to_f64() > 1e40 { 600.0 } else { 80.0 });
        T::select(wm.z > T::ZERO && exponent < vanishes, d, T::ZERO)
    }

    /// ```text
    /// sigma(w) = z erfc(-a) / 2 + h exp(-a^2) / (2 sqrt(pi)),   a = z / h
    /// ```
    ///
    /// For `z < 0` the two terms cancel: relative error about `2 a^2` times the type's epsilon.
    ///
    /// Source: Heitz 2014, eq. 78, times `z`.
    #[inline(always)]
    fn projected_area(&self, w: Vec3<T>) -> T {
        let lambda_cos = self.lambda_cos(w);
        (lambda_cos + T::select(w.z >= T::ZERO, w.z, T::ZERO)).at_least(T::of(1e-24))
    }

    /// ```text
    /// |z| Lambda(w) = h exp(-a^2) / (2 sqrt(pi)) - |z| erfc(a) / 2,   a = |z| / h
    /// ```
    ///
    /// Source: Heitz 2014, eq. 78, times `|z|`.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<T>) -> T {
        let (h, a) = self.slope(w);
        let rise = h * (-(a * a)).exp() * T::of(0.282_094_791_773_878_14);
        (rise - T::HALF * w.z.abs() * a.erfc()).at_least(T::ZERO)
    }
}
