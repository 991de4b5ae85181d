//! Parts of quadrics as triangles, where a renderer has none.

use std::collections::HashMap;

use crate::mesh;
use crate::scene::{Geometry, MeshId, Scene, Shape};

impl Scene {
    /// Replaces parts of quadrics by [their triangles](crate::scene::QuadricPart::mesh), in the shapes that `is_replaced` says.
    pub fn triangulate_quadric_parts(&mut self, is_replaced: impl Fn(&Shape) -> bool) {
        let Self {
            meshes,
            shapes,
            objects,
            ..
        } = self;
        let mut made = HashMap::new();
        for shapes in std::iter::once(shapes).chain(objects.iter_mut().map(|o| &mut o.shapes)) {
            shapes.retain_mut(|shape| {
                let Geometry::QuadricPart(part) = shape.geometry else {
                    return true;
                };
                if !is_replaced(shape) {
                    return true;
                }
                let mesh = *made.entry(part.key()).or_insert_with(|| {
                    let mut mesh = part.mesh();
                    // Parts that are thinner than numbers can tell have no triangles.
                    let is_sound = mesh::clean(&mut mesh).is_ok() && !mesh.triangles.is_empty();
                    is_sound.then(|| {
                        meshes.push(mesh);
                        MeshId(meshes.len() - 1)
                    })
                });
                if let Some(mesh) = mesh {
                    shape.geometry = Geometry::Mesh(mesh);
                }
                mesh.is_some()
            });
        }
    }
}
