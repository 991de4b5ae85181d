//! Lobes of texts are those of parameters; texts that are none say what was expected.

use super::{Argument, NamedLobe, Value, make, parse};

type Words = &'static [(&'static str, Value<'static>)];

/// Texts, with the same as parameters.
const SAME: &[(&str, &str, Words)] = &[
    ("lambert", "lambert", &[]),
    (
        "lambert albedo 0.8,0.2,0.1",
        "lambert",
        &[("albedo", Value::Three([0.8, 0.2, 0.1]))],
    ),
    (
        "eon roughness 0.25 albedo 0.5",
        "eon",
        &[("albedo", Value::One(0.5)), ("roughness", Value::One(0.25))],
    ),
    (
        "diffuse_transmission reflectance 0.1",
        "diffuse-transmission",
        &[("reflectance", Value::One(0.1))],
    ),
    (
        "smooth-conductor Au",
        "smooth-conductor",
        &[("reflectance", Value::Word("Au"))],
    ),
    (
        "conductor Cu alpha 0.1,0.4 energy kulla-conty masking separable",
        "conductor",
        &[
            ("masking", Value::Word("separable")),
            ("energy", Value::Word("kulla-conty")),
            ("alpha", Value::Two([0.1, 0.4])),
            ("reflectance", Value::Word("Cu")),
        ],
    ),
    (
        "conductor alpha 0.3 f0 0.9 f82-tint 0.5",
        "conductor",
        &[
            ("alpha", Value::One(0.3)),
            ("f0", Value::One(0.9)),
            ("f82_tint", Value::One(0.5)),
        ],
    ),
    (
        "multibounce-conductor alpha 0.3 mis-pdf hapke model wang",
        "multibounce_conductor",
        &[
            ("model", Value::Word("wang")),
            ("mis_pdf", Value::Word("hapke")),
            ("alpha", Value::One(0.3)),
        ],
    ),
    (
        "dielectric alpha 0.3 compensated true",
        "dielectric",
        &[("alpha", Value::One(0.3)), ("compensated", Value::One(1.0))],
    ),
    (
        "coated-diffuse max_depth 4",
        "coated-diffuse",
        &[("max-depth", Value::One(4.0))],
    ),
    (
        "layered Au base_alpha 0.2 g -0.5",
        "layered",
        &[
            ("g", Value::One(-0.5)),
            ("base_alpha", Value::One(0.2)),
            ("reflectance", Value::Word("Au")),
        ],
    ),
    (
        "principled thin true",
        "principled",
        &[("thin", Value::Word("true"))],
    ),
    (
        "gltf volume true outside false",
        "gltf",
        &[
            ("volume", Value::Word("true")),
            ("outside", Value::Word("false")),
        ],
    ),
];

fn made(kind: &str, words: Words) -> Result<NamedLobe, super::LobeError> {
    let of = |&(name, value)| Argument { name, value };
    make(kind, &words.iter().map(of).collect::<Vec<_>>())
}

fn is_same(a: &NamedLobe, b: &NamedLobe) -> bool {
    a.pair == b.pair
}

#[test]
fn texts_and_parameters_make_equal_lobes() {
    let lobes: Vec<_> = (SAME.iter())
        .map(|&(text, kind, words)| (parse(text).unwrap(), made(kind, words).unwrap()))
        .collect();
    for (i, (of_text, _)) in lobes.iter().enumerate() {
        for (k, (_, of_parameters)) in lobes.iter().enumerate() {
            let (a, b) = (SAME[i].0, SAME[k].0);
            assert_eq!(is_same(of_text, of_parameters), i == k, "{a}, {b}");
        }
    }
}

