//! Lobes in each language: read by this library's readers, by naga, by the compiler, or looked up in what is exported.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod common;

use std::fs;
use std::path::Path;

use common::{ask, error};
use serde_json::json;
use specula_scene::{LoadOptions, load_bytes};
use specula_shaders::{Language, export};

const LOBES: [&str; 30] = [
    "lambert albedo 0.8,0.2,0.1",
    "eon roughness 0.7",
    "diffuse-transmission reflectance 0.3 transmittance 0.4",
    "smooth-conductor Ag",
    "smooth-conductor reflectance 0.9,0.8,0.7 tint 0.5",
    "conductor Au alpha 0.1,0.4",
    "conductor Be alpha 0.2",
    "conductor alpha 0.8 energy turquin",
    "conductor alpha 0.8 energy kulla-conty f0 0.9 f82_tint 0.5",
    "conductor Cu alpha 0.3 distribution beckmann",
    "conductor Cu alpha 0.3 sampler bounded masking separable",
    "conductor alpha 0.3 conductor_eta 0.2 conductor_k 3,2,1",
    "multibounce-conductor Au alpha 0.6",
    "multibounce-conductor Au alpha 0.6 model wang mis_pdf hapke",
    "smooth-dielectric",
    "smooth-dielectric eta 1.3 reflection_tint 0.5",
    "thin-dielectric eta 1.3",
    "dielectric alpha 0.3",
    "dielectric alpha 0.3,0.1 compensated true transmission_tint 0.5,1,1",
    "multibounce-dielectric alpha 0.5 model heitz",
    "coated-diffuse alpha 0.2 max_depth 4",
    "coated-diffuse scattering single thickness 0.5",
    "layered Au alpha 0.2 base_alpha 0.3",
    "layered albedo 0.5 thickness 0.4 medium_albedo 0.5 g 0.3",
    "plastic alpha 0.2 nonlinear true",
    "plastic diffuse 0.1,0.2,0.3",
    "principled metallic 0.3 clearcoat 0.5 roughness 0.6 base_color 0.8,0.2,0.1",
    "principled thin true diff_trans 0.5 spec_trans 0.9",
    "gltf roughness 0.6 metallic 0.3 outside false",
    "gltf base_color 0.5 specular_color 0.5,1,1 compensated true",
];

/// The text, or why there is none.
fn code(lobe: &str, language: &str) -> Result<String, String> {
    let request = json!({"ask": "lobes.code", "lobe": lobe, "language": language});
    let message = error(&request);
    if message.is_empty() {
        return Ok(ask(&request).value()["text"].as_str().unwrap().to_owned());
    }
    assert!(
        message.starts_with("language: ") && message.contains(" cannot say this lobe: "),
        "{lobe}: {message}"
    );
    Err(message)
}

#[test]
fn a_language_that_is_none_is_an_error() {
    let message = error(&json!({"ask": "lobes.code", "lobe": "lambert", "language": "osl"}));
    assert!(
        message.starts_with("language: expected specula, rust") && message.ends_with("got 'osl'"),
        "{message}"
    );
}

/// Every text of Rust is part of this file: it compiles. `SPECULA_WRITE=1` writes it.
#[test]
fn rust_compiles() {
    let mut all = "{\n".to_owned();
    for lobe in LOBES {
        all += &format!("// {lobe}\n{{\n{}\n}}\n", code(lobe, "rust").unwrap());
    }
    all += "}\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rust_texts.in");
    if std::env::var_os("SPECULA_WRITE").is_some() {
        fs::write(&path, &all).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap();
    assert!(
        committed == all,
        "tests/rust_texts.in is out of date: SPECULA_WRITE=1 writes it"
    );
}

#[test]
#[allow(unused_variables, reason = "texts end with what a reader goes on from")]
fn rust_runs() {
    include!("rust_texts.in");
}

/// Rust's texts make the lobes that the names make.
#[test]
fn rust_makes_the_same_lobe() {
    use specula_bsdf::bsdf::{Lobe, Plastic, Principled, PrincipledParameters};
    use specula_bsdf::math::rgb;
    let parsed = |text| *specula_lobes::parse(text).unwrap().double();
    let plastic = Plastic::<f64>::smooth(1.49, rgb(0.1, 0.2, 0.3), rgb(1.0, 1.0, 1.0), false);
    assert_eq!(parsed(LOBES[25]), Lobe::from(plastic));
    let text = code(LOBES[25], "rust").unwrap();
    assert!(
        text.contains(
            "Plastic::<f64>::smooth(1.49, rgb(0.1, 0.2, 0.3), rgb(1.0, 1.0, 1.0), false)"
        ),
        "{text}"
    );
    let principled = PrincipledParameters {
        thin: true,
        diff_trans: 0.5,
        spec_trans: 0.9,
        ..PrincipledParameters::default()
    };
    assert_eq!(parsed(LOBES[27]), Lobe::from(Principled::new(principled)));
    let text = code(LOBES[27], "rust").unwrap();
    assert!(
        text.contains("spec_trans: 0.9")
            && text.contains("diff_trans: 0.5")
            && text.contains("thin: true"),
        "{text}"
    );
}

