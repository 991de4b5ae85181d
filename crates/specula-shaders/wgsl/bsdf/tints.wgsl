// Colours of a dielectric's two branches, which nature leaves white.

/// Factors on what a surface reflects and on what it lets through; white in nature.
///
/// Twin: specula-bsdf/src/bsdf/tints.rs, Tints.
struct TintsPair {
    /// Factor on reflection, in [0, 1].
    reflection: vec3f,
    /// Factor on transmission, in [0, 1].
    transmission: vec3f,
}

/// The factor for light on the viewer's side or on the other.
///
/// Twin: specula-bsdf/src/bsdf/tints.rs, Tints::on_side.
fn tints_on_side(tints: TintsPair, reflects: bool) -> vec3f {
    return select(tints.transmission, tints.reflection, reflects);
}