/// Texts, with the same and all defaults.
const DEFAULTS: &[(&str, &str)] = &[
    ("lambert", "albedo 0.5"),
    ("eon", "albedo 0.5 roughness 0.5"),
    (
        "diffuse-transmission",
        "reflectance 0.25 transmittance 0.25",
    ),
    ("smooth-conductor", "reflectance 1"),
    (
        "conductor alpha 0.3",
        "reflectance 1 distribution ggx sampler exact masking height-correlated",
    ),
    (
        "multibounce-conductor alpha 0.3",
        "reflectance 1 distribution ggx model specula mis_pdf normalised",
    ),
    (
        "smooth-dielectric",
        "eta 1.5 reflection_tint 1 transmission_tint 1",
    ),
    (
        "thin-dielectric",
        "eta 1.5 reflection_tint 1 transmission_tint 1",
    ),
    (
        "dielectric alpha 0.3",
        "eta 1.5 distribution ggx sampler cap masking height-correlated compensated false reflection_tint 1 \
         transmission_tint 1",
    ),
    (
        "multibounce-dielectric alpha 0.3",
        "eta 1.5 distribution ggx model specula mis_pdf normalised reflection_tint 1 transmission_tint 1",
    ),
    (
        "coated-diffuse",
        "eta 1.5 albedo 0.5 thickness 0 scattering lossless",
    ),
    (
        "layered albedo 0.5",
        "eta 1.5 thickness 0 medium_albedo 0 g 0",
    ),
    ("plastic", "eta 1.49 diffuse 0.5 specular 1 nonlinear false"),
    (
        "plastic alpha 0.3",
        "eta 1.49 diffuse 0.5 specular 1 nonlinear false distribution ggx masking separable",
    ),
    (
        "principled",
        "base_color 0.5 roughness 0.5 anisotropic 0 metallic 0 spec_trans 0 eta 1.5 spec_tint 0 sheen 0 \
         sheen_tint 0 clearcoat 0 clearcoat_gloss 0 flatness 0 diff_trans 0 thin false outside true",
    ),
    (
        "gltf",
        "base_color 1 metallic 1 roughness 1 anisotropy 0 ior 1.5 specular 1 specular_color 1 transmission 0 \
         volume false outside true clearcoat 0 clearcoat_roughness 0 sheen_color 0 sheen_roughness 0 compensated false",
    ),
];

#[test]
fn what_is_not_given_has_its_default() {
    for (text, defaults) in DEFAULTS {
        let (short, long) = (parse(text), parse(&format!("{text} {defaults}")));
        assert!(is_same(&short.unwrap(), &long.unwrap()), "{text}");
    }
}

/// What a kind cannot do without, as a text.
fn least(kind: &super::Kind) -> String {
    let needed = match kind.name {
        "layered" => " albedo 0.5",
        _ if kind
            .parameter("alpha")
            .is_some_and(|p| p.doc.ends_with("must be given")) =>
        {
            " alpha 0.3"
        }
        _ => "",
    };
    format!("{}{needed}", kind.name)
}

/// The catalogue's defaults are the lobes', its choices are taken, and the ends of its ranges, too.
#[test]
fn the_catalogue_is_what_is_read() {
    for kind in super::kinds() {
        let text = least(kind);
        let plain = parse(&text).unwrap();
        for parameter in kind.parameters() {
            let with = |value: &str| parse(&format!("{text} {} {value}", parameter.key));
            if let Some(default) = parameter.default {
                assert!(
                    is_same(&plain, &with(default).unwrap()),
                    "{text} {parameter:?}"
                );
            }
            for choice in parameter.kind.choices() {
                let is_read = with(choice).is_ok_and(|lobe| lobe.to_string().ends_with(choice));
                assert!(is_read, "{text} {parameter:?} {choice}");
            }
            if let super::ParameterKind::Number { low, high } = parameter.kind {
                for end in [low, high].into_iter().filter(|end| *end < f64::MAX) {
                    assert!(with(&end.to_string()).is_ok(), "{text} {parameter:?} {end}");
                }
                assert!(
                    with(&(low - 1e-3).to_string()).is_err(),
                    "{text} {parameter:?}"
                );
            }
        }
    }
}

/// Normal forms are read as the same lobes, and are their own normal forms.
#[test]
fn normal_forms_are_read_back() {
    for (text, _, _) in SAME {
        let lobe = parse(text).unwrap();
        let again = parse(&lobe.to_string()).unwrap();
        assert!(
            is_same(&lobe, &again) && lobe.to_string() == again.to_string(),
            "{text}"
        );
    }
}

