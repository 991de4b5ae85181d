//! Statistical tests of samplers and BSDFs.
//!
//! Describe a BSDF as a [`Subject`]: three closures, or anything that implements
//! [`specula_bsdf::Bsdf`]. [`prove`] runs every check and returns a [`Report`]. Each check can
//! also be called alone:
//!
//! * [`chi_square`]: do samples follow the pdf, missing mass included?
//! * [`normalisation`]: does the pdf integrate to the rate at which samples are accepted?
//! * [`consistency`]: is `weight = f cos / pdf`, and everything finite and non-negative?
//! * [`reciprocity`]: is `f` the same where the two directions are exchanged?
//! * [`furnace`]: is the mean weight of samples the quadrature of `f cos`?
//! * [`twin`]: does the `f32` code compute what the `f64` code does?
//! * [`z_test`] and [`image`]: are two noisy means, or two noisy images, the same?
//!
//! Directions point away from the surface in the local frame, z up: `wo` towards the viewer,
//! given; `wi` towards the light, sampled. Every check has a fixed seed: results are the same on
//! every machine.
//!
//! # Examples
//!
//! A sampler with a wrong pdf (uniform directions, claimed to be cosine-weighted) fails:
//!
//! ```
//! use specula_bsdf::Rgb;
//! use specula_stat::{DirectionSample, Plan, Subject, prove, quadrature::direction};
//! use std::f64::consts::PI;
//!
//! let wrong = Subject::new(
//!     |_wo, wi| Rgb::splat(wi.z.max(0.0) / PI),
//!     |_wo, wi| wi.z.max(0.0) / PI,
//!     |_wo, u| {
//!         let wi = direction(u[1], 2.0 * PI * u[2]);
//!         Some(DirectionSample::new(wi, Rgb::splat(1.0)))
//!     },
//! );
//! let report = prove("cosine", &wrong, &[direction(0.7, 0.3)], &Plan::default());
//! assert!(!report.is_pass());
//! ```
#![forbid(unsafe_code)]

pub mod chi_square;
pub mod consistency;
pub mod furnace;
pub mod image;
pub mod normalisation;
mod proof;
pub mod quadrature;
pub mod reciprocity;
mod report;
mod rng;
mod subject;
pub mod twin;
pub mod z_test;

pub use proof::{Plan, prove};
pub use report::{Check, Report};
pub use rng::Rng;
pub use subject::{DirectionSample, Subject};

/// The Rust of the README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
