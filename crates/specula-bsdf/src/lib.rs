//! Microfacet mathematics whose pdfs can be trusted: distributions of normals, samplers of visible
//! normals, Fresnel terms and lobes, generic over `f32` and `f64`.
//!
//! Nothing here allocates, does I/O or can fail in `eval`, `pdf` or `sample`: constructors
//! validate or clamp, and a sample that failed is `None`.
//!
//! ```
//! use specula_bsdf::bsdf::RoughConductor;
//! use specula_bsdf::fresnel::{Conductor, Reflectance};
//! use specula_bsdf::math::{rgb, vec3};
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Transport};
//!
//! let gold = Conductor {
//!     eta: rgb(0.14, 0.37, 1.44),
//!     k: rgb(3.98, 2.38, 1.60),
//! };
//! let ggx = Ggx::new(Alpha::new(0.1_f32, 0.4)?);
//! let lobe = RoughConductor::new(ggx, Reflectance::Conductor(gold));
//!
//! let wo = vec3(0.6, 0.0, 0.8);
//! let sample = lobe.sample(wo, [0.1, 0.4, 0.7], Transport::Radiance).expect("above the horizon");
//! let f_cos = lobe.eval(wo, sample.wi, Transport::Radiance);
//! assert!((sample.weight.r - f_cos.r / sample.pdf).abs() < 1e-3);
//! # Ok::<(), specula_bsdf::AlphaError>(())
//! ```
#![forbid(unsafe_code)]

mod alpha;
pub mod batch;
pub mod bsdf;
pub mod energy;
pub mod fresnel;
pub mod math;
pub mod metals;
pub mod multibounce;
pub mod ndf;
pub mod vndf;

pub use alpha::{Alpha, AlphaError};
pub use bsdf::{Bsdf, BsdfSample, Event, Transport};
pub use math::{Frame, Real, Rgb, Vec3};
