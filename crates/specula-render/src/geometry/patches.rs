//! Surfaces and derivatives of bilinear patches.
//!
//! Source: Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, 6.6, and pbrt-v4's `BilinearPatch`.
//! Departures: derivatives by texture coordinates come from the inverse of those of the coordinates; pbrt-v4 takes the
//! reciprocal of each of these, which differs where both coordinates depend on both of the patch's. Where an edge is
//! collapsed to a point, the normal there is the one next to it.

use glam::DVec3;
use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};

use super::hit::PrimitiveLocation;
use super::{GroupData, NONE, Partials, ShapeRecord, Surface, unit_or};
use crate::convert::{abs, narrow3};
use crate::offset::coupled;

/// Share of the way to the middle of a patch at which a normal is taken instead, where there is none.
const INWARDS: f32 = 1e-3;

/// A point of a patch in its group: the four corners of the patch, and the coordinates.
struct PatchPoint {
    corners: [usize; 4],
    uv: [f32; 2],
}

/// A vector's derivatives by the coordinates of a patch.
type Gradient = [Vec3<f32>; 2];

impl PatchPoint {
    /// Bilinear interpolation of a value at the corners.
    fn mix<const N: usize>(&self, values: &[[f32; N]]) -> [f32; N] {
        let [u, v] = self.uv;
        let [a, b, c, d] = self.corners.map(|i| values[i]);
        std::array::from_fn(|k| {
            let [from, to] = [[a[k], b[k]], [c[k], d[k]]].map(|[x, y]| (1.0 - u) * x + u * y);
            (1.0 - v) * from + v * to
        })
    }

    /// Derivatives of [`Self::mix`] by u and v.
    fn slopes<const N: usize>(&self, values: &[[f32; N]]) -> [[f32; N]; 2] {
        let [u, v] = self.uv;
        let [a, b, c, d] = self.corners.map(|i| values[i]);
        let along = |[a, b]: [f32; 2], [c, d]: [f32; 2], x: f32| (1.0 - x) * (b - a) + x * (d - c);
        [
            std::array::from_fn(|k| along([a[k], b[k]], [c[k], d[k]], v)),
            std::array::from_fn(|k| along([a[k], c[k]], [b[k], d[k]], u)),
        ]
    }

    /// The unit normal `dp/du x dp/dv` and its derivatives.
    ///
    /// `m = dp/du x dp/dv` has the derivatives `dp/du x p_uv` and `p_uv x dp/dv`, as `p_uu = p_vv = 0`.
    fn normal(&self, positions: &[[f32; 3]]) -> (Vec3<f32>, Gradient) {
        let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let [u, v] = self.uv;
        let [a, b, c, d] = self.corners.map(|i| wide(positions[i]));
        let twist = (d - c) - (b - a);
        let at = |u: f64, v: f64| {
            let (along_u, along_v) = ((b - a) + twist * v, (c - a) + twist * u);
            let m = along_u.cross(along_v);
            let length = m.length();
            (length > 0.0).then(|| {
                let n = m / length;
                let slopes = [along_u.cross(twist), twist.cross(along_v)];
                (n, slopes.map(|d| (d - n * n.dot(d)) / length))
            })
        };
        let inwards = |x: f32| f64::from(x + (0.5 - x) * INWARDS);
        let found = at(f64::from(u), f64::from(v)).or_else(|| at(inwards(u), inwards(v)));
        let (n, slopes) = found.unwrap_or((DVec3::Z, [DVec3::ZERO; 2]));
        (narrow3(n), slopes.map(narrow3))
    }

    /// Derivatives by texture coordinates, from those by the patch's own; zero where the former are constant.
    fn by_texture(&self, uvs: Option<&[[f32; 2]]>, [along_u, along_v]: Gradient) -> Gradient {
        let Some(uvs) = uvs else {
            return [along_u, along_v];
        };
        let [[su, tu], [sv, tv]] = self.slopes(uvs);
        let determinant = su * tv - sv * tu;
        if determinant == 0.0 {
            return [Vec3::ZERO; 2];
        }
        let scale = 1.0 / determinant;
        [
            (along_u * tv - along_v * tu) * scale,
            (along_v * su - along_u * sv) * scale,
        ]
    }
}

