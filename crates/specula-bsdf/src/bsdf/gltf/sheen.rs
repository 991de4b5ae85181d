//! Sheen by the Charlie distribution, with its scaling of what lies below.

use super::albedo;
use crate::energy::stencil::Stencil;
use crate::math::{Real, Rgb, Vec3};

/// `KHR_materials_sheen`.
///
/// ```text
/// f = colour D(wm) / ((1 + L(wo) + L(wi)) 4 |wo.z| |wi.z|)
/// D(wm) = (2 + 1/r) sin^(1/r) / (2 pi)
/// ```
///
/// Source: Estevez and Kulla 2017, eqs. 2 to 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sheen<T> {
    colour: Rgb<T>,
    roughness: T,
    /// The albedo's table at this roughness.
    stencil: Stencil<T>,
}

/// Below, the fitted masking reflects more than arrives.
pub const LEAST_ROUGHNESS: f64 = 0.07;

impl<T: Real> Sheen<T> {
    #[inline]
    pub(super) fn new(colour: Rgb<T>, roughness: T) -> Self {
        let roughness = roughness.at_least(T::of(LEAST_ROUGHNESS));
        Self {
            colour,
            roughness,
            stencil: albedo::sheen_stencil(roughness),
        }
    }

    /// `f |cos|`, finite at grazing views.
    #[inline]
    pub(super) fn f_cos(&self, wo: Vec3<T>, wi: Vec3<T>, wm: Vec3<T>) -> Rgb<T> {
        self.colour * charlie_f_cos(self.roughness, wo, wi, wm)
    }

    /// The share of light that reaches the base from `wo` and leaves to `wi`.
    #[inline]
    pub(super) fn left(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let at = |w: Vec3<T>| albedo::sheen(&self.stencil, w.z.abs());
        let most = at(wo).at_least(at(wi));
        (T::ONE - self.colour.max_channel() * most).at_least(T::ZERO)
    }

    /// The largest channel of the albedo from `wo`.
    #[inline]
    pub(super) fn strength(&self, wo: Vec3<T>) -> T {
        self.colour.max_channel() * albedo::sheen(&self.stencil, wo.z.abs())
    }
}

/// `f |wi.z|` of white sheen.
#[inline]
pub fn charlie_f_cos<T: Real>(roughness: T, wo: Vec3<T>, wi: Vec3<T>, wm: Vec3<T>) -> T {
    let inverse = T::ONE / roughness;
    let sin2 = (wm.x * wm.x + wm.y * wm.y).at_most(T::ONE);
    // sin^(1/r); exp and ln of a floor that is 0 for every roughness here.
    let power = (sin2.at_least(T::of(1e-30)).ln() * (T::HALF * inverse)).exp();
    let d = (T::TWO + inverse) * power * (T::HALF * T::INV_PI);
    // Finite at grazing angles, the same way for both directions.
    let [cos_o, cos_i] = [wo, wi].map(|w| w.z.abs().at_least(T::of(1e-4)));
    let masking = T::ONE + lambda(cos_o, roughness) + lambda(cos_i, roughness);
    d * wi.z.abs() / (masking * T::of(4.0) * cos_o * cos_i)
}

/// Masking of the fibres.
#[inline]
fn lambda<T: Real>(cos: T, roughness: T) -> T {
    let l = |x: T| fitted(x, roughness);
    if cos < T::HALF {
        l(cos).exp()
    } else {
        (T::TWO * l(T::HALF) - l(T::ONE - cos)).exp()
    }
}

/// The fit `a / (1 + b x^c) + d x + e` of the paper's table 1.
#[inline]
fn fitted<T: Real>(x: T, roughness: T) -> T {
    let smooth = (T::ONE - roughness) * (T::ONE - roughness);
    let mix = |rough: f64, fine: f64| T::of(rough) + T::of(fine - rough) * smooth;
    let a = mix(21.5473, 25.3245);
    let b = mix(3.82987, 3.32435);
    let c = mix(0.19823, 0.16801);
    let d = mix(-1.97760, -1.27393);
    let e = mix(-4.32054, -4.85967);
    let power = (x.at_least(T::of(1e-30)).ln() * c).exp();
    a / (T::ONE + b * power) + d * x + e
}
