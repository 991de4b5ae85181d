// Which distribution of microfacet normals, for code that knows several.

/// GGX; see `ggx`.
///
/// Twin: specula-bsdf/src/ndf/ggx.rs, Ggx.
const DISTRIBUTION_GGX: u32 = 0u;
/// Beckmann; see `beckmann`.
///
/// Twin: specula-bsdf/src/ndf/beckmann.rs, Beckmann.
const DISTRIBUTION_BECKMANN: u32 = 1u;
