// Where a texture is evaluated.
//
// Twin of specula-render/src/texture/mod.rs, TextureCoordinates.

/// Where a texture is evaluated.
///
/// Twin: specula-render/src/texture/mod.rs, TextureCoordinates.
struct TextureCoordinates {
    /// Surface coordinates.
    uv: vec2f,
    /// Of the second set; 0 where the mesh has none.
    second_uv: vec2f,
    /// In the world.
    position: vec3f,
    /// Geometric normal in the world, unit: pbrt's `directionmix` takes this one, too.
    normal: vec3f,
    /// Vertex colour, interpolated; white where the mesh has none.
    colour: vec3f,
}
