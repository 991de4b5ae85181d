//! Rectangles, boxes and spheres of small scenes, beside triangles and double precision.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::super::parallelogram::{Parallelogram, Triangle};
use super::super::quadric::PreparedQuadric;
use super::*;
use crate::offset::{SurfacePoint, coupled};

/// Adds the parallelogram of four corners in a row, cut along either diagonal.
fn push_face(mesh: &mut Mesh, [a, b, c, d]: [Vec3<f32>; 4], random: &mut Random) {
    let halves = match random.below(3) {
        0 => [[a, b, c], [a, c, d]],
        1 => [[b, c, d], [d, a, b]],
        _ => [[c, a, b], [d, a, c]],
    };
    for corners in halves {
        mesh.push(corners);
    }
}

/// Adds the box of a corner and its edges.
fn push_box(
    mesh: &mut Mesh,
    corner: Vec3<f32>,
    edges: [Vec3<f32>; 3],
    random: &mut Random,
) -> [Vec3<f32>; 8] {
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i: u32| {
        (0..3).fold(corner, |p, k| {
            let side = if i >> k & 1 == 0 { 0.0 } else { 1.0 };
            p + edges[k as usize] * side
        })
    });
    for face in BOX_FACES {
        push_face(mesh, face.map(|k| corners[k as usize]), random);
    }
    corners
}

/// Three edges, turned at random, sheared at times.
///
/// * `spread`: decades of their sizes about 1.
fn edges(spread: f32, random: &mut Random) -> [Vec3<f32>; 3] {
    let axis = DVec3::from(random.direction().to_array().map(f64::from)).normalize();
    let turn = DMat3::from_quat(DQuat::from_axis_angle(
        axis,
        f64::from(3.0 * random.signed()),
    ));
    let shear = if random.below(2) == 0 { 0.0 } else { 0.3 };
    let size = |random: &mut Random| f64::from(10.0_f32.powf(spread * random.signed()));
    let [x, y, z] = [size(random), size(random), size(random)];
    [
        DVec3::new(x, 0.0, 0.0),
        DVec3::new(shear * y, y, 0.0),
        DVec3::new(0.0, 0.0, z),
    ]
    .map(|edge| Vec3::from((turn * edge).to_array().map(crate::convert::narrow)))
}

fn has_own_tests(accel: &Accel) -> bool {
    accel.small_with_own_tests().is_some()
}

/// Triangles of one parallelogram in all orders of their corners tell the point that they were asked for.
#[test]
fn points_lie_on_their_triangles() {
    let mut random = Random(31);
    let ordered = |order: usize, [a, b, c]: [[f32; 3]; 3]| match order {
        0 => [a, b, c],
        1 => [b, c, a],
        2 => [c, a, b],
        3 => [a, c, b],
        4 => [c, b, a],
        _ => [b, a, c],
    };
    for (first, second) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        let p0 = random.vector();
        let [s, t, _] = edges(1.0, &mut random);
        let p = [p0, p0 + s, p0 + t, p0 + s + t].map(Vec3::to_array);
        let triangles = [
            (7, ordered(first, [p[0], p[1], p[2]])),
            (9, ordered(second, [p[3], p[2], p[1]])),
        ];
        let (found, others) = Parallelogram::all(&triangles);
        assert_eq!((found.len(), others.len()), (1, 0), "{p:?}");
        let face = found[0].face();
        let size = s.length() + t.length() + p0.length();
        for _ in 0..100 {
            let [a, b] = [random.signed().abs(), random.signed().abs()];
            let point = p0 + s * a + t * b;
            let on = face.at(point.to_array());
            let triangle = triangles.iter().find(|t| t.0 == on.primitive).unwrap();
            let [x, y, z] = triangle.1.map(Vec3::from);
            let there = x * (1.0 - on.u - on.v) + y * on.u + z * on.v;
            assert!(
                (there - point).length() < 1e-5 * size,
                "{there:?} {point:?}"
            );
            assert!(on.u >= 0.0 && on.v >= 0.0 && on.u + on.v <= 1.0 + 1e-6);
        }
    }
}

#[test]
fn only_parallelograms_are_found() {
    let [a, b, c, d] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0_f32],
    ];
    let (bent, kite) = ([0.0, 1.0, 1e-3], [-0.5, 1.5, 0.0]);
    let count = |triangles: [Triangle; 2]| {
        let (found, others) = Parallelogram::all(&triangles);
        (found.len(), others.len())
    };
    for (last, expected) in [(d, (1, 0)), (bent, (0, 2)), (kite, (0, 2))] {
        assert_eq!(count([(0, [a, b, c]), (1, [a, c, last])]), expected);
    }
    // The same triangle twice, one that shares a single corner, and a sliver.
    let far = [5.0, 5.0, 5.0];
    assert_eq!(count([(0, [a, b, c]), (1, [a, b, c])]), (0, 2));
    assert_eq!(
        count([(0, [a, b, c]), (1, [c, far, [6.0, 5.0, 5.0]])]),
        (0, 2)
    );
    let (near, end) = ([1.0, 0.05, 0.0], [2.0, 0.05, 0.0]);
    assert_eq!(count([(0, [a, b, near]), (1, [b, near, end])]), (0, 2));
}

