//! Many elements at once: structures of arrays in, structures of arrays out.
//!
//! Each function loops over the scalar source of this crate, compiled three times: for what the
//! crate is compiled for, for AVX2 and for AVX-512. [`Level::best`] is what the machine runs.
//!
//! ```
//! use specula_bsdf::batch::{Directions, Level, Samples};
//! use specula_bsdf::bsdf::RoughConductor;
//! use specula_bsdf::fresnel::{Reflectance, Schlick};
//! use specula_bsdf::math::{rgb, vec3};
//! use specula_bsdf::ndf::Ggx;
//! use specula_bsdf::{Alpha, Transport};
//!
//! let f0 = rgb(0.9_f32, 0.6, 0.3);
//! let lobe = RoughConductor::new(Ggx::new(Alpha::isotropic(0.3)), Reflectance::Schlick(Schlick { f0 }));
//! let wo: Directions<Vec<f32>> = (0..1000).map(|_| vec3(0.6, 0.0, 0.8)).collect();
//! let u = vec![0.5; 1000];
//! let mut samples = Samples::rejected(1000);
//! Level::best().sample(
//!     &lobe,
//!     wo.as_slices(),
//!     [&u, &u, &u],
//!     Transport::Radiance,
//!     samples.as_mut_slices(),
//! )?;
//! assert!(samples.pdf[999] > 0.0);
//! # Ok::<(), specula_bsdf::batch::LengthMismatch>(())
//! ```
//!
//! # What goes in
//!
//! * One lobe for all elements, or [`PerElement`] alphas for rough metal and rough glass, or
//!   [`PerElementMetal`] alphas and colours, or [`PerElementBase`] colours under a coat, or [`Each`]
//!   its own [`Gltf`](crate::bsdf::Gltf) or [`Principled`](crate::bsdf::Principled), or [`Any`] lobe of the caller's own. Or no lobe:
//!   [`Level::sample_reflection`], [`Level::reflection_pdf`]. Rough metal with all bounces:
//!   [`Level::eval_pdf_random`], [`Level::sample_random`], walks in batches.
//! * Or a [`Lobe`](crate::bsdf::Lobe) whose kind is known when the program runs: [`LobeBatches`].
//! * Slices of any one length, tails of no special length needed. Slices that differ in length are an
//!   error ([`LengthMismatch`]) that names the slice, and nothing is written.
//! * Directions are unit, and local as everywhere in this crate; `u` lies in `[0, 1)`.
//!
//! A rejected sample has `wi`, `weight` and `pdf` zero, and is [`SampleOutcome::Rejected`].
//!
//! # What comes out
//!
//! At [`Level::Baseline`], bit for bit what the scalar functions return. At the vector levels
//! products and sums are fused in places ([`Real::mad`](crate::Real::mad)); the levels agree
//! with each other bit for bit. An element never depends on its place or its neighbours.
//!
//! Which loops are vectors (instructions an element at AVX2, `f32`, in `benches/instructions.txt`):
//! * All of Lambert, EON, the diffuse sheet, metals, rough glass and smooth dielectrics at both
//!   vector levels, but for the samples of rough glass by [`Sampler::Bounded`](crate::vndf::Sampler) or
//!   `Exact`, which choose a branch first.
//! * Values and densities of Beckmann's metals and glass, and weights of the metals' samples; its normals are found one by
//!   one.
//! * Coats over diffuse bases and plastics of GGX, whose tables are a row over the cosine for each batch, of which values
//!   are selected, not addressed. Exact at every level.
//! * glTF's material without coat, sheen and transmission, and Mitsuba's principled without transmission. Of glTF's some 110
//!   instructions a direction are look-ups of tables, one by one. Exact at every level.
//! * Compensated lobes look up tables: plain loops of the scalar code, exact at every level. Of the 3900
//!   instructions of a compensated metal's value 3500 are those of its loss.
//!
//! Largest relative errors against `f64`, at every level, for alphas in `[1e-3, 8]` and cosines down
//! to 1e-3 on both sides of the horizon (values below 1e-6 by absolute error; densities and weights
//! of samples at the direction that was returned; test `errors_stay_within_the_table`):
//!
//! | f32 | `f cos` | `pdf` | weight | density of a sample |
//! |---|---|---|---|---|
//! | rough metal, every sampler | 2e-6 | 2e-6 | 2e-6 | 2e-6 |
//! | Lambert, EON, diffuse sheet | 1e-6 | 1e-6 | 1e-6 | 1e-6 |
//! | rough glass | 5e-5 | 5e-5 | 3e-3 | 3e-3 |
//! | coats over diffuse bases, plastics | 5e-6 | 1e-5 | 1e-5 | 1e-5 |
//!
//! Directions that are sampled lie within 2e-3 of their twins' at the most extreme (test
//! `directions_stay_within_their_bound`). Samples of rough glass weigh the facet that was sampled, not
//! that of the direction as it was rounded: at the critical angle the two differ.

mod alphas;
mod coats;
mod columns;
mod functions;
mod kernels;
mod level;
mod lobe_batches;
mod lobes;
mod metals;
mod multibounce;
mod recast;
mod rough;
mod slices;
mod visible;

pub use alphas::Alphas;
pub use coats::PerElementBase;
pub use columns::Each;
pub use level::Level;
pub use lobe_batches::LobeBatches;
pub use lobes::{Any, Lobes};
pub use metals::PerElementMetal;
pub use rough::PerElement;
pub use slices::{Colours, Directions, LengthMismatch, SampleOutcome, Samples};
