//! The values that the modules of `energy` and some lobes read, as one array.
//!
//! A shader's `energy_table(index)` gives the number at a place of this array; the modules hold the
//! offsets of their tables as constants, which a test compares with [`offset`].

use std::sync::LazyLock;

use specula_bsdf::internal::raw_tables::{interfaces, losses};
use specula_bsdf::internal::{gltf_albedo, plastic_interface};

/// All tables, one after the other.
struct Tables {
    names: Vec<(String, usize)>,
    bytes: Vec<u8>,
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let mut tables = Tables {
        names: Vec::new(),
        bytes: Vec::new(),
    };
    for (table, prefix) in ["GGX", "GGX_SEPARABLE", "BECKMANN", "BECKMANN_SEPARABLE"]
        .into_iter()
        .enumerate()
    {
        for (name, values) in losses(table) {
            tables.push(format!("{prefix}_{name}"), &values);
        }
    }
    for (name, values) in interfaces() {
        tables.push(format!("COAT_{name}"), &values);
    }
    let plastic = ["PLASTIC_TRANSMITTANCE", "PLASTIC_INTERNAL"];
    let gltf = ["GLTF_SCHLICK", "GLTF_SHEEN"];
    let pairs = plastic.into_iter().zip(plastic_interface::raw_tables());
    for (name, values) in pairs.chain(gltf.into_iter().zip(gltf_albedo::raw_tables())) {
        tables.push(name.to_owned(), &values);
    }
    tables
});

impl Tables {
    fn push(&mut self, name: String, values: &[f32]) {
        self.names.push((name, self.bytes.len() / 4));
        self.bytes
            .extend(values.iter().flat_map(|x| x.to_le_bytes()));
    }
}

/// The array as bytes: `f32`, little-endian, 3.7 MB.
#[must_use]
pub fn tables() -> &'static [u8] {
    &TABLES.bytes
}

/// Where a table begins, in values.
///
/// Names: `GGX`, `GGX_SEPARABLE`, `BECKMANN` or `BECKMANN_SEPARABLE`, `_`, and a name of
/// `specula_bsdf::internal::raw_tables::losses`; `COAT_` and a name of `interfaces` there;
/// `PLASTIC_TRANSMITTANCE`, `PLASTIC_INTERNAL`, `GLTF_SCHLICK`, `GLTF_SHEEN`.
#[must_use]
pub fn offset(name: &str) -> Option<usize> {
    let found = TABLES.names.iter().find(|(n, _)| n == name);
    found.map(|&(_, at)| at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MODULES;

    /// Constants of the modules, and the tables that begin there.
    const STARTS: [(&str, &str); 19] = [
        ("ALBEDO_ISOTROPIC_START", "GGX_ISOTROPIC"),
        ("ALBEDO_ISOTROPIC_AVERAGE_START", "GGX_ISOTROPIC_AVERAGE"),
        ("ALBEDO_ANISOTROPIC_START", "GGX_ANISOTROPIC"),
        (
            "ALBEDO_ANISOTROPIC_AVERAGE_START",
            "GGX_ANISOTROPIC_AVERAGE",
        ),
        ("ALBEDO_TABLES_STRIDE", "GGX_SEPARABLE_ISOTROPIC"),
        ("DIELECTRIC_ALBEDO_START", "GGX_INTERFACE"),
        ("DIELECTRIC_ALBEDO_AVERAGE_START", "GGX_INTERFACE_AVERAGE"),
        (
            "DIELECTRIC_ALBEDO_ANISOTROPIC_START",
            "GGX_INTERFACE_ANISOTROPIC",
        ),
        (
            "DIELECTRIC_ALBEDO_ANISOTROPIC_AVERAGE_START",
            "GGX_INTERFACE_ANISOTROPIC_AVERAGE",
        ),
        ("INTERFACE_TRANSMITTANCE_START", "COAT_TRANSMITTANCE"),
        ("INTERFACE_INTERNAL_START", "COAT_INTERNAL"),
        (
            "INTERFACE_SINGLE_TRANSMITTANCE_START",
            "COAT_SINGLE_TRANSMITTANCE",
        ),
        ("INTERFACE_SINGLE_INTERNAL_START", "COAT_SINGLE_INTERNAL"),
        ("INTERFACE_LAYER_CROSSING_START", "COAT_CROSSING"),
        (
            "INTERFACE_LAYER_THERE_AND_BACK_START",
            "COAT_THERE_AND_BACK",
        ),
        (
            "PLASTIC_INTERFACE_TRANSMITTANCE_START",
            "PLASTIC_TRANSMITTANCE",
        ),
        ("PLASTIC_INTERFACE_INTERNAL_START", "PLASTIC_INTERNAL"),
        ("GLTF_ALBEDO_SCHLICK_START", "GLTF_SCHLICK"),
        ("GLTF_ALBEDO_SHEEN_START", "GLTF_SHEEN"),
    ];

    /// The constant of a name, wherever it is.
    fn constant(name: &str) -> usize {
        let head = format!("const {name}: u32 = ");
        let rest = MODULES.iter().find_map(|m| m.text.split_once(&head));
        let (_, rest) = rest.unwrap_or_else(|| panic!("no constant {name}"));
        let (number, _) = rest.split_once("u;").unwrap();
        number.parse().unwrap()
    }

    #[test]
    fn modules_read_where_the_tables_are() {
        for (constant_name, table) in STARTS {
            assert_eq!(
                Some(constant(constant_name)),
                offset(table),
                "{constant_name}"
            );
        }
        let stride = constant("ALBEDO_TABLES_STRIDE");
        for (i, distribution) in ["GGX_SEPARABLE", "BECKMANN", "BECKMANN_SEPARABLE"]
            .into_iter()
            .enumerate()
        {
            for part in ["ISOTROPIC", "INTERFACE_ANISOTROPIC_AVERAGE"] {
                let there = offset(&format!("{distribution}_{part}")).unwrap();
                assert_eq!(
                    there,
                    offset(&format!("GGX_{part}")).unwrap() + (i + 1) * stride
                );
            }
        }
        // No constant of that kind is left out.
        let named = MODULES.iter().flat_map(|m| m.text.lines());
        let starts = named.filter(|l| l.starts_with("const ") && l.contains("_START: u32"));
        assert_eq!(starts.count(), STARTS.len() - 1);
    }

    #[test]
    fn the_array_is_whole_and_its_numbers_are_sound() {
        let values: Vec<f32> = tables()
            .as_chunks()
            .0
            .iter()
            .map(|b| f32::from_le_bytes(*b))
            .collect();
        assert_eq!(values.len(), 924_064);
        assert!(values.iter().all(|x| x.is_finite() && x.abs() < 13.0));
        assert!(offset("GGX").is_none());
    }
}