/// The words of `--material` between spaces.
#[test]
fn numbers_may_stand_between_spaces() {
    for (spaces, commas) in [
        (
            "conductor Au alpha 0.3 0.1 energy turquin",
            "conductor Au alpha 0.3,0.1 energy turquin",
        ),
        (
            "conductor 0.9 0.6 0.3 alpha 0.2",
            "conductor reflectance 0.9,0.6,0.3 alpha 0.2",
        ),
        (
            "conductor 0.9 alpha 0.2",
            "conductor reflectance 0.9 alpha 0.2",
        ),
        ("lambert albedo 0.8 0.2 0.1", "lambert albedo 0.8,0.2,0.1"),
        (
            "dielectric alpha 0.3 0.1 eta 1.3",
            "dielectric alpha 0.3,0.1 eta 1.3",
        ),
    ] {
        assert!(
            is_same(&parse(spaces).unwrap(), &parse(commas).unwrap()),
            "{spaces}"
        );
    }
}

#[test]
fn values_are_read_as_they_are_written() {
    for (text, value) in [
        ("0.3", Value::One(0.3)),
        ("-1e-2", Value::One(-1e-2)),
        ("0.1,0.4", Value::Two([0.1, 0.4])),
        ("1,2,3", Value::Three([1.0, 2.0, 3.0])),
        ("1,2,3,4", Value::Word("1,2,3,4")),
        ("1,,2", Value::Word("1,,2")),
        ("Au", Value::Word("Au")),
        ("", Value::Word("")),
    ] {
        assert_eq!(Value::of_text(text), value, "{text}");
    }
}

/// Texts of bad rough diffuse lobes, and what is wrong.
const BAD_EON: &[(&str, &str)] = &[
    (
        "eon roughness 2",
        "roughness: expected a number in [0, 1], got 2",
    ),
    (
        "eon roughness nan",
        "roughness: expected a number in [0, 1], got NaN",
    ),
    (
        "eon roughness rough",
        "roughness: expected a number, got 'rough'",
    ),
    (
        "eon albedo 1,2",
        "albedo: expected a colour (one number, or three), got 1,2",
    ),
    (
        "eon albedo 0,0,-1",
        "albedo: expected a number in [0, 1], got -1",
    ),
];

/// Texts of bad metals, and what is wrong.
const BAD_METALS: &[(&str, &str)] = &[
    (
        "conductor Au",
        "alpha: is missing (expected one number in [1e-4, 10], or two)",
    ),
    (
        "conductor alpha 0.3,0.3,0.3",
        "alpha: expected one number or two, got 0.3,0.3,0.3",
    ),
    (
        "conductor alpha 0.3 reflectance Xx",
        "no such metal: 'Xx' (expected one of Ag, Al, Au, Be, Co, Cr, Cu, CuZn, \
         Fe, Hg, Ir, Mg, Mo, Nb, Ni, Pd, Pt, Rh, Ti, V, W, Zn)",
    ),
    (
        "conductor alpha 0.3 distribution phong",
        "no such distribution: 'phong' (expected ggx or beckmann)",
    ),
    (
        "conductor alpha 0.3 distribution 1",
        "distribution: expected a name, got 1",
    ),
    (
        "conductor alpha 0.3 sampler best",
        "no such sampler: 'best' (expected heitz, cap, bounded or exact)",
    ),
    (
        "conductor alpha 0.3 distribution beckmann sampler cap",
        "sampler: 'cap' is of GGX; Beckmann's visible normals have one sampler of their own",
    ),
    (
        "conductor alpha 0.3 masking none",
        "no such masking: 'none' (expected height-correlated or separable)",
    ),
    (
        "conductor alpha 0.3 Au f0 0.5",
        "expected one of reflectance, f0, or conductor_eta and conductor_k",
    ),
    (
        "conductor alpha 0.3 conductor_eta 1",
        "expected both conductor_eta and conductor_k",
    ),
    (
        "conductor alpha 0.3 conductor_eta 1 conductor_k -1",
        "conductor_k: expected 0 or more, got -1",
    ),
    (
        "conductor alpha 0.3 f82_tint 1",
        "f82_tint: expected f0, too",
    ),
    (
        "conductor alpha 0.3 tint 1",
        "tint: expected a reflectance, too",
    ),
];

const KINDS: &str = "(expected one of lambert, eon, diffuse-transmission, smooth-conductor, conductor, \
    multibounce-conductor, smooth-dielectric, thin-dielectric, dielectric, multibounce-dielectric, coated-diffuse, \
    layered, plastic, principled, gltf)";
const OF_METALS: &str = "alpha, distribution, sampler, masking, energy, reflectance, conductor_eta, conductor_k, f0, \
    f82_tint, tint";

