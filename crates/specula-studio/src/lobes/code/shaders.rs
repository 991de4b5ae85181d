//! Lobes as calls of the functions that `specula export` writes: WGSL, HLSL, GLSL, Metal, C++.
//!
//! Structures are filled field by field, which every one of these languages can.

use std::fmt::Write as _;

use super::{Metal, Said, Text, none};

/// What differs between the languages.
pub(super) struct Syntax {
    name: &'static str,
    /// The file of `specula export`, and how it is taken in.
    head: &'static str,
    vectors: [&'static str; 2],
    /// In front of a number's suffix.
    suffix: &'static str,
    /// Type first, or `var name: type`.
    is_typed_first: bool,
    /// Tables are an argument of functions that read them.
    passes_tables: bool,
}

pub(super) const WGSL: Syntax = Syntax {
    name: "WGSL",
    head: "// Behind specula.wgsl, of `specula export --language wgsl`.",
    vectors: ["vec2f", "vec3f"],
    suffix: "",
    is_typed_first: false,
    passes_tables: false,
};
pub(super) const HLSL: Syntax = Syntax {
    name: "HLSL",
    head: "#include \"specula.hlsl\" // of `specula export --language hlsl`",
    vectors: ["float2", "float3"],
    suffix: "",
    is_typed_first: true,
    passes_tables: false,
};
pub(super) const GLSL: Syntax = Syntax {
    name: "GLSL",
    head: "// Behind specula.glsl, of `specula export --language glsl`.",
    vectors: ["vec2", "vec3"],
    suffix: "",
    is_typed_first: true,
    passes_tables: false,
};
pub(super) const METAL: Syntax = Syntax {
    name: "Metal",
    head: "#include \"specula.metal\" // of `specula export --language metal`",
    vectors: ["metal::float2", "metal::float3"],
    suffix: "f",
    is_typed_first: true,
    passes_tables: true,
};
pub(super) const CPP: Syntax = Syntax {
    name: "C++",
    head: "#include \"specula.hpp\" // of `specula export --language cpp`\nusing namespace specula;",
    vectors: ["vec2f", "vec3f"],
    suffix: "f",
    is_typed_first: true,
    passes_tables: false,
};

impl Syntax {
    fn vector(&self, numbers: &[f64]) -> String {
        let name = self.vectors[usize::from(numbers.len() == 3)];
        let numbers: Vec<String> = numbers.iter().map(|x| self.real(*x)).collect();
        format!("{name}({})", numbers.join(", "))
    }

    fn real(&self, x: f64) -> String {
        format!("{}{}", super::real(x), self.suffix)
    }

    fn declare(&self, kind: &str, name: &str) -> String {
        if self.is_typed_first {
            format!("{kind} {name};\n")
        } else {
            format!("var {name}: {kind};\n")
        }
    }

