//! Derivatives of a surface by its texture coordinates: for bump maps, and for the sense of rotations.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::QuadricPart;

use super::{Geometry, GroupData, PlacedQuadric, Surface, normal_of, unit_or};
use crate::accel::QuadricShape;
use crate::convert::{Affine, narrow};
use crate::geometry::hit::PrimitiveLocation;

/// First derivatives by u and v, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Partials {
    /// Of the position.
    pub(crate) dp: [Vec3<f32>; 2],
    /// Of the shading normal, which points to the outside.
    pub(crate) dn: [Vec3<f32>; 2],
}

impl Geometry {
    /// The derivatives at a surface; zero vectors where its texture coordinates are constant.
    pub(crate) fn partials(&self, surface: &Surface) -> Partials {
        let at = &surface.at;
        let placement = &self.placements[at.instance as usize];
        let group = &self.groups[placement.group as usize];
        let triangles = group.triangles.len();
        let own = placement.moving(at.time);
        let pose = own.as_ref().unwrap_or(&placement.pose);
        let (normal, partials) = if (at.primitive as usize) < triangles {
            let has_uvs = self.shapes[surface.shape as usize].has_uvs;
            group.triangle_partials(at, has_uvs)
        } else if let Some(quadric) = group.quadrics.get(at.primitive as usize - triangles) {
            let near = match placement.identity {
                true => surface.position,
                false => pose.to_group_point(surface.position),
            };
            quadric.partials(near)
        } else {
            let shape = &self.shapes[surface.shape as usize];
            match group.curve_at(at.primitive) {
                None => group.patch_partials(at, shape),
                Some(curve) => {
                    let [position, normal] = match placement.identity {
                        true => [surface.position, surface.ng],
                        false => pose.to_group_surface(surface),
                    };
                    curve.partials(at.weights, [position, normal], shape.is_inside_out)
                }
            }
        };
        if placement.identity {
            return partials;
        }
        partials.moved(normal, &pose.to_world, &pose.normals).1
    }
}

impl Partials {
    /// The unit normal and the derivatives after a transform.
    ///
    /// With `m = N n`, `d(m/|m|) = (dm - n' (n' . dm)) / |m|`.
    fn moved(self, normal: Vec3<f32>, points: &Affine, normals: &Affine) -> (Vec3<f32>, Self) {
        let moved = normals.vector(normal);
        let unit = unit_or(moved, normal);
        let length = moved.dot(unit);
        let partials = Self {
            dp: self.dp.map(|d| points.vector(d)),
            dn: self.dn.map(|d| {
                let d = normals.vector(d);
                (d - unit * unit.dot(d)) * (1.0 / length)
            }),
        };
        (unit, partials)
    }
}

impl GroupData {
    /// The unit shading normal and the derivatives of a triangle.
    fn triangle_partials(&self, at: &PrimitiveLocation, has_uvs: bool) -> (Vec3<f32>, Partials) {
        let [i, j, k] = self.triangles[at.primitive as usize].map(|v| v as usize);
        let [a, b, c] = [i, j, k].map(|v| Vec3::from(self.positions[v]));
        let edges = [b - a, c - a];
        // As in `triangle_surface`: pbrt's coordinates of triangles without any.
        let [ta, tb, tc] = if has_uvs {
            [i, j, k].map(|v| self.uvs[v])
        } else {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
        };
        let rows = [tb, tc].map(|t| [t[0] - ta[0], t[1] - ta[1]]);
        let determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
        let solve = |[d1, d2]: [Vec3<f32>; 2]| {
            if determinant == 0.0 {
                return [Vec3::ZERO; 2];
            }
            let scale = 1.0 / determinant;
            [
                (d1 * rows[1][1] - d2 * rows[0][1]) * scale,
                (d2 * rows[0][0] - d1 * rows[1][0]) * scale,
            ]
        };
        let ng = normal_of(edges[0], edges[1]);
        let mut partials = Partials {
            dp: solve(edges),
            dn: [Vec3::ZERO; 2],
        };
        if self.normals.len() <= i.max(j).max(k) {
            return (ng, partials);
        }
        let [na, nb, nc] = [i, j, k].map(|v| Vec3::from(self.normals[v]));
        let [u, v] = at.weights;
        let interpolated = na * (1.0 - u - v) + nb * u + nc * v;
        let ns = unit_or(interpolated, ng);
        if self.tangents.len() > i.max(j).max(k) {
            let (tangent, side) = self.tangent(at);
            let along_v = ns.cross(tangent) * side;
            // The mesh's own tangents; lengths do not matter to normal maps and rotations.
            if along_v.length_squared() > 0.0 {
                partials.dp = [tangent, along_v];
            }
        }
        let length = interpolated.dot(ns);
        if length > 0.0 {
            partials.dn = solve([nb - na, nc - na]).map(|d| (d - ns * ns.dot(d)) * (1.0 / length));
        }
        (ns, partials)
    }
}

impl PlacedQuadric {
    /// The unit normal and the derivatives next to a point of the group's space.
    fn partials(&self, near: Vec3<f32>) -> (Vec3<f32>, Partials) {
        use core::f32::consts::{PI, TAU};
        let q = self.backward.point(near);
        let radial = (q.x * q.x + q.y * q.y).sqrt();
        let outwards = unit_or(vec3(q.x, q.y, 0.0), Vec3::X);
        let around = vec3(-outwards.y, outwards.x, 0.0);
        let sphere = |r: f32, [turn, rise]: [f32; 2]| {
            let n = unit_or(q, Vec3::Z);
            let sin = (n.x * n.x + n.y * n.y).sqrt();
            // v runs from -z to +z.
            let up = vec3(-outwards.x * n.z, -outwards.y * n.z, sin);
            let dn = [around * (turn * sin), up * rise];
            let dp = dn.map(|d| d * r);
            (n, Partials { dp, dn })
        };
        let (normal, partials) = match self.shape {
            QuadricShape::Sphere { radius } => sphere(narrow(radius), [TAU, PI]),
            QuadricShape::Part(QuadricPart::Sphere { radius, z, phi_max }) => {
                let angle = |z: f32| f64::from(z / radius).clamp(-1.0, 1.0).acos();
                let rise = angle(z[0]) - angle(z[1]);
                sphere(radius, [phi_max, narrow(rise)])
            }
            QuadricShape::Part(QuadricPart::Cylinder { radius, z, phi_max }) => {
                let turn = around * phi_max;
                let partials = Partials {
                    dp: [turn * radius, Vec3::Z * (z[1] - z[0])],
                    dn: [turn, Vec3::ZERO],
                };
                (outwards, partials)
            }
            QuadricShape::Part(QuadricPart::Disk {
                radius,
                inner,
                phi_max,
                ..
            }) => {
                let partials = Partials {
                    dp: [around * (phi_max * radial), outwards * (inner - radius)],
                    dn: [Vec3::ZERO; 2],
                };
                (Vec3::Z, partials)
            }
            QuadricShape::Disk { radius, .. } => (
                Vec3::Z,
                Partials {
                    dp: [around * (TAU * radial), outwards * -narrow(radius)],
                    dn: [Vec3::ZERO; 2],
                },
            ),
        };
        let sign = if self.flipped { -1.0 } else { 1.0 };
        let turned = Partials {
            dn: partials.dn.map(|d| d * sign),
            ..partials
        };
        turned.moved(normal * sign, &self.forward, &self.normals)
    }
}
