//! The kinds of lobes with their parameters: the one definition that readers, pages and documentation use.

use crate::kinds::Kind;
use crate::parameter::ParameterKind::{Alpha, Choice, Colour, Count, Flag, Number};
use crate::parameter::{NO_END, Parameter, ParameterKind};
use crate::{compound, microfacet};

const SHARE: ParameterKind = Number {
    low: 0.0,
    high: 1.0,
};
const ANY: ParameterKind = Number {
    low: 0.0,
    high: NO_END,
};
const ALBEDO: ParameterKind = Colour {
    low: 0.0,
    high: 1.0,
};
const ANY_COLOUR: ParameterKind = Colour {
    low: 0.0,
    high: NO_END,
};

const fn parameter(
    key: &'static str,
    kind: ParameterKind,
    default: &'static str,
    doc: &'static str,
) -> Parameter {
    let default = Some(default);
    Parameter {
        key,
        kind,
        default,
        doc,
    }
}

const fn optional(key: &'static str, kind: ParameterKind, doc: &'static str) -> Parameter {
    Parameter {
        key,
        kind,
        default: None,
        doc,
    }
}

const NEEDED_ALPHA: Parameter = optional(
    "alpha",
    Alpha,
    "width of the facets' slopes, along x and y; must be given",
);
const SMOOTH_ALPHA: Parameter = optional(
    "alpha",
    Alpha,
    "width of the facets' slopes, along x and y; smooth without",
);
const ETA: Parameter = parameter(
    "eta",
    Number {
        low: 1e-3,
        high: 1e3,
    },
    "1.5",
    "index of refraction inside, over that outside",
);
const COAT: ParameterKind = Number {
    low: 1.0,
    high: 3.0,
};
const COAT_ETA: Parameter = parameter("eta", COAT, "1.5", "index of refraction of the coat");
const DISTRIBUTION: Parameter = parameter(
    "distribution",
    Choice(&["ggx", "beckmann"]),
    "ggx",
    "distribution of the facets' normals",
);
const fn sampler(default: &'static str) -> Parameter {
    parameter(
        "sampler",
        Choice(&["exact", "bounded", "cap", "heitz"]),
        default,
        "sampler of visible GGX normals; of Beckmann's there is one",
    )
}
const fn masking(default: &'static str) -> Parameter {
    parameter(
        "masking",
        Choice(&["height-correlated", "separable"]),
        default,
        "how shadowing and masking go together",
    )
}
const MIS_PDF: Parameter = parameter(
    "mis_pdf",
    Choice(&["normalised", "hapke", "lambert"]),
    "normalised",
    "density of all bounces, for multiple importance sampling",
);
const REFLECTION_TINT: Parameter = parameter(
    "reflection_tint",
    ALBEDO,
    "1",
    "factor on what is reflected",
);
const TRANSMISSION_TINT: Parameter = parameter(
    "transmission_tint",
    ALBEDO,
    "1",
    "factor on what is transmitted",
);
const DIFFUSE_ALBEDO: Parameter =
    parameter("albedo", ALBEDO, "0.5", "share of light that is reflected");
const PANE: &[Parameter] = &[ETA, REFLECTION_TINT, TRANSMISSION_TINT];

const CONDUCTOR_ETA: Parameter = optional(
    "conductor_eta",
    ANY_COLOUR,
    "real part of the index of refraction, with conductor_k",
);
const CONDUCTOR_K: Parameter = optional(
    "conductor_k",
    ANY_COLOUR,
    "imaginary part of the index of refraction, with conductor_eta",
);
const F0: Parameter = optional("f0", ALBEDO, "reflectance at normal incidence (Schlick)");
const F82_TINT: Parameter = optional(
    "f82_tint",
    ALBEDO,
    "factor at 82 degrees on the reflectance of f0",
);
const TINT: Parameter = optional("tint", ALBEDO, "factor on the reflectance that is given");

/// The reflectance of metals.
const METAL: &[Parameter] = &[
    parameter(
        "reflectance",
        ParameterKind::Metal,
        "1",
        "a measured metal's symbol, or a constant colour",
    ),
    CONDUCTOR_ETA,
    CONDUCTOR_K,
    F0,
    F82_TINT,
    TINT,
];
/// That of a base, which may be none.
const METAL_BASE: &[Parameter] = &[
    optional(
        "reflectance",
        ParameterKind::Metal,
        "of a metal as the base: its symbol, or a constant colour",
    ),
    CONDUCTOR_ETA,
    CONDUCTOR_K,
    F0,
    F82_TINT,
    TINT,
];

