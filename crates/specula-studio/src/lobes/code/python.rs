//! Lobes of the Python package `specula_render`: its keywords are the text's keys.

use std::fmt::Write as _;

use specula_lobes::ParameterKind;

use super::{Metal, Said, reals};

/// The class of each kind.
fn class(kind: &str) -> &'static str {
    match kind {
        "lambert" => "Lambert",
        "eon" => "Eon",
        "diffuse-transmission" => "DiffuseTransmission",
        "smooth-conductor" => "SmoothConductor",
        "conductor" => "RoughConductor",
        "multibounce-conductor" => "MultibounceConductor",
        "smooth-dielectric" => "SmoothDielectric",
        "thin-dielectric" => "ThinDielectric",
        "dielectric" => "RoughDielectric",
        "multibounce-dielectric" => "MultibounceDielectric",
        "coated-diffuse" => "CoatedDiffuse",
        "layered" => "Layered",
        "plastic" => "Plastic",
        "principled" => "Principled",
        _ => "Gltf",
    }
}

pub(super) fn text(said: Said<'_>) -> String {
    let mut arguments = Vec::new();
    for (key, value) in said.0.given() {
        let Some(parameter) = said.0.kind().parameter(key) else {
            continue;
        };
        let is_of_metal = matches!(
            key,
            "conductor_eta" | "conductor_k" | "f0" | "f82_tint" | "tint"
        );
        if is_of_metal || parameter.kind == ParameterKind::Metal {
            continue;
        }
        let value = match parameter.kind {
            ParameterKind::Flag if value == "true" => "True".to_owned(),
            ParameterKind::Flag => "False".to_owned(),
            ParameterKind::Choice(_) => format!("\"{value}\""),
            _ if value.contains(',') => format!("({})", value.replace(',', ", ")),
            _ => value.to_owned(),
        };
        arguments.push(format!("{key}={value}"));
    }
    let is_metal = said.0.kind().takes_metals() && said.kind() != "layered";
    if let Some(metal) = said
        .reflectance()
        .filter(|m| is_metal || said.kind() == "layered" && is_given(said, *m))
    {
        arguments.push(format!("reflectance={}", reflectance(said, metal)));
    }
    let mut text = "import specula_render as sr\n\n".to_owned();
    let _ = writeln!(
        text,
        "lobe = sr.{}({})",
        class(said.kind()),
        arguments.join(", ")
    );
    text.push_str("f_cos, pdf = lobe.eval_pdf(wo, wi)\nsamples = lobe.sample(wo, seed=1)\n");
    text
}

/// Of a base: nothing is said where nothing is given.
fn is_given(said: Said<'_>, metal: Metal<'_>) -> bool {
    !matches!(metal, Metal::Constant(_)) || said.given("reflectance").is_some()
}

fn reflectance(said: Said<'_>, metal: Metal<'_>) -> String {
    let call = |name: &str, colours: &[[f64; 3]]| {
        let colours: Vec<String> = colours.iter().map(|c| format!("({})", reals(c))).collect();
        format!("sr.Reflectance.{name}({})", colours.join(", "))
    };
    let tinted = |text: String| match said.colour("tint") {
        Some(tint) => format!("{text}.tinted(({}))", reals(&tint)),
        None => text,
    };
    match metal {
        Metal::Measured(symbol, ..) if said.given("tint").is_none() => format!("\"{symbol}\""),
        Metal::Measured(symbol, ..) => tinted(format!("sr.Reflectance.metal(\"{symbol}\")")),
        Metal::Constant(colour) => tinted(call("constant", &[colour])),
        Metal::Index(eta, k) => tinted(call("conductor", &[eta, k])),
        Metal::Schlick(f0) => tinted(call("schlick", &[f0])),
        Metal::F82(f0, tint) => tinted(call("f82_tint", &[f0, tint])),
    }
}
