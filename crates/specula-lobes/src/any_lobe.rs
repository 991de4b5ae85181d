//! Lobes of the library's list, hair and measured materials as one type, with batches.

use specula_bsdf::batch::{
    Any, Colours, Directions, LengthMismatch, Level, LobeBatches, SampleOutcome, Samples,
};
use specula_bsdf::bsdf::{Bsdf, Lobe, Transport};
use specula_bsdf::hair::Hair;
use specula_bsdf::math::Real;
use specula_bsdf::measured::Measured;

/// A BSDF of the library: one of its list of lobes, or one that does not fit there.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum AnyLobe<T> {
    /// One of the list.
    Lobe(Lobe<T>),
    /// A fibre: it scatters to the whole sphere.
    Hair(Hair<T>),
    /// A measured material, with tables.
    Measured(Box<Measured<T>>),
}

impl<T: Precision> AnyLobe<T> {
    /// It, by what all have in common.
    #[must_use]
    pub fn as_bsdf(&self) -> &dyn Bsdf<T> {
        T::as_bsdf(self)
    }

    /// Whether samples read the second and third random number alone: there is nothing to choose from.
    #[must_use]
    pub fn takes_two_numbers(&self) -> bool {
        matches!(
            self,
            Self::Lobe(Lobe::RoughConductor(_) | Lobe::RoughConductorBeckmann(_))
                | Self::Measured(_)
        )
    }

    /// Its batches.
    ///
    /// * `transport`: what the path carries.
    /// * `seed`: of lobes that are themselves estimates.
    #[must_use]
    pub fn batches(&self, transport: Transport, seed: u64) -> AnyBatches<'_, T> {
        AnyBatches {
            lobe: self,
            transport,
            seed,
        }
    }
}

impl<T> From<Lobe<T>> for AnyLobe<T> {
    fn from(lobe: Lobe<T>) -> Self {
        Self::Lobe(lobe)
    }
}

impl<T> From<Hair<T>> for AnyLobe<T> {
    fn from(hair: Hair<T>) -> Self {
        Self::Hair(hair)
    }
}

impl<T> From<Measured<T>> for AnyLobe<T> {
    fn from(measured: Measured<T>) -> Self {
        Self::Measured(Box::new(measured))
    }
}

/// Batches of an [`AnyLobe`]: those of [`LobeBatches`], and loops over what is no [`Lobe`].
#[derive(Clone, Copy, Debug)]
pub struct AnyBatches<'a, T> {
    lobe: &'a AnyLobe<T>,
    transport: Transport,
    seed: u64,
}

/// Runs `$call` with the batches of a lobe, or `$other` with what is none.
macro_rules! batches {
    ($of:expr, $lobe:ident => $call:expr, $any:ident => $other:expr) => {
        match $of.lobe {
            AnyLobe::Lobe(lobe) => {
                let $lobe = LobeBatches::new(lobe, $of.transport, $of.seed);
                $call
            }
            AnyLobe::Hair(hair) => {
                let $any = &Any(*hair);
                $other
            }
            AnyLobe::Measured(measured) => {
                let $any = &Any(&**measured);
                $other
            }
        }
    };
}

/// What is compiled for a precision.
mod compiled {
    use super::{AnyBatches, AnyLobe, Bsdf, Colours, Directions, Real};
    use super::{LengthMismatch, SampleOutcome, Samples};

    /// The functions of [`AnyBatches`] and [`AnyLobe`]. Those of an implementation are not generic, so that they are
    /// compiled in this crate, once for all that call them.
    pub trait Compiled: Real {
        fn as_bsdf(lobe: &AnyLobe<Self>) -> &dyn Bsdf<Self>;

        fn eval(
            of: AnyBatches<'_, Self>,
            first: usize,
            wo: Directions<&[Self]>,
            wi: Directions<&[Self]>,
            f_cos: Colours<&mut [Self]>,
        ) -> Result<(), LengthMismatch>;

        fn pdf(
            of: AnyBatches<'_, Self>,
            wo: Directions<&[Self]>,
            wi: Directions<&[Self]>,
            pdf: &mut [Self],
        ) -> Result<(), LengthMismatch>;

