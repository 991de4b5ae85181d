//! The kinds of lobes: their names, their keys, and who makes them.

use super::given::{Given, Parameter, same};
use super::{LobeHandle, compound, microfacet, reflectance};

/// A kind of lobe.
pub(super) struct Kind {
    pub(super) name: &'static str,
    keys: &'static [&'static str],
    /// Whether it takes the keys of a reflectance, too.
    pub(super) is_metal: bool,
    make: fn(Given<'_>) -> Result<LobeHandle, String>,
}

const KINDS: &[Kind] = &[
    Kind {
        name: "lambert",
        keys: &["albedo"],
        is_metal: false,
        make: microfacet::lambert,
    },
    Kind {
        name: "eon",
        keys: &["albedo", "roughness"],
        is_metal: false,
        make: microfacet::eon,
    },
    Kind {
        name: "diffuse-transmission",
        keys: &["reflectance", "transmittance"],
        is_metal: false,
        make: microfacet::diffuse_transmission,
    },
    Kind {
        name: "smooth-conductor",
        keys: &[],
        is_metal: true,
        make: microfacet::smooth_conductor,
    },
    Kind {
        name: "conductor",
        keys: &["alpha", "distribution", "sampler", "masking", "energy"],
        is_metal: true,
        make: microfacet::conductor,
    },
    Kind {
        name: "multibounce-conductor",
        keys: &["alpha", "distribution", "model", "mis_pdf"],
        is_metal: true,
        make: microfacet::multibounce_conductor,
    },
    Kind {
        name: "smooth-dielectric",
        keys: &["eta", "reflection_tint", "transmission_tint"],
        is_metal: false,
        make: microfacet::smooth_dielectric,
    },
    Kind {
        name: "thin-dielectric",
        keys: &["eta", "reflection_tint", "transmission_tint"],
        is_metal: false,
        make: microfacet::thin_dielectric,
    },
    Kind {
        name: "dielectric",
        keys: &[
            "alpha",
            "eta",
            "distribution",
            "sampler",
            "masking",
            "compensated",
            "reflection_tint",
            "transmission_tint",
        ],
        is_metal: false,
        make: microfacet::dielectric,
    },
    Kind {
        name: "multibounce-dielectric",
        keys: &[
            "alpha",
            "eta",
            "distribution",
            "model",
            "mis_pdf",
            "reflection_tint",
            "transmission_tint",
        ],
        is_metal: false,
        make: microfacet::multibounce_dielectric,
    },
    Kind {
        name: "coated-diffuse",
        keys: &[
            "alpha",
            "eta",
            "albedo",
            "thickness",
            "max_depth",
            "scattering",
        ],
        is_metal: false,
        make: compound::coated_diffuse,
    },
    Kind {
        name: "layered",
        keys: &[
            "alpha",
            "eta",
            "albedo",
            "base_alpha",
            "thickness",
            "medium_albedo",
            "g",
        ],
        is_metal: true,
        make: compound::layered,
    },
    Kind {
        name: "plastic",
        keys: &[
            "alpha",
            "eta",
            "diffuse",
            "specular",
            "nonlinear",
            "distribution",
            "masking",
        ],
        is_metal: false,
        make: compound::plastic,
    },
    Kind {
        name: "principled",
        keys: &[
            "base_color",
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
            "thin",
            "outside",
        ],
        is_metal: false,
        make: compound::principled,
    },
    Kind {
        name: "gltf",
        keys: &[
            "base_color",
            "metallic",
            "roughness",
            "anisotropy",
            "ior",
            "specular",
            "specular_color",
            "transmission",
            "volume",
            "outside",
            "clearcoat",
            "clearcoat_roughness",
            "sheen_color",
            "sheen_roughness",
            "compensated",
        ],
        is_metal: false,
        make: compound::gltf,
    },
];

impl Kind {
    /// A kind by its name.
    pub(super) fn named(name: &str) -> Result<&'static Self, String> {
        KINDS.iter().find(|k| same(k.name, name)).ok_or_else(|| {
            let known: Vec<_> = KINDS.iter().map(|k| k.name).collect();
            format!(
                "no such lobe: '{name}' (expected one of {})",
                known.join(", ")
            )
        })
    }

    fn keys(&self) -> impl Iterator<Item = &'static str> {
        let of_metals: &[&str] = if self.is_metal {
            &reflectance::KEYS
        } else {
            &[]
        };
        self.keys.iter().chain(of_metals).copied()
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.keys().any(|known| same(known, key))
    }

    /// What is said of a word that is no key.
    pub(super) fn unknown(&self, word: &str) -> String {
        let known: Vec<_> = self.keys().collect();
        format!(
            "{}: no such parameter: '{word}' (expected one of {})",
            self.name,
            known.join(", ")
        )
    }

    pub(super) fn make(&self, parameters: &[Parameter<'_>]) -> Result<LobeHandle, String> {
        for (i, parameter) in parameters.iter().enumerate() {
            if !self.has(parameter.name) {
                return Err(self.unknown(parameter.name));
            }
            if parameters[..i].iter().any(|p| same(p.name, parameter.name)) {
                return Err(format!("{}: {}: is given twice", self.name, parameter.name));
            }
        }
        (self.make)(Given(parameters)).map_err(|problem| {
            let known: Vec<_> = self.keys().collect();
            format!(
                "{}: {problem}; its parameters are {}",
                self.name,
                known.join(", ")
            )
        })
    }
}

/// Makes a lobe of a kind.
pub(crate) fn make(kind: &str, parameters: &[Parameter<'_>]) -> Result<LobeHandle, String> {
    Kind::named(kind)?.make(parameters)
}
