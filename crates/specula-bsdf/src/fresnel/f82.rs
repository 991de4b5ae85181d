//! Schlick's approximation with a chosen colour at 82 degrees.

use super::Schlick;
use crate::math::{Real, Rgb};

/// The "F82-tint" model: Schlick's term less a hump that is largest at `cos = 1/7`.
///
/// ```text
/// F = F0 + (1 - F0) (1 - cos)^5 - b cos (1 - cos)^6
/// b = (F_schlick(1/7) (1 - tint)) / ((1/7) (6/7)^6)
/// ```
///
/// A tint of 1 is Schlick's term; metals have tints below 1.
///
/// Source: Kutz, Hasan and Edmondson 2021, Novel Aspects of the Adobe Standard Material; Hoffman
/// 2019, Fresnel Equations Considered Harmful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82Tint<T> {
    pub(crate) schlick: Schlick<T>,
    pub(crate) hump: Rgb<T>,
}

impl<T: Real> F82Tint<T> {
    /// * `f0`: reflectance at normal incidence, in `[0, 1]`.
    /// * `tint`: factor on Schlick's reflectance at `cos = 1/7` (81.8 degrees), in `[0, 1]`.
    #[inline(always)]
    pub fn new(f0: Rgb<T>, tint: Rgb<T>) -> Self {
        let schlick = Schlick { f0 };
        let cos = T::of(1.0 / 7.0);
        let m = T::ONE - cos;
        let m3 = m * m * m;
        let scale = T::ONE / (cos * m3 * m3);
        let at = schlick.eval(cos);
        Self {
            schlick,
            hump: at.zip(tint, |f, t| f * (T::ONE - t) * scale),
        }
    }

    /// Reflectance at `cos`, in `[0, 1]`.
    #[inline(always)]
    pub fn eval(&self, cos: T) -> Rgb<T> {
        let m = (T::ONE - cos).within(T::ZERO, T::ONE);
        let m3 = m * m * m;
        let hump = cos.within(T::ZERO, T::ONE) * m3 * m3;
        self.schlick
            .eval(cos)
            .zip(self.hump, |f, b| (f - b * hump).within(T::ZERO, T::ONE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tint_is_met_and_one_is_schlick() {
        let f0 = Rgb::splat(0.9_f64);
        let cos = 1.0 / 7.0;
        let schlick = Schlick { f0 };
        let tinted = F82Tint::new(f0, Rgb::splat(0.8));
        assert!((tinted.eval(cos).r - 0.8 * schlick.eval(cos).r).abs() < 1e-14);
        assert!((tinted.eval(1.0).r - 0.9).abs() < 1e-14);
        assert!((tinted.eval(0.0).r - 1.0).abs() < 1e-14);
        let plain = F82Tint::new(f0, Rgb::WHITE);
        for i in 0..=20 {
            let cos = f64::from(i) / 20.0;
            assert!((plain.eval(cos).r - schlick.eval(cos).r).abs() < 1e-14);
        }
    }
}
