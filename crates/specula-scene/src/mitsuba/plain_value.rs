//! Values that are written in attributes: numbers, strings, vectors, colours and references.

use super::document::{Attributes, attribute};
use super::number::{number, triple};
use super::spectrum;
use super::value::{Samples, Value};
use crate::num::shorten;

/// The value of a property that holds no plugin.
pub(super) fn plain_value(
    tag: &str,
    attributes: &Attributes,
    legacy: bool,
) -> Result<Value, String> {
    let value = || {
        attribute(attributes, "value")
            .ok_or_else(|| format!("<{tag}> needs an attribute \"value\""))
    };
    match tag {
        "float" => number(value()?).map(Value::Number),
        "integer" => integer(value()?).map(Value::Integer),
        "boolean" => match value()?.trim().to_ascii_lowercase().as_str() {
            "true" => Ok(Value::Boolean(true)),
            "false" => Ok(Value::Boolean(false)),
            other => Err(format!(
                "expected \"true\" or \"false\", found \"{}\"",
                shorten(other)
            )),
        },
        "string" => Ok(Value::Text(value()?.to_owned())),
        "point" | "vector" => vector(attributes),
        "rgb" => colour(value()?, false),
        "srgb" => colour(value()?, true),
        "spectrum" => spectrum::parse(value()?).map(Value::Spectrum),
        "blackbody" if legacy => black_body(attributes),
        "ref" => attribute(attributes, "id")
            .map(|id| Value::Reference(id.to_owned()))
            .ok_or_else(|| "<ref> needs an attribute \"id\"".to_owned()),
        other => Err(format!("<{}> is no element of a scene", shorten(other))),
    }
}

fn integer(text: &str) -> Result<i64, String> {
    text.trim()
        .parse()
        .map_err(|_| format!("expected an integer, found \"{}\"", shorten(text)))
}

fn vector(attributes: &Attributes) -> Result<Value, String> {
    if let Some(value) = attribute(attributes, "value") {
        return triple(value).map(|v| Value::Vector(v.into()));
    }
    let part = |name: &str| {
        attribute(attributes, name)
            .ok_or_else(|| format!("expected attributes \"x\", \"y\" and \"z\"; no \"{name}\""))
            .and_then(number)
    };
    Ok(Value::Vector([part("x")?, part("y")?, part("z")?].into()))
}

/// Linear RGB, or sRGB where `encoded`; `#rrggbb` is always sRGB.
fn colour(text: &str, encoded: bool) -> Result<Value, String> {
    let decode = |c: [f64; 3]| c.map(spectrum::linear_from_srgb);
    if let Some(hex) = text.trim().strip_prefix('#') {
        let value = u32::from_str_radix(hex, 16)
            .ok()
            .filter(|_| hex.len() == 6)
            .ok_or_else(|| format!("expected \"#rrggbb\", found \"{}\"", shorten(text)))?;
        let channel = |shift: u32| f64::from((value >> shift) & 255) / 255.0;
        return Ok(Value::Colour(decode([channel(16), channel(8), channel(0)])));
    }
    let c = triple(text)?;
    Ok(Value::Colour(if encoded { decode(c) } else { c }))
}

fn black_body(attributes: &Attributes) -> Result<Value, String> {
    let kelvin = attribute(attributes, "temperature")
        .or_else(|| attribute(attributes, "value"))
        .ok_or("<blackbody> needs an attribute \"temperature\"")?;
    let kelvin = number(kelvin.trim().trim_end_matches(['K', 'k']))?;
    let scale = attribute(attributes, "scale").map_or(Ok(1.0), number)?;
    Ok(Value::Spectrum(Samples::BlackBody(kelvin, scale)))
}
