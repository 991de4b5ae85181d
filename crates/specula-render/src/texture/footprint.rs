//! What filtered textures are means over.

use specula_bsdf::Vec3;

/// An ellipse in the tangent plane of a surface around a point, by two half axes, and how much the surface's coordinates
/// change along each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Footprint {
    /// In the world.
    pub(crate) position: [Vec3<f32>; 2],
    /// `(du, dv)` of each.
    pub(crate) uv: [[f32; 2]; 2],
    /// Of the second texture coordinates.
    pub(crate) second_uv: [[f32; 2]; 2],
}
