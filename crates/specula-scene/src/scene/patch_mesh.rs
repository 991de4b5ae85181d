//! Meshes of bilinear patches: surfaces ruled in two ways, between four corners each.

use glam::DVec3;

use super::Mesh;
use crate::num::f32_of;

/// How far a patch may lie from its triangles, over the longer of its diagonals.
const TOLERANCE: f64 = 1e-3;

/// Most steps along a side of one patch.
const MOST_STEPS: u32 = 32;

/// Coordinates of a patch's corners, where the file has none.
const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

/// A mesh of bilinear patches. Optional attributes are empty or one per vertex.
///
/// ```text
/// p(u, v) = (1 - u) (1 - v) p00 + u (1 - v) p10 + (1 - u) v p01 + u v p11,   u, v in [0, 1]
/// ```
///
/// Attributes are interpolated likewise. The outside is the side of `dp/du x dp/dv`, or that to which the shading
/// normals point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PatchMesh {
    /// Vertices.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals, not necessarily unit. Without them that of the surface itself shades.
    pub normals: Vec<[f32; 3]>,
    /// Surface coordinates. Without them they are `(u, v)`.
    pub uvs: Vec<[f32; 2]>,
    /// Patches, as indices of `p00`, `p10`, `p01` and `p11`.
    pub patches: Vec<[u32; 4]>,
    /// Whether they are quadrilaterals of a mesh of polygons, in whose place two triangles do. Others are cut finely
    /// where they must be triangles.
    pub are_polygons: bool,
}

impl PatchMesh {
    /// Whether all patches are parallelograms, which two triangles equal.
    pub(crate) fn is_flat(&self) -> bool {
        self.patches.iter().all(|p| self.steps(p) == 1)
    }

    /// Whether any three corners of a patch span an area.
    pub(crate) fn has_area(&self, patch: &[u32; 4]) -> bool {
        let [a, b, c, d] = self.corner_points(patch);
        let spans = |p: DVec3, q: DVec3, r: DVec3| {
            let square = (q - p).cross(r - p).length_squared();
            square > 0.0 && square < f64::INFINITY
        };
        spans(a, b, c) || spans(a, b, d) || spans(a, c, d) || spans(b, c, d)
    }

    /// How many triangles [`Self::mesh`] has.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        let of = |p: &[u32; 4]| match self.are_polygons {
            true => 2,
            false => 2 * u64::from(self.steps(p)).pow(2),
        };
        self.patches.iter().map(of).sum()
    }

    /// Its triangles, with its coordinates and normals: two for a parallelogram, and for each of polygons. Other patches
    /// are cut until the flat pieces are nowhere further from the patch than 1e-3 of its diagonal (at most 32 by 32
    /// pieces), and until coordinates interpolate as they do over the patch.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let own_uvs = !self.uvs.is_empty();
        if self.are_polygons {
            return self.halved();
        }
        if self.is_flat() && (own_uvs || self.patches.len() == 1 && self.positions.len() == 4) {
            return self.halved();
        }
        let mut mesh = Mesh::default();
        for patch in &self.patches {
            self.cut(patch, self.steps(patch), &mut mesh);
        }
        mesh
    }

    /// Two triangles for every patch, on the corners themselves.
    fn halved(&self) -> Mesh {
        let mut uvs = self.uvs.clone();
        if let ([patch], true) = (&self.patches[..], uvs.is_empty()) {
            // Its corners, in whatever order.
            uvs = vec![[0.0; 2]; self.positions.len()];
            for (i, uv) in patch.iter().zip(CORNERS) {
                uvs[*i as usize] = uv;
            }
        }
        let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, d], [a, d, c]];
        Mesh {
            positions: self.positions.clone(),
            normals: self.normals.clone(),
            uvs,
            triangles: self.patches.iter().flat_map(halves).collect(),
            ..Mesh::default()
        }
    }

    fn corner_points(&self, patch: &[u32; 4]) -> [DVec3; 4] {
        patch.map(|i| DVec3::from(self.positions[i as usize].map(f64::from)))
    }

    fn steps(&self, patch: &[u32; 4]) -> u32 {
        steps(self.corner_points(patch))
    }

    /// Adds `n` by `n` pieces of a patch.
    fn cut(&self, patch: &[u32; 4], n: u32, mesh: &mut Mesh) {
        let points = self.corner_points(patch);
        let first = u32::try_from(mesh.positions.len()).unwrap_or(u32::MAX);
        let pick3 = |v: &[[f32; 3]]| patch.map(|i| DVec3::from(v[i as usize].map(f64::from)));
        let normals = (!self.normals.is_empty()).then(|| pick3(&self.normals));
        let uvs = match self.uvs.is_empty() {
            true => CORNERS,
            false => patch.map(|i| self.uvs[i as usize]),
        };
        let uvs = uvs.map(|[u, v]| DVec3::new(f64::from(u), f64::from(v), 0.0));
        for j in 0..=n {
            for i in 0..=n {
                let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                mesh.positions
                    .push(mix(points, u, v).to_array().map(f32_of));
                let uv = mix(uvs, u, v);
                mesh.uvs.push([f32_of(uv.x), f32_of(uv.y)]);
                let normal = normals.map_or_else(|| normal(points, u, v), |n| mix(n, u, v));
                mesh.normals.push(normal.to_array().map(f32_of));
            }
        }
        for j in 0..n {
            for i in 0..n {
                let a = first + j * (n + 1) + i;
                let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
                mesh.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
}

/// Whether four corners are those of a parallelogram, which two triangles equal.
///
/// * `corners`: p00, p10, p01 and p11.
pub(crate) fn is_parallelogram(corners: [[f32; 3]; 4]) -> bool {
    steps(corners.map(|p| DVec3::from(p.map(f64::from)))) == 1
}

/// Pieces along each side of a patch that lie near enough to it.
fn steps([a, b, c, d]: [DVec3; 4]) -> u32 {
    let size = (d - a).length().max((c - b).length());
    // The middle of a patch lies a quarter of its twist from either diagonal.
    let twist = (a - b - c + d).length() / 4.0;
    if twist <= 1e-6 * size {
        return 1;
    }
    let steps = (twist / (TOLERANCE * size)).sqrt().ceil();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to small numbers"
    )]
    let steps = steps.clamp(4.0, f64::from(MOST_STEPS)) as u32;
    steps
}

