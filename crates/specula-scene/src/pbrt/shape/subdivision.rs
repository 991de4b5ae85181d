//! `loopsubdiv`: Loop's subdivision surfaces (Loop 1987), with limit positions and normals.

use glam::DVec3;
use rayon::prelude::*;

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
        let corners = Corners::of(&faces, points.len());
        let limit = corners.each(|ring, v| ring.limit(v, &points));
        let normals = corners.each(|ring, v| ring.normal(v, &limit));
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

/// Cuts every face in four.
fn refine(points: &[DVec3], faces: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut fine = Corners::of(faces, points.len()).each(|ring, v| ring.moved(v, points));
    let edges = Edges::of(faces);
    // The limit of vertices fits 32 bits.
    let first = u32::try_from(fine.len()).unwrap_or(u32::MAX);
    let middles = edges.all.par_iter();
    fine.par_extend(middles.map(|edge| edge.middle(points, faces)));
    let quarters = |(i, &[a, b, c]): (usize, &[u32; 3])| {
        let [ab, bc, ca] = [0, 1, 2].map(|k| first + edges.of_side[3 * i + k]);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let faces = faces.par_iter().enumerate();
    let faces = faces.flat_map_iter(quarters).collect();
    (fine, faces)
}

/// Ends of a face's side, sides of all faces being counted one after the other, and the vertex across.
fn side(faces: &[[u32; 3]], side: u32) -> ([u32; 2], u32) {
    let face = faces[side as usize / 3];
    let [a, b, c] = [0, 1, 2].map(|k| face[(side as usize + k) % 3]);
    ([a, b], c)
}

/// An edge, by the sides of faces that lie on it.
#[derive(Clone, Default)]
struct Edge {
    first: u32,
    /// The only other one.
    second: Option<u32>,
}

impl Edge {
    /// The vertex that cuts it.
    fn middle(&self, points: &[DVec3], faces: &[[u32; 3]]) -> DVec3 {
        let ([a, b], c) = side(faces, self.first);
        // In the order of the ends.
        let [pa, pb, pc] = [a.min(b), a.max(b), c].map(|v| points[v as usize]);
        match self.second {
            Some(second) => {
                let pd = points[side(faces, second).1 as usize];
                (pa + pb) * (3.0 / 8.0) + (pc + pd) * (1.0 / 8.0)
            }
            None => pa.midpoint(pb),
        }
    }
}

/// The edges of a mesh.
struct Edges {
    /// In the order in which faces meet them.
    all: Vec<Edge>,
    /// The edge of every side.
    of_side: Vec<u32>,
}

impl Edges {
    fn of(faces: &[[u32; 3]]) -> Self {
        let count = u32::try_from(3 * faces.len()).unwrap_or(u32::MAX);
        let key = |i: u32| {
            let ([a, b], _) = side(faces, i);
            (u64::from(a.min(b)) << 32 | u64::from(a.max(b)), i)
        };
        let mut sorted: Vec<(u64, u32)> = (0..count).into_par_iter().map(key).collect();
        sorted.par_sort_unstable();
        // Sides of one edge lie beside each other, the first of them first.
        let of_one = || sorted.chunk_by(|a, b| a.0 == b.0);
        let mut of_side = vec![0; sorted.len()];
        for group in of_one() {
            of_side[group[0].1 as usize] = 1;
        }
        // How many edges are met before each side.
        let mut met = 0;
        for place in &mut of_side {
            met += std::mem::replace(place, met);
        }
        let mut all = vec![Edge::default(); met as usize];
        for group in of_one() {
            let edge = of_side[group[0].1 as usize];
            all[edge as usize] = Edge {
                first: group[0].1,
                second: match group {
                    [_, second] => Some(second.1),
                    _ => None,
                },
            };
            for &(_, side) in group {
                of_side[side as usize] = edge;
            }
        }
        Self { all, of_side }
    }
}

/// For every vertex, the edges (from, to) across its faces, in the order of these.
struct Corners {
    /// Where the edges of each vertex begin, and where the last ones end.
    begin: Vec<usize>,
    edges: Vec<(u32, u32)>,
}

impl Corners {
    fn of(faces: &[[u32; 3]], vertices: usize) -> Self {
        let mut begin = vec![0; vertices + 1];
        for v in faces.iter().flatten() {
            begin[*v as usize + 1] += 1;
        }
        for v in 0..vertices {
            begin[v + 1] += begin[v];
        }
        let mut next = begin.clone();
        let mut edges = vec![(0, 0); 3 * faces.len()];
        for &[a, b, c] in faces {
            for (corner, edge) in [(a, (b, c)), (b, (c, a)), (c, (a, b))] {
                let at = &mut next[corner as usize];
                edges[*at] = edge;
                *at += 1;
            }
        }
        Self { begin, edges }
    }

    /// A value for every vertex, from its neighbours.
    fn each(&self, value: impl Fn(&Ring, usize) -> DVec3 + Sync) -> Vec<DVec3> {
        let vertices = (0..self.begin.len() - 1).into_par_iter();
        let values = vertices.map_init(Ring::default, |ring, v| {
            ring.go_around(&self.edges[self.begin[v]..self.begin[v + 1]]);
            value(ring, v)
        });
        values.collect()
    }
}

/// The neighbours of one vertex.
#[derive(Default)]
struct Ring {
    /// Each neighbour once. In order around the vertex, counterclockwise, where `ordered`; at a
    /// border from one end to the other.
    neighbours: Vec<u32>,
    border: bool,
    ordered: bool,
    /// The edges by where they begin; of several the last.
    next: Vec<(u32, u32)>,
    /// Where edges end, in order.
    ends: Vec<u32>,
}

impl Ring {
    /// From the edges across the faces around a vertex.
    fn go_around(&mut self, edges: &[(u32, u32)]) {
        self.neighbours.clear();
        (self.border, self.ordered) = (true, false);
        self.ends.clear();
        self.ends.extend(edges.iter().map(|e| e.1));
        self.ends.sort_unstable();
        self.next.clear();
        self.next.extend(edges.iter().rev());
        self.next.sort_by_key(|e| e.0);
        self.next.dedup_by_key(|e| e.0);
        let starts = edges.iter().map(|e| e.0);
        let mut starts = starts.filter(|from| self.ends.binary_search(from).is_err());
        let start = starts.next();
        let others = starts.next().is_some();
        let Some(first) = start.or(edges.first().map(|e| e.0)) else {
            return;
        };
        self.neighbours.push(first);
        let mut at = first;
        while let Ok(i) = self.next.binary_search_by_key(&at, |e| e.0) {
            at = self.next[i].1;
            if at == first || self.neighbours.len() > edges.len() {
                break;
            }
            self.neighbours.push(at);
        }
        // A disk: one walk over all faces, none of which overlap.
        let walked = self.neighbours.len() - usize::from(start.is_some());
        self.ordered = self.next.len() == edges.len() && walked == edges.len() && !others;
        if !self.ordered {
            self.neighbours.clear();
            self.neighbours
                .extend(edges.iter().flat_map(|e| [e.0, e.1]));
            self.neighbours.sort_unstable();
            self.neighbours.dedup();
        }
        self.border = start.is_some() || !self.ordered;
    }

    /// The vertex after one subdivision.
    fn moved(&self, v: usize, points: &[DVec3]) -> DVec3 {
        if self.border {
            return self.border_point(points[v], points, 1.0 / 8.0);
        }
        self.interior_point(points[v], points, beta(self.neighbours.len()))
    }

    /// Where the vertex goes after infinitely many.
    fn limit(&self, v: usize, points: &[DVec3]) -> DVec3 {
        if self.border {
            return self.border_point(points[v], points, 1.0 / 5.0);
        }
        let n = self.neighbours.len();
        let gamma = 1.0 / (n as f64 + 3.0 / (8.0 * beta(n)));
        self.interior_point(points[v], points, gamma)
    }

    /// Normal of the limit surface by the tangents of Hoppe et al. 1994, and pbrt-v4's choice of its
    /// side: it looks against the winding. Zero where the neighbourhood is no disk.
    fn normal(&self, v: usize, points: &[DVec3]) -> DVec3 {
        if !self.ordered {
            return DVec3::ZERO;
        }
        let p = |i: usize| points[self.neighbours[i] as usize];
        let n = self.neighbours.len();
        let (mut s, mut t) = (DVec3::ZERO, DVec3::ZERO);
        if self.border {
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
    fn cuts_are_numbered_as_faces_meet_them() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
        let (fine, faces) = refine(&points, &[[0, 1, 2], [0, 2, 3]]);
        let first = [[0, 4, 6], [4, 1, 5], [6, 5, 2], [4, 5, 6]];
        let second = [[0, 6, 8], [6, 2, 7], [8, 7, 3], [6, 7, 8]];
        assert_eq!(faces, [first, second].concat());
        // At borders halfway; else 3/8 of the ends and 1/8 of the corners across.
        let within = DVec3::ONE * (3.0 / 8.0) + (DVec3::X + DVec3::Y) / 8.0;
        assert_eq!(fine[4], DVec3::X / 2.0);
        assert_eq!(fine[6], within);
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
