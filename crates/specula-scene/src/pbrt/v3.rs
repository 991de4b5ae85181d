//! Files of pbrt-v3: what tells them, and their names in pbrt-v4, by the rules of its `--upgrade`.
//!
//! Source: `FormattingParserTarget` in pbrt-v4's `parser.cpp`. Departures: what it refuses is read as near
//! as may be, with a warning, and pictures of the sky stay latitude and longitude.

mod features;
mod light;
mod material;
mod names;
mod options;
mod texture;

use std::sync::Arc;

use super::context::{Context, Entity};
use super::param::{Param, ParamList, Values};
use crate::error::{Place, SourceText, Warning};

pub(crate) use features::FEATURES;
pub(super) use material::OPACITY;
pub(super) use names::{Kind, Names};
pub(super) use texture::texture;

/// The only warning about the version.
const READ_AS: &str =
    "the file is read as pbrt-v3, with the names that pbrt-v4's `--upgrade` gives it";

/// Names that pbrt-v3 alone has, by the directive before them.
const MARKERS: &[(&str, &[&str])] = &[
    ("Film", &["image"]),
    ("Material", &material::OLD),
    (
        "Sampler",
        &["lowdiscrepancy", "02sequence", "maxmindist", "random"],
    ),
    ("Integrator", &["directlighting", "whitted", "ao"]),
    ("Camera", &["environment"]),
    ("AreaLightSource", &["area"]),
    ("LightSource", &["exinfinite"]),
    ("Shape", &GONE),
];

/// Shapes that pbrt-v4 has no more.
const GONE: [&str; 5] = ["cone", "paraboloid", "hyperboloid", "heightfield", "nurbs"];

/// How much of a file's beginning, and of its end, is searched for marks.
const SEARCHED: usize = 1 << 18;

/// Whether a name after a directive tells that the file is of pbrt-v3.
pub(super) fn is_marker(directive: &str, name: &str) -> bool {
    MARKERS
        .iter()
        .any(|(d, names)| *d == directive && names.contains(&name))
}

/// What tells that a text is of pbrt-v3, if anything does.
pub(super) fn find(source: &Arc<SourceText>) -> Option<Place> {
    let text = source.text();
    let head = &text[..text.floor_char_boundary(SEARCHED)];
    let at_name = MARKERS.iter().flat_map(|(directive, _)| {
        let found = head.match_indices(directive);
        found.filter_map(move |(at, word)| {
            let rest = head[at + word.len()..].trim_start().strip_prefix('"')?;
            let name = rest.split('"').next()?;
            (stands_alone(text, at) && is_marker(directive, name)).then_some((at, word.len()))
        })
    });
    let first = at_name.min();
    let tail = text.ceil_char_boundary(text.len().saturating_sub(SEARCHED));
    let ends = || {
        let at = tail + text[tail..].rfind("WorldEnd")?;
        stands_alone(text, at).then_some((at, "WorldEnd".len()))
    };
    let (at, length) = first.or_else(ends)?;
    Some(Place::new(source, at, length))
}

/// Whether what is at an offset begins a word outside of a comment.
fn stands_alone(text: &str, at: usize) -> bool {
    let line = text[..at].rfind('\n').map_or(0, |i| i + 1);
    let before = &text[line..at];
    !before.contains('#') && before.chars().next_back().is_none_or(char::is_whitespace)
}

impl Context {
    /// From here on the file is read as one of pbrt-v3.
    pub(super) fn turn_v3(&mut self, place: &Place) {
        if self.v3.is_none() {
            self.v3 = Some(Names::default());
            self.warnings.push(Warning::new(place, READ_AS));
        }
    }

