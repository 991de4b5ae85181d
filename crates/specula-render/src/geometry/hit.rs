//! From a hit to the surface there: position with its error, normals, tangent, texture coordinates.

use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::QuadricPart;

use super::quadric_parts::uv_of_part;
use super::{Geometry, GroupData, NONE, PlacedQuadric, normal_of, unit_or};
use crate::accel::{Hit, QuadricShape, Ray};
use crate::convert::{abs, id, narrow};
use crate::offset::{RELATIVE_ERROR, SurfacePoint, coupled};
use crate::texture::{Footprint, TextureCoordinates};

/// A triangle of a mesh.
pub(crate) struct Facet<'a> {
    pub(crate) corners: [&'a [f32; 3]; 3],
    /// Normals of the corners, zero where the mesh has none; `None` where no mesh of its group has any.
    pub(crate) normals: Option<[&'a [f32; 3]; 3]>,
}

/// A point of a surface, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub(crate) position: Vec3<f32>,
    /// Bound on the error of each component of `position`.
    pub(crate) error: Vec3<f32>,
    /// Geometric normal, unit, towards the outside.
    pub(crate) ng: Vec3<f32>,
    /// Shading normal, unit.
    pub(crate) ns: Vec3<f32>,
    /// dp/du, or zero where there are no texture coordinates: any tangent will do then.
    pub(crate) tangent: Vec3<f32>,
    pub(crate) uv: [f32; 2],
    /// Second texture coordinates; 0 where the mesh has none.
    pub(crate) second_uv: [f32; 2],
    /// Vertex colour, interpolated; white where the mesh has none.
    pub(crate) colour: Rgb<f32>,
    pub(crate) shape: u32,
    /// Index of the light that it is part of, or [`NONE`].
    pub(crate) light: u32,
    /// The point of the primitive.
    pub(crate) at: PrimitiveLocation,
    /// What filtered textures are means over, where it is known.
    pub(crate) footprint: Option<Footprint>,
}

/// What textures are looked up by, beside the position.
pub(crate) struct Coordinates {
    pub(crate) uv: [f32; 2],
    /// Second texture coordinates; 0 where the mesh has none.
    pub(crate) second_uv: [f32; 2],
    /// Vertex colour; white where the mesh has none.
    pub(crate) colour: Rgb<f32>,
}

/// A point on a primitive.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PrimitiveLocation {
    /// Index of the instance.
    pub(crate) instance: u32,
    /// Index within the group.
    pub(crate) primitive: u32,
    /// Barycentric weights of a triangle's second and third vertex; the coordinates on a patch or a curve.
    pub(crate) weights: [f32; 2],
    /// When it is there, in exposures; for what moves only.
    pub(crate) time: f32,
}

impl PrimitiveLocation {
    /// Where a ray hit.
    ///
    /// * `time`: of the ray, in exposures.
    #[inline(always)]
    pub(crate) fn of(hit: &Hit, time: f32) -> Self {
        Self {
            instance: hit.instance,
            primitive: hit.primitive,
            weights: [hit.u, hit.v],
            time,
        }
    }
}

impl Surface {
    /// The surface as rays leave it.
    #[inline(always)]
    pub(crate) fn point(&self) -> SurfacePoint {
        SurfacePoint {
            position: self.position,
            error: self.error,
            normal: self.ng,
        }
    }

    /// The coordinates at which its textures are evaluated.
    #[inline(always)]
    pub(crate) fn place(&self) -> TextureCoordinates {
        TextureCoordinates {
            uv: self.uv,
            second_uv: self.second_uv,
            position: self.position,
            normal: self.ng,
            colour: self.colour,
            footprint: self.footprint,
        }
    }
}

