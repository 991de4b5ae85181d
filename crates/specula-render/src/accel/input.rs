//! What an acceleration structure is built from, and what can be wrong with it.

use glam::DMat4;
use thiserror::Error;

use super::Quadric;
use super::curve::{CurveSegment, MOST_SPLITS};

/// Geometry in a space of its own, to be placed by [`Instance`]s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Group<'a> {
    /// Vertices.
    pub positions: &'a [[f32; 3]],
    /// Triangles, as indices of vertices. Primitives `0..triangles.len()`.
    pub triangles: &'a [[u32; 3]],
    /// Spheres and disks. Primitives from `triangles.len()` on.
    pub quadrics: &'a [Quadric],
    /// Bilinear patches, as indices of their vertices `p00`, `p10`, `p01` and `p11`. Primitives behind those.
    pub patches: &'a [[u32; 4]],
    /// Segments of curves. The last primitives.
    pub curves: &'a [CurveSegment],
}

/// A group, placed in the world.
///
/// A single instance with the identity transform costs nothing: rays go straight into the group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the group.
    pub group: u32,
    /// The group's space to the world's; affine, invertible, mirroring or not.
    pub to_world: DMat4,
}

impl Instance {
    /// The group where it is, untransformed.
    pub fn of(group: u32) -> Self {
        Self {
            group,
            to_world: DMat4::IDENTITY,
        }
    }
}

/// Why an acceleration structure cannot be built.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum AccelError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} of group {group} uses vertex {vertex}, but there are {vertices}")]
    VertexOutOfRange {
        /// The group.
        group: usize,
        /// The triangle within it.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices the group has.
        vertices: usize,
    },
    /// A patch names a vertex that does not exist.
    #[error("patch {patch} of group {group} uses vertex {vertex}, but there are {vertices}")]
    PatchVertexOutOfRange {
        /// The group.
        group: usize,
        /// The patch within it.
        patch: usize,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices the group has.
        vertices: usize,
    },
    /// An instance names a group that does not exist.
    #[error("instance {instance} uses group {group}, but there are {groups}")]
    GroupOutOfRange {
        /// The instance.
        instance: usize,
        /// The group that it names.
        group: u32,
        /// How many groups there are.
        groups: usize,
    },
    /// An instance's transform cannot be inverted.
    #[error("the transform of instance {instance} is singular or not finite")]
    SingularInstance {
        /// The instance.
        instance: usize,
    },
    /// A quadric's transform cannot be inverted, or its sizes are not finite.
    #[error("quadric {quadric} of group {group} is singular or not finite")]
    SingularQuadric {
        /// The group.
        group: usize,
        /// The quadric within it.
        quadric: usize,
    },
    /// More primitives or instances than indices of 30 bits.
    #[error("{count} primitives or instances: at most {MOST} are possible")]
    TooMany {
        /// How many there are.
        count: usize,
    },
}

/// Indices of nodes, packets and quadrics have 30 bits, those of patches, parts of curves and instances 29.
const MOST: usize = 1 << 29;

/// Checks every index and transform, so that the build and the traversal cannot fail.
pub(super) fn check(groups: &[Group<'_>], instances: &[Instance]) -> Result<(), AccelError> {
    let primitives: usize = groups
        .iter()
        .map(|g| {
            let parts = g.curves.len() << MOST_SPLITS;
            g.triangles.len() + g.quadrics.len() + g.patches.len() + parts
        })
        .sum();
    let count = primitives.max(instances.len());
    if count > MOST {
        return Err(AccelError::TooMany { count });
    }
    for (group, input) in groups.iter().enumerate() {
        let vertices = input.positions.len();
        for (triangle, indices) in input.triangles.iter().enumerate() {
            if let Some(&vertex) = indices.iter().find(|&&v| v as usize >= vertices) {
                return Err(AccelError::VertexOutOfRange {
                    group,
                    triangle,
                    vertex,
                    vertices,
                });
            }
        }
        for (patch, indices) in input.patches.iter().enumerate() {
            if let Some(&vertex) = indices.iter().find(|&&v| v as usize >= vertices) {
                return Err(AccelError::PatchVertexOutOfRange {
                    group,
                    patch,
                    vertex,
                    vertices,
                });
            }
        }
        if let Some(quadric) = input.quadrics.iter().position(|q| !q.is_regular()) {
            return Err(AccelError::SingularQuadric { group, quadric });
        }
    }
    for (index, instance) in instances.iter().enumerate() {
        if instance.group as usize >= groups.len() {
            return Err(AccelError::GroupOutOfRange {
                instance: index,
                group: instance.group,
                groups: groups.len(),
            });
        }
        if !invertible(&instance.to_world) {
            return Err(AccelError::SingularInstance { instance: index });
        }
    }
    Ok(())
}

/// Whether a transform and its inverse are finite.
pub(super) fn invertible(m: &DMat4) -> bool {
    m.is_finite() && m.determinant() != 0.0 && m.inverse().is_finite()
}
