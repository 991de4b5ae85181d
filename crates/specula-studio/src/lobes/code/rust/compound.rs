//! Lobes of several in Rust: coats, layers, plastics, lobes of many parameters.

use super::{Said, Text, ndf, perhaps, real, reflectance, rgb};

pub(super) fn coated(said: Said<'_>) -> String {
    let depth = said
        .given("max_depth")
        .map_or("None".to_owned(), |d| format!("Some({d})"));
    let scattering = if said.is("scattering", "single") {
        "Single"
    } else {
        "Lossless"
    };
    format!(
        "CoatedDiffuse::over_layer({}, {}, {}, CoatLayer {{\n    thickness: {},\n    max_depth: {depth},\n    \
         scattering: CoatScattering::{scattering},\n}})",
        perhaps(said, "alpha"),
        real(said.number("eta")),
        rgb(said.tint("albedo")),
        real(said.number("thickness"))
    )
}

pub(super) fn layered(said: Said<'_>) -> Text {
    let base = match said.colour("albedo") {
        Some(albedo) => format!("Base::diffuse({})", rgb(albedo)),
        None => format!(
            "Base::metal({}, {})",
            perhaps(said, "base_alpha"),
            reflectance(said)?
        ),
    };
    let medium = format!(
        "Medium {{ thickness: {}, albedo: {}, g: {} }}",
        real(said.number("thickness")),
        rgb(said.tint("medium_albedo")),
        real(said.number("g"))
    );
    let (coat, eta) = (perhaps(said, "alpha"), real(said.number("eta")));
    Ok(format!(
        "Layered::new({coat}, {eta}, {base}).with_medium({medium})"
    ))
}

pub(super) fn plastic(said: Said<'_>) -> String {
    let rest = format!(
        "{}, {}, {}, {}",
        real(said.number("eta")),
        rgb(said.tint("diffuse")),
        rgb(said.tint("specular")),
        said.word("nonlinear").unwrap_or("false")
    );
    if said.given("alpha").is_none() {
        return format!("Plastic::<f64>::smooth({rest})");
    }
    let masking = if said.is("masking", "separable") {
        "Separable"
    } else {
        "HeightCorrelated"
    };
    format!(
        "Plastic::rough({}, Masking::{masking}, {rest})",
        ndf(said, "alpha")
    )
}

/// A lobe of many parameters: those that are given, and the defaults.
pub(super) fn parameters(said: Said<'_>, name: &str) -> String {
    let field = |(key, value): (&'static str, &str)| {
        let value = match said.0.kind().parameter(key).map(|p| p.kind) {
            Some(specula_lobes::ParameterKind::Colour { .. }) => rgb(said.tint(key)),
            Some(specula_lobes::ParameterKind::Flag) => value.to_owned(),
            _ => real(said.number(key)),
        };
        let name = key.replace("color", "colour");
        format!("    {name}: {value},\n")
    };
    let fields: String = said.0.given().map(field).collect();
    format!("{name}::new({name}Parameters {{\n{fields}    ..{name}Parameters::default()\n}})")
}
