//! Vertices on spheres and disks: many of one quadric at once.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;

use super::vertex_batch::{Indices, Surfaces, WAVEFRONT_SIZE, select};
use crate::accel::QuadricShape;
use crate::convert::{id, narrow};
use crate::geometry::{Geometry, NONE, PlacedQuadric, QuadricId, QuadricPoint};
use crate::simd::simd_levels;

/// Most quadrics of a batch whose vertices wait for each other.
const MOST: usize = 16;

/// The vertices of a batch that wait to be located on their quadrics.
pub(super) struct VerticesOnQuadrics {
    quadrics: [Waiting; MOST],
    count: usize,
    /// Of each vertex the place of its quadric among those, or `NONE`.
    places: Indices,
}

/// A quadric, and the first and the last vertex that may be on it.
#[derive(Clone, Copy)]
struct Waiting {
    quadric: QuadricId,
    needs_tangent: bool,
    from: usize,
    to: usize,
}

impl VerticesOnQuadrics {
    pub(super) const EMPTY: Self = Self {
        quadrics: [Waiting {
            quadric: QuadricId::FIRST,
            needs_tangent: false,
            from: 0,
            to: 0,
        }; MOST],
        count: 0,
        places: Indices::of(NONE),
    };

    pub(super) fn clear(&mut self) {
        let used = &self.quadrics[..self.count.min(MOST)];
        let from = used.iter().map(|w| w.from).min().unwrap_or(0);
        let to = used.iter().map(|w| w.to).max().unwrap_or(0);
        if let Some(places) = self.places.get_mut(from..to) {
            places.fill(NONE);
        }
        self.count = 0;
    }

    /// Adds a vertex whose position is a point near the quadric; returns whether there is room.
    #[inline(always)]
    pub(super) fn push(&mut self, i: usize, quadric: QuadricId, needs_tangent: bool) -> bool {
        let used = &mut self.quadrics[..self.count.min(MOST)];
        let is_it = |w: &Waiting| w.quadric == quadric && w.needs_tangent == needs_tangent;
        let place = match used.iter().rposition(is_it) {
            Some(place) => place,
            None if self.count < MOST => {
                self.quadrics[self.count] = Waiting {
                    quadric,
                    needs_tangent,
                    from: i,
                    to: i,
                };
                self.count += 1;
                self.count - 1
            }
            None => return false,
        };
        let waiting = &mut self.quadrics[place % MOST];
        waiting.from = waiting.from.min(i);
        waiting.to = waiting.to.max(i + 1);
        self.places[i % WAVEFRONT_SIZE] = id(place);
        true
    }

    /// Locates the vertices: positions, their errors, normals, and tangents where they are needed.
    pub(super) fn locate(&self, geometry: &Geometry, s: &mut Surfaces) {
        for (place, waiting) in (0..).zip(&self.quadrics[..self.count.min(MOST)]) {
            let quadric = geometry.placed_quadric(waiting.quadric);
            locate_on(quadric, (place, &self.places), waiting, s);
        }
    }
}

/// Locates the vertices of one quadric.
#[apply(simd_levels)]
fn locate_on(
    quadric: &PlacedQuadric,
    (place, places): (u32, &Indices),
    waiting: &Waiting,
    s: &mut Surfaces,
) {
    let (from, to) = (waiting.from, waiting.to.min(WAVEFRONT_SIZE));
    // No closure: it would be compiled for the baseline.
    match quadric.shape {
        QuadricShape::Sphere { radius } => {
            let radius = narrow(radius);
            for i in from..to {
                let point = quadric.point_of_sphere(radius, s.position.get(i));
                pick(places[i] == place, waiting.needs_tangent, &point, i, s);
            }
        }
        QuadricShape::Disk { height, .. } => {
            let height = narrow(height);
            for i in from..to {
                let point = quadric.point_of_disk(height, s.position.get(i));
                pick(places[i] == place, waiting.needs_tangent, &point, i, s);
            }
        }
        QuadricShape::Part(_) => {
            for i in from..to {
                if places[i] == place {
                    let point = quadric.point_near(s.position.get(i));
                    pick(true, waiting.needs_tangent, &point, i, s);
                }
            }
        }
    }
}

/// Stores a point where the vertex is on its quadric.
#[inline(always)]
fn pick(is_on: bool, needs_tangent: bool, point: &QuadricPoint, i: usize, s: &mut Surfaces) {
    s.position
        .set(i, select(is_on, point.position, s.position.get(i)));
    s.error[i] = if is_on { point.error.x } else { s.error[i] };
    s.ng.set(i, select(is_on, point.normal, s.ng.get(i)));
    s.ns.set(i, select(is_on, point.normal, s.ns.get(i)));
    s.tangent.set(
        i,
        select(is_on & needs_tangent, point.tangent, s.tangent.get(i)),
    );
}