#[test]
fn bad_texts_say_what_was_expected() {
    let of_eon = "albedo, roughness";
    let whole = [
        ("", format!("no such lobe: '' {KINDS}")),
        ("metal", format!("no such lobe: 'metal' {KINDS}")),
        (
            "eon roughnes 1",
            format!("eon: no such parameter: 'roughnes' (expected one of {of_eon})"),
        ),
        (
            "eon Au",
            format!("eon: no such parameter: 'Au' (expected one of {of_eon})"),
        ),
        (
            "eon roughness",
            "eon: roughness: expected a value after it".to_owned(),
        ),
        (
            "eon roughness 1 roughness 1",
            "eon: roughness: is given twice".to_owned(),
        ),
    ];
    let message = |text| parse(text).map_or_else(|e| e.to_string(), |lobe| lobe.to_string());
    for (text, expected) in whole {
        assert_eq!(message(text), expected, "{text}");
    }
    for (kind, keys, bad) in [
        ("eon", of_eon, BAD_EON),
        ("conductor", OF_METALS, BAD_METALS),
    ] {
        for (text, problem) in bad {
            let expected = format!("{kind}: {problem}; its parameters are {keys}");
            assert_eq!(message(text), expected, "{text}");
        }
    }
}

/// Texts that break a rule of one kind, and how the message begins.
const BAD_OF_KINDS: &[(&str, &str)] = &[
    (
        "conductor Xx alpha 0.3",
        "conductor: no such parameter: 'Xx' (expected one of alpha, distribution, sampler, masking, energy, \
             reflectance, conductor_eta, conductor_k, f0, f82_tint, tint), or a metal: Ag",
    ),
    (
        "conductor alpha 0.3 energy x",
        "conductor: no such energy compensation: 'x' (expected turquin,",
    ),
    ("conductor alpha 11", "conductor: alpha: "),
    (
        "multibounce-conductor alpha 0.3 model x",
        "multibounce-conductor: no such model of multiple bounces: 'x'",
    ),
    (
        "multibounce-conductor alpha 0.3 mis_pdf x",
        "multibounce-conductor: no such density: 'x'",
    ),
    (
        "multibounce-dielectric alpha 0.3 model wang",
        "multibounce-dielectric: model: 'wang' is of metals (expected heitz or specula)",
    ),
    (
        "smooth-dielectric eta 0",
        "smooth-dielectric: eta: expected a number in [0.001, 1000], got 0",
    ),
    (
        "dielectric alpha 0.3 compensated 2",
        "dielectric: compensated: expected true or false, got 2",
    ),
    ("dielectric", "dielectric: alpha: is missing"),
    (
        "multibounce-dielectric",
        "multibounce-dielectric: alpha: is missing",
    ),
    (
        "multibounce-conductor",
        "multibounce-conductor: alpha: is missing",
    ),
    (
        "coated-diffuse eta 4",
        "coated-diffuse: eta: expected a number in [1, 3], got 4",
    ),
    (
        "coated-diffuse max_depth 1.5",
        "coated-diffuse: max_depth: expected a whole number, got 1.5",
    ),
    (
        "coated-diffuse scattering x",
        "coated-diffuse: no such scattering: 'x' (expected lossless or single)",
    ),
    (
        "layered",
        "layered: expected the base's albedo (diffuse) or its reflectance (metal), one of the two",
    ),
    (
        "layered Au albedo 1",
        "layered: expected the base's albedo (diffuse) or its reflectance (metal), one of the two",
    ),
    (
        "layered albedo 1 base_alpha 0.3",
        "layered: base_alpha: a diffuse base has none",
    ),
    (
        "layered albedo 1 g 1",
        "layered: g: expected a number in [-0.99, 0.99], got 1",
    ),
    (
        "plastic nonlinear yes",
        "plastic: nonlinear: expected true or false, got 'yes'",
    ),
    (
        "principled diff_trans 3",
        "principled: diff_trans: expected a number in [0, 2], got 3",
    ),
    (
        "gltf ior -1",
        "gltf: ior: expected a number in [0, 1000], got -1",
    ),
];

#[test]
fn bad_texts_of_single_kinds_say_what_was_expected() {
    for (text, beginning) in BAD_OF_KINDS {
        let message = parse(text).map_or_else(|e| e.to_string(), |lobe| lobe.to_string());
        assert!(message.starts_with(beginning), "{text}: {message}");
    }
}
