//! Nothing is reflected and nothing passes: the back of a one-sided material.

use super::{Bsdf, BsdfSample, Transport};
use crate::math::{Real, Rgb, Vec3};

/// `f = 0`. It takes light and gives none; no direction is ever sampled.
///
/// Formats whose opaque materials have one side (Mitsuba's without `twosided`) are black from
/// behind: a renderer binds this lobe there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Black;

impl<T: Real> Bsdf<T> for Black {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, _wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        Rgb::BLACK
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, _wi: Vec3<T>) -> T {
        T::ZERO
    }

    #[inline(always)]
    fn sample(&self, _wo: Vec3<T>, _u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        None
    }

    /// There is nothing to evaluate: light sources need not be sampled.
    #[inline(always)]
    fn is_specular(&self) -> bool {
        true
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        Rgb::BLACK
    }
}
