//! Bilinear patches against marched rays in double precision, and as closed meshes.

use glam::{DMat4, DVec3};

use super::*;

fn wide(v: Vec3<f32>) -> DVec3 {
    DVec3::from_array(v.to_array().map(f64::from))
}

/// Patches of all sizes and twists within about `[-1, 1]^3`; adds their vertices.
pub(super) fn soup(
    count: usize,
    positions: &mut Vec<[f32; 3]>,
    random: &mut Random,
) -> Vec<[u32; 4]> {
    let mut patches = Vec::new();
    for _ in 0..count {
        let (centre, size) = (random.vector() * 0.6, 0.6 * random.signed().abs() + 0.05);
        let first = u32::try_from(positions.len()).unwrap();
        let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
        let turn = random.direction();
        let specula_bsdf::Frame { s, t, .. } = specula_bsdf::Frame::from_normal(turn);
        for [x, y] in corners {
            let flat = centre + (s * x + t * y) * size;
            positions.push((flat + random.vector() * (1.2 * size)).to_array());
        }
        patches.push([first, first + 1, first + 2, first + 3]);
    }
    patches
}

/// Weights of a point by four corners, whose sum is 1.
fn weights([a, b, c, d]: [DVec3; 4], p: DVec3) -> [f64; 4] {
    let [x, y, z] = [b - a, c - a, d - a];
    let volume = x.cross(y).dot(z);
    let p = p - a;
    let [wb, wc, wd] = [y.cross(z), z.cross(x), x.cross(y)].map(|n| p.dot(n) / volume);
    [1.0 - wb - wc - wd, wb, wc, wd]
}

/// The first crossing of the patch's quadric `w00 w11 = w10 w01` within the patch, with u and v; `Err`: too near an edge
/// or a silhouette to tell.
fn marched_to_patch(corners: [DVec3; 4], o: DVec3, d: DVec3) -> Result<Option<[f64; 3]>, ()> {
    let at = |t: f64| weights(corners, o + d * t);
    let implicit = |t: f64| {
        let [a, b, c, d] = at(t);
        a * d - b * c
    };
    let coordinates = |t: f64| {
        let [_, b, c, d] = at(t);
        [b + d, c + d]
    };
    let margin = |t: f64| {
        let [u, v] = coordinates(t);
        u.min(1.0 - u).min(v).min(1.0 - v)
    };
    let first = marched(6.0 / d.length(), (implicit, 1e-3), (margin, 1e-4))?;
    Ok(first.map(|t| {
        let [u, v] = coordinates(t);
        [t, u, v]
    }))
}

