//! The 0.6 dialect: names in camel case, and a few parameters that were called otherwise.

use std::rc::Rc;

use glam::{DMat4, DVec3};

use super::element::{Element, Property};
use super::value::Value;

/// Renames the properties of a plugin of the 0.6 dialect as Mitsuba 3 calls them.
pub(super) fn upgrade(element: &mut Element) {
    for property in &mut element.properties {
        property.name = snake_case(&property.name);
    }
    let rename = |element: &mut Element, from: &str, to: &str| {
        if !element.has(to)
            && let Some(p) = element.properties.iter_mut().find(|p| p.name == from)
        {
            to.clone_into(&mut p.name);
        }
    };
    if element.plugin == "diffuse" || element.plugin == "roughdiffuse" {
        rename(element, "diffuse_reflectance", "reflectance");
    }
    if element.class == "texture" {
        gather_uv(element);
    }
}

/// `uoffset`, `voffset`, `uscale` and `vscale` as `to_uv`; Mitsuba 3 applies the offset first.
fn gather_uv(element: &mut Element) {
    let number = |element: &Element, name: &str, default: f64| {
        let found = element.properties.iter().find(|p| p.name == name);
        match found.map(|p| &p.value) {
            Some(Value::Number(x)) => *x,
            #[expect(clippy::cast_precision_loss, reason = "far beyond any sensible value")]
            Some(Value::Integer(x)) => *x as f64,
            _ => default,
        }
    };
    let names = ["uoffset", "voffset", "uscale", "vscale"];
    let Some(place) = names
        .iter()
        .find_map(|n| element.has(n).then(|| element.place_of(n)))
    else {
        return;
    };
    let offset = DVec3::new(
        number(element, "uoffset", 0.0),
        number(element, "voffset", 0.0),
        0.0,
    );
    let scale = DVec3::new(
        number(element, "uscale", 1.0),
        number(element, "vscale", 1.0),
        1.0,
    );
    element
        .properties
        .retain(|p| !names.contains(&p.name.as_str()));
    let damaged = Rc::clone(&element.damaged);
    element.properties.push(Property {
        damaged,
        name: "to_uv".to_owned(),
        value: Value::Transform(DMat4::from_scale(scale) * DMat4::from_translation(offset)),
        place,
        used: std::cell::Cell::new(false),
    });
}

/// `intIOR` as `int_ior`: a capital after a small letter begins a word.
fn snake_case(name: &str) -> String {
    let mut out = String::with_capacity(name.len() + 4);
    let mut previous = ' ';
    for c in name.chars() {
        let begins = c.is_ascii_uppercase() && previous.is_ascii_lowercase();
        if begins {
            out.push('_');
        }
        let inside = c.is_ascii_uppercase() && previous.is_ascii_uppercase() && out.contains('_');
        if begins || inside {
            out.push(c.to_ascii_lowercase());
        } else {
            out.push(c);
        }
        previous = c;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn camel_case_becomes_snake_case() {
        for (old, new) in [
            ("toWorld", "to_world"),
            ("intIOR", "int_ior"),
            ("maxDepth", "max_depth"),
            ("alphaU", "alpha_u"),
            ("cropOffsetX", "crop_offset_x"),
            ("already_new", "already_new"),
            ("B", "B"),
        ] {
            assert_eq!(snake_case(old), new);
        }
    }
}