impl Geometry {
    /// The surface at a hit.
    ///
    /// * `time`: of the ray, in exposures.
    #[inline]
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit, time: f32) -> Surface {
        let at = PrimitiveLocation::of(hit, time);
        // The point along the ray is only as exact as the ray is long: quadrics project it.
        self.surface_at(&at, || [ray.origin + ray.direction * hit.t, ray.direction])
    }

    /// The triangle at a hit; `None` for other shapes, and in instances with a transform.
    #[inline(always)]
    pub(crate) fn facet(&self, hit: &Hit) -> Option<Facet<'_>> {
        let placement = &self.placements[hit.instance as usize];
        let group = &self.groups[placement.group as usize];
        let [a, b, c] = group.triangles.get(hit.primitive as usize)?;
        if !placement.identity {
            return None;
        }
        let corner = |v: u32| &group.positions[v as usize];
        let normal = |v: u32| group.normals.get(v as usize).unwrap_or(&[0.0; 3]);
        Some(Facet {
            corners: [corner(*a), corner(*b), corner(*c)],
            normals: (!group.normals.is_empty()).then(|| [normal(*a), normal(*b), normal(*c)]),
        })
    }

    /// The tangent at a hit of a triangle, as of [`Surface::tangent`], in an instance without transform.
    #[inline]
    pub(crate) fn tangent(&self, hit: &Hit) -> Vec3<f32> {
        let group = &self.groups[self.placements[hit.instance as usize].group as usize];
        let at = PrimitiveLocation::of(hit, 0.0);
        let shape = group.shape_of[hit.primitive as usize];
        group.tangent_of_triangle(&at, self.shapes[shape as usize].has_uvs)
    }

    /// Texture coordinates and colour at a hit of a triangle; `None` for other shapes.
    #[inline]
    pub(crate) fn coordinates(&self, hit: &Hit) -> Option<Coordinates> {
        let group = self.group_of(hit);
        if hit.primitive as usize >= group.triangles.len() {
            return None;
        }
        let at = PrimitiveLocation::of(hit, 0.0);
        let shape = group.shape_of[hit.primitive as usize];
        Some(group.coordinates(&at, self.shapes[shape as usize].has_uvs))
    }

    /// The quadric of a hit; `None` for other shapes, and in instances with a transform.
    #[inline(always)]
    pub(crate) fn quadric(&self, hit: &Hit) -> Option<QuadricId> {
        let placement = &self.placements[hit.instance as usize];
        let group = &self.groups[placement.group as usize];
        let quadric = (hit.primitive as usize).checked_sub(group.triangles.len())?;
        let is_quadric = placement.identity && quadric < group.quadrics.len();
        is_quadric.then_some(QuadricId {
            group: placement.group,
            quadric: id(quadric),
        })
    }

    /// The quadric with an index.
    #[inline(always)]
    pub(crate) fn placed_quadric(&self, at: QuadricId) -> &PlacedQuadric {
        &self.groups[at.group as usize].quadrics[at.quadric as usize]
    }

    /// The surface at a point of a primitive.
    ///
    /// * `near`: the point in the world, roughly, for quadrics, and the direction of the ray, for curves; 0 where there
    ///   is none of these.
    #[inline]
    pub(crate) fn surface_at(
        &self,
        at: &PrimitiveLocation,
        near: impl FnOnce() -> [Vec3<f32>; 2],
    ) -> Surface {
        let placement = &self.placements[at.instance as usize];
        let group = &self.groups[placement.group as usize];
        let triangles = group.triangles.len();
        let primitive = at.primitive as usize;
        let shape = group.shape_of[primitive];
        let own;
        let pose = if placement.identity {
            None
        } else if let Some(moving) = placement.moving(at.time) {
            own = moving;
            Some(&own)
        } else {
            Some(&placement.pose)
        };
        let mut surface = if primitive < triangles {
            let has_uvs = self.shapes[shape as usize].has_uvs;
            group.triangle_surface(at, has_uvs)
        } else if let Some(quadric) = group.quadrics.get(primitive - triangles) {
            let [near, _] = near();
            let near = pose.map_or(near, |pose| pose.to_group_point(near));
            quadric.surface(near)
        } else {
            let shape = &self.shapes[shape as usize];
            match group.curve_at(at.primitive) {
                None => group.patch_surface(at, shape),
                Some(curve) => {
                    let [_, direction] = near();
                    let direction = pose.map_or(direction, |p| p.to_group_vector(direction));
                    curve.surface(at.weights, direction, shape.is_inside_out)
                }
            }
        };
        surface.shape = shape;
        surface.at = *at;
        let light = group.light_of(at.primitive);
        if light != NONE {
            surface.light = placement.first_light + light;
        }
        if let Some(pose) = pose {
            let m = &pose.to_world;
            let p = surface.position;
            surface.position = m.point(p);
            let reach = abs(p) + surface.error * (1.0 / RELATIVE_ERROR);
            surface.error = coupled(m.magnitude(reach));
            surface.ng = unit_or(pose.normals.vector(surface.ng), surface.ng);
            surface.ns = unit_or(pose.normals.vector(surface.ns), surface.ng);
            surface.tangent = m.vector(surface.tangent);
        }
        surface
    }
}

