//! Footprints of cones on surfaces, and the curvature that spreads them.

use specula_bsdf::{Frame, Vec3};

use super::{Geometry, Surface};
use crate::texture::Footprint;

/// Least cosine between a cone and a surface's normal: footprints are no longer than 1/this times their width.
const LEAST_COSINE: f32 = 1e-3;

impl Geometry {
    /// What a cone covers of the tangent plane of a surface.
    ///
    /// Along the plane of incidence the ellipse is `radius / |cos|` long, across it `radius`.
    ///
    /// * `direction`: of the cone, unit.
    /// * `radius`: of the cone at the surface.
    ///
    /// Source: Akenine-Moeller, Crassin, Boksansky, Belcour, Panteleev and Wright 2021, "Improved Shader and Texture
    /// Level of Detail Using Ray Cones", section 5.
    pub(crate) fn footprint(
        &self,
        surface: &Surface,
        direction: Vec3<f32>,
        radius: f32,
    ) -> Footprint {
        let frame = Frame::from_normal_tangent(surface.ng, direction);
        let cosine = surface.ng.dot(direction).abs();
        let position = [
            frame.s * (radius / cosine.max(LEAST_COSINE)),
            frame.t * radius,
        ];
        let [uv, second_uv] = self.changes_of_coordinates(surface, position);
        Footprint {
            position,
            uv,
            second_uv,
        }
    }

    /// How much both sets of texture coordinates change along two vectors in the tangent plane.
    fn changes_of_coordinates(
        &self,
        surface: &Surface,
        along: [Vec3<f32>; 2],
    ) -> [[[f32; 2]; 2]; 2] {
        let at = &surface.at;
        let placement = &self.placements[at.instance as usize];
        let group = &self.groups[placement.group as usize];
        let Some(&triangle) = group.triangles.get(at.primitive as usize) else {
            let dp = self.partials(surface).dp;
            return [along.map(|d| weights_of(d, dp)), [[0.0; 2]; 2]];
        };
        let corners = triangle.map(|v| v as usize);
        let [a, b, c] = corners.map(|v| Vec3::from(group.positions[v]));
        let edges = [b - a, c - a];
        let own = placement.moving(at.time);
        let pose = own.as_ref().unwrap_or(&placement.pose);
        let edges = if placement.identity {
            edges
        } else {
            edges.map(|e| pose.to_world.vector(e))
        };
        let has_uvs = self.shapes[surface.shape as usize].has_uvs;
        let [ta, tb, tc] = if has_uvs {
            corners.map(|v| group.uvs[v])
        } else {
            // As in `triangle_surface`.
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
        };
        let [sa, sb, sc] = corners.map(|v| group.second_uvs.get(v).copied().unwrap_or_default());
        let weights = along.map(|d| weights_of(d, edges));
        let change = |[a, b, c]: [[f32; 2]; 3]| {
            weights.map(|[u, v]| [0, 1].map(|x| (b[x] - a[x]) * u + (c[x] - a[x]) * v))
        };
        [change([ta, tb, tc]), change([sa, sb, sc])]
    }

    /// Mean of the two principal curvatures of a surface, above 0 where it is convex seen from the outside, in 1 over
    /// the world's unit of length. 0 where its texture coordinates are constant.
    ///
    /// Source: do Carmo 1976, "Differential Geometry of Curves and Surfaces", 3.3, with the second form of the shading
    /// normal, made symmetric.
    pub(crate) fn mean_curvature(&self, surface: &Surface) -> f32 {
        let partials = self.partials(surface);
        let [pu, pv] = partials.dp;
        let [nu, nv] = partials.dn;
        let (e, f, g) = (pu.dot(pu), pu.dot(pv), pv.dot(pv));
        let determinant = e * g - f * f;
        if determinant <= 1e-6 * e * g {
            return 0.0;
        }
        let mixed = 0.5 * (nu.dot(pv) + nv.dot(pu));
        let trace = nu.dot(pu) * g - 2.0 * mixed * f + nv.dot(pv) * e;
        0.5 * trace / determinant
    }
}

/// The weights `[x, y]` with which `x a + y b` is nearest to a vector; 0 where the two are parallel.
fn weights_of(d: Vec3<f32>, [a, b]: [Vec3<f32>; 2]) -> [f32; 2] {
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let determinant = aa * bb - ab * ab;
    if determinant <= 0.0 {
        return [0.0; 2];
    }
    let (da, db) = (d.dot(a), d.dot(b));
    [da * bb - db * ab, db * aa - da * ab].map(|x| x / determinant)
}

#[cfg(test)]
mod tests;
