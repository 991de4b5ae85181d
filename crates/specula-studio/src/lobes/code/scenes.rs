//! Lobes as materials of pbrt-v4 and Mitsuba 3, where these renderers have them.

use std::fmt::Write as _;

use super::{Metal, Said, Text, none};

fn spaced(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
    texts.join(" ")
}

/// Metals that pbrt-v4 has by name.
const OF_PBRT: [&str; 5] = ["Ag", "Al", "Au", "Cu", "CuZn"];

/// `Material "..."` with its parameters.
pub(super) fn pbrt(said: Said<'_>) -> Text {
    let refuse = |why: &str| Err(none("pbrt-v4", why));
    if said.is("distribution", "beckmann") {
        return refuse("it knows GGX alone");
    }
    if said.is("masking", "separable") && said.kind() != "plastic" {
        return refuse("its masking is height-correlated");
    }
    if said.word("energy").is_some() || said.is("compensated", "true") {
        return refuse("it has no energy compensation");
    }
    let rgb = |name: &str, key: &str| format!("    \"rgb {name}\" [{}]\n", spaced(&said.tint(key)));
    let float = |name: &str, value: f64| format!("    \"float {name}\" {value}\n");
    let glass = || {
        let is_white = said.is_white("reflection_tint") && said.is_white("transmission_tint");
        if is_white {
            Ok(float("eta", said.number("eta")))
        } else {
            refuse("its glass has no tints")
        }
    };
    let (name, body) = match said.kind() {
        "lambert" => ("diffuse", rgb("reflectance", "albedo")),
        "diffuse-transmission" => (
            "diffusetransmission",
            rgb("reflectance", "reflectance") + &rgb("transmittance", "transmittance"),
        ),
        "smooth-conductor" | "conductor" => (
            "conductor",
            pbrt_metal(said, "")? + &pbrt_alpha(said, "alpha", ""),
        ),
        "smooth-dielectric" | "dielectric" => {
            ("dielectric", glass()? + &pbrt_alpha(said, "alpha", ""))
        }
        "thin-dielectric" => ("thindielectric", glass()?),
        "layered" if said.given("albedo").is_some() => (
            "coateddiffuse",
            rgb("reflectance", "albedo")
                + &float("eta", said.number("eta"))
                + &pbrt_alpha(said, "alpha", "")
                + &pbrt_medium(said),
        ),
        "layered" => (
            "coatedconductor",
            pbrt_metal(said, "conductor.")?
                + &float("interface.eta", said.number("eta"))
                + &pbrt_alpha(said, "alpha", "interface.")
                + &pbrt_alpha(said, "base_alpha", "conductor.")
                + &pbrt_medium(said),
        ),
        "coated-diffuse" => return refuse("its coats are random walks: 'layered' is the same"),
        other => return refuse(&format!("it has no '{other}'")),
    };
    Ok(format!("Material \"{name}\"\n{body}"))
}

fn pbrt_alpha(said: Said<'_>, key: &str, prefix: &str) -> String {
    let [x, y] = said.alpha(key).unwrap_or([0.0; 2]);
    let remapped = if prefix == "conductor." {
        ""
    } else {
        "    \"bool remaproughness\" false\n"
    };
    format!("    \"float {prefix}uroughness\" {x} \"float {prefix}vroughness\" {y}\n{remapped}")
}

fn pbrt_metal(said: Said<'_>, prefix: &str) -> Text {
    if said.given("tint").is_some() {
        return Err(none("pbrt-v4", "its metals have no tint"));
    }
    let rgb = |name: &str, c: [f64; 3]| format!("    \"rgb {prefix}{name}\" [{}]\n", spaced(&c));
    match said.reflectance() {
        Some(Metal::Measured(symbol, ..)) if OF_PBRT.contains(&symbol) => Ok(format!(
            "    \"spectrum {prefix}eta\" \"metal-{symbol}-eta\" \"spectrum {prefix}k\" \"metal-{symbol}-k\"\n"
        )),
        Some(Metal::Measured(_, eta, k) | Metal::Index(eta, k)) => {
            Ok(rgb("eta", eta) + &rgb("k", k))
        }
        // Without a prefix, also of coated metals.
        Some(Metal::Constant(colour)) => {
            Ok(format!("    \"rgb reflectance\" [{}]\n", spaced(&colour)))
        }
        _ => Err(none("pbrt-v4", "its metals are by index or reflectance")),
    }
}

fn pbrt_medium(said: Said<'_>) -> String {
    let albedo = spaced(&said.tint("medium_albedo"));
    let (thickness, g) = (said.number("thickness"), said.number("g"));
    format!("    \"float thickness\" {thickness} \"rgb albedo\" [{albedo}] \"float g\" {g}\n")
}

