//! Lobes of the crate `specula-bsdf`, in double precision.

mod compound;

use self::compound::{coated, layered, parameters, plastic};
use super::{Metal, Said, Text, none, real, reals};

/// What the text's names come from, and the lobe.
pub(super) fn text(said: Said<'_>) -> Text {
    let mut text = String::new();
    let lobe = lobe(said)?;
    let all = [
        (
            "specula_bsdf::bsdf",
            [
                "Base",
                "CoatLayer",
                "CoatScattering",
                "CoatedDiffuse",
                "Compensated",
                "CompensatedDielectric",
                "DiffuseTransmission",
                "Eon",
                "Gltf",
                "GltfParameters",
                "Lambert",
                "Layered",
                "Medium",
                "MultibounceConductor",
                "MultibounceDielectric",
                "Plastic",
                "Principled",
                "PrincipledParameters",
                "RoughConductor",
                "RoughDielectric",
                "SmoothConductor",
                "SmoothDielectric",
                "ThinDielectric",
                "Tints",
            ]
            .as_slice(),
        ),
        ("specula_bsdf::energy", &["EnergyModel", "FmsVariant"]),
        (
            "specula_bsdf::fresnel",
            &["Conductor", "F82Tint", "Reflectance", "Schlick"],
        ),
        ("specula_bsdf::math", &["rgb", "vec3"]),
        ("specula_bsdf::multibounce", &["MisPdf", "MultibounceModel"]),
        ("specula_bsdf::ndf", &["Beckmann", "Ggx", "Masking"]),
        ("specula_bsdf::vndf", &["Sampler"]),
        ("specula_bsdf", &["Alpha", "Bsdf", "Transport"]),
    ];
    let use_of = "\nlet (wo, wi) = (vec3(0.6, 0.0, 0.8), vec3(0.0, 0.6, 0.8));\n\
        let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);\n\
        let sample = lobe.sample(wo, [0.1, 0.4, 0.7], Transport::Radiance);\n";
    let body = format!("let lobe = {lobe};\n{use_of}");
    for (module, names) in all {
        let used: Vec<&str> = names
            .iter()
            .copied()
            .filter(|name| has(&body, name))
            .collect();
        let used: Vec<&str> = if module == "specula_bsdf" {
            names
                .iter()
                .copied()
                .filter(|name| *name != "Alpha" || has(&body, name))
                .collect()
        } else {
            used
        };
        match used.as_slice() {
            [] => {}
            [one] => text.push_str(&format!("use {module}::{one};\n")),
            several => text.push_str(&format!("use {module}::{{{}}};\n", several.join(", "))),
        }
    }
    Ok(format!("{text}\n{body}"))
}

/// Whether a name stands in a text, on its own.
fn has(text: &str, name: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    text.split(|c| !is_word(c)).any(|word| word == name)
}

fn lobe(said: Said<'_>) -> Text {
    let colour = |key| rgb(said.tint(key));
    let number = |key| real(said.number(key));
    Ok(match said.kind() {
        "lambert" => format!("Lambert::new({})", colour("albedo")),
        "eon" => format!("Eon::new({}, {})", colour("albedo"), number("roughness")),
        "diffuse-transmission" => {
            let (r, t) = (colour("reflectance"), colour("transmittance"));
            format!("DiffuseTransmission::new({r}, {t})")
        }
        "smooth-conductor" => format!("SmoothConductor::new({})", reflectance(said)?),
        "conductor" => conductor(said)?,
        "multibounce-conductor" => format!(
            "MultibounceConductor::new({}, {}, {}){}",
            ndf(said, "alpha"),
            reflectance(said)?,
            model(said),
            mis(said)
        ),
        "smooth-dielectric" => format!("SmoothDielectric::new({}){}", number("eta"), tints(said)),
        "thin-dielectric" => format!("ThinDielectric::new({}){}", number("eta"), tints(said)),
        "dielectric" => {
            let name = if said.is("compensated", "true") {
                "CompensatedDielectric"
            } else {
                "RoughDielectric"
            };
            let (ndf, eta) = (ndf(said, "alpha"), number("eta"));
            format!(
                "{name}::new({ndf}, {eta}){}{}{}",
                masking(said),
                sampler(said),
                tints(said)
            )
        }
        "multibounce-dielectric" => format!(
            "MultibounceDielectric::new({}, {}, {}){}{}",
            ndf(said, "alpha"),
            number("eta"),
            model(said),
            mis(said),
            tints(said)
        ),
        "coated-diffuse" => coated(said),
        "layered" => layered(said)?,
        "plastic" => plastic(said),
        "principled" => parameters(said, "Principled"),
        _ => parameters(said, "Gltf"),
    })
}

