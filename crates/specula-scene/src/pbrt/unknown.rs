//! Suggestions for unknown directives.

use crate::error::{ErrorKind, Place, SceneError};
use crate::num::shorten;

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

/// Whether a word is a directive.
pub(super) fn is_directive(word: &str) -> bool {
    DIRECTIVES.contains(&word)
}

/// The directive that a word is a clear misspelling of: a check goes on as if it were that.
pub(super) fn meant(word: &str) -> Option<&'static str> {
    let (edits, directive) = nearest(word)?;
    let letters = |word: &str| {
        let mut bytes = word.as_bytes().to_vec();
        bytes.sort_unstable();
        bytes
    };
    // Two edits are much, unless letters changed places or the word is long.
    let is_near = match edits {
        1 => word.len() >= 4,
        2 => word.len() >= 8 || letters(word) == letters(directive),
        _ => false,
    };
    is_near.then_some(directive)
}

/// The error for a word that is no directive, with the nearest one that is.
pub(super) fn directive(word: &str, place: &Place) -> SceneError {
    let message = format!("unknown directive `{}`", shorten(word));
    let error = SceneError::new(ErrorKind::UnknownDirective, place, message);
    match nearest(word) {
        Some((d, directive)) if d <= 3 => error.with_help(format!("did you mean `{directive}`?")),
        _ => {
            error.with_help("expected a directive of pbrt-v4, such as `Shape` or `AttributeBegin`")
        }
    }
}

/// The nearest directive, and how many edits away it is.
fn nearest(word: &str) -> Option<(usize, &'static str)> {
    DIRECTIVES.iter().map(|d| (distance(word, d), *d)).min()
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
    use super::{distance, meant};

    #[test]
    fn edits_are_counted() {
        assert_eq!(distance("Shape", "Shape"), 0);
        assert_eq!(distance("Shpae", "Shape"), 2);
        assert_eq!(distance("", "Scale"), 5);
    }

    #[test]
    fn only_what_is_nearly_right_is_taken_for_a_directive() {
        assert_eq!(meant("Shpae"), Some("Shape"));
        assert_eq!(meant("Scene"), None, "not `Scale`");
        assert_eq!(meant("Shap"), Some("Shape"));
        assert_eq!(meant("AttributeBgein"), Some("AttributeBegin"));
        assert_eq!(meant("garbage"), None);
    }
}
