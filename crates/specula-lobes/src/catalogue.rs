//! The kinds of lobes with their parameters: the one definition that readers, pages and documentation use.

mod compound;

use crate::kind::Kind;
use crate::microfacet;
use crate::parameter::ParameterKind::{Alpha, Choice, Colour, Flag, Number};
use crate::parameter::{NO_END, Parameter, ParameterKind};

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
    compound::COATED_DIFFUSE,
    compound::LAYERED,
    compound::PLASTIC,
    compound::PRINCIPLED,
    compound::GLTF,
];
