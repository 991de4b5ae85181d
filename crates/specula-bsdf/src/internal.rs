//! What the other crates of the workspace need of this one, and its users do not.
//!
//! Not part of the public interface: it may change with any release. Here are the tables' layout, for
//! the generator that makes them and for shaders that hold copies of them; and terms of lobes, for the
//! tests that compare them with their twins in WGSL and with quadrature.

/// A module of this crate, its public items and no others.
macro_rules! expose {
    ($($(#[$doc:meta])* $name:ident = $path:path),* $(,)?) => {
        $($(#[$doc])* pub mod $name {
            pub use $path::*;
        })*
    };
}

expose!(
    /// Lost energy of rough reflection.
    albedo = crate::energy::albedo,
    /// Coordinates of the tables of lost energy.
    coordinates = crate::energy::coordinates,
    /// Lost energy of rough interfaces.
    dielectric_albedo = crate::energy::dielectric_albedo,
    /// Lost energy of isotropic GGX as polynomials.
    fit = crate::energy::fit,
    /// Cosine-averaged reflectance.
    fresnel_average = crate::energy::fresnel_average,
    /// Albedos of glTF's layers.
    gltf_albedo = crate::bsdf::gltf::albedo,
    /// Transmittance of interfaces.
    interface = crate::energy::interface,
    /// Absorption under interfaces.
    interface_layer = crate::energy::interface_layer,
    /// Transmittance of interfaces whose facets scatter once.
    interface_single = crate::energy::interface_single,
    /// Factors of energy compensation.
    model = crate::energy::model,
    /// Rows of pairs of alphas.
    pairs = crate::energy::pairs,
    /// Transmittance of Mitsuba's plastics.
    plastic_interface = crate::bsdf::plastic::interface,
    /// The tables as plain values.
    raw_tables = crate::energy::raw_tables,
    /// Rows of large tables.
    rows = crate::energy::rows,
    /// Codes of choices in shaders.
    shader_codes = crate::shader_codes,
    /// Splines.
    spline = crate::energy::spline,
    /// Lagrange's interpolation.
    stencil = crate::energy::stencil,
);

pub use crate::multibounce::normalised::{pdf as normalised_pdf, sample as sample_normalised};
pub use crate::multibounce::state::DepthState;
