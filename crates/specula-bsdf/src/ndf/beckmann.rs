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
        let d = (-exponent).exp_below() / (T::PI * ax * ay * z2 * z2);
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
    /// Source: Heitz 2014, eq. 78, times `|z|`. The two terms cancel for large `a`, so that they are written as one.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<T>) -> T {
        let (h, a) = self.slope(w);
        let falling = (-(a * a)).exp_below();
        let beyond = T::ONE + a;
        (h * falling * shape(a) / (beyond * beyond)).at_least(T::ZERO)
    }
}

/// The integral of the slopes above `a >= 0`, over what is steep about it:
///
/// ```text
/// shape(a) = (1 + a)^2 exp(a^2) (exp(-a^2) / sqrt(pi) - a erfc(a)) / 2
/// ```
///
/// in `[1/(4 sqrt(pi)), 0.3]`, as a polynomial in `(a - 2) / (a + 2)`: without branches or a library, so that loops over it
/// are vectors. Chebyshev interpolation, largest relative errors 4e-8 (`f32`) and 5e-15 (`f64`).
#[inline(always)]
fn shape<T: Real>(a: T) -> T {
    let t = (a - T::TWO) / (a + T::TWO);
    if T::MAX.to_f64() > 1e40 {
        polynomial(&DOUBLE, t)
    } else {
        polynomial(&SINGLE, t)
    }
}

#[inline(always)]
fn polynomial<T: Real, const N: usize>(coefficients: &[f64; N], t: T) -> T {
    let mut i = N - 1;
    let mut sum = T::of(coefficients[i]);
    while i > 0 {
        i -= 1;
        sum = sum * t + T::of(coefficients[i]);
    }
    sum
}

const SINGLE: [f64; 12] = [
    0.240_292_034_167_060_08,
    -0.111_670_697_013_075_93,
    -0.021_267_778_530_542_78,
    0.050_242_390_941_489_23,
    -0.010_476_465_294_361_28,
    -0.011_176_236_857_631_147,
    0.003_612_658_244_200_351_9,
    0.002_635_978_918_971_831,
    -0.000_651_025_411_163_793_6,
    -0.000_656_572_630_117_279_2,
    0.000_061_667_907_950_235_61,
    0.000_101_444_301_606_462_8,
];

const DOUBLE: [f64; 25] = [
    0.240_292_039_170_351_74,
    -0.111_670_775_742_517_2,
    -0.021_268_174_754_473_415,
    0.050_244_621_450_160_92,
    -0.010_471_215_805_363_578,
    -0.011_194_355_309_107_957,
    0.003_585_900_027_938_517_9,
    0.002_699_366_914_441_706,
    -0.000_583_755_141_245_638_9,
    -0.000_765_064_798_833_900_7,
    -0.000_030_645_909_731_138_636,
    0.000_190_757_073_828_228_2,
    0.000_071_610_037_360_666_98,
    -0.000_025_683_904_521_442_1,
    -0.000_030_913_767_994_448_95,
    -6.666_367_116_612_878e-6,
    6.192_860_793_999_359e-6,
    5.642_527_881_532_43e-6,
    7.706_946_049_518_108e-7,
    -1.829_608_811_500_254_6e-6,
    -9.799_649_772_261_706e-7,
    3.111_552_673_198_539e-7,
    3.039_117_998_709_454_7e-7,
    -2.133_413_994_886_567_4e-8,
    -3.752_865_586_962_996e-8,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the functions of a library, where their difference does not cancel.
    #[test]
    fn the_shape_is_as_near_as_stated() {
        let mut worst = [0.0_f64; 2];
        for i in 0..=3000 {
            let a = f64::from(i) * 1e-3;
            let rest = 1.0 / core::f64::consts::PI.sqrt() - a * (a * a).exp() * libm::erfc(a);
            let exact = 0.5 * (1.0 + a) * (1.0 + a) * rest;
            let single = f64::from(shape(f64_to_f32(a)));
            worst[0] = worst[0].max((shape(a) / exact - 1.0).abs());
            worst[1] = worst[1].max((single / exact - 1.0).abs());
        }
        assert!(worst[0] < 1e-13 && worst[1] < 3e-7, "{worst:?}");
        // Far out by the asymptotic series.
        for a in [20.0_f64, 100.0, 1e6, 1e18] {
            let b = 1.0 / (a * a);
            let series = 1.0 - 1.5 * b * (1.0 - 2.5 * b * (1.0 - 3.5 * b * (1.0 - 4.5 * b)));
            let scale = (1.0 + 1.0 / a) * (1.0 + 1.0 / a) / (4.0 * core::f64::consts::PI.sqrt());
            let error = shape(a) / (scale * series) - 1.0;
            assert!(error.abs() < 1e-9, "{a}: {error:e}");
        }
    }

    #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
    fn f64_to_f32(x: f64) -> f32 {
        x as f32
    }
}
