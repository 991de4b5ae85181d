//! Statistical proof for samplers and BSDFs: of this project's lobes, and of anybody's own.
//!
//! Describe a BSDF as a [`Subject`] (three closures, or anything that implements
//! [`specula_bsdf::Bsdf`]) and hand it to [`prove`]: it answers with a [`Report`]. Each check can
//! be called alone too:
//!
//! * [`chi_square`]: do samples follow the pdf, missing mass included?
//! * [`normalisation`]: does the pdf integrate to the rate at which samples are accepted?
//! * [`consistency`]: is `weight = f cos / pdf`, and everything finite and non-negative?
//! * [`reciprocity`]: are the two directions exchangeable?
//! * [`furnace`]: do samples reflect as much light as the quadrature of `f cos` says?
//! * [`twin`]: does the `f32` code compute what the `f64` code does?
//! * [`z_test`] and [`image`]: are two noisy means, or two noisy images, the same?
//!
//! Directions point away from the surface in the local frame, z up: `wo` towards the viewer,
//! given; `wi` towards the light, sampled. Every check has a fixed seed: a result is the same
//! today and tomorrow, on any machine.
//!
//! # Examples
//!
//! A sampler whose pdf is wrong (uniform directions, said to be cosine-weighted) is caught:
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
mod plot;
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