/// Bilinear interpolation between the values at p00, p10, p01 and p11.
fn mix([a, b, c, d]: [DVec3; 4], u: f64, v: f64) -> DVec3 {
    a.lerp(b, u).lerp(c.lerp(d, u), v)
}

/// Normal of the patch, `dp/du x dp/dv`, unit; 0 where that is 0.
fn normal([a, b, c, d]: [DVec3; 4], u: f64, v: f64) -> DVec3 {
    let along_u = (b - a).lerp(d - c, v);
    let along_v = (c - a).lerp(d - b, u);
    along_u.cross(along_v).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use glam::DMat4;

    use super::*;
    use crate::mesh::{area, clean};

    fn one(points: [[f32; 3]; 4]) -> PatchMesh {
        PatchMesh {
            positions: points.to_vec(),
            patches: vec![[0, 1, 2, 3]],
            ..PatchMesh::default()
        }
    }

    #[test]
    fn parallelograms_are_two_triangles() {
        let square = one([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
        assert!(square.is_flat() && square.triangle_count() == 2);
        let mesh = square.mesh();
        assert_eq!(mesh.triangles, [[0, 1, 3], [0, 3, 2]]);
        assert_eq!(mesh.uvs, CORNERS);
    }

    #[test]
    fn twisted_patches_are_cut_finely_enough() {
        let saddle = one([[0.0; 3], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.0]]);
        let points = saddle.corner_points(&[0, 1, 2, 3]);
        let mut mesh = saddle.mesh();
        assert!(!saddle.is_flat());
        assert_eq!(saddle.triangle_count(), mesh.triangles.len() as u64);
        assert_eq!(clean(&mut mesh).unwrap(), Default::default());
        // The middle of every triangle against the patch z = u + v - 2 u v.
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
            let p = (a + b + c) / 3.0;
            let exact = mix(points, p.x, p.y);
            assert!((p - exact).length() < TOLERANCE * 3f64.sqrt(), "{p}");
        }
        // Integral of sqrt(1 + (1 - 2v)^2 + (1 - 2u)^2) over the square.
        let found = area(&mesh, &DMat4::IDENTITY);
        assert!((found - 1.280_789).abs() < 2e-3, "{found}");
    }

    #[test]
    fn patches_without_area_are_lines_and_points() {
        let [o, x, y] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let twice = [2.0, 0.0, 0.0];
        for (points, expected) in [
            ([o, x, y, x], true),
            ([o, x, y, o], true),
            ([o, o, x, y], true),
            ([o, x, twice, o], false),
            ([x; 4], false),
        ] {
            assert_eq!(one(points).has_area(&[0, 1, 2, 3]), expected, "{points:?}");
        }
    }
}