impl GroupData {
    fn patch_point(&self, at: &PrimitiveLocation) -> PatchPoint {
        let first = self.triangles.len() + self.quadrics.len();
        PatchPoint {
            corners: self.patches[at.primitive as usize - first].map(|v| v as usize),
            uv: at.weights,
        }
    }

    /// Normals of the corners, where the patch's mesh has any.
    fn patch_normals(&self, point: &PatchPoint) -> Option<&[[f32; 3]]> {
        let last = point.corners.iter().copied().max()?;
        (self.normals.len() > last).then_some(&self.normals)
    }

    /// The unit normals of a patch, that of its own side and the shading normal, and the derivatives of the latter.
    ///
    /// The outside is the side to which normals of the corners point; without them that of `dp/du x dp/dv`, or the
    /// other if it is inside out.
    fn normals_of_patch(
        &self,
        point: &PatchPoint,
        is_inside_out: bool,
    ) -> ([Vec3<f32>; 2], Gradient) {
        let (n, slopes) = point.normal(&self.positions);
        let sign = if is_inside_out { -1.0 } else { 1.0 };
        if let Some(normals) = self.patch_normals(point) {
            let shading = Vec3::from(point.mix(normals));
            let ns = unit_or(shading, Vec3::ZERO);
            let length = shading.dot(ns);
            if length > 0.0 {
                let ng = if n.dot(ns) < 0.0 { -n } else { n };
                let slopes = point.slopes(normals).map(Vec3::from);
                let slopes = slopes.map(|d| (d - ns * ns.dot(d)) * (1.0 / length));
                return ([ng, ns], slopes);
            }
        }
        ([n * sign; 2], slopes.map(|d| d * sign))
    }

    /// The surface at a point of a patch.
    pub(super) fn patch_surface(&self, at: &PrimitiveLocation, shape: &ShapeRecord) -> Surface {
        let point = self.patch_point(at);
        let ([ng, ns], _) = self.normals_of_patch(&point, shape.is_inside_out);
        let uvs = shape.has_uvs.then_some(&self.uvs[..]);
        let along = point.slopes(&self.positions).map(Vec3::from);
        let [tangent, _] = point.by_texture(uvs, along);
        let reach = point.corners.map(|i| abs(Vec3::from(self.positions[i])));
        let reach = reach.into_iter().reduce(largest).unwrap_or(Vec3::ZERO);
        Surface {
            position: Vec3::from(point.mix(&self.positions)),
            error: coupled(reach),
            ng,
            ns,
            tangent: unit_or(tangent, Vec3::ZERO),
            uv: uvs.map_or(point.uv, |uvs| point.mix(uvs)),
            second_uv: [0.0; 2],
            colour: Rgb::WHITE,
            shape: 0,
            light: NONE,
            at: PrimitiveLocation::default(),
            footprint: None,
        }
    }

    /// The unit shading normal and the derivatives at a point of a patch.
    pub(super) fn patch_partials(
        &self,
        at: &PrimitiveLocation,
        shape: &ShapeRecord,
    ) -> (Vec3<f32>, Partials) {
        let point = self.patch_point(at);
        let ([_, ns], slopes) = self.normals_of_patch(&point, shape.is_inside_out);
        let uvs = shape.has_uvs.then_some(&self.uvs[..]);
        let along = point.slopes(&self.positions).map(Vec3::from);
        let partials = Partials {
            dp: point.by_texture(uvs, along),
            dn: point.by_texture(uvs, slopes),
        };
        (ns, partials)
    }
}

fn largest(a: Vec3<f32>, b: Vec3<f32>) -> Vec3<f32> {
    vec3(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z))
}

#[cfg(test)]
mod tests;
