//! Exact shapes as triangles, where a renderer has none.

use std::collections::HashMap;

use crate::mesh;
use crate::scene::{CurveMesh, Geometry, Mesh, MeshId, PatchMesh, Scene, Shape};

/// What geometries of exact shapes refer to.
#[derive(Clone, Copy, Default)]
pub(crate) struct ExactMeshes<'a> {
    pub(crate) patches: &'a [PatchMesh],
    pub(crate) curves: &'a [CurveMesh],
}

impl ExactMeshes<'_> {
    /// Triangles of an exact shape; `None` of others.
    pub(crate) fn mesh(&self, geometry: &Geometry) -> Option<Mesh> {
        match *geometry {
            Geometry::QuadricPart(part) => Some(part.mesh()),
            Geometry::Patches(id) => Some(self.patches[id.0].mesh()),
            Geometry::Curves(id) => Some(self.curves[id.0].mesh()),
            Geometry::Mesh(_) | Geometry::Sphere { .. } | Geometry::Disk { .. } => None,
        }
    }
}

/// Exact shapes that are equal.
#[derive(PartialEq, Eq, Hash)]
enum Key {
    Part([u32; 5]),
    Patches(usize),
    Curves(usize),
}

impl Scene {
    pub(crate) fn exact_meshes(&self) -> ExactMeshes<'_> {
        ExactMeshes {
            patches: &self.patch_meshes,
            curves: &self.curve_meshes,
        }
    }

    /// Replaces [parts of quadrics](crate::scene::QuadricPart::mesh), [bilinear patches](crate::scene::PatchMesh::mesh)
    /// and [curves](crate::scene::CurveMesh::mesh) by their triangles, in the shapes that `is_replaced` says.
    pub fn triangulate_exact_shapes(&mut self, is_replaced: impl Fn(&Shape) -> bool) {
        let Self {
            meshes,
            patch_meshes,
            curve_meshes,
            shapes,
            objects,
            ..
        } = self;
        let exact = ExactMeshes {
            patches: patch_meshes,
            curves: curve_meshes,
        };
        // What is thinner than numbers can tell has no triangles.
        let mut add = |mut mesh: Mesh| {
            let is_sound = mesh::clean(&mut mesh).is_ok() && !mesh.triangles.is_empty();
            is_sound.then(|| {
                meshes.push(mesh);
                MeshId(meshes.len() - 1)
            })
        };
        // Equal ones are made once.
        let mut made = HashMap::new();
        for shapes in std::iter::once(shapes).chain(objects.iter_mut().map(|o| &mut o.shapes)) {
            shapes.retain_mut(|shape| {
                let key = match shape.geometry {
                    Geometry::QuadricPart(part) => Key::Part(part.key()),
                    Geometry::Patches(id) => Key::Patches(id.0),
                    Geometry::Curves(id) => Key::Curves(id.0),
                    Geometry::Mesh(_) | Geometry::Sphere { .. } | Geometry::Disk { .. } => {
                        return true;
                    }
                };
                if !is_replaced(shape) {
                    return true;
                }
                let geometry = &shape.geometry;
                let mesh =
                    *(made.entry(key)).or_insert_with(|| exact.mesh(geometry).and_then(&mut add));
                if let Some(mesh) = mesh {
                    shape.geometry = Geometry::Mesh(mesh);
                }
                mesh.is_some()
            });
        }
    }
}