pub(crate) static KINDS: [Kind; 15] = [
    Kind {
        name: "lambert",
        doc: "diffuse reflection",
        own: &[DIFFUSE_ALBEDO],
        reflectance: &[],
        make: microfacet::lambert,
    },
    Kind {
        name: "eon",
        doc: "rough diffuse reflection (energy-preserving Oren-Nayar)",
        own: &[
            DIFFUSE_ALBEDO,
            parameter("roughness", SHARE, "0.5", "spread of the facets' slopes"),
        ],
        reflectance: &[],
        make: microfacet::eon,
    },
    Kind {
        name: "diffuse-transmission",
        doc: "a thin sheet that scatters to both sides",
        own: &[
            parameter("reflectance", ALBEDO, "0.25", "share that is reflected"),
            parameter("transmittance", ALBEDO, "0.25", "share that is transmitted"),
        ],
        reflectance: &[],
        make: microfacet::diffuse_transmission,
    },
    Kind {
        name: "smooth-conductor",
        doc: "a mirror of metal",
        own: &[],
        reflectance: METAL,
        make: microfacet::smooth_conductor,
    },
    Kind {
        name: "conductor",
        doc: "rough metal that scatters once, or with compensated energy",
        own: &[
            NEEDED_ALPHA,
            DISTRIBUTION,
            sampler("exact"),
            masking("height-correlated"),
            optional(
                "energy",
                Choice(&["turquin", "turquin-series", "kulla-conty"]),
                "what makes up for the energy that one bounce loses",
            ),
        ],
        reflectance: METAL,
        make: microfacet::conductor,
    },
    Kind {
        name: "multibounce-conductor",
        doc: "rough metal with all bounces between facets, by random walks",
        own: &[
            NEEDED_ALPHA,
            DISTRIBUTION,
            parameter(
                "model",
                Choice(&[
                    "specula",
                    "heitz",
                    "bitterli",
                    "wang",
                    "wang-uncorrelated",
                    "cui",
                    "cui-bidirectional",
                ]),
                "specula",
                "estimator of the bounces",
            ),
            MIS_PDF,
        ],
        reflectance: METAL,
        make: microfacet::multibounce_conductor,
    },
    Kind {
        name: "smooth-dielectric",
        doc: "clear glass",
        own: PANE,
        reflectance: &[],
        make: microfacet::smooth_dielectric,
    },
    Kind {
        name: "thin-dielectric",
        doc: "a pane of clear glass",
        own: PANE,
        reflectance: &[],
        make: microfacet::thin_dielectric,
    },
    Kind {
        name: "dielectric",
        doc: "rough glass that scatters once, or with compensated energy",
        own: &[
            NEEDED_ALPHA,
            ETA,
            DISTRIBUTION,
            sampler("cap"),
            masking("height-correlated"),
            parameter(
                "compensated",
                Flag,
                "false",
                "whether the energy that one bounce loses is made up for",
            ),
            REFLECTION_TINT,
            TRANSMISSION_TINT,
        ],
        reflectance: &[],
        make: microfacet::dielectric,
    },
    Kind {
        name: "multibounce-dielectric",
        doc: "rough glass with all bounces between facets, by random walks",
        own: &[
            NEEDED_ALPHA,
            ETA,
            DISTRIBUTION,
            parameter(
                "model",
                Choice(&["specula", "heitz"]),
                "specula",
                "estimator of the bounces",
            ),
            MIS_PDF,
            REFLECTION_TINT,
            TRANSMISSION_TINT,
        ],
        reflectance: &[],
        make: microfacet::multibounce_dielectric,
    },
    Kind {
        name: "coated-diffuse",
        doc: "a clear coat over a diffuse base",
        own: &[
            SMOOTH_ALPHA,
            COAT_ETA,
            parameter("albedo", ALBEDO, "0.5", "albedo of the base"),
            parameter("thickness", ANY, "0", "optical thickness of the coat"),
            optional(
                "max_depth",
                Count,
                "bounces between coat and base; no limit without",
            ),
            parameter(
                "scattering",
                Choice(&["lossless", "single"]),
                "lossless",
                "whether the coat's facets keep all energy or scatter once",
            ),
        ],
        reflectance: &[],
        make: compound::coated_diffuse,
    },
    Kind {
        name: "layered",
        doc: "a coat and a medium over a diffuse base or a metal, by random walks",
        own: &[
            SMOOTH_ALPHA,
            COAT_ETA,
            optional("albedo", ALBEDO, "albedo of a diffuse base"),
            optional(
                "base_alpha",
                Alpha,
                "width of the slopes of a metal as the base; smooth without",
            ),
            parameter("thickness", ANY, "0", "optical thickness of the medium"),
            parameter(
                "medium_albedo",
                ALBEDO,
                "0",
                "share that the medium scatters of what it takes",
            ),
            parameter(
                "g",
                Number {
                    low: -0.99,
                    high: 0.99,
                },
                "0",
                "mean cosine of the medium's scattering",
            ),
        ],
        reflectance: METAL_BASE,
        make: compound::layered,
    },
    Kind {
        name: "plastic",
        doc: "Mitsuba's plastics: a coat over a diffuse base",
        own: &[
            SMOOTH_ALPHA,
            parameter("eta", COAT, "1.49", "index of refraction of the coat"),
            parameter("diffuse", ALBEDO, "0.5", "albedo of the base"),
            parameter("specular", ALBEDO, "1", "factor on the coat's reflection"),
            parameter(
                "nonlinear",
                Flag,
                "false",
                "whether bounces under the coat saturate the colour",
            ),
            DISTRIBUTION,
            masking("separable"),
        ],
        reflectance: &[],
        make: compound::plastic,
    },
    Kind {
        name: "principled",
        doc: "Mitsuba's principled material",
        own: &[
            parameter("base_color", ALBEDO, "0.5", "colour of the base"),
            parameter(
                "roughness",
                SHARE,
                "0.5",
                "the artist's: alpha is its square",
            ),
            parameter("anisotropic", SHARE, "0", "how much the alphas differ"),
            parameter("metallic", SHARE, "0", "share of metal"),
            parameter("spec_trans", SHARE, "0", "share of glass"),
            ETA,
            parameter(
                "spec_tint",
                SHARE,
                "0",
                "how much the base colours the highlight",
            ),
            parameter("sheen", SHARE, "0", "sheen at grazing angles"),
            parameter(
                "sheen_tint",
                SHARE,
                "0",
                "how much the base colours the sheen",
            ),
            parameter("clearcoat", SHARE, "0", "strength of the coat"),
            parameter("clearcoat_gloss", SHARE, "0", "gloss of the coat"),
            parameter(
                "flatness",
                SHARE,
                "0",
                "share of flat diffuse reflection, where thin",
            ),
            parameter(
                "diff_trans",
                Number {
                    low: 0.0,
                    high: 2.0,
                },
                "0",
                "diffuse transmission, where thin; 2 is all",
            ),
            parameter("thin", Flag, "false", "whether it is a sheet"),
            parameter(
                "outside",
                Flag,
                "true",
                "whether it is seen from outside of its shape",
            ),
        ],
        reflectance: &[],
        make: compound::principled,
    },
    Kind {
        name: "gltf",
        doc: "glTF's material",
        own: &[
            parameter("base_color", ALBEDO, "1", "colour of the base"),
            parameter("metallic", SHARE, "1", "share of metal"),
            parameter("roughness", SHARE, "1", "the artist's: alpha is its square"),
            parameter("anisotropy", SHARE, "0", "how much the alphas differ"),
            parameter(
                "ior",
                Number {
                    low: 0.0,
                    high: 1e3,
                },
                "1.5",
                "index of refraction; 0: reflects all",
            ),
            parameter(
                "specular",
                SHARE,
                "1",
                "strength of the dielectric's reflection",
            ),
            parameter(
                "specular_color",
                ANY_COLOUR,
                "1",
                "factor on its reflection at normal incidence",
            ),
            parameter("transmission", SHARE, "0", "share of glass"),
            parameter(
                "volume",
                Flag,
                "false",
                "whether there is an inside, or it is a sheet",
            ),
            parameter(
                "outside",
                Flag,
                "true",
                "whether it is seen from outside; where volume is set",
            ),
            parameter("clearcoat", SHARE, "0", "strength of the coat"),
            parameter("clearcoat_roughness", SHARE, "0", "roughness of the coat"),
            parameter("sheen_color", ALBEDO, "0", "colour of the sheen"),
            parameter("sheen_roughness", SHARE, "0", "roughness of the sheen"),
            parameter(
                "compensated",
                Flag,
                "false",
                "whether the energy that one bounce loses is made up for",
            ),
        ],
        reflectance: &[],
        make: compound::gltf,
    },
];
