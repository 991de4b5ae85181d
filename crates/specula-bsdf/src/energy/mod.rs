//! Energy: what single scattering loses, what brings it back, and what an interface passes on.
//!
//! | file | what |
//! |---|---|
//! | `albedo` | directional and average albedo of rough reflection, tables |
//! | `dielectric_albedo` | the same of rough interfaces, both branches |
//! | `coordinates` | where the tables have their knots |
//! | `spline`, `rows`, `pairs` | splines, and how their coefficients are stored |
//! | `stencil` | neighbouring knots of a table of values |
//! | `values` | all tables as plain values, for shaders |
//! | `fit` | the directional loss as a short formula, for shaders |
//! | `model` | Turquin's and Kulla and Conty's factors |
//! | `fresnel_average` | cosine-averaged reflectance |
//! | `interface` | transmittance and internal reflectance, for coats |
//! | `interface_single` | the same where facets scatter once |
//! | `interface_layer` | what an absorbing layer under the interface takes |

pub mod albedo;
mod albedo_tables;
pub mod coordinates;
pub mod dielectric_albedo;
pub mod fit;
pub mod fresnel_average;
pub mod interface;
pub mod interface_layer;
pub mod interface_single;
mod interface_single_table;
mod interface_table;
pub mod model;
pub mod pairs;
pub mod raw_tables;
pub mod rows;
pub mod spline;
pub mod stencil;

pub use albedo::{Loss, Tabulated};
pub use dielectric_albedo::DielectricLoss;
pub use model::{EnergyModel, FmsVariant};
