//! Materials of pbrt-v3.

use super::Change;
use crate::pbrt::param::{Param, ParamList, Values};

/// Materials that pbrt-v3 alone has.
pub(super) const OLD: [&str; 11] = [
    "matte",
    "plastic",
    "uber",
    "metal",
    "glass",
    "mirror",
    "substrate",
    "translucent",
    "disney",
    "kdsubsurface",
    "fourier",
];

/// The opacity of `uber`, which its shapes take for their `alpha`.
pub(in crate::pbrt) const OPACITY: &str = "pbrt-v3 opacity";

/// Whether a named material's type is of pbrt-v3.
pub(super) fn is_old_type(params: &ParamList) -> bool {
    type_of(params).is_some_and(|kind| OLD.contains(&kind))
        || params.own("namedmaterial1").is_some()
}

fn type_of(params: &ParamList) -> Option<&str> {
    match params.own("type") {
        Some(Param {
            values: Values::Texts(texts),
            ..
        }) => texts.first().map(|(t, _)| t.as_str()),
        _ => None,
    }
}

/// `MakeNamedMaterial`.
pub(super) fn named(change: &mut Change<'_>) {
    let mut kind = type_of(change.params).unwrap_or("matte").to_owned();
    let place = change
        .params
        .own("type")
        .map_or(change.place, |p| &p.place)
        .clone();
    material(&mut kind, change);
    change.params.set_texts("string", "type", &[&kind], &place);
}

/// Gives a material its name in pbrt-v4, and its parameters.
pub(super) fn material(name: &mut String, change: &mut Change<'_>) {
    let title = name.clone();
    change.params.rename("bumpmap", "displacement");
    if matches!(title.as_str(), "glass" | "uber") {
        index(change, &title);
    }
    let new = match title.as_str() {
        "uber" => {
            let new = dull(change, &title);
            change.remove_constant("Kr", 0.0, &title);
            change.remove_constant("Kt", 0.0, &title);
            opacity(change);
            new
        }
        "plastic" => dull(change, &title),
        "substrate" => {
            change.remove_constant("Ks", 1.0, &title);
            change.params.rename("Kd", "reflectance");
            "coateddiffuse"
        }
        "glass" => {
            change.remove_constant("Kr", 1.0, &title);
            change.remove_constant("Kt", 1.0, &title);
            "dielectric"
        }
        "matte" => {
            change.params.rename("Kd", "reflectance");
            change.remove(&["sigma"]);
            "diffuse"
        }
        "metal" => {
            change.remove_constant("Kr", 1.0, &title);
            "conductor"
        }
        "mirror" => mirror(change, &title),
        "translucent" => translucent(change, &title),
        "disney" => disney(change),
        "kdsubsurface" => {
            change.params.rename("Kd", "reflectance");
            "subsurface"
        }
        "fourier" => {
            let place = change.place.clone();
            change.remove(&["bsdffile"]);
            change.warn(
                &place,
                "material \"fourier\" of pbrt-v3 is not supported: diffuse grey of 0.5 is used",
            );
            "diffuse"
        }
        "hair" => {
            change.params.rename("color", "reflectance");
            return;
        }
        "mix" => return mix(change),
        "" | "none" => "interface",
        _ => return,
    };
    new.clone_into(name);
}

/// `index`, which pbrt-v4 calls `eta`.
fn index(change: &mut Change<'_>, title: &str) {
    let is_texture = change
        .params
        .own("index")
        .is_some_and(|p| p.kind == "texture");
    if is_texture {
        change.remove_constant("index", 1.5, title);
    }
    change.params.rename("index", "eta");
}

/// Paint under a coat, or without one where nothing is reflected.
fn dull(change: &mut Change<'_>, title: &str) -> &'static str {
    let is_bare = change.remove_constant("Ks", 0.0, title);
    change.params.rename("Kd", "reflectance");
    if !is_bare {
        return "coateddiffuse";
    }
    change.remove(&[
        "eta",
        "roughness",
        "uroughness",
        "vroughness",
        "remaproughness",
    ]);
    "diffuse"
}

/// pbrt-v4 refuses what is not opaque; here shapes let light pass.
fn opacity(change: &mut Change<'_>) {
    if change.params.own_numbers("opacity", "rgb") == Some(&[1.0; 3]) {
        change.remove(&["opacity"]);
    }
    change.params.rename("opacity", OPACITY);
}

fn mirror(change: &mut Change<'_>, title: &str) -> &'static str {
    let place = change.place.clone();
    change.remove_constant("Kr", 0.0, title);
    change.params.set_float("roughness", 0.0, &place);
    for (name, spectrum) in [("eta", "metal-Ag-eta"), ("k", "metal-Ag-k")] {
        change
            .params
            .set_texts("spectrum", name, &[spectrum], &place);
    }
    "conductor"
}

fn translucent(change: &mut Change<'_>, title: &str) -> &'static str {
    change.params.rename("Kd", "transmittance");
    change.remove_constant("reflect", 0.0, title);
    change.remove_constant("transmit", 1.0, title);
    change.remove_constant("Ks", 0.0, title);
    change.remove(&["roughness", "remaproughness"]);
    "diffusetransmission"
}

fn disney(change: &mut Change<'_>) -> &'static str {
    let place = change.place.clone();
    change.params.rename("color", "reflectance");
    change.warn(
        &place,
        "material \"disney\" of pbrt-v3 is diffuse of its \"color\", as by pbrt-v4's `--upgrade`",
    );
    change.remove(&[
        "anisotropic",
        "clearcoat",
        "clearcoatgloss",
        "eta",
        "metallic",
        "roughness",
    ]);
    change.remove(&[
        "scatterdistance",
        "sheen",
        "sheentint",
        "spectrans",
        "speculartint",
    ]);
    change.remove(&["thin", "difftrans", "flatness"]);
    "diffuse"
}

/// The first of pbrt-v3's materials is the second of pbrt-v4's.
fn mix(change: &mut Change<'_>) {
    if let Some(amount) = change.take_number("amount") {
        let place = change.place.clone();
        change.params.set_float("amount", amount, &place);
    }
    let part = |change: &mut Change<'_>, name: &str| match change.params.remove(name) {
        Some(Param {
            values: Values::Texts(texts),
            ..
        }) => texts.into_iter().next(),
        _ => None,
    };
    let (first, second) = (
        part(change, "namedmaterial1"),
        part(change, "namedmaterial2"),
    );
    if let (Some((first, place)), Some((second, _))) = (first, second) {
        change
            .params
            .set_texts("string", "materials", &[&second, &first], &place);
    }
}
