//! Energy: what single scattering loses, what compensates for it, and what an interface transmits.
//!
//! | file | what |
//! |---|---|
//! | `albedo` | directional and average albedo of rough reflection, tables |
//! | `dielectric_albedo` | the same of rough interfaces, both branches |
//! | `coordinates` | where the tables have their knots |
//! | `spline`, `rows`, `pairs` | splines, and how their coefficients are stored |
//! | `stencil` | neighbouring knots of a table of values |
//! | `raw_tables` | all tables as plain values, for shaders |
//! | `fit` | directional and average loss of isotropic GGX as short formulas, for shaders |
//! | `model` | Turquin's and Kulla and Conty's factors |
//! | `fresnel_average` | cosine-averaged reflectance |
//! | `interface` | transmittance and internal reflectance, for coats |
//! | `interface_single` | the same where facets scatter once |
//! | `interface_layer` | what an absorbing layer under the interface takes |
//! | `interface_coat` | an interface with its layer, for a coat that is asked often |

pub(crate) mod albedo;
mod albedo_tables;
pub(crate) mod coordinates;
pub(crate) mod dielectric_albedo;
pub(crate) mod fit;
mod fit_coefficients;
pub(crate) mod fresnel_average;
pub(crate) mod interface;
pub(crate) mod interface_coat;
pub(crate) mod interface_layer;
pub(crate) mod interface_single;
mod interface_single_table;
mod interface_table;
pub(crate) mod model;
mod neighbours;
pub(crate) mod pairs;
pub(crate) mod raw_tables;
pub(crate) mod rows;
pub(crate) mod spline;
pub(crate) mod stencil;

pub use albedo::{Loss, Tabulated};
pub use dielectric_albedo::DielectricLoss;
pub use fit::{ggx_average_loss, ggx_loss};
pub use model::{EnergyModel, FmsVariant, UnknownEnergyModel};
