//! Requests about lobes.

mod code;
mod describe;
mod prove;
mod sampled;
mod values;
mod walks;

use serde_json::{Map, Value};
use specula_lobes::NamedLobe;

use crate::fields::Fields;
use crate::{Answer, AskError};

/// Answers `lobes.{what}`.
pub(crate) fn answer(what: &str, request: Map<String, Value>) -> Result<Answer, AskError> {
    let fields = Fields::new(request);
    match what {
        "kinds" => describe::kinds(fields),
        "parse" => describe::parse(fields),
        "slice" => values::slice(fields),
        "grid" => values::grid(fields),
        "albedo" => sampled::albedo(fields),
        "samples" => sampled::samples(fields),
        "prove" => prove::prove_lobe(fields),
        "walks" => walks::walks(fields),
        "code" => code::code(fields),
        _ => Err(AskError::unknown(&format!("lobes.{what}"))),
    }
}

/// The field `lobe`.
fn lobe(fields: &mut Fields) -> Result<NamedLobe, AskError> {
    let text = fields.text("lobe")?;
    specula_lobes::parse(&text).map_err(|e| AskError::new(e.to_string()))
}