/// Rectangles and boxes beside the same triangles in a tree: distances, points and their triangles.
#[test]
fn solids_are_hit_where_their_triangles_are() {
    let mut random = Random(32);
    let (mut hits, mut apart) = (0, 0);
    for round in 0..40 {
        let mut mesh = Mesh::default();
        for _ in 0..2 {
            let corner = random.vector() * 3.0;
            push_box(&mut mesh, corner, edges(0.2, &mut random), &mut random);
        }
        for axis in 0..3 {
            let side = |k: usize, s: f32| {
                let mut side = [0.0; 3];
                side[(axis + k) % 3] = s;
                Vec3::from(side)
            };
            let (p, s, t) = (random.vector() * 4.0, side(1, 2.5), side(2, -1.5));
            push_face(&mut mesh, [p, p + s, p + s + t, p + t], &mut random);
        }
        if round % 2 == 0 {
            mesh.push([random.vector(), random.vector(), random.vector()]);
        }
        let accel = mesh.accel();
        let small = accel.small_with_own_tests().unwrap();
        assert_eq!((small.boxes.len(), small.rectangles.len()), (2, 3));
        assert_eq!(small.clusters.is_empty(), round % 2 == 1);
        for _ in 0..20_000 {
            let ray = ray(random.vector() * 6.0, random.vector());
            let (hit, expected) = (accel.intersect(&ray), mesh.brute_force(&ray));
            assert_eq!(accel.occluded(&ray), hit.is_some(), "{ray:?}");
            let (Some(hit), Some(expected)) = (hit, expected) else {
                apart += usize::from(hit.is_some() != expected.is_some());
                continue;
            };
            hits += 1;
            let size = ray.origin.length() + ray.direction.length() * expected.t;
            let point = |hit: &Hit| {
                let [a, b, c] = mesh.corners(hit.primitive as usize).map(Vec3::from);
                a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
            };
            let near = (point(&hit) - point(&expected)).length();
            if near > 1e-3 * size {
                // Past an edge: what the one hits, the other misses.
                apart += 1;
                continue;
            }
            let on_ray = ray.origin + ray.direction * hit.t;
            let off = (on_ray - point(&hit)).length();
            assert!(off < 1e-4 * size, "{off} {hit:?} {expected:?} {ray:?}");
        }
    }
    assert!(hits > 20_000 && apart < 20, "{hits} {apart}");
}

/// Rays that leave a box hit it no more from outside, and once from inside.
#[test]
fn rays_leave_boxes_and_rectangles_freely() {
    let mut random = Random(33);
    let mut boxes = 0;
    for round in 0..400 {
        let mut mesh = Mesh::default();
        let corner = match round % 3 {
            0 => Vec3::ZERO,
            1 => random.vector(),
            _ => random.vector() * 300.0,
        };
        let edges = edges(if round % 3 == 2 { 0.3 } else { 1.0 }, &mut random);
        push_box(&mut mesh, corner, edges, &mut random);
        let accel = mesh.accel();
        boxes += usize::from(has_own_tests(&accel));
        let centre = corner + (edges[0] + edges[1] + edges[2]) * 0.5;
        for _ in 0..500 {
            let index = random.below(12);
            let corners = mesh.corners(index).map(Vec3::from);
            let [a, b, c] = corners;
            let (u, v) = (random.signed().abs(), random.signed().abs());
            let (u, v) = if u + v > 1.0 {
                (1.0 - u, 1.0 - v)
            } else {
                (u, v)
            };
            // Not where a ray that is moved inside may pass an edge.
            let (u, v) = (0.05 + 0.85 * u, 0.05 + 0.85 * v);
            let position = a * (1.0 - u - v) + b * u + c * v;
            let normal = (b - a).cross(c - a).normalize();
            let normal = normal * (position - centre).dot(normal).signum();
            let reach = corners
                .map(|p| vec3(p.x.abs(), p.y.abs(), p.z.abs()))
                .into_iter()
                .fold(Vec3::ZERO, |m: Vec3<f32>, p| {
                    vec3(m.x.max(p.x), m.y.max(p.y), m.z.max(p.z))
                });
            let point = SurfacePoint {
                position,
                error: coupled(reach),
                normal,
            };
            let direction = random.direction();
            let grazing = (direction - normal * direction.dot(normal) * 0.99).normalize();
            for direction in [direction, grazing] {
                let cosine = direction.dot(normal);
                // The normal itself is not known better.
                if cosine.abs() < 1e-4 {
                    continue;
                }
                let leaves = cosine > 0.0;
                let ray = ray(point.ray_origin(direction), direction);
                let hit = accel.intersect(&ray);
                assert_eq!(
                    hit.is_none(),
                    leaves,
                    "{index} {hit:?} {ray:?} {corners:?} {edges:?} {corner:?}"
                );
            }
        }
    }
    // Corners of the others round to what is none.
    assert!((100..400).contains(&boxes), "{boxes}");
}

