//! Lights of pbrt-v3.

use super::Change;
use crate::pbrt::param::Values;

/// `LightSource`.
pub(super) fn light(name: &mut String, change: &mut Change<'_>) {
    if name == "exinfinite" {
        "infinite".clone_into(name);
    }
    let mut scale = scale_of(change);
    change.remove(&["samples", "nsamples"]);
    if change.params.own("mapname").is_some() {
        // pbrt-v4 takes no colour beside a picture.
        let colour = match name.as_str() {
            "infinite" => "L",
            _ => "I",
        };
        scale *= change.take_number(colour).unwrap_or(1.0);
    }
    scale *= blackbody(change, "I") * blackbody(change, "L");
    change.params.rename("mapname", "filename");
    set_scale(change, scale);
}

/// `AreaLightSource`.
pub(super) fn area(name: &mut String, change: &mut Change<'_>) {
    if name == "area" {
        "diffuse".clone_into(name);
    }
    let scale = scale_of(change) * blackbody(change, "L");
    change.remove(&["samples", "nsamples"]);
    set_scale(change, scale);
}

/// The colour `scale`, which is a number in pbrt-v4.
fn scale_of(change: &mut Change<'_>) -> f64 {
    change.take_number("scale").unwrap_or(1.0)
}

/// Takes the second value of a blackbody, which scales it.
fn blackbody(change: &mut Change<'_>, name: &str) -> f64 {
    let params = change.params.own_mut();
    let mut scale = 1.0;
    for param in params.filter(|p| p.name == name && p.kind == "blackbody") {
        if let Values::Numbers(numbers) = &mut param.values
            && numbers.len() == 2
        {
            scale *= numbers.pop().unwrap_or(1.0);
        }
    }
    scale
}

fn set_scale(change: &mut Change<'_>, scale: f64) {
    if scale != 1.0 {
        let own = change.params.own_numbers("scale", "float");
        let own = own.and_then(|n| n.first().copied()).unwrap_or(1.0);
        let place = change.place.clone();
        change.params.set_float("scale", scale * own, &place);
    }
}
