// Which sampler samples reflections off GGX; `reflection` samples by it.

/// Heitz 2018.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Sampler::Heitz.
const SAMPLER_HEITZ: u32 = 0u;
/// Spherical caps, Dupuy and Benyoub 2023.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Sampler::Cap.
const SAMPLER_CAP: u32 = 1u;
/// Bounded spherical caps, Tokuyoshi and Eto 2024.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Sampler::Bounded.
const SAMPLER_BOUNDED: u32 = 2u;
/// Exactly the reflections above the surface: none rejected, the lowest variance of the four.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Sampler::Exact.
const SAMPLER_EXACT: u32 = 3u;
