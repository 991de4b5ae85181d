//! Terms that both principled materials share, by the formulas of Mitsuba 3.

use crate::alpha::Alpha;
use crate::fresnel::Refraction;
use crate::math::{Real, Rgb};
use crate::ndf::Ggx;

/// `(1 - cos)^5`, Schlick's weight of the reflectance at grazing angles.
#[inline(always)]
pub(crate) fn schlick_weight<T: Real>(cos: T) -> T {
    let m = (T::ONE - cos).within(T::ZERO, T::ONE);
    let m2 = m * m;
    m2 * m2 * m
}

/// Schlick's weight at the larger of the two angles: the transmitted one where light leaves the
/// denser medium.
#[inline(always)]
pub(super) fn schlick_weight_across<T: Real>(cos: T, bent: &Refraction<T>, eta: T) -> T {
    schlick_weight(T::select(eta > T::ONE, cos, bent.cos_t))
}

/// `F0 + (F90 - F0) s` with `F90 = 1`.
#[inline(always)]
pub(super) fn schlick<T: Real>(f0: Rgb<T>, s: T) -> Rgb<T> {
    f0.map(|f0| f0 + (T::ONE - f0) * s)
}

/// Reflectance at normal incidence, `((eta - 1) / (eta + 1))^2`.
#[inline(always)]
pub(super) fn normal_reflectance<T: Real>(eta: T) -> T {
    let r = (eta - T::ONE) / (eta + T::ONE);
    r * r
}

/// The base colour at luminance 1; white where it is black.
#[inline(always)]
pub(super) fn hue<T: Real>(base: Rgb<T>) -> Rgb<T> {
    let luminance = base.luminance();
    if luminance > T::ZERO {
        base / luminance
    } else {
        Rgb::WHITE
    }
}

/// The sheen's colour: white, or towards the base's hue.
#[inline(always)]
pub(super) fn sheen_colour<T: Real>(base: Rgb<T>, tint: T) -> Rgb<T> {
    hue(base).map(|c| T::ONE + (c - T::ONE) * tint)
}

/// Alphas of the specular lobe: `alpha = roughness^2`, divided and multiplied by `sqrt(1 - 0.9 anisotropic)`.
///
/// Source: Burley 2012, section 5.4; the floor of 1e-3 is Mitsuba's.
#[inline(always)]
pub(super) fn distribution<T: Real>(roughness: T, anisotropic: T) -> Ggx<T> {
    let alpha = roughness * roughness;
    let aspect = (T::ONE - T::of(0.9) * anisotropic).sqrt();
    let floor = T::of(1e-3);
    let x = (alpha / aspect).at_least(floor);
    let y = (alpha * aspect).at_least(floor);
    Ggx::new(Alpha::clamped(x, y))
}

/// Diffuse reflection with retro-reflection and fake subsurface scattering, as a factor on
/// `base / pi`.
///
/// ```text
/// diffuse = (1 - Fo/2) (1 - Fi/2) + R (Fo + Fi + Fo Fi (R - 1)),     R = 2 roughness cos_d^2
/// flat    = 1.25 (S (1 / (cos_o + cos_i) - 1/2) + 1/2)
/// S       = (1 + (R/2 - 1) Fo) (1 + (R/2 - 1) Fi)
/// ```
///
/// with Schlick's weights `Fo`, `Fi` at the two cosines.
///
/// * `cos_d`: between either direction and the half vector.
///
/// Source: Burley 2012, section 5.3; Burley 2015, section 4.
#[inline(always)]
pub(super) fn diffuse<T: Real>(cos_o: T, cos_i: T, cos_d: T, roughness: T, flatness: T) -> T {
    let (fo, fi) = (schlick_weight(cos_o), schlick_weight(cos_i));
    let retro = T::TWO * roughness * cos_d * cos_d;
    let burley = (T::ONE - T::HALF * fo) * (T::ONE - T::HALF * fi)
        + retro * (fo + fi + fo * fi * (retro - T::ONE));
    let grazing = T::HALF * retro - T::ONE;
    let through = (T::ONE + grazing * fo) * (T::ONE + grazing * fi);
    let inverse = T::ONE / (cos_o + cos_i).at_least(T::of(1e-6));
    let flat = T::of(1.25) * (through * (inverse - T::HALF) + T::HALF);
    burley + (flat - burley) * flatness
}