/// A wall of boxes that touch, met at its seams, from near and from afar, and a room of rectangles from inside.
#[test]
fn no_ray_leaks_at_seams() {
    let mut random = Random(34);
    for (round, distance) in [1.0, 100.0, 10_000.0, 1.0, 100.0].into_iter().enumerate() {
        let mut mesh = Mesh::default();
        let [x, y, z] = if round < 3 {
            [Vec3::X, Vec3::Y, Vec3::Z]
        } else {
            edges(0.2, &mut random)
        };
        let at = random.vector();
        for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            push_box(&mut mesh, at + x * i + y * j, [x, y, z], &mut random);
        }
        let accel = mesh.accel();
        assert!(has_own_tests(&accel));
        let seam = at + x + y;
        for k in 0..200_000 {
            let along = random.signed() * 0.9;
            let target = seam + if k % 2 == 0 { x } else { y } * along;
            let jitter = random.vector() * (2e-7 * target.length());
            let from = target - z * distance + (x + y) * (random.signed() * distance);
            let ray = ray(from, target + z * 0.5 + jitter - from);
            assert!(accel.occluded(&ray), "{round} {ray:?}");
        }
    }
    // The floor in two, so that the room is no box.
    for scale in [1.0, 1e-3, 1e5] {
        let mut mesh = Mesh::default();
        let at = random.vector() * scale;
        let p = |x: f32, y: f32, z: f32| at + vec3(x, y, z) * scale;
        let mut face = |a: [f32; 3], b: [f32; 3], c: [f32; 3], d: [f32; 3]| {
            let face = [a, b, c, d].map(|[x, y, z]| p(x, y, z));
            push_face(&mut mesh, face, &mut random);
        };
        face([0., 0., 0.], [1., 0., 0.], [1., 2., 0.], [0., 2., 0.]);
        face([1., 0., 0.], [2., 0., 0.], [2., 2., 0.], [1., 2., 0.]);
        face([0., 0., 3.], [2., 0., 3.], [2., 2., 3.], [0., 2., 3.]);
        face([0., 0., 0.], [2., 0., 0.], [2., 0., 3.], [0., 0., 3.]);
        face([0., 2., 0.], [2., 2., 0.], [2., 2., 3.], [0., 2., 3.]);
        face([0., 0., 0.], [0., 2., 0.], [0., 2., 3.], [0., 0., 3.]);
        face([2., 0., 0.], [2., 2., 0.], [2., 2., 3.], [2., 0., 3.]);
        let accel = mesh.accel();
        let small = accel.small_with_own_tests().unwrap();
        assert_eq!((small.rectangles.len(), small.boxes.len()), (7, 0));
        let ends = vec3(2.0, 2.0, 3.0);
        for _ in 0..400_000 {
            let unit = |random: &mut Random| random.vector() * 0.5 + vec3(0.5, 0.5, 0.5);
            let (from, mut target) = (unit(&mut random).hadamard(ends), unit(&mut random));
            // On an edge, within a few ulps, or anywhere.
            let mut snap = |x: f32| x.round() * (1.0 + random.signed() * 3e-7);
            let along = k_of(from);
            if along != 0 {
                target.x = snap(target.x);
            }
            if along != 1 {
                target.y = snap(target.y);
            }
            if along < 2 {
                target.z = snap(target.z);
            }
            let target = target.hadamard(ends);
            let from = p(from.x, from.y, from.z);
            let ray = ray(from, p(target.x, target.y, target.z) - from);
            let hit = accel.intersect(&ray);
            assert!(hit.is_some() && accel.occluded(&ray), "{ray:?}");
        }
    }
}

/// One of four, by a point.
fn k_of(p: Vec3<f32>) -> u32 {
    p.x.to_bits() % 4
}

