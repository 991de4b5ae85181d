//! `loopsubdiv`: Loop's subdivision surfaces (Loop 1987), with limit positions and normals.

use std::collections::HashMap;

use glam::DVec3;

use super::{bounded, mesh_error, triangles};
use crate::Limits;
use crate::error::SceneError;
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::Mesh;

/// A control mesh and how often it is subdivided.
pub(in crate::pbrt) struct Control {
    points: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    levels: u32,
}

impl Control {
    /// Reads the shape `loopsubdiv`.
    pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<Self, SceneError> {
        entity.params.ignore(&["scheme"]);
        let mesh = triangles::vertices(context, entity)?;
        if mesh.positions.len() < 3 {
            let message = "\"P\": expected at least 3 vertices".to_owned();
            return Err(mesh_error(entity, "P", message));
        }
        Ok(Self {
            faces: triangles::indices::<3>(entity, mesh.positions.len())?,
            points: mesh
                .positions
                .iter()
                .map(|p| p.map(f64::from).into())
                .collect(),
            levels: entity.params.integer_within("levels", 3, 0..=12)?,
        })
    }

    /// Takes its triangles from those that the scene's surfaces may still be subdivided into.
    pub(super) fn take_from(&self, left: &mut u64, limits: &Limits) -> Result<(), String> {
        let Self { faces, levels, .. } = self;
        let size = (faces.len() as u64).saturating_mul(1 << (2 * levels));
        let most = limits.max_subdivided;
        *left = left.checked_sub(size).ok_or_else(|| {
            let before = most - *left;
            let all = match before {
                0 => String::new(),
                n => format!(", {n} of others"),
            };
            format!(
                "{levels} levels would make {size} triangles of it{all}; at most {most} are made \
                 (`max_subdivided`)"
            )
        })?;
        Ok(())
    }

    /// The limit surface at the vertices after the last level.
    pub(super) fn build(self, limits: &Limits) -> Result<Mesh, String> {
        let Self {
            mut points,
            mut faces,
            levels,
        } = self;
        // Faces that use a vertex twice have no area, and no neighbours to speak of.
        faces.retain(|[a, b, c]| a != b && b != c && c != a);
        let size = faces.len().saturating_mul(1 << (2 * levels));
        bounded((), size as u64, limits)?;
        for _ in 0..levels {
            (points, faces) = refine(&points, &faces);
        }
        let ring = Rings::of(&faces, points.len());
        let limit: Vec<DVec3> = (0..points.len()).map(|v| ring.limit(v, &points)).collect();
        let normals: Vec<DVec3> = (0..points.len()).map(|v| ring.normal(v, &limit)).collect();
        Ok(Mesh {
            positions: limit.iter().map(|p| p.to_array().map(f32_of)).collect(),
            normals: normals.iter().map(|n| n.to_array().map(f32_of)).collect(),
            triangles: faces,
            ..Mesh::default()
        })
    }
}

/// Weight of each neighbour of an interior vertex (Warren's).
fn beta(valence: usize) -> f64 {
    match valence {
        3 => 3.0 / 16.0,
        n => 3.0 / (8.0 * n as f64),
    }
}

/// An edge in the order of its ends.
fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Cuts every face in four.
fn refine(points: &[DVec3], faces: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let rings = Rings::of(faces, points.len());
    let mut fine: Vec<DVec3> = (0..points.len()).map(|v| rings.moved(v, points)).collect();
    // The vertices across each edge, in the order in which faces meet it.
    let mut across: HashMap<(u32, u32), Vec<u32>> = HashMap::new();
    let mut order = Vec::new();
    for &[a, b, c] in faces {
        for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
            let opposites = across.entry(edge(from, to)).or_insert_with(|| {
                order.push(edge(from, to));
                Vec::new()
            });
            opposites.push(opposite);
        }
    }
    let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
    for key @ (a, b) in order {
        let [pa, pb] = [a, b].map(|v| points[v as usize]);
        let point = match across[&key].as_slice() {
            [c, d] => {
                let [pc, pd] = [*c, *d].map(|v| points[v as usize]);
                (pa + pb) * (3.0 / 8.0) + (pc + pd) * (1.0 / 8.0)
            }
            _ => pa.midpoint(pb),
        };
        // The limit of vertices fits 32 bits.
        middle.insert(key, u32::try_from(fine.len()).unwrap_or(u32::MAX));
        fine.push(point);
    }
    let quarters = |&[a, b, c]: &[u32; 3]| {
        let [ab, bc, ca] = [edge(a, b), edge(b, c), edge(c, a)].map(|e| middle[&e]);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let faces = faces.iter().flat_map(quarters).collect();
    (fine, faces)
}

