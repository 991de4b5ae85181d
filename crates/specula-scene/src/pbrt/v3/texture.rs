//! Textures of pbrt-v3.

use super::Change;
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::param::Values;

/// Gives a texture the names of pbrt-v4, where the file is of pbrt-v3.
pub(in crate::pbrt) fn texture(context: &mut Context, is_float: bool, entity: &mut Entity) {
    let Some(names) = &context.v3 else {
        return;
    };
    names.use_textures(&mut entity.params);
    let mut change = Change {
        params: &mut entity.params,
        warnings: &mut context.warnings,
        place: &entity.place,
    };
    match entity.name.as_str() {
        "scale" if is_float => {
            change.params.rename("tex1", "tex");
            change.params.rename("tex2", "scale");
        }
        "scale" => scale(&mut change),
        "imagemap" | "ptex" => imagemap(&mut change),
        "checkerboard" => change.remove(&["aamode"]),
        "uv" => {
            let place = change.place.clone();
            change.warn(
                &place,
                "texture \"uv\" of pbrt-v3 is not supported: 0.5 everywhere is used",
            );
            change.params.set_float("value", 0.5, &place);
            if !is_float {
                change
                    .params
                    .set("rgb", "value", Values::Numbers(vec![0.5; 3]), &place);
            }
            "constant".clone_into(&mut entity.name);
        }
        _ => {}
    }
}

/// A colour times another, of which pbrt-v4 takes one as a number; two textures are multiplied as they are.
fn scale(change: &mut Change<'_>) {
    let is_number = |name: &str| matches!(change.params.own_numbers(name, "rgb"), Some(&[r, g, b]) if r == g && g == b);
    let (tex, by) = match (is_number("tex1"), is_number("tex2")) {
        (true, false) => ("tex2", "tex1"),
        _ => ("tex1", "tex2"),
    };
    change.params.rename(tex, "tex");
    if is_number_of(change, by) {
        if let Some(x) = change.take_number(by) {
            let place = change.place.clone();
            change.params.set_float("scale", x, &place);
        }
    } else {
        change.params.rename(by, "scale");
    }
}

fn is_number_of(change: &Change<'_>, name: &str) -> bool {
    matches!(change.params.own_numbers(name, "rgb"), Some(&[r, g, b]) if r == g && g == b)
}

fn imagemap(change: &mut Change<'_>) {
    let place = change.place.clone();
    if let Some(param) = change.params.remove("trilinear")
        && let Values::Bools(values) = &param.values
    {
        let filter = if values.first() == Some(&true) {
            "trilinear"
        } else {
            "bilinear"
        };
        change
            .params
            .set_texts("string", "filter", &[filter], &place);
    }
    let Some(param) = change.params.remove("gamma") else {
        return;
    };
    let encoding = match &param.values {
        Values::Bools(values) if values.first() == Some(&false) => "linear".to_owned(),
        Values::Numbers(numbers) if numbers.first().is_some_and(|g| *g > 0.0) => {
            format!("gamma {}", numbers[0])
        }
        _ => "sRGB".to_owned(),
    };
    change
        .params
        .set_texts("string", "encoding", &[&encoding], &param.place);
}
