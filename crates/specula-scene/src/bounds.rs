//! Axis-aligned bounding boxes.

use glam::{DMat4, DVec3, Vec3};
use rayon::prelude::*;

use crate::mesh::SERIAL;
use crate::scene::{Geometry, Mesh, Motion, Scene, Shape, Trajectory};
use crate::triangulate::ExactMeshes;

/// Farthest coordinate of a scene: squares of distances must fit single precision.
pub(crate) const FARTHEST: f64 = 1e18;

/// Smallest diagonal of a shape: its square must be a normal number in single precision.
const SMALLEST: f64 = 1e-18;

/// What a warning says of a shape that is smaller.
pub(crate) const SPECK: &str =
    "the shape is too small to have area in single precision: it is left out";

/// An axis-aligned box; empty where `min > max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl BoundingBox {
    /// The empty box.
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The box with a point added.
    #[must_use]
    pub fn including(self, p: DVec3) -> Self {
        Self {
            min: self.min.min(p),
            max: self.max.max(p),
        }
    }

    /// The box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.min.x > self.max.x
    }

    /// The centre of a box that is not empty.
    #[must_use]
    pub fn centre(self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Half the diagonal: the radius of the sphere around a box that is not empty.
    #[must_use]
    pub fn radius(self) -> f64 {
        0.5 * (self.max - self.min).length()
    }

    /// A box around the transformed box.
    #[must_use]
    pub fn transformed(self, m: &DMat4) -> Self {
        if self.is_empty() {
            return self;
        }
        let corner = |i: u8| {
            let pick = |bit: u8, axis: usize| {
                if i & bit == 0 {
                    self.min[axis]
                } else {
                    self.max[axis]
                }
            };
            m.transform_point3(DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2)))
        };
        (0..8).map(corner).fold(Self::EMPTY, Self::including)
    }

    /// A box around the box under a transform, with all that it sweeps over where it moves.
    pub(crate) fn placed(self, to_world: &DMat4, motion: Option<&Motion>) -> Self {
        match motion {
            Some(motion) if !self.is_empty() => {
                let [min, max] = Trajectory::new(to_world, motion).swept([self.min, self.max]);
                Self { min, max }
            }
            _ => self.transformed(to_world),
        }
    }

    /// Whether areas of what is in it are 0 in single precision.
    pub(crate) fn is_speck(self) -> bool {
        !self.is_empty() && (self.max - self.min).length() < SMALLEST
    }

    /// Greatest absolute coordinate; infinite if one is not a number.
    pub(crate) fn farthest(self) -> f64 {
        let far = self.min.abs().max(self.max.abs()).max_element();
        if self.is_empty() {
            0.0
        } else if far.is_nan() {
            f64::INFINITY
        } else {
            far
        }
    }
}

/// The box around a geometry in its own space.
pub(crate) fn of_geometry(
    meshes: &[Mesh],
    exact: ExactMeshes<'_>,
    geometry: &Geometry,
) -> BoundingBox {
    match *geometry {
        Geometry::Mesh(id) => {
            let mesh = &meshes[id.0];
            // Vertices that no triangle uses do not count.
            let of_chunk = |triangles: &[[u32; 3]]| {
                let corners = triangles.iter().flatten();
                let points = corners.map(|&i| Vec3::from(mesh.positions[i as usize]));
                let (low, high) = points
                    .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| {
                        (low.min(p), high.max(p))
                    });
                BoundingBox {
                    min: low.as_dvec3(),
                    max: high.as_dvec3(),
                }
            };
            if mesh.triangles.len() <= SERIAL {
                return of_chunk(&mesh.triangles);
            }
            let chunks = mesh.triangles.par_chunks(SERIAL).map(of_chunk);
            chunks.reduce(|| BoundingBox::EMPTY, BoundingBox::union)
        }
        Geometry::Sphere { radius } => {
            let r = DVec3::splat(f64::from(radius));
            BoundingBox { min: -r, max: r }
        }
        Geometry::Disk { radius, height } => {
            let (r, z) = (f64::from(radius), f64::from(height));
            BoundingBox {
                min: DVec3::new(-r, -r, z),
                max: DVec3::new(r, r, z),
            }
        }
        Geometry::QuadricPart(part) => {
            let least = |sign: f64| DVec3::AXES.map(|axis| sign * part.least_along(axis * sign));
            BoundingBox {
                min: DVec3::from(least(1.0)),
                max: DVec3::from(least(-1.0)),
            }
        }
        // A patch lies within the hull of its corners.
        Geometry::Patches(id) => {
            let mesh = &exact.patches[id.0];
            let corners = mesh.patches.iter().flatten();
            let points = corners.map(|&i| Vec3::from(mesh.positions[i as usize]).as_dvec3());
            points.fold(BoundingBox::EMPTY, BoundingBox::including)
        }
        // A centre line lies within the hull of its control points.
        Geometry::Curves(id) => {
            let curves = &exact.curves[id.0];
            let segments = curves.segments.iter().zip(&curves.width_at_ends);
            let boxes = segments.map(|(controls, [from, to])| {
                let half = DVec3::splat(0.5 * f64::from(from.max(*to)));
                let points = controls.iter().map(|p| Vec3::from(*p).as_dvec3());
                let hull = points.fold(BoundingBox::EMPTY, BoundingBox::including);
                BoundingBox {
                    min: hull.min - half,
                    max: hull.max + half,
                }
            });
            boxes.fold(BoundingBox::EMPTY, BoundingBox::union)
        }
    }
}

/// The box around a scene in world space.
pub(crate) fn of_scene(scene: &Scene) -> BoundingBox {
    of_shapes_where(scene, |_| true)
}

/// The box around what a scene's file shows: without a floor that was added under it.
pub(crate) fn of_file(scene: &Scene) -> BoundingBox {
    of_shapes_where(scene, |shape| Some(shape.material) != scene.floor)
}

fn of_shapes_where(scene: &Scene, counts: impl Fn(&Shape) -> bool) -> BoundingBox {
    let of_shapes = |shapes: &[Shape]| {
        let boxes = (shapes.iter().filter(|s| counts(s))).map(|s| {
            of_geometry(&scene.meshes, scene.exact_meshes(), &s.geometry)
                .placed(&s.to_world, s.motion.as_ref())
        });
        boxes.fold(BoundingBox::EMPTY, BoundingBox::union)
    };
    let objects: Vec<BoundingBox> = scene.objects.iter().map(|o| of_shapes(&o.shapes)).collect();
    let copies = scene
        .instances
        .iter()
        .map(|i| objects[i.object.0].placed(&i.to_world, i.motion.as_ref()));
    copies.fold(of_shapes(&scene.shapes), BoundingBox::union)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_box_is_wrapped() {
        let unit = BoundingBox {
            min: DVec3::splat(-1.0),
            max: DVec3::ONE,
        };
        let turned = unit.transformed(&DMat4::from_rotation_z(std::f64::consts::FRAC_PI_4));
        assert!((turned.max.x - 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(turned.max.z, 1.0);
        assert!(BoundingBox::EMPTY.transformed(&DMat4::IDENTITY).is_empty());
        assert_eq!(BoundingBox::EMPTY.farthest(), 0.0);
    }
}
