//! Suggestions for words that are no directives.

use super::token::shorten;
use crate::error::{ErrorKind, Place, SceneError};

/// Every directive, for suggestions.
const DIRECTIVES: [&str; 41] = [
    "Accelerator",
    "ActiveTransform",
    "AreaLightSource",
    "Attribute",
    "AttributeBegin",
    "AttributeEnd",
    "Camera",
    "ColorSpace",
    "ConcatTransform",
    "CoordSysTransform",
    "CoordinateSystem",
    "Film",
    "Identity",
    "Import",
    "Include",
    "Integrator",
    "LightSource",
    "LookAt",
    "MakeNamedMaterial",
    "MakeNamedMedium",
    "Material",
    "MediumInterface",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "Option",
    "PixelFilter",
    "ReverseOrientation",
    "Rotate",
    "Sampler",
    "Scale",
    "Shape",
    "Texture",
    "Transform",
    "TransformBegin",
    "TransformEnd",
    "TransformTimes",
    "Translate",
    "WorldBegin",
    "WorldEnd",
];

/// The error for a word that is no directive, with the nearest one that is.
pub(super) fn directive(word: &str, place: &Place) -> SceneError {
    let message = format!("unknown directive `{}`", shorten(word));
    let error = SceneError::new(ErrorKind::UnknownDirective, place, message);
    let nearest = DIRECTIVES.iter().map(|d| (distance(word, d), d)).min();
    match nearest {
        Some((d, directive)) if d <= 3 => error.with_help(format!("did you mean `{directive}`?")),
        _ => {
            error.with_help("expected a directive of pbrt-v4, such as `Shape` or `AttributeBegin`")
        }
    }
}

/// Edits that make one word the other (Levenshtein); words beyond 40 bytes are far from all.
fn distance(a: &str, b: &str) -> usize {
    if a.len() > 40 {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.bytes().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::distance;

    #[test]
    fn edits_are_counted() {
        assert_eq!(distance("Shape", "Shape"), 0);
        assert_eq!(distance("Shpae", "Shape"), 2);
        assert_eq!(distance("", "Scale"), 5);
    }
}
