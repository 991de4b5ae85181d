//! Everything before `WorldBegin` in pbrt-v3, media and shapes.

use super::Change;
use crate::pbrt::param::Values;

/// `Film`.
pub(super) fn film(name: &mut String, change: &mut Change<'_>) {
    if name == "image" {
        "rgb".clone_into(name);
    }
    change
        .params
        .rename("maxsampleluminance", "maxcomponentvalue");
    if let Some(scale) = number(change, "scale") {
        let place = change.place.clone();
        change.params.set_float("iso", 100.0 * scale, &place);
        change.remove(&["scale"]);
    }
}

/// `PixelFilter`.
pub(super) fn filter(name: &str, change: &mut Change<'_>) {
    change.params.rename("xwidth", "xradius");
    change.params.rename("ywidth", "yradius");
    if name == "gaussian"
        && let Some(alpha) = number(change, "alpha").filter(|a| *a > 0.0)
    {
        let place = change.place.clone();
        change
            .params
            .set_float("sigma", 1.0 / (2.0 * alpha).sqrt(), &place);
        change.remove(&["alpha"]);
    }
}

/// `Sampler`.
pub(super) fn sampler(name: &mut String, change: &mut Change<'_>) {
    let new = match name.as_str() {
        "lowdiscrepancy" | "02sequence" => "paddedsobol",
        "maxmindist" => "pmj02bn",
        "random" => "independent",
        _ => name.as_str(),
    };
    *name = new.to_owned();
    change.remove(&["dimensions", "samplepixelcenter"]);
}

/// `Integrator`.
pub(super) fn integrator(name: &mut String, change: &mut Change<'_>) {
    change.remove(&["rrthreshold", "imagewritefrequency", "numiterations"]);
    change.remove(&["lightsamplestrategy", "strategy", "nsamples", "pixelbounds"]);
    match name.as_str() {
        "directlighting" => {
            "path".clone_into(name);
            let place = change.place.clone();
            change
                .params
                .set("integer", "maxdepth", Values::Numbers(vec![1.0]), &place);
        }
        "whitted" => {
            let place = change.place.clone();
            change.warn(
                &place,
                "integrator \"whitted\" is not supported: paths are traced",
            );
            "path".clone_into(name);
        }
        "ao" => "ambientocclusion".clone_into(name),
        _ => {}
    }
}

/// `Camera`.
pub(super) fn camera(name: &mut String, change: &mut Change<'_>) {
    let place = change.place.clone();
    if name == "environment" {
        "spherical".clone_into(name);
        change
            .params
            .set_texts("string", "mapping", &["equirectangular"], &place);
    }
    change.remove(&["simpleweighting"]);
    if let Some(half) = number(change, "halffov") {
        change.params.set_float("fov", 2.0 * half, &place);
        change.remove(&["halffov"]);
    }
}

/// `MakeNamedMedium`.
pub(super) fn medium(change: &mut Change<'_>) {
    for param in change.params.own_mut().filter(|p| p.name == "type") {
        if let Values::Texts(texts) = &mut param.values {
            for (kind, _) in texts.iter_mut().filter(|(k, _)| k == "heterogeneous") {
                "uniformgrid".clone_into(kind);
            }
        }
    }
}

/// `Shape`.
pub(super) fn shape(name: &str, change: &mut Change<'_>) {
    change.remove(&["discarddegenerateUVs", "shadowalpha"]);
    change.params.rename("nlevels", "levels");
    if name == "trianglemesh" {
        change.params.rename("st", "uv");
    }
}

/// The only number of a parameter of type `float`.
fn number(change: &Change<'_>, name: &str) -> Option<f64> {
    match change.params.own_numbers(name, "float") {
        Some(&[x]) => Some(x),
        _ => None,
    }
}
