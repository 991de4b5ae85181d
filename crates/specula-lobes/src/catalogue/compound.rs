//! Kinds of several lobes: coats, layers, plastics, principled, glTF.

use super::{
    ALBEDO, ANY, ANY_COLOUR, COAT, COAT_ETA, DISTRIBUTION, ETA, METAL_BASE, SHARE, SMOOTH_ALPHA,
};
use super::{masking, optional, parameter};
use crate::compound;
use crate::kind::Kind;
use crate::parameter::ParameterKind::{Alpha, Choice, Count, Flag, Number};

/// `coated-diffuse`.
pub(super) const COATED_DIFFUSE: Kind = Kind {
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
};

/// `layered`.
pub(super) const LAYERED: Kind = Kind {
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
};

/// `plastic`.
pub(super) const PLASTIC: Kind = Kind {
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
};

/// `principled`.
pub(super) const PRINCIPLED: Kind = Kind {
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
};

/// `gltf`.
pub(super) const GLTF: Kind = Kind {
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
};
