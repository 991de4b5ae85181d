//! Small files of measured materials: rough metal.

use specula_bsdf::Alpha;
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::rgb;
use specula_bsdf::measured::{MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;

fn tables_of([x, y]: [f64; 2], symmetry: Symmetry) -> MeasuredTables {
    let ndf = Ggx::new(Alpha::clamped(x, y));
    let metal = RoughConductor::new(ndf, Reflectance::Constant(rgb(0.9, 0.6, 0.3)));
    let size = Resolution {
        theta: 4,
        phi: 3,
        normals: [8, 6],
        colours: 4,
    };
    tabulate(&ndf, &metal, symmetry, size)
}

/// The tables of an isotropic one.
pub(crate) fn tables() -> MeasuredTables {
    tables_of([0.4; 2], Symmetry::Isotropic)
}

/// Those of an anisotropic one.
pub(crate) fn anisotropic_tables() -> MeasuredTables {
    tables_of([0.3, 0.6], Symmetry::QuarterTurn)
}

/// The isotropic file.
pub(crate) fn file() -> Vec<u8> {
    specula_scene::measured::to_bytes(&tables(), "rough metal")
}