impl super::Placement {
    /// Where it is at a time, if it moves.
    #[inline]
    pub(super) fn moving(&self, time: f32) -> Option<super::Pose> {
        let movement = self.movement.as_ref()?;
        Some(super::Pose::new(&movement.at(time)))
    }
}

impl super::Pose {
    /// A world vector in the group's space.
    #[inline]
    pub(super) fn to_group_vector(&self, v: Vec3<f32>) -> Vec3<f32> {
        crate::convert::narrow3(self.inverse.transform_vector3(crate::convert::widen3(v)))
    }

    /// The position and the geometric normal of a surface in the group's space.
    #[inline]
    pub(super) fn to_group_surface(&self, surface: &Surface) -> [Vec3<f32>; 2] {
        use crate::convert::{narrow3, widen3};
        // Normals move as planes do.
        let linear = glam::DMat3::from_mat4(self.inverse).inverse().transpose();
        let normal = narrow3(linear * widen3(surface.ng));
        [
            self.to_group_point(surface.position),
            unit_or(normal, surface.ng),
        ]
    }

    /// A world point in the group's space.
    #[inline]
    pub(super) fn to_group_point(&self, p: Vec3<f32>) -> Vec3<f32> {
        crate::convert::narrow3(self.inverse.transform_point3(crate::convert::widen3(p)))
    }
}

impl GroupData {
    /// The mesh's own tangent, not unit, and its side; zero where it has none. Within a group that
    /// has tangents.
    pub(super) fn tangent(&self, at: &PrimitiveLocation) -> (Vec3<f32>, f32) {
        let [i, j, k] = self.triangles[at.primitive as usize].map(|v| v as usize);
        let [ta, tb, tc] = [i, j, k].map(|v| self.tangents.get(v).copied().unwrap_or([0.0; 4]));
        let [u, v] = at.weights;
        let [x, y, z, side] = [0, 1, 2, 3].map(|c| ta[c] * (1.0 - u - v) + tb[c] * u + tc[c] * v);
        (vec3(x, y, z), side)
    }

    /// dp/du of a triangle, or the mesh's own tangent, unit; zero where it has neither.
    ///
    /// Departure: pbrt takes the first edge where there are no texture coordinates, which would turn brushed metal at
    /// every triangle.
    #[inline]
    fn tangent_of_triangle(&self, at: &PrimitiveLocation, has_uvs: bool) -> Vec3<f32> {
        let [i, j, k] = self.triangles[at.primitive as usize].map(|v| v as usize);
        let mut tangent = Vec3::ZERO;
        if has_uvs {
            let [ta, tb, tc] = [i, j, k].map(|v| self.uvs[v]);
            let [a, b, c] = [i, j, k].map(|v| Vec3::from(self.positions[v]));
            let (du1, dv1) = (tb[0] - ta[0], tb[1] - ta[1]);
            let (du2, dv2) = (tc[0] - ta[0], tc[1] - ta[1]);
            let determinant = du1 * dv2 - dv1 * du2;
            let dpdu = ((b - a) * dv2 - (c - a) * dv1) * 1.0_f32.copysign(determinant);
            if determinant != 0.0 {
                tangent = unit_or(dpdu, Vec3::ZERO);
            }
        }
        if self.tangents.len() > i.max(j).max(k) {
            tangent = unit_or(self.tangent(at).0, tangent);
        }
        tangent
    }

