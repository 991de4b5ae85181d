//! The native half of the Python package `specula_render`.
//!
//! | module | holds |
//! |---|---|
//! | `arrays` | arrays of Python as slices, checked |
//! | `parameters` | colours, alphas and names out of Python's arguments |
//! | `parallel` | loops over blocks of elements, by several threads |
//! | `bsdf` | lobes over arrays |
//! | `reflectance` | Fresnel terms |
//! | `render` | scenes, renders, pictures |
//! | `distribution` | distributions of normals and their samplers |
//! | `energy` | tables of lost energy |
//! | `command_line` | the program `specula` |

mod arrays;
mod bsdf;
mod command_line;
mod distribution;
mod energy;
mod parallel;
mod parameters;
mod reflectance;
mod render;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::bsdf::{
        Bsdf, CoatedDiffuse, DiffuseTransmission, Eon, Gltf, Hair, Lambert, Layered, MeasuredBrdf,
        MultibounceConductor, MultibounceDielectric, Plastic, Principled, RoughConductor,
        RoughDielectric, Samples, SmoothConductor, SmoothDielectric, ThinDielectric,
    };
    #[pymodule_export]
    use super::command_line::command_line;
    #[pymodule_export]
    use super::distribution::{Beckmann, Ggx};
    #[pymodule_export]
    use super::energy::energy_tables;
    #[pymodule_export]
    use super::reflectance::{Reflectance, dielectric, metals};
    #[pymodule_export]
    use super::render::{Material, PictureData, RenderJob, SceneData, builtin, load, read_exr};

    use pyo3::prelude::*;
    use specula_bsdf::batch::Level;

    /// The vector instructions that this machine runs.
    #[pyfunction]
    fn level() -> String {
        Level::best().to_string()
    }

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