    /// Gives a directive the names of pbrt-v4, where the file is of pbrt-v3.
    pub(super) fn upgraded(&mut self, directive: &str, entity: &mut Entity) {
        if is_marker(directive, &entity.name)
            || directive == "MakeNamedMaterial" && material::is_old_type(&entity.params)
        {
            self.turn_v3(&entity.place);
        }
        let Some(names) = &self.v3 else {
            return;
        };
        names.use_textures(&mut entity.params);
        let mut change = Change {
            params: &mut entity.params,
            warnings: &mut self.warnings,
            place: &entity.place,
        };
        match directive {
            "Material" => material::material(&mut entity.name, &mut change),
            "MakeNamedMaterial" => material::named(&mut change),
            "LightSource" => light::light(&mut entity.name, &mut change),
            "AreaLightSource" => light::area(&mut entity.name, &mut change),
            "MakeNamedMedium" => options::medium(&mut change),
            "Shape" => options::shape(&entity.name, &mut change),
            "Film" => options::film(&mut entity.name, &mut change),
            "PixelFilter" => options::filter(&entity.name, &mut change),
            "Sampler" => options::sampler(&mut entity.name, &mut change),
            "Integrator" => options::integrator(&mut entity.name, &mut change),
            "Camera" => options::camera(&mut entity.name, &mut change),
            _ => {}
        }
        names.use_materials(&mut entity.params);
    }
}

/// A directive's parameters while they are changed.
struct Change<'a> {
    params: &'a mut ParamList,
    warnings: &'a mut Vec<Warning>,
    /// The place of the directive's name.
    place: &'a Place,
}

impl Change<'_> {
    fn warn(&mut self, place: &Place, message: impl Into<String>) {
        self.warnings.push(Warning::new(place, message));
    }

    /// Takes parameters away.
    fn remove(&mut self, names: &[&str]) {
        for name in names {
            self.params.remove(name);
        }
    }

    /// Takes a colour away, with a warning where it is not `value` in all channels.
    ///
    /// * Returns: whether it is.
    fn remove_constant(&mut self, name: &str, value: f64, title: &str) -> bool {
        let Some(param) = self.params.remove(name) else {
            return false;
        };
        let is =
            matches!(&param.values, Values::Numbers(n) if param.kind == "rgb" && n == &[value; 3]);
        if !is {
            let message = format!(
                "\"{name}\" of pbrt-v3's \"{title}\" is left out, as by pbrt-v4's `--upgrade`"
            );
            self.warn(&param.place, message);
        }
        is
    }

    /// Takes a colour away, as a number: its mean where it varies, with a warning.
    fn take_number(&mut self, name: &str) -> Option<f64> {
        let values: Vec<f64> = match self.params.own(name)? {
            Param {
                kind: "rgb",
                values: Values::Numbers(numbers),
                ..
            } => numbers.clone(),
            // Pairs of wavelength and value.
            Param {
                kind: "spectrum",
                values: Values::Numbers(numbers),
                ..
            } => numbers.iter().skip(1).step_by(2).copied().collect(),
            _ => return None,
        };
        let first = *values.first()?;
        let param = self.params.remove(name)?;
        if values.iter().any(|v| *v != first) {
            let message =
                format!("\"{name}\" is a number in pbrt-v4: the mean of its values is used");
            self.warn(&param.place, message);
            return Some(values.iter().sum::<f64>() / values.len() as f64);
        }
        Some(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Option<usize> {
        find(&SourceText::new("a", text)).map(|place| place.line())
    }

    #[test]
    fn marks_of_the_version_are_found_outside_of_comments_and_strings() {
        assert_eq!(found("Camera \"perspective\"\nFilm\n\"image\""), Some(2));
        assert_eq!(found("WorldBegin\nMaterial \"matte\""), Some(2));
        assert_eq!(
            found("# Film \"image\"\nFilm \"rgb\"\nWorldBegin # WorldEnd"),
            None
        );
        assert_eq!(found("WorldBegin\nShape \"sphere\"\nWorldEnd\n"), Some(3));
        assert_eq!(found("WorldBegin\nNamedMaterial \"matte\""), None);
        assert_eq!(
            found("Material \"diffuse\" \"string note\" \"Material\""),
            None
        );
        assert_eq!(found("ü".repeat(SEARCHED).as_str()), None);
    }
}
