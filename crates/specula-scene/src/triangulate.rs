//! Exact shapes as triangles, where a renderer has none.

use std::collections::HashMap;

use crate::mesh;
use crate::scene::{Geometry, Mesh, MeshId, Scene, Shape};

impl Scene {
    /// Replaces [parts of quadrics](crate::scene::QuadricPart::mesh) and
    /// [bilinear patches](crate::scene::PatchMesh::mesh) by their triangles, in the shapes that `is_replaced` says.
    pub fn triangulate_exact_shapes(&mut self, is_replaced: impl Fn(&Shape) -> bool) {
        let Self {
            meshes,
            patch_meshes,
            shapes,
            objects,
            ..
        } = self;
        // What is thinner than numbers can tell has no triangles.
        let mut add = |mut mesh: Mesh| {
            let is_sound = mesh::clean(&mut mesh).is_ok() && !mesh.triangles.is_empty();
            is_sound.then(|| {
                meshes.push(mesh);
                MeshId(meshes.len() - 1)
            })
        };
        // Equal ones are made once.
        let (mut parts, mut patches) = (HashMap::new(), HashMap::new());
        for shapes in std::iter::once(shapes).chain(objects.iter_mut().map(|o| &mut o.shapes)) {
            shapes.retain_mut(|shape| {
                if !is_replaced(shape) {
                    return true;
                }
                let mesh = match shape.geometry {
                    Geometry::QuadricPart(part) => {
                        let made = parts.entry(part.key());
                        *made.or_insert_with(|| add(part.mesh()))
                    }
                    Geometry::Patches(id) => {
                        let made = patches.entry(id);
                        *made.or_insert_with(|| add(patch_meshes[id.0].mesh()))
                    }
                    Geometry::Mesh(_) | Geometry::Sphere { .. } | Geometry::Disk { .. } => {
                        return true;
                    }
                };
                if let Some(mesh) = mesh {
                    shape.geometry = Geometry::Mesh(mesh);
                }
                mesh.is_some()
            });
        }
    }
}