    /// Texture coordinates and colour at a point of a triangle.
    #[inline]
    fn coordinates(&self, at: &PrimitiveLocation, has_uvs: bool) -> Coordinates {
        let [i, j, k] = self.triangles[at.primitive as usize].map(|v| v as usize);
        let [u, v] = at.weights;
        let w = 1.0 - u - v;
        let uv = if has_uvs {
            let [ta, tb, tc] = [i, j, k].map(|v| self.uvs[v]);
            [0, 1].map(|x| ta[x] * w + tb[x] * u + tc[x] * v)
        } else {
            // pbrt's coordinates of triangles without any: (0, 0), (1, 0), (1, 1).
            [u + v, v]
        };
        let second_uv = if self.second_uvs.len() > i.max(j).max(k) {
            let [ta, tb, tc] = [i, j, k].map(|v| self.second_uvs[v]);
            [0, 1].map(|x| ta[x] * w + tb[x] * u + tc[x] * v)
        } else {
            [0.0; 2]
        };
        let colour = if self.colours.len() > i.max(j).max(k) {
            let [ca, cb, cc] = [i, j, k].map(|v| self.colours[v]);
            let [r, g, b] = [0, 1, 2].map(|x| ca[x] * w + cb[x] * u + cc[x] * v);
            rgb(r, g, b)
        } else {
            Rgb::WHITE
        };
        Coordinates {
            uv,
            second_uv,
            colour,
        }
    }

    #[inline]
    fn triangle_surface(&self, at: &PrimitiveLocation, has_uvs: bool) -> Surface {
        let [i, j, k] = self.triangles[at.primitive as usize].map(|v| v as usize);
        let [a, b, c] = [i, j, k].map(|v| Vec3::from(self.positions[v]));
        let [u, v] = at.weights;
        let w = 1.0 - u - v;
        let (e1, e2) = (b - a, c - a);
        let ng = normal_of(e1, e2);
        let ns = if self.normals.len() > i.max(j).max(k) {
            let [na, nb, nc] = [i, j, k].map(|v| Vec3::from(self.normals[v]));
            unit_or(na * w + nb * u + nc * v, ng)
        } else {
            ng
        };
        let Coordinates {
            uv,
            second_uv,
            colour,
        } = self.coordinates(at, has_uvs);
        Surface {
            position: a * w + b * u + c * v,
            error: coupled(largest(abs(a), largest(abs(b), abs(c)))),
            ng,
            ns,
            tangent: self.tangent_of_triangle(at, has_uvs),
            uv,
            second_uv,
            colour,
            shape: 0,
            light: NONE,
            at: PrimitiveLocation::default(),
            footprint: None,
        }
    }
}

impl PlacedQuadric {
    /// The surface next to a point of the group's space.
    fn surface(&self, near: Vec3<f32>) -> Surface {
        use core::f32::consts::{PI, TAU};
        let point = self.point_near(near);
        let q = point.own;
        let phi = q.y.atan2(q.x);
        let u = if phi < 0.0 {
            phi / TAU + 1.0
        } else {
            phi / TAU
        };
        let [u, v] = match self.shape {
            // pbrt's v runs from -z to +z.
            QuadricShape::Sphere { radius } => {
                [u, 1.0 - (q.z / narrow(radius)).clamp(-1.0, 1.0).acos() / PI]
            }
            QuadricShape::Disk { radius, .. } => {
                [u, 1.0 - (q.x * q.x + q.y * q.y).sqrt() / narrow(radius)]
            }
            QuadricShape::Part(part) => uv_of_part(&part, q),
        };
        Surface {
            position: point.position,
            error: point.error,
            ng: point.normal,
            ns: point.normal,
            tangent: point.tangent,
            uv: [u, v.clamp(0.0, 1.0)],
            second_uv: [0.0; 2],
            colour: Rgb::WHITE,
            shape: 0,
            light: NONE,
            at: PrimitiveLocation::default(),
            footprint: None,
        }
    }