/// Spheres in single precision beside doubles.
#[test]
fn balls_are_hit_where_spheres_are() {
    let mut random = Random(35);
    let (mut hits, mut apart, mut apart_alone) = (0, 0, 0);
    for round in 0..60 {
        let radius = f64::from(10.0_f32.powf(3.0 * random.signed()));
        let at = DVec3::from(random.vector().to_array().map(f64::from)) * radius;
        let axis = DVec3::from(random.direction().to_array().map(f64::from)).normalize();
        let turn = DQuat::from_axis_angle(axis, f64::from(random.signed()));
        let mirrored = DVec3::new(2.0, 2.0, if round % 2 == 0 { 2.0 } else { -2.0 });
        let quadric = Quadric {
            shape: QuadricShape::Sphere {
                radius: 0.5 * radius,
            },
            to_group: DMat4::from_scale_rotation_translation(mirrored, turn, at),
        };
        let prepared = PreparedQuadric::new(&quadric, 0);
        assert!(prepared.ball().is_some());
        let group = Group {
            quadrics: &[quadric],
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        assert!(has_own_tests(&accel));
        let radius = crate::convert::narrow(radius);
        for _ in 0..20_000 {
            let mut ray = ray(random.vector() * (4.0 * radius), random.direction());
            ray.direction *= radius * 10.0_f32.powf(4.0 * random.signed());
            let expected = prepared.t_in_own_space(&ray);
            let of_one = prepared.t(&ray);
            let is_near = (of_one - expected).abs() <= 2e-6 * expected.abs();
            apart_alone += usize::from(!is_near && (of_one > 0.0 || expected > 0.0));
            let hit = accel.intersect(&ray);
            assert_eq!(accel.occluded(&ray), hit.is_some());
            match hit {
                Some(hit) if expected > 0.0 => {
                    let off = (hit.t - expected).abs() * ray.direction.length();
                    assert!(off < 2e-3 * radius, "{off} {radius} {ray:?}");
                    apart += usize::from(off > 1e-5 * radius);
                    hits += 1;
                    assert_eq!((hit.u, hit.v), (0.0, 0.0));
                }
                Some(_) => apart += 1,
                None => apart += usize::from(expected > 0.0),
            }
        }
    }
    assert!(hits > 20_000 && apart < hits / 1000, "{hits} {apart}");
    assert!(apart_alone < hits / 10_000, "{hits} {apart_alone}");
    // What is squeezed is no ball.
    let quadric = Quadric {
        shape: QuadricShape::Sphere { radius: 1.0 },
        to_group: DMat4::from_scale(DVec3::new(1.0, 1.0, 1.001)),
    };
    assert!(PreparedQuadric::new(&quadric, 0).ball().is_none());
}

/// What is no ray hits nothing, in batches and alone.
#[test]
fn rays_that_are_none_hit_no_solid() {
    let mut random = Random(36);
    let mut mesh = Mesh::default();
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    push_box(
        &mut mesh,
        vec3(-1.0, -1.0, -1.0),
        [x * 2.0, y * 2.0, z * 2.0],
        &mut random,
    );
    push_face(
        &mut mesh,
        [-x, x, x + y, y - x].map(|p| p * 9.0 - z),
        &mut random,
    );
    let quadric = Quadric {
        shape: QuadricShape::Sphere { radius: 3.0 },
        to_group: DMat4::IDENTITY,
    };
    let group = Group {
        quadrics: &[quadric],
        ..mesh.group()
    };
    let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
    let sound = ray(vec3(0.1, 0.2, 0.3), vec3(0.3, 0.5, -0.7));
    let mut rays = vec![sound];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 0..3 {
            let broken = |v: Vec3<f32>| {
                let mut v = v.to_array();
                v[k] = bad;
                Vec3::from(v)
            };
            for t_max in [f32::INFINITY, 100.0] {
                let origin = broken(sound.origin);
                let direction = broken(sound.direction);
                rays.push(Ray {
                    origin,
                    t_max,
                    ..sound
                });
                rays.push(Ray {
                    direction,
                    t_max,
                    ..sound
                });
            }
        }
    }
    for t_max in [f32::NAN, 0.0, -1.0, f32::NEG_INFINITY, 1e-3] {
        rays.push(Ray { t_max, ..sound });
    }
    let direction = Vec3::ZERO;
    rays.push(Ray { direction, ..sound });
    let (mut hits, mut occluded) = (Vec::new(), Vec::new());
    accel.intersect_all(&rays, &mut hits);
    accel.occluded_all(&rays, &mut occluded);
    for (k, ray) in rays.iter().enumerate() {
        assert_eq!(hits[k].is_some(), k == 0, "{ray:?}");
        assert_eq!(
            (occluded[k], exact(accel.intersect(ray))),
            (k == 0, exact(hits[k]))
        );
    }
}
