// Where a texture is evaluated.
//
// Twin of specula-render/src/texture/mod.rs, TextureCoordinates, and texture/footprint.rs.

/// What filtered textures are means over: an ellipse in the tangent plane of a surface around a point, by two half axes,
/// and how much the surface's coordinates change along each. Zero: the point alone.
///
/// Twin: specula-render/src/texture/footprint.rs, Footprint.
struct Footprint {
    /// Half axes, in the world.
    first: vec3f,
    second: vec3f,
    /// `(du, dv)` of the first, then of the second.
    changes: vec4f,
    /// Of the second texture coordinates.
    second_changes: vec4f,
}

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
    /// What filtered textures are means over.
    footprint: Footprint,
}