    /// The surface next to a point of the group's space, without texture coordinates.
    #[inline(always)]
    pub(crate) fn point_near(&self, near: Vec3<f32>) -> QuadricPoint {
        match self.shape {
            QuadricShape::Sphere { radius } => self.point_of_sphere(narrow(radius), near),
            QuadricShape::Disk { height, .. } => self.point_of_disk(narrow(height), near),
            QuadricShape::Part(QuadricPart::Sphere { radius, .. }) => {
                self.point_of_sphere(radius, near)
            }
            QuadricShape::Part(QuadricPart::Disk { height, .. }) => {
                self.point_of_disk(height, near)
            }
            QuadricShape::Part(QuadricPart::Cylinder { radius, .. }) => {
                self.point_of_cylinder(radius, near)
            }
        }
    }

    /// Whether a ray meets the outside next to a point of the group's space: its direction is against the normal.
    ///
    /// With `n` the normal and `d` the direction, `n . d` has the sign of their product in the quadric's own space,
    /// which takes no square root. Where the ray all but touches the quadric, the normal itself decides, so that the
    /// answer is that of the surface.
    #[inline(always)]
    pub(crate) fn is_met_outside(&self, near: Vec3<f32>, direction: Vec3<f32>) -> bool {
        const TOUCHING: f32 = 1e-3;
        let along = self.backward.vector(direction);
        let normal = match self.shape {
            QuadricShape::Sphere { .. } | QuadricShape::Part(QuadricPart::Sphere { .. }) => {
                self.backward.point(near)
            }
            QuadricShape::Disk { .. } | QuadricShape::Part(QuadricPart::Disk { .. }) => Vec3::Z,
            QuadricShape::Part(QuadricPart::Cylinder { .. }) => {
                let q = self.backward.point(near);
                vec3(q.x, q.y, 0.0)
            }
        };
        let cosine = normal.dot(along);
        let squared = TOUCHING * TOUCHING * normal.length_squared() * along.length_squared();
        if cosine * cosine > squared {
            return (cosine < 0.0) != self.flipped;
        }
        self.point_near(near).normal.dot(direction) < 0.0
    }

    /// [`PlacedQuadric::point_near`] of a sphere.
    #[inline(always)]
    pub(crate) fn point_of_sphere(&self, radius: f32, near: Vec3<f32>) -> QuadricPoint {
        let n = unit_or(self.backward.point(near), Vec3::Z);
        self.point_at(n * radius, n)
    }

    /// [`PlacedQuadric::point_near`] of a disk.
    #[inline(always)]
    pub(crate) fn point_of_disk(&self, height: f32, near: Vec3<f32>) -> QuadricPoint {
        let q = self.backward.point(near);
        self.point_at(vec3(q.x, q.y, height), Vec3::Z)
    }

    /// [`PlacedQuadric::point_near`] of a cylinder.
    #[inline(always)]
    pub(crate) fn point_of_cylinder(&self, radius: f32, near: Vec3<f32>) -> QuadricPoint {
        let q = self.backward.point(near);
        let n = unit_or(vec3(q.x, q.y, 0.0), Vec3::X);
        self.point_at(vec3(n.x * radius, n.y * radius, q.z), n)
    }

    /// * `q`, `normal`: in the quadric's own space.
    #[inline(always)]
    fn point_at(&self, q: Vec3<f32>, normal: Vec3<f32>) -> QuadricPoint {
        let normal = if self.flipped { -normal } else { normal };
        QuadricPoint {
            position: self.forward.point(q),
            error: coupled(self.forward.magnitude(q)),
            normal: unit_or(self.normals.vector(normal), normal),
            tangent: self.forward.vector(vec3(-q.y, q.x, 0.0)),
            own: q,
        }
    }
}

/// The index of a quadric: of its group, and in that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct QuadricId {
    group: u32,
    quadric: u32,
}

impl QuadricId {
    /// The first of the first group.
    pub(crate) const FIRST: Self = Self {
        group: 0,
        quadric: 0,
    };
}

/// A point of a quadric.
pub(crate) struct QuadricPoint {
    pub(crate) position: Vec3<f32>,
    pub(crate) error: Vec3<f32>,
    pub(crate) normal: Vec3<f32>,
    pub(crate) tangent: Vec3<f32>,
    /// In the quadric's own space.
    own: Vec3<f32>,
}

#[inline(always)]
fn largest(a: Vec3<f32>, b: Vec3<f32>) -> Vec3<f32> {
    vec3(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z))
}
