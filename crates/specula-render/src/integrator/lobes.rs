//! Lobes that are evaluated and sampled many at once.

use specula_bsdf::batch::{Colours, Directions, Level, SampleOutcome, Samples};
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Transport};

/// Whether [`eval_pdf`] and [`sample`] know a lobe.
pub(crate) fn is_known(lobe: &Lobe<f32>) -> bool {
    matches!(
        lobe,
        Lobe::Lambert(_)
            | Lobe::Eon(_)
            | Lobe::SmoothConductor(_)
            | Lobe::RoughConductor(_)
            | Lobe::CoatedDiffuse(_)
            | Lobe::Compensated(_)
            | Lobe::MultibounceConductor(_)
            | Lobe::SmoothDielectric(_)
            | Lobe::RoughDielectric(_)
    )
}

/// Whether light comes through one of those.
pub(crate) fn lets_pass(lobe: &Lobe<f32>) -> bool {
    matches!(lobe, Lobe::SmoothDielectric(_) | Lobe::RoughDielectric(_))
}

/// [`Bsdf::eval_pdf_random`] of all elements.
///
/// * `streams`: for lobes whose values are estimates.
pub(super) fn eval_pdf(
    lobe: &Lobe<f32>,
    wo: Directions<&[f32]>,
    wi: Directions<&[f32]>,
    streams: &mut [Stream],
    f_cos: Colours<&mut [f32]>,
    pdf: &mut [f32],
) {
    let (level, radiance) = (Level::best(), Transport::Radiance);
    let done = match lobe {
        Lobe::Lambert(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::Eon(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::RoughConductor(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::CoatedDiffuse(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::Compensated(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::RoughDielectric(l) => level.eval_pdf(l, wo, wi, radiance, f_cos, pdf),
        Lobe::MultibounceConductor(l) => level.eval_pdf_random(l, wo, wi, streams, f_cos, pdf),
        _ => Ok(()),
    };
    debug_assert_eq!(done, Ok(()), "all slices are as long");
}

/// [`Bsdf::sample_random`] of all elements.
///
/// * `streams`: as of [`eval_pdf`].
pub(super) fn sample(
    lobe: &Lobe<f32>,
    wo: Directions<&[f32]>,
    u: [&[f32]; 3],
    streams: &mut [Stream],
    samples: Samples<&mut [f32], &mut [SampleOutcome]>,
) {
    let (level, radiance) = (Level::best(), Transport::Radiance);
    let done = match lobe {
        Lobe::Lambert(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::Eon(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::SmoothConductor(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::RoughConductor(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::CoatedDiffuse(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::Compensated(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::SmoothDielectric(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::RoughDielectric(l) => level.sample(l, wo, u, radiance, samples),
        Lobe::MultibounceConductor(l) => level.sample_random(l, wo, u, streams, samples),
        _ => Ok(()),
    };
    debug_assert_eq!(done, Ok(()), "all slices are as long");
}

/// Whether values of a lobe are estimates.
pub(super) fn takes_streams(lobe: &Lobe<f32>) -> bool {
    Bsdf::<f32>::is_stochastic(lobe)
}