/// The neighbours of every vertex.
struct Rings(Vec<Ring>);

/// The neighbours of one vertex.
#[derive(Default)]
struct Ring {
    /// Each neighbour once. In order around the vertex, counterclockwise, where `ordered`; at a
    /// border from one end to the other.
    neighbours: Vec<u32>,
    border: bool,
    ordered: bool,
}

impl Rings {
    fn of(faces: &[[u32; 3]], vertices: usize) -> Self {
        // For every vertex, the edges (from, to) across its faces.
        let mut opposite: Vec<Vec<(u32, u32)>> = vec![Vec::new(); vertices];
        for &[a, b, c] in faces {
            opposite[a as usize].push((b, c));
            opposite[b as usize].push((c, a));
            opposite[c as usize].push((a, b));
        }
        Self(opposite.iter().map(|edges| Ring::of(edges)).collect())
    }

    /// An old vertex after one subdivision.
    fn moved(&self, v: usize, points: &[DVec3]) -> DVec3 {
        let ring = &self.0[v];
        if ring.border {
            return ring.border_point(points[v], points, 1.0 / 8.0);
        }
        ring.interior_point(points[v], points, beta(ring.neighbours.len()))
    }

    /// Where a vertex goes after infinitely many.
    fn limit(&self, v: usize, points: &[DVec3]) -> DVec3 {
        let ring = &self.0[v];
        if ring.border {
            return ring.border_point(points[v], points, 1.0 / 5.0);
        }
        let n = ring.neighbours.len();
        let gamma = 1.0 / (n as f64 + 3.0 / (8.0 * beta(n)));
        ring.interior_point(points[v], points, gamma)
    }

    /// Normal of the limit surface by the tangents of Hoppe et al. 1994, and pbrt-v4's choice of its
    /// side: it looks against the winding. Zero where the neighbourhood is no disk.
    fn normal(&self, v: usize, points: &[DVec3]) -> DVec3 {
        let ring = &self.0[v];
        if !ring.ordered {
            return DVec3::ZERO;
        }
        let p = |i: usize| points[ring.neighbours[i] as usize];
        let n = ring.neighbours.len();
        let (mut s, mut t) = (DVec3::ZERO, DVec3::ZERO);
        if ring.border {
            s = p(n - 1) - p(0);
            t = match n {
                2 => p(0) + p(1) - 2.0 * points[v],
                3 => p(1) - points[v],
                4 => 2.0 * (p(1) + p(2)) - p(0) - p(3) - 2.0 * points[v],
                _ => {
                    let theta = std::f64::consts::PI / (n - 1) as f64;
                    let inner = (1..n - 1).map(|k| p(k) * (k as f64 * theta).sin());
                    let ends = (p(0) + p(n - 1)) * theta.sin();
                    -(ends + inner.sum::<DVec3>() * (2.0 * theta.cos() - 2.0))
                }
            };
        } else {
            for j in 0..n {
                let (sin, cos) = (std::f64::consts::TAU * j as f64 / n as f64).sin_cos();
                s += p(j) * cos;
                // The ring runs counterclockwise, pbrt-v4's clockwise.
                t -= p(j) * sin;
            }
        }
        s.cross(t).normalize_or_zero()
    }
}

impl Ring {
    /// From the edges across the faces around a vertex.
    fn of(edges: &[(u32, u32)]) -> Self {
        let mut next: HashMap<u32, u32> = HashMap::new();
        let mut arrivals: HashMap<u32, u32> = HashMap::new();
        for &(from, to) in edges {
            next.insert(from, to);
            *arrivals.entry(to).or_default() += 1;
        }
        let starts: Vec<u32> = edges
            .iter()
            .map(|e| e.0)
            .filter(|from| !arrivals.contains_key(from))
            .collect();
        let Some(first) = starts.first().or(edges.first().map(|e| &e.0)).copied() else {
            return Self {
                border: true,
                ..Self::default()
            };
        };
        let mut neighbours = vec![first];
        let mut at = first;
        while let Some(&to) = next.get(&at) {
            if to == first || neighbours.len() > edges.len() {
                break;
            }
            neighbours.push(to);
            at = to;
        }
        let border = !starts.is_empty();
        // A disk: one walk over all faces, none of which overlap.
        let walked = neighbours.len() - usize::from(border);
        let ordered = next.len() == edges.len() && walked == edges.len() && starts.len() <= 1;
        if !ordered {
            neighbours = edges.iter().flat_map(|e| [e.0, e.1]).collect();
            neighbours.sort_unstable();
            neighbours.dedup();
        }
        Self {
            neighbours,
            border: border || !ordered,
            ordered,
        }
    }

