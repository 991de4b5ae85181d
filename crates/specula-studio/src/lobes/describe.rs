//! `lobes.kinds` and `lobes.parse`: lobes as words.

use serde_json::{Map, Value, json};
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::metals::METALS;
use specula_bsdf::{Bsdf, Event, Transport};
use specula_lobes::{NamedLobe, Parameter, ParameterKind};

use crate::fields::Fields;
use crate::{Answer, AskError};

/// Every kind with its parameters, and the measured metals.
pub(super) fn kinds(fields: Fields) -> Result<Answer, AskError> {
    fields.end()?;
    let kinds: Vec<Value> = specula_lobes::kinds()
        .iter()
        .map(|kind| {
            let parameters: Vec<Value> = kind.parameters().map(parameter).collect();
            json!({"name": kind.name, "doc": kind.doc, "parameters": parameters})
        })
        .collect();
    let metals: Vec<Value> = METALS
        .iter()
        .map(|metal| json!({"symbol": metal.symbol, "name": metal.name}))
        .collect();
    Ok(Answer::new(json!({"kinds": kinds, "metals": metals})))
}

fn parameter(parameter: &Parameter) -> Value {
    let kind = match parameter.kind {
        ParameterKind::Number { .. } => "number",
        ParameterKind::Count => "count",
        ParameterKind::Alpha => "alpha",
        ParameterKind::Colour { .. } => "colour",
        ParameterKind::Choice(_) => "choice",
        ParameterKind::Flag => "flag",
        ParameterKind::Metal => "metal",
    };
    let mut said = json!({
        "key": parameter.key,
        "type": kind,
        "default": parameter.default,
        "doc": parameter.doc,
    });
    if let Some([low, high]) = parameter.kind.range() {
        said["low"] = json!(low);
        if high < f64::MAX {
            said["high"] = json!(high);
        }
    }
    if let ParameterKind::Choice(words) = parameter.kind {
        said["choices"] = json!(words);
    }
    said
}

/// The normal form of a lobe, and what it is.
pub(super) fn parse(mut fields: Fields) -> Result<Answer, AskError> {
    let lobe = super::lobe(&mut fields)?;
    fields.end()?;
    let given: Map<String, Value> = lobe
        .given()
        .map(|(key, value)| (key.to_owned(), json!(value)))
        .collect();
    Ok(Answer::new(json!({
        "lobe": lobe.to_string(),
        "kind": lobe.kind().name,
        "given": given,
        "isStochastic": lobe.is_stochastic(),
        "isSpecular": lobe.is_specular(),
        "transmits": transmits(&lobe),
    })))
}

/// Whether any of its samples is on the other side with a weight.
///
/// By samples: of some kinds the parameters decide. A share of light of 1 % is found but for one case in 10^17.
pub(super) fn transmits(lobe: &NamedLobe) -> bool {
    let mut stream = Stream::new(0);
    (0..4096).any(|_| {
        let u = [stream.next(), stream.next(), stream.next()];
        let wo = vec3(0.6, 0.0, 0.8);
        let sample = lobe
            .double()
            .sample_random(wo, u, Transport::Radiance, &mut stream);
        sample.is_some_and(|s| s.event == Event::Transmission && !s.weight.is_black())
    })
}