        fn eval_pdf(
            of: AnyBatches<'_, Self>,
            first: usize,
            wo: Directions<&[Self]>,
            wi: Directions<&[Self]>,
            f_cos: Colours<&mut [Self]>,
            pdf: &mut [Self],
        ) -> Result<(), LengthMismatch>;

        fn sample(
            of: AnyBatches<'_, Self>,
            first: usize,
            wo: Directions<&[Self]>,
            u: [&[Self]; 3],
            samples: Samples<&mut [Self], &mut [SampleOutcome]>,
        ) -> Result<(), LengthMismatch>;
    }
}

use compiled::Compiled;

/// A precision that lobes are compiled for: `f32` or `f64`.
pub trait Precision: Compiled {}

macro_rules! compile {
    ($($t:ty),*) => {$(
        impl Precision for $t {}

        impl Compiled for $t {
            fn as_bsdf(lobe: &AnyLobe<$t>) -> &dyn Bsdf<$t> {
                match lobe {
                    AnyLobe::Lobe(lobe) => lobe,
                    AnyLobe::Hair(hair) => hair,
                    AnyLobe::Measured(measured) => &**measured,
                }
            }

            fn eval(
                of: AnyBatches<'_, $t>,
                first: usize,
                wo: Directions<&[$t]>,
                wi: Directions<&[$t]>,
                f_cos: Colours<&mut [$t]>,
            ) -> Result<(), LengthMismatch> {
                batches!(of,
                    lobe => lobe.eval(first, wo, wi, f_cos),
                    any => Level::best().eval(any, wo, wi, of.transport, f_cos)
                )
            }

            fn pdf(
                of: AnyBatches<'_, $t>,
                wo: Directions<&[$t]>,
                wi: Directions<&[$t]>,
                pdf: &mut [$t],
            ) -> Result<(), LengthMismatch> {
                batches!(of,
                    lobe => lobe.pdf(wo, wi, pdf),
                    any => Level::best().pdf(any, wo, wi, pdf)
                )
            }

            fn eval_pdf(
                of: AnyBatches<'_, $t>,
                first: usize,
                wo: Directions<&[$t]>,
                wi: Directions<&[$t]>,
                f_cos: Colours<&mut [$t]>,
                pdf: &mut [$t],
            ) -> Result<(), LengthMismatch> {
                batches!(of,
                    lobe => lobe.eval_pdf(first, wo, wi, f_cos, pdf),
                    any => Level::best().eval_pdf(any, wo, wi, of.transport, f_cos, pdf)
                )
            }

            fn sample(
                of: AnyBatches<'_, $t>,
                first: usize,
                wo: Directions<&[$t]>,
                u: [&[$t]; 3],
                samples: Samples<&mut [$t], &mut [SampleOutcome]>,
            ) -> Result<(), LengthMismatch> {
                batches!(of,
                    lobe => lobe.sample(first, wo, u, samples),
                    any => Level::best().sample(any, wo, u, of.transport, samples)
                )
            }
        }
    )*};
}

compile!(f32, f64);

impl<T: Precision> AnyBatches<'_, T> {
    /// As [`LobeBatches::eval`].
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn eval(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        f_cos: Colours<&mut [T]>,
    ) -> Result<(), LengthMismatch> {
        T::eval(*self, first, wo, wi, f_cos)
    }

    /// As [`LobeBatches::pdf`].
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn pdf(
        &self,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        T::pdf(*self, wo, wi, pdf)
    }

    /// As [`LobeBatches::eval_pdf`].
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn eval_pdf(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        f_cos: Colours<&mut [T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        T::eval_pdf(*self, first, wo, wi, f_cos, pdf)
    }

    /// As [`LobeBatches::sample`].
    ///
    /// # Errors
    /// Slices of different lengths; nothing is written then.
    pub fn sample(
        &self,
        first: usize,
        wo: Directions<&[T]>,
        u: [&[T]; 3],
        samples: Samples<&mut [T], &mut [SampleOutcome]>,
    ) -> Result<(), LengthMismatch> {
        T::sample(*self, first, wo, u, samples)
    }
}