#[test]
fn hits_are_where_marched_rays_cross() {
    let mut random = Random(31);
    let (mut hits, mut misses, mut seconds) = (0, 0, 0);
    for _ in 0..24 {
        let mut positions = Vec::new();
        let patches = soup(1, &mut positions, &mut random);
        let corners = [0, 1, 2, 3].map(|i: usize| wide(Vec3::from(positions[i])));
        let group = Group {
            positions: &positions,
            patches: &patches,
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let centre = corners.iter().sum::<DVec3>() / 4.0;
        let centre = Vec3::from(centre.as_vec3().to_array());
        for _ in 0..250 {
            let from = random.vector();
            let ray = ray(from, centre + random.vector() * 0.5 - from);
            let hit = accel.intersect(&ray);
            assert_eq!(accel.occluded(&ray), hit.is_some());
            let (o, d) = (wide(ray.origin), wide(ray.direction));
            let Ok(expected) = marched_to_patch(corners, o, d) else {
                continue;
            };
            match (expected, hit) {
                (Some(expected), Some(hit)) => {
                    hits += 1;
                    for (found, expected) in [hit.t, hit.u, hit.v].into_iter().zip(expected) {
                        let error = (f64::from(found) - expected).abs();
                        assert!(
                            error < 2e-6 * (1.0 + expected),
                            "{ray:?} {hit:?} {expected:?}"
                        );
                    }
                    // Where the ray goes on to hit it again.
                    let behind = Ray {
                        origin: ray.origin + ray.direction * (hit.t * 1.001),
                        ..ray
                    };
                    seconds += usize::from(accel.occluded(&behind));
                }
                (None, None) => misses += 1,
                found => panic!("{corners:?} {ray:?}: {found:?}"),
            }
        }
    }
    assert!(
        hits > 1500 && misses > 1000 && seconds > 15,
        "{hits} {misses} {seconds}"
    );
}

/// Vertices and patches of a closed surface.
struct Closed {
    positions: Vec<[f32; 3]>,
    patches: Vec<[u32; 4]>,
}

impl Closed {
    /// A cube whose faces are cut into `n^2` patches, moved by `warp`.
    fn cube(n: u32, mut warp: impl FnMut(Vec3<f32>) -> Vec3<f32>) -> Self {
        let mut known = std::collections::HashMap::new();
        let (mut positions, mut patches) = (Vec::new(), Vec::new());
        for face in 0..6_usize {
            let (axis, side) = (face / 2, u32::from(face % 2 == 1) * n);
            let mut vertex = |i: u32, j: u32| {
                let mut key = [side; 3];
                (key[(axis + 1) % 3], key[(axis + 2) % 3]) = (i, j);
                *known.entry(key).or_insert_with(|| {
                    let at = key.map(|c| 2.0 * c as f32 / n as f32 - 1.0);
                    positions.push(warp(Vec3::from(at)).to_array());
                    u32::try_from(positions.len()).unwrap() - 1
                })
            };
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let patch = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
                patches.push(patch.map(|[i, j]| vertex(i, j)));
            }
        }
        Self { positions, patches }
    }

    /// A globe of `n` by `2 n` patches, those at the poles with two corners in one.
    fn globe(n: u32) -> Self {
        let row = |j: u32| {
            let theta = core::f32::consts::PI * j as f32 / n as f32;
            (0..2 * n).map(move |i| {
                let phi = core::f32::consts::PI * i as f32 / n as f32;
                [
                    theta.sin() * phi.cos(),
                    theta.sin() * phi.sin(),
                    theta.cos(),
                ]
            })
        };
        let rows = (1..n).flat_map(row);
        let positions = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        let vertex = |i: u32, j: u32| match j {
            0 => 0,
            j if j == n => 1,
            j => 2 + (j - 1) * 2 * n + i % (2 * n),
        };
        let patches = (0..n).flat_map(|j| (0..2 * n).map(move |i| (i, j)));
        let corners = |(i, j)| [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
        Self {
            patches: patches
                .map(|at| corners(at).map(|[i, j]| vertex(i, j)))
                .collect(),
            positions: positions.into_iter().chain(rows).collect(),
        }
    }

    fn accel(&self) -> Accel {
        let group = Group {
            positions: &self.positions,
            patches: &self.patches,
            ..Group::default()
        };
        Accel::build(&[group], &[Instance::of(0)]).unwrap()
    }

    /// Counts rays from `origins` that miss: in random directions, at vertices, and at points of edges.
    fn leaks(&self, origin: impl Fn(&mut Random) -> Vec3<f32>, count: usize) -> usize {
        let accel = self.accel();
        let mut random = Random(5);
        let mut missed = 0;
        let mut shoot = |origin: Vec3<f32>, direction: Vec3<f32>| {
            let ray = ray(origin, direction);
            missed += usize::from(accel.intersect(&ray).is_none() || !accel.occluded(&ray));
        };
        for _ in 0..count {
            let from = origin(&mut random);
            shoot(from, random.direction());
        }
        for i in 0..count {
            let patch = self.patches[i % self.patches.len()];
            let [a, b, c, d] = patch.map(|v| Vec3::from(self.positions[v as usize]));
            let (p, q) = [(a, b), (b, d), (d, c), (c, a)][random.below(4)];
            let from = origin(&mut random);
            let along = [0.0, 0.5, random.signed().abs()][random.below(3)];
            shoot(from, p + (q - p) * along - from);
        }
        missed
    }
}

#[test]
fn closed_meshes_of_patches_hold_a_million_rays() {
    let within = |random: &mut Random| random.vector() * 0.3;
    let mut bumps = Random(3);
    let bumpy = |p: Vec3<f32>| p.normalize() + bumps.vector() * 0.02;
    assert_eq!(Closed::cube(12, bumpy).leaks(within, 300_000), 0);
    // Twelve edges, and faces that turn by far more than a right angle.
    let mut bumps = Random(4);
    let twisted = |p: Vec3<f32>| p + bumps.vector() * 0.3;
    assert_eq!(Closed::cube(1, twisted).leaks(within, 200_000), 0);
    assert_eq!(Closed::cube(8, |p| p).leaks(within, 100_000), 0);
    let globe = Closed::globe(16);
    assert_eq!(globe.leaks(within, 100_000), 0);
    let transposed = Closed {
        patches: globe
            .patches
            .iter()
            .map(|&[a, b, c, d]| [d, b, c, a])
            .collect(),
        ..globe
    };
    assert_eq!(transposed.leaks(within, 100_000), 0);
    let at = vec3(1000.0, -777.7, 333.3);
    let distant = Closed::cube(12, |p| p.normalize() + at);
    assert_eq!(distant.leaks(|r| r.vector() * 0.3 + at, 100_000), 0);
    let long = |p: Vec3<f32>| vec3(1000.0 * p.x, 0.1 * p.y, p.z);
    let needle = Closed::cube(12, |p| long(p.normalize()));
    assert_eq!(needle.leaks(|r| long(r.vector() * 0.3), 100_000), 0);
}

#[test]
fn flat_patches_are_hit_as_their_triangles_are() {
    let mut random = Random(11);
    // A parallelogram, a trapezoid, and quadrilaterals of which two corners are one.
    let quads = [
        [[0.0, 0.0], [1.0, 0.1], [0.2, 0.9], [1.2, 1.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.3, 1.0], [0.6, 1.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 1.0]],
        [[0.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 1.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]],
    ];
    let mut hits = 0;
    for quad in quads {
        let specula_bsdf::Frame { s, t, .. } = specula_bsdf::Frame::from_normal(random.direction());
        let positions = quad.map(|[x, y]| (s * x + t * y).to_array());
        let group = Group {
            positions: &positions,
            ..Group::default()
        };
        let patch = Group {
            patches: &[[0, 1, 2, 3]],
            ..group
        };
        let halves = Group {
            triangles: &[[0, 1, 3], [0, 3, 2]],
            ..group
        };
        let [patch, halves] =
            [patch, halves].map(|g| Accel::build(&[g], &[Instance::of(0)]).unwrap());
        for _ in 0..4000 {
            let target = s * random.signed().abs() + t * random.signed().abs();
            let from = random.vector() * 2.0;
            let ray = ray(from, target - from);
            if ray.direction.normalize().dot(s.cross(t)).abs() < 0.05 {
                continue;
            }
            let (found, expected) = (patch.intersect(&ray), halves.intersect(&ray));
            let (Some(found), Some(expected)) = (found, expected) else {
                // Beside an edge by less than the triangles' rounding.
                let edge = |hit: Hit| hit.u.min(hit.v).min(1.0 - hit.u - hit.v);
                assert!(
                    found.is_none() && expected.is_none_or(|h| edge(h) < 1e-5),
                    "{ray:?}"
                );
                continue;
            };
            hits += 1;
            assert!((found.t - expected.t).abs() < 1e-5, "{ray:?}");
        }
    }
    assert!(hits > 8000, "{hits}");
}

#[test]
fn patches_without_area_are_not_hit_and_all_hits_are_numbers() {
    let mut random = Random(12);
    let [a, b, c] = [[0.0; 3], [0.5, 0.2, 0.1], [1.0, 0.4, 0.2]];
    let beside = [0.5, 0.200_000_02, 0.1];
    for (corners, can_be_hit) in [
        ([a; 4], false),
        ([a, b, c, a], false),
        ([a, c, a, c], false),
        ([a, c, beside, b], true),
        ([a, beside, c, b], true),
        ([a, [f32::NAN; 3], c, b], false),
    ] {
        let group = Group {
            positions: &corners,
            patches: &[[0, 1, 2, 3]],
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        assert_eq!(accel.stats().patches, usize::from(can_be_hit));
        for i in 0..20_000 {
            let from = random.vector();
            let target = Vec3::from(c) * random.signed().abs();
            let mut ray = ray(from, target - from);
            if i % 3 == 0 {
                ray.direction = Vec3::from(c);
                ray.origin = target;
            }
            let Some(hit) = accel.intersect(&ray) else {
                continue;
            };
            assert!(can_be_hit && hit.t > 0.0 && hit.t.is_finite());
            assert!((0.0..=1.0).contains(&hit.u) && (0.0..=1.0).contains(&hit.v));
        }
    }
}

#[test]
fn instances_and_units_of_length_change_no_hit() {
    let mut random = Random(13);
    let mut positions = Vec::new();
    let patches = soup(30, &mut positions, &mut random);
    let group = Group {
        positions: &positions,
        patches: &patches,
        ..Group::default()
    };
    let own = Accel::build(&[group], &[Instance::of(0)]).unwrap();
    let (mut hits, mut different) = (0, 0);
    for scale in [2.0_f32.powi(-20), 1.0, 2.0_f32.powi(20)] {
        let scaled: Vec<[f32; 3]> = positions.iter().map(|p| p.map(|x| x * scale)).collect();
        let group = Group {
            positions: &scaled,
            ..group
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        // Exact: the transform has small integers alone.
        let to_world = DMat4::from_translation(DVec3::new(4.0, -2.0, 0.0) * f64::from(scale))
            * DMat4::from_scale(DVec3::new(-1.0, 2.0, 1.0));
        let instance = Instance { group: 0, to_world };
        let instanced = Accel::build(&[group], &[instance, instance]).unwrap();
        for _ in 0..3000 {
            let from = random.vector();
            let straight = ray(from, random.direction());
            let expected = own.intersect(&straight);
            let far = Ray {
                origin: straight.origin * scale,
                direction: straight.direction * scale,
                ..straight
            };
            assert_eq!(exact(accel.intersect(&far)), exact(expected));
            let moved = |v: Vec3<f32>| vec3(-v.x, 2.0 * v.y, v.z);
            let there = Ray {
                origin: moved(far.origin) + vec3(4.0, -2.0, 0.0) * scale,
                direction: moved(far.direction),
                ..far
            };
            let found = instanced.intersect(&there);
            // Rounding moves the ray.
            let is_same = match (found, expected) {
                (Some(a), Some(b)) => a.primitive == b.primitive && (a.t - b.t).abs() < 1e-4,
                (a, b) => a.is_none() && b.is_none(),
            };
            hits += usize::from(found.is_some());
            different += usize::from(!is_same);
        }
    }
    assert!(hits > 2000 && different < 5, "{hits} {different}");
}