    fn interior_point(&self, own: DVec3, points: &[DVec3], weight: f64) -> DVec3 {
        let sum: DVec3 = self.neighbours.iter().map(|i| points[*i as usize]).sum();
        own * (1.0 - weight * self.neighbours.len() as f64) + sum * weight
    }

    /// Vertices that are no part of a surface, or of several, stay.
    fn border_point(&self, own: DVec3, points: &[DVec3], weight: f64) -> DVec3 {
        let (Some(first), Some(last)) = (self.neighbours.first(), self.neighbours.last()) else {
            return own;
        };
        if !self.ordered {
            return own;
        }
        let ends = points[*first as usize] + points[*last as usize];
        own * (1.0 - 2.0 * weight) + ends * weight
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::clean;

    fn octahedron(levels: u32) -> Control {
        let axes = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
        let mut faces = Vec::new();
        for i in 0..4 {
            let j = (i + 1) % 4;
            faces.extend([[i, j, 4], [j, i, 5]]);
        }
        Control {
            points: axes.into_iter().chain([DVec3::Z, DVec3::NEG_Z]).collect(),
            faces,
            levels,
        }
    }

    #[test]
    fn closed_meshes_grow_by_four_and_keep_their_euler_number() {
        for levels in 0..4 {
            let mesh = octahedron(levels).build(&Limits::default()).unwrap();
            assert_eq!(mesh.triangles.len(), 8 << (2 * levels));
            assert_eq!(mesh.positions.len(), mesh.triangles.len() / 2 + 2);
        }
    }

    #[test]
    fn limit_positions_do_not_depend_on_the_level() {
        // A vertex of the control mesh goes to the same limit from every level.
        let limits = [0, 1, 3].map(|levels| {
            let mesh = octahedron(levels).build(&Limits::default()).unwrap();
            mesh.positions[4]
        });
        // Weights 1/2 and 1/8 of valence 4: (0, 0, 1) shrinks to 1/2 ... exactly (1 - 4 gamma).
        let gamma = 1.0 / (4.0 + 3.0 / (8.0 * beta(4)));
        for p in limits {
            assert!(
                (f64::from(p[2]) - (1.0 - 4.0 * gamma)).abs() < 1e-6,
                "{p:?}"
            );
        }
    }

    #[test]
    fn normals_are_those_of_the_surface() {
        let mut mesh = octahedron(4).build(&Limits::default()).unwrap();
        assert_eq!(clean(&mut mesh).unwrap(), Default::default());
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
            let n = DVec3::from(mesh.normals[t[0] as usize].map(f64::from));
            let winding = (b - a).cross(c - a).normalize();
            assert!(winding.dot(n) < -0.95, "{winding} {n}");
        }
    }

    #[test]
    fn flat_sheets_stay_flat_with_their_border() {
        let point = |i: u32| DVec3::new(f64::from(i % 4), f64::from(i / 4), 0.0);
        let mut faces = Vec::new();
        for (x, y) in (0..3).flat_map(|x| (0..3).map(move |y| (x, y))) {
            let a = 4 * y + x;
            faces.extend([[a, a + 1, a + 5], [a, a + 5, a + 4]]);
        }
        let sheet = Control {
            points: (0..16).map(point).collect(),
            faces,
            levels: 2,
        };
        let mesh = sheet.build(&Limits::default()).unwrap();
        assert!(mesh.positions.iter().all(|p| p[2] == 0.0));
        assert!(
            mesh.normals.iter().all(|n| n[2] < -0.999),
            "{:?}",
            mesh.normals
        );
        // A straight border stays straight; corners are rounded, which reaches two faces far.
        let on_border = mesh.positions.iter().filter(|p| p[1] == 0.0).count();
        assert_eq!(on_border, 5);
    }

    #[test]
    fn broken_neighbourhoods_are_kept_and_limits_hold() {
        // Three faces on one edge, a face used twice, a vertex without faces.
        let control = || Control {
            points: (0..6)
                .map(|i| DVec3::new(f64::from(i), f64::from(i * i), f64::from(i % 2)))
                .collect(),
            faces: vec![[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 1, 2], [3, 3, 1]],
            levels: 2,
        };
        let mesh = control().build(&Limits::default()).unwrap();
        assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
        let small = Limits {
            max_vertices: 10,
            ..Limits::default()
        };
        assert!(control().build(&small).is_err());
    }
}