impl Surfaces {
    /// Stores a point of a quadric.
    #[inline(always)]
    pub(super) fn set_quadric(&mut self, i: usize, point: &QuadricPoint) {
        pick(true, false, point, i, self);
    }
}

#[cfg(test)]
mod tests {
    use super::super::vertex_batch::VertexBatch;
    use super::*;
    use crate::accel::Ray;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use glam::{DMat4, DVec3};
    use specula_bsdf::Vec3;
    use specula_bsdf::math::vec3;
    use specula_scene::scene::{Geometry as SceneGeometry, QuadricPart, Shape};

    /// Forty spheres, more than wait at once, squeezed, turned and inside out, and a disk and parts among them.
    fn scene() -> PreparedScene {
        let mut scene = specula_scene::builtin::orbs();
        let material = scene.shapes[0].material;
        scene.shapes.clear();
        for i in 0..41_u8 {
            let x = f64::from(i);
            let place = DMat4::from_translation(DVec3::new(3.0 * x, 0.2 * x, 1.0))
                * DMat4::from_rotation_x(0.3 * x)
                * DMat4::from_scale(DVec3::new(1.0, 0.5 + 0.02 * x, 1.5));
            let geometry = match i {
                20 => SceneGeometry::Disk {
                    radius: 1.2,
                    height: 0.1,
                },
                5 => SceneGeometry::QuadricPart(QuadricPart::Cylinder {
                    radius: 0.8,
                    z: [-0.7, 0.7],
                    phi_max: QuadricPart::TURN,
                }),
                30 => SceneGeometry::QuadricPart(QuadricPart::Sphere {
                    radius: 0.8,
                    z: [-0.5, 0.8],
                    phi_max: 4.0,
                }),
                _ => SceneGeometry::Sphere { radius: 0.8 },
            };
            let mut shape = Shape::new(geometry, place, material);
            shape.reverse_orientation = i % 3 == 0;
            scene.shapes.push(shape);
        }
        PreparedScene::new(&scene, &RenderOptions::default()).expect("it is sound")
    }

    #[test]
    fn many_vertices_are_located_as_single_ones() {
        let scene = scene();
        let geometry = &scene.geometry;
        let mut waiting = Box::new(VerticesOnQuadrics::EMPTY);
        let mut batch = VertexBatch::new();
        let (mut refused, mut sides) = (0, [0; 2]);
        // The second batch meets what the first one left.
        for round in 0..2_u16 {
            waiting.clear();
            let mut expected = Vec::new();
            for i in 0..400_u16 {
                let target = usize::from(i * 7 % 41);
                let x = 3.0 * target as f32 + f32::from(i % 5) * 0.1;
                let origin = vec3(x, 0.2 * target as f32 - 9.0, 1.3 + 0.1 * f32::from(round));
                let ray = Ray {
                    origin,
                    direction: vec3(0.01, 1.0, -0.02).normalize(),
                    t_max: f32::INFINITY,
                };
                // Every third vertex is on something else.
                let hit = geometry.accel.intersect(&ray).filter(|_| i % 3 != 1);
                let i = usize::from(i);
                let s = &mut batch.surfaces;
                s.position.set(i, origin);
                s.tangent.set(i, Vec3::ZERO);
                let needs_tangent = i % 2 == 0;
                let Some(hit) = hit else {
                    expected.push((i, None));
                    continue;
                };
                let quadric = geometry.quadric(&hit).expect("there is nothing else");
                let near = ray.origin + ray.direction * hit.t;
                s.position.set(i, near);
                let normal = geometry.surface(&ray, &hit, 0.0).ng;
                let is_outside = geometry
                    .placed_quadric(quadric)
                    .is_met_outside(near, ray.direction);
                assert_eq!(is_outside, normal.dot(ray.direction) < 0.0, "{i}");
                sides[usize::from(is_outside)] += 1;
                if waiting.push(i, quadric, needs_tangent) {
                    let surface = geometry.surface(&ray, &hit, 0.0);
                    expected.push((i, Some((surface, needs_tangent))));
                } else {
                    refused += 1;
                }
            }
            waiting.locate(geometry, &mut batch.surfaces);
            let s = &batch.surfaces;
            let mut located = 0;
            for (i, surface) in expected {
                let Some((surface, needs_tangent)) = surface else {
                    assert_eq!(s.tangent.get(i), Vec3::ZERO);
                    continue;
                };
                let none = Vec3::ZERO;
                let tangent = if needs_tangent { surface.tangent } else { none };
                let found = [
                    s.position.get(i),
                    s.ng.get(i),
                    s.ns.get(i),
                    s.tangent.get(i),
                ];
                assert_eq!(
                    found,
                    [surface.position, surface.ng, surface.ns, tangent],
                    "{i}"
                );
                assert_eq!(s.error[i], surface.error.x, "{i}");
                located += 1;
            }
            assert!(located > 40, "{located}");
        }
        assert!(
            refused > 10 && sides[0] > 50 && sides[1] > 50,
            "{refused}, {sides:?}"
        );
    }
}
