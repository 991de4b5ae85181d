//! Tests of the acceleration structure: against brute force, against itself, against doubles.

mod batches;
mod curves;
mod degenerate;
mod instances;
mod large;
mod moving;
mod patches;
mod quadric_parts;
mod quadrics;
mod reference;
mod solids;
mod tree_packs;
mod watertight;

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

use super::frame::RayFrame;
use super::{
    Accel, AccelError, Bounds, Group, Hit, Instance, Instructions, Quadric, QuadricShape, Ray,
    triangle,
};

/// Steps of a ray that is marched.
const STEPS: u32 = 4000;

/// Where a function of the way along a ray is first 0 within bounds, from 0 to `end`, by steps and bisection; `Err`: too
/// near an edge or a silhouette to tell.
///
/// * `near`: a value from which the function may turn around, without a crossing that the steps see.
/// * `margin`: how far within the bounds a place is, negative outside; `least`: the margin that tells.
fn marched(
    end: f64,
    (at, near): (impl Fn(f64) -> f64, f64),
    (margin, least): (impl Fn(f64) -> f64, f64),
) -> Result<Option<f64>, ()> {
    let step = end / f64::from(STEPS);
    let (mut before, mut slope) = (at(0.0), 0.0_f64);
    for i in 1..=STEPS {
        let to = f64::from(i) * step;
        let after = at(to);
        let rise = after - before;
        if slope * rise < 0.0 && after.abs().min(before.abs()) < near {
            return Err(());
        }
        slope = rise;
        if before * after <= 0.0 {
            let [mut low, mut high] = [to - step, to];
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(middle) * before > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let within = margin(low);
            if within.abs() < least {
                return Err(());
            }
            if within > 0.0 {
                return Ok(Some(low));
            }
        }
        before = after;
    }
    Ok(None)
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.bits() % n as u64).unwrap()
    }

    /// In `[-1, 1)`, 24 bits.
    fn signed(&mut self) -> f32 {
        let bits = u32::try_from(self.bits() >> 40).unwrap();
        f32::from_bits(0x4000_0000 | (bits >> 1)) - 3.0
    }

    fn vector(&mut self) -> Vec3<f32> {
        vec3(self.signed(), self.signed(), self.signed())
    }

    fn direction(&mut self) -> Vec3<f32> {
        loop {
            let v = self.vector();
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

#[derive(Clone, Default)]
struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn push(&mut self, corners: [Vec3<f32>; 3]) {
        let first = u32::try_from(self.positions.len()).unwrap();
        self.positions.extend(corners.map(Vec3::to_array));
        self.triangles.push([first, first + 1, first + 2]);
    }

    /// Triangles of all sizes within about `[-1, 1]^3`.
    fn soup(count: usize, random: &mut Random) -> Self {
        let mut mesh = Self::default();
        for _ in 0..count {
            let (centre, size) = (random.vector(), 0.5 * random.signed().abs().powi(4) + 1e-3);
            let corners = std::array::from_fn(|_| centre + random.vector() * size);
            mesh.push(corners);
        }
        mesh
    }

    /// An octahedron, each face cut into `n^2` triangles that share vertices, moved by `warp`.
    fn closed(n: u32, warp: impl Fn(Vec3<f32>) -> Vec3<f32>) -> Self {
        let mut mesh = Self::default();
        let mut known = std::collections::HashMap::new();
        for face in 0..8 {
            let sign = |bit: i32| 1 - 2 * (face >> bit & 1);
            let n = i32::try_from(n).unwrap();
            let mut vertex = |i: i32, j: i32| {
                let key = [sign(0) * i, sign(1) * j, sign(2) * (n - i - j)];
                *known.entry(key).or_insert_with(|| {
                    let at = Vec3::from(key.map(|c| f32::from(i16::try_from(c).unwrap())));
                    mesh.positions.push(warp(at.normalize()).to_array());
                    u32::try_from(mesh.positions.len()).unwrap() - 1
                })
            };
            let mut triangles = Vec::new();
            for i in 0..n {
                for j in 0..n - i {
                    triangles.push([vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)]);
                    if i + j + 2 <= n {
                        let (b, c) = (vertex(i + 1, j), vertex(i, j + 1));
                        triangles.push([b, vertex(i + 1, j + 1), c]);
                    }
                }
            }
            mesh.triangles.extend(triangles);
        }
        mesh
    }

    fn group(&self) -> Group<'_> {
        Group {
            positions: &self.positions,
            triangles: &self.triangles,
            ..Group::default()
        }
    }

    fn accel(&self) -> Accel {
        Accel::build(&[self.group()], &[Instance::of(0)]).unwrap()
    }

    fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    /// The closest hit by trying every triangle; of equal ones the first.
    fn brute_force(&self, ray: &Ray) -> Option<Hit> {
        let frame = RayFrame::new(ray)?;
        let mut best: Option<Hit> = None;
        for (index, _) in self.triangles.iter().enumerate() {
            let corners = self.corners(index);
            if triangle::bounds(&corners).is_none() {
                continue;
            }
            let [a, b, c] = corners.map(|p| {
                let p = frame.axes.map(|axis| p[usize::from(axis)]);
                triangle::shear(p, frame.sheared_origin, frame.shear)
            });
            let uvw = triangle::edge_functions(a, b, c);
            let (t, u, v) = triangle::distance(uvw, [a[2], b[2], c[2]], frame.shear[2]);
            let t_max = best.map_or(ray.t_max, |hit| hit.t);
            if triangle::inside(uvw) && t > 0.0 && t < t_max {
                best = Some(Hit {
                    t,
                    u,
                    v,
                    primitive: u32::try_from(index).unwrap(),
                    instance: 0,
                });
            }
        }
        best
    }
}

/// The faces of a box whose corners are told by the bits of their indices.
const BOX_FACES: [[u32; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

impl Accel {
    /// Without what small scenes are tested by.
    fn in_tree(mut self) -> Self {
        self.small = None;
        self
    }
}

fn ray(origin: Vec3<f32>, direction: Vec3<f32>) -> Ray {
    Ray {
        origin,
        direction,
        t_max: f32::INFINITY,
    }
}

/// Hits as bits, so that equality is exact.
fn exact(hit: Option<Hit>) -> Option<[u32; 5]> {
    hit.map(|h| {
        let [t, u, v] = [h.t, h.u, h.v].map(f32::to_bits);
        [t, u, v, h.primitive, h.instance]
    })
}