/// What of the scenes' formats there is, is read without a warning.
#[test]
fn scenes_are_read() {
    let mut read = [0, 0];
    for lobe in LOBES {
        for (i, (language, name)) in [("pbrt", "lobe.pbrt"), ("mitsuba", "lobe.xml")]
            .into_iter()
            .enumerate()
        {
            let Ok(text) = code(lobe, language) else {
                continue;
            };
            let scene = if language == "pbrt" {
                format!("Camera \"perspective\"\nWorldBegin\n{text}Shape \"sphere\"\n")
            } else {
                format!(
                    "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>\
                     <shape type=\"sphere\">{text}</shape></scene>"
                )
            };
            let loaded = load_bytes(name.as_ref(), scene.into_bytes(), &LoadOptions::default());
            let loaded = loaded.unwrap_or_else(|e| panic!("{lobe}: {e}\n{text}"));
            let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
            let warnings: Vec<_> = warnings
                .iter()
                .filter(|w| !w.contains("light") && !w.contains("sensor") && !w.contains("camera"))
                .collect();
            assert!(warnings.is_empty(), "{lobe}: {warnings:?}\n{text}");
            assert!(!loaded.scene.materials.is_empty());
            read[i] += 1;
        }
    }
    assert!(read[0] >= 10 && read[1] >= 14, "{read:?}");
}

#[test]
fn wgsl_is_valid() {
    let modules = [
        "lambert",
        "eon",
        "diffuse_transmission",
        "smooth_conductor",
        "rough_conductor",
        "compensated",
        "smooth_dielectric",
        "thin_dielectric",
        "rough_dielectric",
        "compensated_dielectric",
        "coated_diffuse",
    ];
    let library = specula_shaders::compose(&modules).unwrap();
    let mut valid = 0;
    for lobe in LOBES {
        let Ok(text) = code(lobe, "wgsl") else {
            continue;
        };
        let whole = format!(
            "{library}\n@group(1) @binding(0) var<storage, read_write> results: array<vec4f>;\n\
             @compute @workgroup_size(1)\nfn main() {{\nlet wo = vec3f(0.6, 0.0, 0.8);\nlet u = vec3f(0.3);\n{text}\n\
             results[0] = vec4f(sampled.wi, sampled.pdf);\n}}\n"
        );
        let module = naga::front::wgsl::parse_str(&whole)
            .unwrap_or_else(|e| panic!("{lobe}: {}", e.emit_to_string(&whole)));
        let mut validator = naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::all(),
        );
        validator
            .validate(&module)
            .unwrap_or_else(|e| panic!("{lobe}: {e:?}\n{text}"));
        valid += 1;
    }
    assert!(valid >= 18, "{valid}");
}

/// Every name that the texts of the other languages call or read is in what is exported.
#[test]
fn names_of_shaders_are_exported() {
    let file = |language| {
        let files = export(language, &[]).unwrap();
        files
            .into_iter()
            .map(|f| String::from_utf8_lossy(&f.bytes).into_owned())
            .next()
            .unwrap()
    };
    for (name, language) in [
        ("hlsl", Language::Hlsl),
        ("glsl", Language::Glsl),
        ("metal", Language::Msl),
        ("cpp", Language::Cpp),
    ] {
        let library = file(language);
        let known: std::collections::BTreeSet<&str> = words(&library).collect();
        for lobe in LOBES {
            let Ok(text) = code(lobe, name) else {
                continue;
            };
            let without_comments: String = text
                .lines()
                .map(|l| l.split("//").next().unwrap().to_owned() + "\n")
                .collect();
            for word in words(&without_comments) {
                let is_own = matches!(
                    word,
                    "lobe"
                        | "sampled"
                        | "wo"
                        | "u"
                        | "include"
                        | "namespace"
                        | "using"
                        | "hpp"
                        | "hlsl"
                        | "specula"
                        | "metal"
                        | "tints"
                        | "facets"
                        | "true"
                        | "false"
                );
                let is_number = word.starts_with(|c: char| c.is_ascii_digit()) || word == "f";
                assert!(
                    is_own || is_number || known.contains(word),
                    "{name}, {lobe}: '{word}'\n{text}"
                );
            }
        }
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|w| !w.is_empty())
}

/// Python's classes and keywords are those of the package's stubs.
#[test]
fn names_of_python_are_the_packages() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../specula-py/python/specula_render/_native.pyi");
    let stubs = fs::read_to_string(root).unwrap();
    for lobe in LOBES {
        let text = code(lobe, "python").unwrap();
        let call = text.split("sr.").nth(1).unwrap();
        let class = call.split('(').next().unwrap();
        let body = stubs
            .split(&format!("class {class}(Bsdf):"))
            .nth(1)
            .unwrap_or_else(|| panic!("{class}"));
        let body = body.split("@final").next().unwrap();
        for part in text
            .lines()
            .nth(2)
            .unwrap()
            .split(['(', ','])
            .filter_map(|p| p.split_once('='))
        {
            let key = part.0.trim();
            if key != "lobe" && !key.is_empty() && !key.contains(' ') {
                assert!(body.contains(&format!("{key}:")), "{lobe}: {key}\n{text}");
            }
        }
    }
    let text = code("conductor Au alpha 0.1,0.4 energy turquin", "python").unwrap();
    assert!(
        text.contains(
            "sr.RoughConductor(alpha=(0.1, 0.4), energy=\"turquin\", reflectance=\"Au\")"
        ),
        "{text}"
    );
}

#[test]
fn names_of_c_are_the_headers() {
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specula-c/include/specula.h");
    let header = fs::read_to_string(header).unwrap();
    let text = code("conductor Au alpha 0.3", "c").unwrap();
    for word in words(&text).filter(|w| w.starts_with("specula_") || w.starts_with("SPECULA_")) {
        assert!(header.contains(word), "{word}");
    }
    assert!(text.contains("specula_lobe_parse(\"conductor Au alpha 0.3\", &lobe)"));
}
