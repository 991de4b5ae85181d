//! `bilinearmesh`: patches between four corners.

use glam::DVec3;

use super::{bounded, triangles};
use crate::Limits;
use crate::error::SceneError;
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::Mesh;

/// How far a patch may lie from its triangles, over the longer of its diagonals.
const TOLERANCE: f64 = 1e-3;

/// Most steps along a side of one patch.
const MOST_STEPS: u32 = 32;

/// Patches `(p00, p10, p01, p11)`.
pub(in crate::pbrt) struct Patches {
    /// Corners and attributes; no triangles.
    corners: Mesh,
    patches: Vec<[u32; 4]>,
}

/// Reads the shape `bilinearmesh`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<Patches, SceneError> {
    // A distribution for sampling alone: it changes no picture.
    entity.params.ignore(&["emissionfilename"]);
    let corners = triangles::vertices(context, entity)?;
    let patches = triangles::indices::<4>(entity, corners.positions.len())?;
    Ok(Patches { corners, patches })
}

impl Patches {
    pub(super) fn len(&self) -> usize {
        self.patches.len()
    }

    /// Parallelograms become two triangles. Others are cut until the flat pieces are nowhere
    /// further from the patch than 1e-3 of its diagonal (at most 32 by 32 pieces), and until
    /// coordinates interpolate as they do over the patch.
    pub(super) fn build(self, limits: &Limits) -> Result<Mesh, String> {
        let steps: Vec<u32> = self.patches.iter().map(|p| self.steps(p)).collect();
        let squares: usize = steps.iter().map(|n| (*n as usize).pow(2)).sum();
        bounded((), 2 * squares, limits)?;
        let whole = steps.iter().all(|n| *n == 1);
        let own_uvs = !self.corners.uvs.is_empty();
        if whole && (own_uvs || self.patches.len() == 1 && self.corners.positions.len() == 4) {
            return Ok(self.flat());
        }
        let mut mesh = Mesh::default();
        for (patch, n) in self.patches.iter().zip(steps) {
            self.cut(patch, n, &mut mesh)?;
        }
        Ok(mesh)
    }

    /// Two triangles for every patch, on the corners themselves.
    fn flat(self) -> Mesh {
        let mut mesh = self.corners;
        if mesh.uvs.is_empty() {
            // There is one patch: its corners, in whatever order.
            let [patch] = self.patches[..] else {
                return mesh;
            };
            mesh.uvs = vec![[0.0; 2]; mesh.positions.len()];
            for (i, uv) in patch.into_iter().zip(CORNERS) {
                mesh.uvs[i as usize] = uv;
            }
        }
        let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, d], [a, d, c]];
        mesh.triangles = self.patches.iter().flat_map(halves).collect();
        mesh
    }

    fn corner_points(&self, patch: &[u32; 4]) -> [DVec3; 4] {
        patch.map(|i| DVec3::from(self.corners.positions[i as usize].map(f64::from)))
    }

    fn steps(&self, patch: &[u32; 4]) -> u32 {
        let [a, b, c, d] = self.corner_points(patch);
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

    /// Adds `n` by `n` pieces of a patch.
    fn cut(&self, patch: &[u32; 4], n: u32, mesh: &mut Mesh) -> Result<(), String> {
        let corners = &self.corners;
        let points = self.corner_points(patch);
        let first = u32::try_from(mesh.positions.len()).map_err(|e| e.to_string())?;
        let pick3 = |v: &[[f32; 3]]| patch.map(|i| DVec3::from(v[i as usize].map(f64::from)));
        let normals = (!corners.normals.is_empty()).then(|| pick3(&corners.normals));
        let uvs = match corners.uvs.is_empty() {
            true => CORNERS,
            false => patch.map(|i| corners.uvs[i as usize]),
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
        Ok(())
    }
}

/// Coordinates of a patch's corners.
const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

/// Bilinear interpolation between the values at p00, p10, p01 and p11.
fn mix([a, b, c, d]: [DVec3; 4], u: f64, v: f64) -> DVec3 {
    a.lerp(b, u).lerp(c.lerp(d, u), v)
}

/// Normal of the patch, dp/du x dp/dv; not unit.
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

    fn one(points: [[f32; 3]; 4]) -> Patches {
        Patches {
            corners: Mesh {
                positions: points.to_vec(),
                ..Mesh::default()
            },
            patches: vec![[0, 1, 2, 3]],
        }
    }

    #[test]
    fn parallelograms_are_two_triangles() {
        let square = one([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
        let mesh = square.build(&Limits::default()).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 3], [0, 3, 2]]);
        assert_eq!(mesh.uvs, CORNERS);
    }

    #[test]
    fn twisted_patches_are_cut_finely_enough() {
        let saddle = one([[0.0; 3], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.0]]);
        let points = saddle.corner_points(&[0, 1, 2, 3]);
        let mut mesh = saddle.build(&Limits::default()).unwrap();
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
        let small = Limits {
            max_vertices: 10,
            ..Limits::default()
        };
        let saddle = one([[0.0; 3], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 0.0]]);
        assert!(saddle.build(&small).is_err());
    }
}
