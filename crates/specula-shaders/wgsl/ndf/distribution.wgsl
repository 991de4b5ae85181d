// Which distribution of microfacet normals, for code that knows several.

/// GGX; see `ggx`.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, Distribution.
const DISTRIBUTION_GGX: u32 = 0u;
/// Beckmann; see `beckmann`.
///
/// Twin: specula-bsdf/src/energy/albedo.rs, Distribution.
const DISTRIBUTION_BECKMANN: u32 = 1u;
