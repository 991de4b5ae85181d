//! The tables as plain values, for shaders, which cannot read the text that they are stored in.

use alloc::vec::Vec;

use super::albedo_tables::TABLES;
use super::{interface_single_table, interface_table};

/// A table and what it is called.
pub type NamedTable = (&'static str, Vec<f32>);

/// The tables of lost energy, coefficients of splines, of one distribution and masking.
///
/// * `table`: 0 to 3: GGX with height-correlated and with separable masking, Beckmann with both.
///
/// # Panics
/// Where `table` is above 3.
pub fn losses(table: usize) -> [NamedTable; 8] {
    let t = &TABLES[table];
    [
        ("ISOTROPIC", t.isotropic.as_flattened().to_vec()),
        ("ISOTROPIC_AVERAGE", t.isotropic_average.to_vec()),
        ("ANISOTROPIC", t.anisotropic.values().collect()),
        ("ANISOTROPIC_AVERAGE", t.anisotropic_average.to_vec()),
        ("INTERFACE", t.interface.values().collect()),
        (
            "INTERFACE_AVERAGE",
            t.interface_average.as_flattened().to_vec(),
        ),
        (
            "INTERFACE_ANISOTROPIC",
            t.anisotropic_interface.values().collect(),
        ),
        (
            "INTERFACE_ANISOTROPIC_AVERAGE",
            t.anisotropic_interface_average.as_flattened().to_vec(),
        ),
    ]
}

/// The tables of what interfaces let through and reflect (`interface`, `interface_single`,
/// `interface_layer`).
pub fn interfaces() -> [NamedTable; 6] {
    use interface_single_table as single;
    let cubes = |table: &[[[f32; 25]; 25]]| table.as_flattened().as_flattened().to_vec();
    [
        ("TRANSMITTANCE", cubes(&interface_table::TRANSMITTANCE)),
        (
            "INTERNAL",
            interface_table::INTERNAL_REFLECTANCE
                .as_flattened()
                .to_vec(),
        ),
        ("SINGLE_TRANSMITTANCE", cubes(&single::TRANSMITTANCE)),
        (
            "SINGLE_INTERNAL",
            single::INTERNAL_REFLECTANCE.as_flattened().to_vec(),
        ),
        (
            "CROSSING",
            single::CROSSING
                .as_flattened()
                .as_flattened()
                .as_flattened()
                .to_vec(),
        ),
        (
            "THERE_AND_BACK",
            single::THERE_AND_BACK
                .as_flattened()
                .as_flattened()
                .to_vec(),
        ),
    ]
}