    fn defined(&self, kind: &str, name: &str, value: &str) -> String {
        if self.is_typed_first {
            format!("{kind} {name} = {value};\n")
        } else {
            format!("let {name} = {value};\n")
        }
    }
}

/// The prefix of a kind's functions, and whether they read tables.
struct Names(&'static str, bool);

pub(super) fn text(said: Said<'_>, syntax: &Syntax) -> Text {
    let (names, body) = body(said, syntax)?;
    let Names(prefix, reads_tables) = names;
    let tables = if syntax.passes_tables && reads_tables {
        ", specula_tables"
    } else {
        ""
    };
    let mut text = format!("{}\n", syntax.head);
    text.push_str(&body);
    let sampled = format!("{prefix}_sample(lobe, wo, u, BSDF_SAMPLE_RADIANCE{tables})");
    text.push_str(&syntax.defined("BsdfSample", "sampled", &sampled));
    let _ = writeln!(
        text,
        "// {prefix}_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE{tables}): f cos, and the density behind it"
    );
    Ok(text)
}

fn body(said: Said<'_>, syntax: &Syntax) -> Result<(Names, String), crate::AskError> {
    let colour = |key| syntax.vector(&said.tint(key));
    let number = |key| syntax.real(said.number(key));
    let set = |field: &str, value: &str| format!("lobe.{field} = {value};\n");
    let of = |kind: &'static str, fields: &str| format!("{}{fields}", syntax.declare(kind, "lobe"));
    let one_of_two = |is: bool| if is { "1u" } else { "0u" };
    Ok(match said.kind() {
        "lambert" => (
            Names("lambert", false),
            of("LambertLobe", &set("albedo", &colour("albedo"))),
        ),
        "eon" => (
            Names("eon", false),
            of(
                "EonLobe",
                &(set("albedo", &colour("albedo")) + &set("roughness", &number("roughness"))),
            ),
        ),
        "diffuse-transmission" => (
            Names("diffuse_transmission", false),
            of(
                "DiffuseTransmission",
                &(set("reflectance", &colour("reflectance"))
                    + &set("transmittance", &colour("transmittance"))),
            ),
        ),
        "smooth-conductor" => (
            Names("smooth_conductor", false),
            of(
                "SmoothConductor",
                &set("reflectance", &reflectance(said, syntax)?),
            ),
        ),
        "conductor" => conductor(said, syntax)?,
        "smooth-dielectric" => (
            Names("smooth_dielectric", false),
            of(
                "SmoothDielectric",
                &(set("eta", &number("eta"))
                    + &set("two_sided", one_of_two(true))
                    + &tints(said, syntax, "lobe.tints")),
            ),
        ),
        "thin-dielectric" => (
            Names("thin_dielectric", false),
            of(
                "ThinDielectric",
                &(set("eta", &number("eta")) + &tints(said, syntax, "lobe.tints")),
            ),
        ),
        "dielectric" => dielectric(said, syntax),
        "coated-diffuse" => coated(said, syntax),
        other => {
            let why = format!(
                "the shader library has '{other}', but not in a few lines: it takes parameters of its own, or \
                 random numbers; see docs/shaders/modules.md"
            );
            return Err(none(syntax.name, &why));
        }
    })
}

fn facets(said: Said<'_>, syntax: &Syntax) -> String {
    let upper = |key: &str, default: &str| {
        let word = said.word(key).unwrap_or(default);
        word.replace('-', "_").to_uppercase()
    };
    // Smooth coats have facets that nothing reads.
    let alpha = said.alpha("alpha").unwrap_or([1.0; 2]);
    let mut text = syntax.declare("MicrofacetsModel", "facets");
    for (field, value) in [
        ("alpha", syntax.vector(&alpha)),
        (
            "distribution",
            format!("DISTRIBUTION_{}", upper("distribution", "ggx")),
        ),
        (
            "masking",
            format!("MASKING_{}", upper("masking", "height-correlated")),
        ),
        ("strategy", format!("SAMPLER_{}", upper("sampler", "exact"))),
    ] {
        let _ = writeln!(text, "facets.{field} = {value};");
    }
    text
}

fn reflectance(said: Said<'_>, syntax: &Syntax) -> Text {
    let call = |name: &str, colours: &[[f64; 3]]| {
        let colours: Vec<String> = colours.iter().map(|c| syntax.vector(c)).collect();
        format!("reflectance_{name}({})", colours.join(", "))
    };
    let untinted = match said.reflectance() {
        Some(Metal::Constant(colour)) => call("constant", &[colour]),
        Some(Metal::Measured(_, eta, k) | Metal::Index(eta, k)) => call("conductor", &[eta, k]),
        Some(Metal::Schlick(f0)) => call("schlick", &[f0]),
        Some(Metal::F82(f0, tint)) => call("f82_tint", &[f0, tint]),
        None => return Err(none(syntax.name, "it has no reflectance")),
    };
    Ok(match said.colour("tint") {
        Some(tint) => format!("reflectance_tinted({untinted}, {})", syntax.vector(&tint)),
        None => untinted,
    })
}

fn tints(said: Said<'_>, syntax: &Syntax, name: &str) -> String {
    let pair = ["reflection", "transmission"].map(|side| {
        let colour = syntax.vector(&said.tint(&format!("{side}_tint")));
        format!("{name}.{side} = {colour};\n")
    });
    pair.concat()
}

fn conductor(said: Said<'_>, syntax: &Syntax) -> Result<(Names, String), crate::AskError> {
    let mut text = facets(said, syntax);
    let metal = reflectance(said, syntax)?;
    let Some(model) = said.word("energy") else {
        text.push_str(&syntax.declare("RoughConductor", "lobe"));
        let _ = write!(text, "lobe.facets = facets;\nlobe.reflectance = {metal};\n");
        return Ok((Names("rough_conductor", false), text));
    };
    let model = format!("MODEL_{}", model.replace('-', "_").to_uppercase());
    let tables = if syntax.passes_tables {
        ", specula_tables"
    } else {
        ""
    };
    let made = format!("compensated_new(facets, {metal}, {model}{tables})");
    text.push_str(&syntax.defined("CompensatedConductor", "lobe", &made));
    Ok((Names("compensated", true), text))
}

fn dielectric(said: Said<'_>, syntax: &Syntax) -> (Names, String) {
    let mut text = facets(said, syntax);
    let eta = syntax.real(said.number("eta"));
    if said.is("compensated", "true") {
        text.push_str(&syntax.declare("TintsPair", "tints"));
        text.push_str(&tints(said, syntax, "tints"));
        let tables = if syntax.passes_tables {
            ", specula_tables"
        } else {
            ""
        };
        let made = format!("compensated_dielectric_new(facets, {eta}, 1u, tints{tables})");
        text.push_str(&syntax.defined("CompensatedDielectric", "lobe", &made));
        return (Names("compensated_dielectric", true), text);
    }
    text.push_str(&syntax.declare("RoughDielectric", "lobe"));
    let _ = write!(
        text,
        "lobe.facets = facets;\nlobe.eta = {eta};\nlobe.two_sided = 1u;\n"
    );
    text.push_str(&tints(said, syntax, "lobe.tints"));
    (Names("rough_dielectric", false), text)
}

fn coated(said: Said<'_>, syntax: &Syntax) -> (Names, String) {
    let mut text = facets(said, syntax);
    let depth = match said.given("max_depth") {
        Some(depth) => format!("{depth}u"),
        None => "COATED_DIFFUSE_UNLIMITED".to_owned(),
    };
    let scattering = said.word("scattering").unwrap_or("lossless").to_uppercase();
    let tables = if syntax.passes_tables {
        ", specula_tables"
    } else {
        ""
    };
    let made = format!(
        "coated_diffuse_new(facets, {}, {}, {}, {}, {depth}, COATED_DIFFUSE_{scattering}{tables})",
        said.given("alpha").is_some(),
        syntax.real(said.number("eta")),
        syntax.vector(&said.tint("albedo")),
        syntax.real(said.number("thickness")),
    );
    text.push_str(&syntax.defined("CoatedDiffuse", "lobe", &made));
    (Names("coated_diffuse", true), text)
}
