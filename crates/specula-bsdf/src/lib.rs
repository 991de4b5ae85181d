//! Microfacet BSDFs whose pdfs can be trusted: distributions of normals, samplers of visible
//! normals, Fresnel terms and lobes, generic over `f32` and `f64`.
//!
//! | module | holds |
//! |---|---|
//! | [`bsdf`] | the trait [`Bsdf`] and every lobe |
//! | [`ndf`] | distributions of microfacet normals, masking |
//! | [`vndf`] | samplers of visible normals and of reflections |
//! | [`fresnel`] | reflectance of conductors and dielectrics |
//! | [`hair`] | fibres of hair and fur |
//! | [`measured`] | measured materials: tables of the RGL database |
//! | [`metals`] | measured metals |
//! | [`energy`] | energy compensation |
//! | [`multibounce`] | models of all bounces between facets |
//! | [`batch`] | many elements at once, in vectors |
//! | [`math`] | vectors, colours, frames |
//!
//! # Conventions
//!
//! Directions are unit and point away from the surface. They are in the local frame of the surface,
//! whose z is the normal ([`Frame`] converts). `wo` leads to the viewer and is given; `wi` leads to
//! the light and is sampled. `eval` returns `f |cos theta_i|`; `pdf` is per steradian; the weight of
//! a sample is `f |cos theta_i| / pdf`. `alpha` is the parameter of a distribution, not an artist's
//! roughness.
//!
//! No function panics, whatever its arguments: constructors return errors or clamp, and a sample
//! that failed is `None`. Nothing allocates, does I/O or starts threads in `eval`, `pdf` or `sample`.
//! Directions that are not unit, and NaN, give values without meaning.
//!
//! # Sample gold
//!
//! ```
//! use specula_bsdf::bsdf::RoughConductor;
//! use specula_bsdf::fresnel::{Conductor, Reflectance};
//! use specula_bsdf::math::vec3;
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Transport, metals};
//!
//! let gold = metals::by_symbol("Au").expect("measured");
//! let gold = Conductor { eta: gold.eta.into(), k: gold.k.into() };
//! let ggx = Ggx::new(Alpha::new(0.1, 0.4)?);
//! let lobe = RoughConductor::new(ggx, Reflectance::Conductor(gold));
//!
//! let wo = vec3(0.6, 0.0, 0.8);
//! let u = [0.1, 0.4, 0.7]; // uniform random numbers
//! let sample = lobe.sample(wo, u, Transport::Radiance).expect("above the horizon");
//! let f_cos = lobe.eval(wo, sample.wi, Transport::Radiance);
//! assert!((sample.weight.r - f_cos.r / sample.pdf).abs() < 1e-12);
//! assert!((sample.pdf - lobe.pdf(wo, sample.wi)).abs() < 1e-12 * sample.pdf);
//! # Ok::<(), specula_bsdf::AlphaError>(())
//! ```
//!
//! # Compensate energy
//!
//! A rough metal that scatters once is too dark. [`Compensated`](bsdf::Compensated) adds what its
//! other bounces would:
//!
//! ```
//! use specula_bsdf::bsdf::{Compensated, RoughConductor};
//! use specula_bsdf::energy::{EnergyModel, FmsVariant};
//! use specula_bsdf::fresnel::Reflectance;
//! use specula_bsdf::math::{Rgb, vec3};
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Transport};
//!
//! let ggx = Ggx::new(Alpha::isotropic(0.8_f64));
//! let white = Reflectance::Constant(Rgb::WHITE);
//! let single = RoughConductor::new(ggx, white);
//! let model = EnergyModel::Turquin(FmsVariant::NormalIncidence);
//! let compensated = Compensated::new(ggx, white, model);
//!
//! // The share of light that is reflected: the mean of the weights.
//! fn albedo(lobe: &impl Bsdf<f64>) -> f64 {
//!     let n = 64;
//!     let point = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
//!     let weights = (0..n * n).map(|i| {
//!         let u = [0.5, point(i % n), point(i / n)];
//!         let sample = lobe.sample(vec3(0.0, 0.6, 0.8), u, Transport::Radiance);
//!         sample.map_or(0.0, |s| s.weight.g)
//!     });
//!     weights.sum::<f64>() / f64::from(n * n)
//! }
//! assert!(albedo(&single) < 0.9);
//! assert!((albedo(&compensated) - 1.0).abs() < 2e-3);
//! ```
//!
//! # All bounces
//!
//! [`MultibounceConductor`](bsdf::MultibounceConductor) simulates them. Its values are estimates:
//! pass a stream of random numbers of your own, and average.
//!
//! ```
//! use specula_bsdf::bsdf::MultibounceConductor;
//! use specula_bsdf::fresnel::Reflectance;
//! use specula_bsdf::math::{Rgb, Stream, vec3};
//! use specula_bsdf::multibounce::MultibounceModel;
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Transport};
//!
//! let ggx = Ggx::new(Alpha::isotropic(0.8_f32));
//! let white = Reflectance::Constant(Rgb::WHITE);
//! let lobe = MultibounceConductor::new(ggx, white, MultibounceModel::default());
//! assert!(lobe.is_stochastic());
//!
//! let (wo, wi) = (vec3(0.6, 0.0, 0.8), vec3(0.0, 0.6, 0.8));
//! let mut stream = Stream::new(1);
//! let n = 256;
//! let mut sum = 0.0;
//! for _ in 0..n {
//!     let (f_cos, _pdf) = lobe.eval_pdf_random(wo, wi, Transport::Radiance, &mut stream);
//!     sum += f_cos.g / n as f32;
//! }
//! assert!(sum > 0.1 && sum < 0.5);
//! ```
//!
//! # Glass
//!
//! `eta` is the index inside over the index outside; `wo.z < 0` looks from inside.
//!
//! ```
//! use specula_bsdf::bsdf::RoughDielectric;
//! use specula_bsdf::math::vec3;
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Event, Transport};
//!
//! let glass = RoughDielectric::new(Ggx::new(Alpha::isotropic(0.2_f32)), 1.5);
//! let wo = vec3(0.6, 0.0, 0.8);
//! let sample = glass.sample(wo, [0.5, 0.3, 0.6], Transport::Radiance).expect("refracted");
//! assert_eq!(sample.event, Event::Transmission);
//! assert!(sample.wi.z < 0.0);
//! // Radiance is compressed in the denser medium, importance is not.
//! let importance = glass.sample(wo, [0.5, 0.3, 0.6], Transport::Importance).expect("refracted");
//! assert!((importance.weight.g / sample.weight.g - 1.5 * 1.5).abs() < 1e-5);
//! ```
//!
//! # Many elements at once
//!
//! [`batch`] evaluates structures of arrays, vectorised for the machine. Its first page has an
//! example.
//!
//! # Multiple importance sampling with a light
//!
//! Sample the light and the lobe; weigh each by the power heuristic (Veach and Guibas 1995):
//!
//! ```
//! use specula_bsdf::bsdf::RoughConductor;
//! use specula_bsdf::fresnel::Reflectance;
//! use specula_bsdf::math::{Rgb, Stream, Vec3, vec3};
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Bsdf, Transport};
//!
//! /// A cap of directions about the normal: radiance 1, sampled uniformly.
//! const COS_MAX: f64 = 0.9;
//! fn light_pdf(wi: Vec3<f64>) -> f64 {
//!     if wi.z > COS_MAX { 1.0 / (core::f64::consts::TAU * (1.0 - COS_MAX)) } else { 0.0 }
//! }
//! fn sample_light(u: [f64; 2]) -> Vec3<f64> {
//!     let z = 1.0 - u[0] * (1.0 - COS_MAX);
//!     let (sin, cos) = (core::f64::consts::TAU * u[1]).sin_cos();
//!     let r = (1.0 - z * z).sqrt();
//!     vec3(r * cos, r * sin, z)
//! }
//! fn power(a: f64, b: f64) -> f64 {
//!     a * a / (a * a + b * b)
//! }
//!
//! let white = Reflectance::Constant(Rgb::WHITE);
//! let lobe = RoughConductor::new(Ggx::new(Alpha::isotropic(0.3)), white);
//! let wo = vec3(0.28, 0.0, 0.96);
//! let mut stream = Stream::new(7);
//! let (n, mut by_both, mut by_lobe) = (20_000, 0.0, 0.0);
//! for _ in 0..n {
//!     let wi = sample_light([stream.next(), stream.next()]);
//!     let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
//!     by_both += f_cos.g / light_pdf(wi) * power(light_pdf(wi), pdf);
//!
//!     let u = [stream.next(), stream.next(), stream.next()];
//!     if let Some(s) = lobe.sample(wo, u, Transport::Radiance) {
//!         if light_pdf(s.wi) > 0.0 {
//!             by_both += s.weight.g * power(s.pdf, light_pdf(s.wi));
//!             by_lobe += s.weight.g;
//!         }
//!     }
//! }
//! assert!((by_both / by_lobe - 1.0).abs() < 0.03);
//! ```
//!
//! # A distribution of one's own
//!
//! Implement [`Ndf`](ndf::Ndf) for evaluation and [`VisibleNormals`](vndf::VisibleNormals) for
//! sampling, and every lobe that is generic over the distribution takes it. Here GGX whose alphas
//! are turned by an angle:
//!
//! ```
//! use specula_bsdf::bsdf::RoughConductor;
//! use specula_bsdf::fresnel::Reflectance;
//! use specula_bsdf::math::{Rgb, Vec3, vec3};
//! use specula_bsdf::ndf::{Ggx, Ndf};
//! use specula_bsdf::vndf::VisibleNormals;
//! use specula_bsdf::{Alpha, Bsdf, Transport};
//!
//! #[derive(Clone, Copy)]
//! struct Turned {
//!     ggx: Ggx<f64>,
//!     sin_cos: (f64, f64),
//! }
//!
//! impl Turned {
//!     fn into_grain(&self, w: Vec3<f64>) -> Vec3<f64> {
//!         let (s, c) = self.sin_cos;
//!         vec3(c * w.x + s * w.y, c * w.y - s * w.x, w.z)
//!     }
//!     fn from_grain(&self, w: Vec3<f64>) -> Vec3<f64> {
//!         let (s, c) = self.sin_cos;
//!         vec3(c * w.x - s * w.y, c * w.y + s * w.x, w.z)
//!     }
//! }
//!
//! impl Ndf<f64> for Turned {
//!     fn alpha(&self) -> Alpha<f64> {
//!         self.ggx.alpha()
//!     }
//!     fn d(&self, wm: Vec3<f64>) -> f64 {
//!         self.ggx.d(self.into_grain(wm))
//!     }
//!     fn projected_area(&self, w: Vec3<f64>) -> f64 {
//!         self.ggx.projected_area(self.into_grain(w))
//!     }
//!     fn lambda_cos(&self, w: Vec3<f64>) -> f64 {
//!         self.ggx.lambda_cos(self.into_grain(w))
//!     }
//! }
//!
//! impl VisibleNormals<f64> for Turned {
//!     fn sample_wm(&self, wo: Vec3<f64>, u: [f64; 2]) -> Vec3<f64> {
//!         self.from_grain(self.ggx.sample_wm(self.into_grain(wo), u))
//!     }
//! }
//!
//! let turned = Turned { ggx: Ggx::new(Alpha::new(0.1, 0.5)?), sin_cos: 0.7_f64.sin_cos() };
//! let lobe = RoughConductor::new(turned, Reflectance::Constant(Rgb::WHITE));
//! let wo = vec3(0.6, 0.0, 0.8);
//! let sample = lobe.sample(wo, [0.5, 0.2, 0.6], Transport::Radiance).expect("above the horizon");
//! let f_cos = lobe.eval(wo, sample.wi, Transport::Radiance);
//! assert!((sample.weight.g - f_cos.g / sample.pdf).abs() < 1e-9);
//! # Ok::<(), specula_bsdf::AlphaError>(())
//! ```
//!
//! # Features
//!
//! * `std` (default): the standard library's mathematical functions in place of `libm`'s, and the
//!   vector levels of [`batch`]. Without it the crate is `no_std` and needs `alloc`.
//! * `glam`, `mint`: conversions of vectors, frames and colours.
//! * `serde`: `Serialize` and `Deserialize` for parameters and other small types.
//!
//! # Stability
//!
//! Enums that a renderer matches in full, such as [`Lobe`](bsdf::Lobe),
//! [`Reflectance`](fresnel::Reflectance) and [`Sampler`](vndf::Sampler), are exhaustive on purpose: a
//! new variant is a breaking change, and a compile error at each place that has to treat it.
#![forbid(unsafe_code)]
#![cfg_attr(not(any(feature = "std", test)), no_std)]

extern crate alloc;

mod alpha;
pub mod batch;
pub mod bsdf;
pub mod energy;
pub mod fresnel;
pub mod hair;
#[doc(hidden)]
pub mod internal;
pub mod math;
pub mod measured;
pub mod metals;
pub mod multibounce;
pub mod ndf;
mod shader_codes;
pub mod vndf;

pub use alpha::{Alpha, AlphaError};
pub use bsdf::{Bsdf, BsdfSample, Event, Transport};
pub use math::{Frame, Real, Rgb, Vec3};

/// The Rust of the README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
