//! Closed meshes, to be seen from within: a sphere with hills, of any size, and a room with boxes.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_render::accel::{Accel, AccelError, Group, Instance};

/// Triangles that share vertices.
pub(super) struct Mesh {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Corners of a cuboid's sides, by the bits of the corners' coordinates.
const SIDES: [[usize; 4]; 6] = [
    [0, 2, 6, 4],
    [1, 5, 7, 3],
    [0, 4, 5, 1],
    [2, 3, 7, 6],
    [0, 1, 3, 2],
    [4, 6, 7, 5],
];

impl Mesh {
    /// A room about the origin with two boxes: 36 triangles, below the limit of small scenes.
    pub(super) fn room() -> Self {
        let mut mesh = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
        };
        mesh.add_cuboid(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.8, 1.2), 0.0);
        mesh.add_cuboid(vec3(-0.4, -0.5, 0.3), vec3(0.2, 0.3, 0.2), 0.3);
        mesh.add_cuboid(vec3(0.4, -0.6, 0.6), vec3(0.2, 0.2, 0.2), 1.0);
        mesh
    }

    /// `half`: half of its extents; turned by an angle about the y axis.
    fn add_cuboid(&mut self, centre: Vec3<f32>, half: Vec3<f32>, angle: f32) {
        let (sine, cosine) = angle.sin_cos();
        let corner = |bits: usize| {
            let sign = |bit: usize| if bits >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let [x, y, z] = [half.x * sign(0), half.y * sign(1), half.z * sign(2)];
            let turned = vec3(cosine * x + sine * z, y, cosine * z - sine * x);
            (centre + turned).to_array()
        };
        for side in SIDES {
            let first = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
            self.positions.extend(side.map(corner));
            self.triangles.push([first, first + 1, first + 2]);
            self.triangles.push([first, first + 2, first + 3]);
        }
    }

    /// A sphere of radius 1, give or take its hills, of about `count` triangles: the faces of an
    /// octahedron, cut into `n^2` triangles each.
    pub(super) fn sphere(count: f64) -> Self {
        let n = (1..).find(|&n| f64::from(8 * n * n) >= 0.95 * count);
        let n = n.unwrap_or(1);
        let mut mesh = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
        };
        for face in 0..8 {
            mesh.add_face(n, [0, 1, 2].map(|bit| 1 - 2 * (face >> bit & 1)));
        }
        mesh
    }

    fn add_face(&mut self, n: i32, signs: [i32; 3]) {
        // Row `i` has `n - i + 1` vertices.
        let mut row_starts = Vec::new();
        for i in 0..=n {
            row_starts.push(u32::try_from(self.positions.len()).unwrap_or(u32::MAX));
            for j in 0..=n - i {
                let [x, y, z] = [signs[0] * i, signs[1] * j, signs[2] * (n - i - j)];
                let at = vec3(f64::from(x), f64::from(y), f64::from(z));
                self.positions.push(hills(at.normalize()));
            }
        }
        for (start, next, i) in row_starts
            .windows(2)
            .zip(0..n)
            .map(|(w, i)| (w[0], w[1], i))
        {
            let length = (n - i).unsigned_abs();
            for j in 0..length {
                let (a, b) = (start + j, next + j);
                self.triangles.push([a, a + 1, b]);
                if j + 1 < length {
                    self.triangles.push([a + 1, b + 1, b]);
                }
            }
        }
    }

    pub(super) fn group(&self) -> Group<'_> {
        Group {
            positions: &self.positions,
            triangles: &self.triangles,
            ..Group::default()
        }
    }

    pub(super) fn accel(&self) -> Result<Accel, AccelError> {
        Accel::build(&[self.group()], &[Instance::of(0)])
    }

    /// Unit normal of a triangle, on the side from which `direction` comes.
    pub(super) fn normal(&self, triangle: u32, direction: Vec3<f32>) -> Vec3<f32> {
        let [a, b, c] =
            self.triangles[triangle as usize].map(|v| Vec3::from(self.positions[v as usize]));
        let normal = (b - a).cross(c - a).normalize();
        if normal.dot(direction) > 0.0 {
            -normal
        } else {
            normal
        }
    }
}

/// A point of the unit sphere, moved in or out.
#[allow(
    clippy::cast_possible_truncation,
    reason = "vertices are single precision numbers"
)]
fn hills(p: Vec3<f64>) -> [f32; 3] {
    let wave = |k: f64| (k * p.x + 1.0).sin() * (k * p.y + 2.0).sin() * (k * p.z + 3.0).sin();
    let radius = 1.0 + 0.2 * wave(5.0) + 0.1 * wave(17.0) + 0.02 * wave(61.0);
    (p * radius).to_array().map(|x| x as f32)
}
