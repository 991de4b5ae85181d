//! Indices of refraction that Mitsuba knows by name.

use super::context::Context;
use super::element::Element;
use super::value::Value;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};

/// At about 589 nm and 0 to 20 degrees Celsius. Source: Hecht, Optics, 4th edition, and common
/// tables; the values that Mitsuba's documentation lists.
const INDICES: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.472_9),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.504_6),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

impl Context<'_> {
    /// `int_ior` over `ext_ior`; `inside` names the default of the first.
    pub(super) fn relative_index(
        &self,
        element: &Element,
        inside: &str,
    ) -> Result<f32, SceneError> {
        let inside = index(element, "int_ior", inside)?;
        let outside = index(element, "ext_ior", "air")?;
        Ok(f32_of(inside / outside))
    }
}

fn index(element: &Element, name: &str, default: &str) -> Result<f64, SceneError> {
    let lookup = |word: &str| {
        let lower = word.trim().to_ascii_lowercase();
        INDICES.iter().find(|(n, _)| *n == lower).map(|i| i.1)
    };
    let Some(property) = element.find(name) else {
        return Ok(lookup(default).unwrap_or(1.0));
    };
    match &property.value {
        Value::Text(word) => lookup(word).ok_or_else(|| {
            let names: Vec<&str> = INDICES.iter().map(|i| i.0).collect();
            let message = format!("\"{name}\": no material is called \"{}\"", shorten(word));
            SceneError::new(ErrorKind::UnknownName, &property.place, message)
                .with_help(format!("expected a number or one of {}", names.join(", ")))
        }),
        _ => element.above_zero(name, 1.0),
    }
}
