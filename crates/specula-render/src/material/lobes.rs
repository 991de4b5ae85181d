//! What the renderer knows of each lobe, by the library's table: on which sides it scatters, and how many elements
//! of it are evaluated and sampled at once.

use specula_bsdf::batch::{Colours, Directions, Level, PerElementBase, SampleOutcome, Samples};
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Transport};

/// Where a lobe scatters to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// It is black where `wi.z <= 0`.
    Reflects,
    /// To both sides.
    Transmits,
    /// Its parameters decide.
    Depends,
}

/// The table's word for [`Sides`].
macro_rules! sides_of {
    (reflects) => {
        Sides::Reflects
    };
    (transmits) => {
        Sides::Transmits
    };
    (depends) => {
        Sides::Depends
    };
}

/// Whether elements of a lobe come in batches.
macro_rules! is_batched {
    (scalar) => {
        false
    };
    ($batch:ident) => {
        true
    };
}

/// The evaluation of a batch; [`eval_pdf`] has the arguments.
macro_rules! eval_pdf_of {
    (closed, $lobe:ident, $streams:ident, $($argument:expr),*) => {
        Level::best().eval_pdf($lobe, $($argument),*)
    };
    (walks, $lobe:ident, $streams:ident, $wo:expr, $wi:expr, $transport:expr, $f_cos:expr, $pdf:expr) => {
        Level::best().eval_pdf_random($lobe, $wo, $wi, $streams, $f_cos, $pdf)
    };
    ($other:ident, $lobe:ident, $($argument:expr),*) => {{
        let _ = $lobe;
        Ok(())
    }};
}

/// The sampling of a batch; [`sample`] has the arguments.
macro_rules! sample_of {
    (scalar, $lobe:ident, $($argument:expr),*) => {{
        let _ = $lobe;
        Ok(())
    }};
    (walks, $lobe:ident, $streams:ident, $wo:expr, $u:expr, $transport:expr, $samples:expr) => {
        Level::best().sample_random($lobe, $wo, $u, $streams, $samples)
    };
    ($closed_or_delta:ident, $lobe:ident, $streams:ident, $($argument:expr),*) => {
        Level::best().sample($lobe, $($argument),*)
    };
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
        /// Where a lobe scatters to.
        pub(crate) fn sides(lobe: &Lobe<f32>) -> Sides {
            match lobe {
                $(Lobe::$name(_) => sides_of!($sides),)*
            }
        }

        /// Whether [`eval_pdf`] and [`sample`] know a lobe.
        pub(crate) fn is_batched(lobe: &Lobe<f32>) -> bool {
            match lobe {
                // A sample's index of refraction is that of the lobe's inside; batches do not return it.
                Lobe::Gltf(gltf) if gltf.transmits() => false,
                Lobe::Principled(principled) if principled.transmits() => false,
                $(Lobe::$name(_) => is_batched!($batch),)*
            }
        }

        /// [`Bsdf::eval_pdf_random`] of all elements; of a perfectly smooth lobe nothing is evaluated.
        ///
        /// * `streams`: for lobes whose values are estimates.
        pub(crate) fn eval_pdf(
            lobe: &Lobe<f32>,
            wo: Directions<&[f32]>,
            wi: Directions<&[f32]>,
            streams: &mut [Stream],
            f_cos: Colours<&mut [f32]>,
            pdf: &mut [f32],
        ) {
            let radiance = Transport::Radiance;
            let done = match lobe {
                $(Lobe::$name(l) => eval_pdf_of!($batch, l, streams, wo, wi, radiance, f_cos, pdf),)*
            };
            debug_assert_eq!(done, Ok(()), "all slices are as long");
        }

        /// [`Bsdf::sample_random`] of all elements.
        ///
        /// * `streams`: as of [`eval_pdf`].
        pub(crate) fn sample(
            lobe: &Lobe<f32>,
            wo: Directions<&[f32]>,
            u: [&[f32]; 3],
            streams: &mut [Stream],
            samples: Samples<&mut [f32], &mut [SampleOutcome]>,
        ) {
            let radiance = Transport::Radiance;
            let done = match lobe {
                $(Lobe::$name(l) => sample_of!($batch, l, streams, wo, u, radiance, samples),)*
            };
            debug_assert_eq!(done, Ok(()), "all slices are as long");
        }
    };
}

specula_bsdf::lobe_table!(functions);

/// The bases of elements under one coat.
#[derive(Clone, Copy)]
pub(crate) struct Bases<'a> {
    pub(crate) albedo: Colours<&'a [f32]>,
    /// With all bounces.
    pub(crate) base: Colours<&'a [f32]>,
}

/// Calls the macro `$call` with the lobe of a coat over bases.
macro_rules! over_bases {
    ($lobe:expr, $bases:expr, $call:ident) => {{
        let Bases { albedo, base } = $bases;
        match $lobe {
            Lobe::CoatedDiffuse(lobe) => $call!(PerElementBase {
                lobe: *lobe,
                albedo,
                base
            }),
            Lobe::Plastic(lobe) => $call!(PerElementBase {
                lobe: *lobe,
                albedo,
                base
            }),
            _ => Ok(()),
        }
    }};
}

/// [`eval_pdf`] of a coat over the elements' own bases.
pub(crate) fn eval_pdf_over(
    (lobe, bases): (&Lobe<f32>, Bases<'_>),
    wo: Directions<&[f32]>,
    wi: Directions<&[f32]>,
    f_cos: Colours<&mut [f32]>,
    pdf: &mut [f32],
) {
    macro_rules! evaluate {
        ($lobes:expr) => {
            Level::best().eval_pdf(&$lobes, wo, wi, Transport::Radiance, f_cos, pdf)
        };
    }
    let done = over_bases!(lobe, bases, evaluate);
    debug_assert_eq!(done, Ok(()), "all slices are as long");
}

/// [`sample`] of a coat over the elements' own bases.
pub(crate) fn sample_over(
    (lobe, bases): (&Lobe<f32>, Bases<'_>),
    wo: Directions<&[f32]>,
    u: [&[f32]; 3],
    samples: Samples<&mut [f32], &mut [SampleOutcome]>,
) {
    macro_rules! sampled {
        ($lobes:expr) => {
            Level::best().sample(&$lobes, wo, u, Transport::Radiance, samples)
        };
    }
    let done = over_bases!(lobe, bases, sampled);
    debug_assert_eq!(done, Ok(()), "all slices are as long");
}

/// Whether values of a lobe are estimates.
pub(crate) fn takes_streams(lobe: &Lobe<f32>) -> bool {
    Bsdf::<f32>::is_stochastic(lobe)
}
