//! Any lobe, without allocation or dynamic dispatch: what a renderer holds at a hit.

#[cfg(doc)]
use super::*;
use super::{Bsdf, BsdfSample, Transport};
use crate::math::{Real, Rgb, Stream, Vec3};

/// Makes the type, the dispatch over its variants and the conversions of the table's rows.
///
/// * `$d`: a dollar sign, for the macro within.
macro_rules! define_lobe {
    ($d:tt $($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
        /// One of the lobes of this crate, with GGX where it is rough unless its name says otherwise.
        ///
        /// Not `#[non_exhaustive]`: who matches on it shall learn from the compiler that there is a new lobe.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Lobe<T> {
            $($(#[$doc])* $name($lobe),)*
        }

        macro_rules! each_lobe {
            ($d lobe:expr, $d l:ident => $d call:expr) => {
                match $d lobe {
                    $(Lobe::$name($d l) => $d call,)*
                }
            };
        }

        $(impl<T: Real> From<$lobe> for Lobe<T> {
            #[inline(always)]
            fn from(lobe: $lobe) -> Self {
                Self::$name(lobe)
            }
        })*
    };
}

crate::lobe_table!(define_lobe $);

impl<T: Real> Bsdf<T> for Lobe<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        each_lobe!(self, l => l.eval(wo, wi, transport))
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        each_lobe!(self, l => l.pdf(wo, wi))
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        each_lobe!(self, l => l.sample(wo, u, transport))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        each_lobe!(self, l => l.eval_pdf(wo, wi, transport))
    }

    #[inline]
    fn is_stochastic(&self) -> bool {
        each_lobe!(self, l => Bsdf::<T>::is_stochastic(l))
    }

    #[inline]
    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        each_lobe!(self, l => l.eval_pdf_random(wo, wi, transport, stream))
    }

    #[inline]
    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        each_lobe!(self, l => l.sample_random(wo, u, transport, stream))
    }

    #[inline]
    fn is_specular(&self) -> bool {
        each_lobe!(self, l => Bsdf::<T>::is_specular(l))
    }

    #[inline]
    fn albedo(&self) -> Rgb<T> {
        each_lobe!(self, l => l.albedo())
    }
}