/// `<bsdf type="...">`.
pub(super) fn mitsuba(said: Said<'_>) -> Text {
    let refuse = |why: &str| Err(none("Mitsuba 3", why));
    if said.word("energy").is_some() || said.is("compensated", "true") {
        return refuse("it has no energy compensation");
    }
    let rgb = |name: &str, key: &str| mitsuba_rgb(name, said.tint(key));
    let float =
        |name: &str, value: f64| format!("    <float name=\"{name}\" value=\"{value}\"/>\n");
    let eta = || float("int_ior", said.number("eta")) + &float("ext_ior", 1.0);
    let glass = || {
        eta()
            + &rgb("specular_reflectance", "reflection_tint")
            + &rgb("specular_transmittance", "transmission_tint")
    };
    let (name, body) = match said.kind() {
        "lambert" => ("diffuse", rgb("reflectance", "albedo")),
        "smooth-conductor" => ("conductor", mitsuba_metal(said)?),
        "conductor" => (
            "roughconductor",
            mitsuba_metal(said)? + &mitsuba_alpha(said),
        ),
        "smooth-dielectric" => ("dielectric", glass()),
        "thin-dielectric" => ("thindielectric", glass()),
        "dielectric" => ("roughdielectric", glass() + &mitsuba_alpha(said)),
        "plastic" => {
            let body = eta()
                + &rgb("diffuse_reflectance", "diffuse")
                + &rgb("specular_reflectance", "specular")
                + &format!(
                    "    <boolean name=\"nonlinear\" value=\"{}\"/>\n",
                    said.word("nonlinear").unwrap_or("false")
                );
            match said.alpha("alpha") {
                None => ("plastic", body),
                Some([x, y]) if x == y => ("roughplastic", body + &mitsuba_alpha(said)),
                Some(_) => return refuse("its plastics are isotropic"),
            }
        }
        "principled" => mitsuba_principled(said),
        other => return refuse(&format!("it has no '{other}'")),
    };
    Ok(format!("<bsdf type=\"{name}\">\n{body}</bsdf>\n"))
}

fn mitsuba_rgb(name: &str, colour: [f64; 3]) -> String {
    let colour = spaced(&colour).replace(' ', ", ");
    format!("    <rgb name=\"{name}\" value=\"{colour}\"/>\n")
}

/// Mitsuba masks separably, whatever the lobe does.
fn mitsuba_alpha(said: Said<'_>) -> String {
    let distribution = said.word("distribution").unwrap_or("ggx");
    let mut text = format!("    <string name=\"distribution\" value=\"{distribution}\"/>\n");
    let [x, y] = said.alpha("alpha").unwrap_or([0.1; 2]);
    for (name, value) in [("alpha", x), ("alpha_u", x), ("alpha_v", y)] {
        if (name == "alpha") == (x == y) {
            let _ = writeln!(text, "    <float name=\"{name}\" value=\"{value}\"/>");
        }
    }
    text
}

fn mitsuba_metal(said: Said<'_>) -> Text {
    let tint = match said.colour("tint") {
        Some(tint) => mitsuba_rgb("specular_reflectance", tint),
        None => String::new(),
    };
    match said.reflectance() {
        // Mitsuba's own names mean other measurements: the index says what is meant.
        Some(Metal::Measured(_, eta, k) | Metal::Index(eta, k)) => {
            Ok(mitsuba_rgb("eta", eta) + &mitsuba_rgb("k", k) + &tint)
        }
        Some(Metal::Constant(colour)) => {
            let colour = [0, 1, 2].map(|i| colour[i] * said.tint("tint")[i]);
            let mirror = "    <string name=\"material\" value=\"none\"/>\n";
            Ok(mirror.to_owned() + &mitsuba_rgb("specular_reflectance", colour))
        }
        _ => Err(none("Mitsuba 3", "its metals are by index or reflectance")),
    }
}

fn mitsuba_principled(said: Said<'_>) -> (&'static str, String) {
    let is_thin = said.is("thin", "true");
    let name = if is_thin {
        "principledthin"
    } else {
        "principled"
    };
    let of_solids = ["metallic", "clearcoat", "clearcoat_gloss"];
    let of_sheets = ["diff_trans"];
    let mut text = mitsuba_rgb("base_color", said.tint("base_color"));
    for key in [
        "roughness",
        "anisotropic",
        "metallic",
        "spec_trans",
        "eta",
        "spec_tint",
        "sheen",
        "sheen_tint",
        "clearcoat",
        "clearcoat_gloss",
        "flatness",
        "diff_trans",
    ] {
        let is_of_other = if is_thin {
            of_solids.contains(&key)
        } else {
            of_sheets.contains(&key)
        };
        if is_of_other || said.given(key).is_none() {
            continue;
        }
        let _ = writeln!(
            text,
            "    <float name=\"{key}\" value=\"{}\"/>",
            said.number(key)
        );
    }
    (name, text)
}
