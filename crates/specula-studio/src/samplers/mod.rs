//! Requests about samplers of reflections off visible GGX normals.
//!
//! Everything is in double precision. The papers' i is our `wo`, their o is our `wi`; the stretched space is that of
//! unit roughness, where a direction is `(ax x, ay y, z)`, normalised.

mod cells;
mod compare;
mod describe;
mod histogram;
mod regions;
mod sampled;
mod stretched;

use serde_json::{Map, Value};
use specula_bsdf::vndf::{Reflections, Sampler};
use specula_bsdf::{Alpha, Vec3};

use crate::fields::{Fields, wrong};
use crate::{Answer, AskError};

/// Answers `samplers.{what}`.
pub(crate) fn answer(what: &str, request: Map<String, Value>) -> Result<Answer, AskError> {
    let fields = Fields::new(request);
    match what {
        "describe" => describe::describe(fields),
        "regions" => regions::regions(fields),
        "samples" => sampled::samples(fields),
        "histogram" => histogram::histogram(fields),
        "compare" => compare::compare(fields),
        _ => Err(AskError::unknown(&format!("samplers.{what}"))),
    }
}

/// A surface and a view.
#[derive(Clone, Copy)]
struct Surface {
    alpha: Alpha<f64>,
    wo: Vec3<f64>,
}

impl Surface {
    /// The fields `alpha` and `wo`.
    fn of(fields: &mut Fields) -> Result<Self, AskError> {
        let [x, y] = fields.numbers("alpha")?;
        let alpha = Alpha::new(x, y).map_err(|e| AskError::new(format!("alpha: {e}")))?;
        let wo = fields.direction("wo")?;
        Ok(Self { alpha, wo })
    }

    fn reflections(&self, sampler: Sampler) -> Reflections<f64> {
        Reflections::new(self.alpha, self.wo, sampler)
    }
}

/// The field `sampler`.
fn sampler(fields: &mut Fields) -> Result<Sampler, AskError> {
    let name = fields.text("sampler")?;
    name.parse().map_err(|_| {
        wrong(
            "sampler",
            "heitz, cap, bounded or exact",
            &format!("'{name}'"),
        )
    })
}
