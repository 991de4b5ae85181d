//! `samplers.describe`: a sampler's formulas with the numbers of one surface and view.
//!
//! In the papers' letters: i is the view (our `wo`), o a reflection (our `wi`), a hat marks the stretched space. The
//! density is that of the mirror direction, `o = (-i.x, -i.y, i.z)`, for views above the horizon.

mod formulas;

use serde_json::json;
use specula_bsdf::math::vec3;
use specula_bsdf::vndf::Sampler;
use specula_stat::normalisation::integrate_bands;
use specula_stat::quadrature::{Peak, Quadrature};

use self::formulas::{area, bounded, cap, density, exact, hemisphere, stretching};
use super::{Surface, sampler};
use crate::fields::Fields;
use crate::{Answer, AskError};

/// Formulas, acceptance, and the stretched view.
pub(super) fn describe(mut fields: Fields) -> Result<Answer, AskError> {
    let sampler = sampler(&mut fields)?;
    let surface = Surface::of(&mut fields)?;
    fields.end()?;

    let is_above = surface.wo.z > 0.0;
    let mut formulas = stretching(&surface);
    match sampler {
        Sampler::Heitz => {
            formulas.push(hemisphere(&surface));
            formulas.push(area(&surface));
        }
        Sampler::Cap => {
            formulas.push(cap(&surface));
            formulas.push(area(&surface));
        }
        Sampler::Bounded if is_above => formulas.extend(bounded(&surface)),
        Sampler::Exact if is_above => formulas.extend(exact(&surface)),
        Sampler::Bounded | Sampler::Exact => {
            formulas.push(cap(&surface));
            formulas.push(area(&surface));
        }
    }
    formulas.push(density(&surface, sampler));
    Ok(Answer::new(json!({
        "formulas": formulas,
        "acceptance": acceptance(&surface, sampler),
        "stretched": surface.stretched().to_array(),
    })))
}

/// Share of samples above the horizon: the integral of the density over the hemisphere.
///
/// Where the quadrature does not converge (alphas below about 1e-3), it is the quotient of norms that it approximates.
fn acceptance(surface: &Surface, sampler: Sampler) -> f64 {
    let reflections = surface.reflections(sampler);
    if surface.wo.z <= 0.0 {
        // Every visible normal reflects upwards: `docs/exact-reflection-sampling.md`.
        return 1.0;
    }
    let wo = surface.wo;
    let quadrature = Quadrature {
        relative_tolerance: 1e-5,
        absolute_tolerance: 1e-6,
        max_patches: 3000,
        peaks: vec![Peak {
            direction: vec3(-wo.x, -wo.y, wo.z),
            width: surface.alpha.x.min(surface.alpha.y),
        }],
        ..Quadrature::default()
    };
    let integral = integrate_bands(&[], &quadrature, |wi| [reflections.pdf(wi)]);
    if integral.converged {
        return integral.value[0].min(1.0);
    }
    let exact = surface.reflections(Sampler::Exact).norm();
    (exact / reflections.norm()).min(1.0)
}