fn rgb(colour: [f64; 3]) -> String {
    format!("rgb({})", reals(&colour))
}

/// A distribution of normals.
fn ndf(said: Said<'_>, key: &str) -> String {
    let alpha = match said.alpha(key) {
        Some([x, y]) if x == y => format!("Alpha::isotropic({})", real(x)),
        Some(alphas) => format!("Alpha::clamped({})", reals(&alphas)),
        None => "Alpha::isotropic(1.0)".to_owned(),
    };
    let name = if said.is("distribution", "beckmann") {
        "Beckmann"
    } else {
        "Ggx"
    };
    format!("{name}::new({alpha})")
}

fn perhaps(said: Said<'_>, key: &str) -> String {
    match said.given(key) {
        Some(_) => format!("Some({})", ndf(said, key)),
        None => "None".to_owned(),
    }
}

fn reflectance(said: Said<'_>) -> Text {
    let untinted = match said.reflectance() {
        Some(Metal::Constant(colour)) => format!("Reflectance::Constant({})", rgb(colour)),
        Some(Metal::Measured(_, eta, k) | Metal::Index(eta, k)) => {
            format!(
                "Reflectance::Conductor(Conductor {{ eta: {}, k: {} }})",
                rgb(eta),
                rgb(k)
            )
        }
        Some(Metal::Schlick(f0)) => format!("Reflectance::Schlick(Schlick {{ f0: {} }})", rgb(f0)),
        Some(Metal::F82(f0, tint)) => {
            format!(
                "Reflectance::F82Tint(F82Tint::new({}, {}))",
                rgb(f0),
                rgb(tint)
            )
        }
        None => return Err(none("Rust", "it has no reflectance")),
    };
    Ok(match said.colour("tint") {
        Some(tint) => format!("{untinted}.tinted({})", rgb(tint)),
        None => untinted,
    })
}

fn masking(said: Said<'_>) -> String {
    match said.given("masking") {
        Some("separable") => ".with_masking(Masking::Separable)".to_owned(),
        Some(_) => ".with_masking(Masking::HeightCorrelated)".to_owned(),
        None => String::new(),
    }
}

fn sampler(said: Said<'_>) -> String {
    let variant = match said.given("sampler") {
        None => return String::new(),
        Some("heitz") => "Heitz",
        Some("cap") => "Cap",
        Some("bounded") => "Bounded",
        Some(_) => "Exact",
    };
    format!(".with_sampler(Sampler::{variant})")
}

fn conductor(said: Said<'_>) -> Text {
    let (ndf, metal) = (ndf(said, "alpha"), reflectance(said)?);
    let made = match said.word("energy") {
        None => format!("RoughConductor::new({ndf}, {metal})"),
        Some(model) => {
            let model = match model {
                "turquin" => "Turquin(FmsVariant::NormalIncidence)",
                "turquin-series" => "Turquin(FmsVariant::AverageSeries)",
                _ => "KullaConty",
            };
            format!("Compensated::new({ndf}, {metal}, EnergyModel::{model})")
        }
    };
    Ok(format!("{made}{}{}", masking(said), sampler(said)))
}

fn model(said: Said<'_>) -> &'static str {
    match said.word("model").unwrap_or("specula") {
        "heitz" => "MultibounceModel::Heitz2016",
        "bitterli" => "MultibounceModel::BitterliDeon2022",
        "wang" => "MultibounceModel::Wang2022 { correlated: true }",
        "wang-uncorrelated" => "MultibounceModel::Wang2022 { correlated: false }",
        "cui" => "MultibounceModel::Cui2023 { bidirectional: false }",
        "cui-bidirectional" => "MultibounceModel::Cui2023 { bidirectional: true }",
        _ => "MultibounceModel::StratifiedBidirectional",
    }
}

fn mis(said: Said<'_>) -> &'static str {
    match said.given("mis_pdf") {
        None => "",
        Some("hapke") => ".with_mis_pdf(MisPdf::Hapke)",
        Some("lambert") => ".with_mis_pdf(MisPdf::Lambert)",
        Some(_) => ".with_mis_pdf(MisPdf::Normalised)",
    }
}

fn tints(said: Said<'_>) -> String {
    if said.is_white("reflection_tint") && said.is_white("transmission_tint") {
        return String::new();
    }
    let [r, t] = ["reflection_tint", "transmission_tint"].map(|key| rgb(said.tint(key)));
    format!(".with_tints(Tints {{ reflection: {r}, transmission: {t} }})")
}
