//! Vertices on planes of small scenes: many of one at once.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;

use super::PathTracer;
use super::vertex_batch::{Surfaces, WAVEFRONT_SIZE};
use super::wavefront::Wavefront;
use crate::places::Face;
use crate::simd::simd_levels;

/// Consecutive vertices of a batch on one face.
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceRun {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) side: u32,
}

impl PathTracer<'_> {
    /// Loads the surfaces of vertices on faces.
    pub(super) fn load_faces(&self, wavefront: &mut Wavefront) {
        let Some(places) = &self.scene.places else {
            return;
        };
        let Wavefront {
            live,
            hits,
            face_runs,
            batch,
            ..
        } = wavefront;
        batch.on_face[..batch.count.min(WAVEFRONT_SIZE)].fill(false);
        for run in face_runs.iter() {
            let place = places.of_side(run.side);
            let Some(face) = &place.face else {
                continue;
            };
            let tangent = match place.key(run.side % 2 == 1) {
                Some(key) if self.needs_tangent(key) => face.tangent,
                _ => Vec3::ZERO,
            };
            let (from, to) = (run.from, run.to.min(WAVEFRONT_SIZE));
            for i in from..to {
                let k = batch.live_indices[i] as usize;
                let ray = live.ray(k);
                let near = ray.origin + ray.direction * hits.t(k);
                batch.surfaces.position.set(i, near);
            }
            batch.on_face[from..to].fill(true);
            batch.triangles.is_triangle[from..to].fill(false);
            locate_on_face(face, tangent, [from, to], &mut batch.surfaces);
        }
    }

    /// Whether a material's lobes depend on the tangent.
    ///
    /// * `key`: as of `QueuedVertex`.
    pub(super) fn needs_tangent(&self, key: u32) -> bool {
        let materials = &self.scene.materials;
        match materials.plain(key / 2) {
            Some(sides) => !sides[(key % 2) as usize].isotropic,
            None => !materials.takes_any_tangent(key / 2),
        }
    }
}

/// Surfaces of vertices whose positions are points near a face.
#[apply(simd_levels)]
fn locate_on_face(face: &Face, tangent: Vec3<f32>, [from, to]: [usize; 2], s: &mut Surfaces) {
    let (normal, point) = (face.normal, face.point);
    for i in from..to.min(WAVEFRONT_SIZE) {
        let near = s.position.get(i);
        let beside = normal.dot(near - point);
        s.position.set(i, near - normal * beside);
        s.error[i] = face.error;
        s.ng.set(i, normal);
        s.ns.set(i, face.shading_normal);
        s.tangent.set(i, tangent);
    }
}

#[cfg(test)]
mod tests {
    use super::super::vertex_batch::VertexBatch;
    use super::*;
    use crate::accel::{BlockHits, Ray, RayBlock};
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use glam::{DMat4, DVec3};
    use specula_bsdf::math::vec3;
    use specula_scene::scene::{Geometry as SceneGeometry, Mesh, MeshId, Shape};

    /// A cube of triangles, with normals and coordinates or without.
    fn cube(has_normals: bool) -> Mesh {
        let mut mesh = Mesh::default();
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let corner = |s: f32, t: f32| {
                    let mut p = [0.0; 3];
                    (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, side * s, t);
                    p
                };
                let first = crate::convert::id(mesh.positions.len());
                let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                for [s, t] in square {
                    mesh.positions.push(corner(s, t));
                    if has_normals {
                        mesh.normals.push(corner(0.0, 0.0));
                        mesh.uvs.push([0.5 * s + 0.5, 0.5 * t + 0.5]);
                    }
                }
                let quad = [[0, 1, 2], [0, 2, 3]];
                mesh.triangles.extend(quad.map(|t| t.map(|k| first + k)));
            }
        }
        mesh
    }

    /// Cubes, turned, reversed and open, one as large as the room.
    fn scene() -> PreparedScene {
        let mut scene = specula_scene::builtin::orbs();
        let material = scene.shapes[0].material;
        scene.shapes.clear();
        scene.meshes = vec![cube(false), cube(true), cube(true)];
        // Without its last face this one is rectangles.
        scene.meshes[2].triangles.truncate(10);
        for (i, (mesh, size)) in [(2, 6.0), (0, 1.0), (1, 0.7), (1, 0.5)]
            .into_iter()
            .enumerate()
        {
            let x = i as f64;
            let turn = if i == 0 { 0.0 } else { 0.4 * x };
            let place = DMat4::from_translation(DVec3::new(1.7 * x - 3.0, 0.2 * x, 0.3))
                * DMat4::from_rotation_x(turn)
                * DMat4::from_scale(DVec3::new(size, 0.8 * size, size));
            let mut shape = Shape::new(SceneGeometry::Mesh(MeshId(mesh)), place, material);
            shape.reverse_orientation = i % 2 == 0;
            scene.shapes.push(shape);
        }
        PreparedScene::new(&scene, &RenderOptions::default()).expect("it is sound")
    }

    #[test]
    fn vertices_on_faces_are_those_of_their_triangles() {
        let scene = scene();
        let geometry = &scene.geometry;
        let places = scene.places.as_ref().expect("it is small");
        let mut batch = VertexBatch::new();
        let (mut block, mut hits) = (RayBlock::NONE, BlockHits::new());
        let n: u16 = 500;
        for i in 0..n {
            let turn = f32::from(i);
            let ray = Ray {
                origin: vec3(0.3 * turn.cos(), 2.0, 2.3 + 0.2 * turn.sin()),
                direction: vec3(turn.sin(), (0.7 * turn).cos(), (0.37 * turn).sin()),
                t_max: f32::INFINITY,
            };
            block.set(usize::from(i), &ray);
        }
        geometry
            .accel
            .intersect_block((&block, usize::from(n)), &mut hits);
        let (mut found, mut with_normals) = (0, 0);
        for k in 0..usize::from(n) {
            let ray = block.get(k);
            let Some((_, place)) = places.at(&hits, k) else {
                assert_eq!(hits.get(&geometry.accel, k, || ray), None);
                continue;
            };
            let face = place.face.as_ref().expect("there is nothing else");
            let near = ray.origin + ray.direction * hits.t(k);
            let s = &mut batch.surfaces;
            s.position.set(k, near);
            locate_on_face(face, face.tangent, [k, k + 1], s);
            let hit = hits
                .get(&geometry.accel, k, || ray)
                .expect("it has a place");
            let surface = geometry.surface(&ray, &hit, 0.0);
            let off = (s.position.get(k) - surface.position).length();
            assert!(off < 2.0 * face.error, "{off} {}", face.error);
            let beside = (s.position.get(k) - surface.position).dot(surface.ng);
            assert!(beside.abs() < 0.5 * face.error, "{beside}");
            assert!(s.error[k] >= surface.error.x && s.error[k] < 3.0 * surface.error.x);
            for (found, expected) in [
                (s.ng.get(k), surface.ng),
                (s.ns.get(k), surface.ns),
                (s.tangent.get(k), surface.tangent),
            ] {
                assert!((found - expected).length() < 1e-6, "{found:?} {expected:?}");
            }
            found += 1;
            with_normals += usize::from(surface.tangent != Vec3::ZERO);
        }
        assert!(found > 300 && with_normals > 50, "{found} {with_normals}");
        assert!(found > with_normals, "one cube has no coordinates");
    }
}
