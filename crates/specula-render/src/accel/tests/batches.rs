//! Batches against rays one by one, bit for bit.

use glam::{DMat4, DQuat, DVec3};
use specula_scene::scene::QuadricPart;

#[cfg(target_arch = "x86_64")]
use super::super::avx2::Avx2;
use super::super::kernel::Portable;
use super::super::{BLOCK, RayBlock, interleaved};
use super::*;

/// Spheres, disks and parts of cylinders, some squeezed.
fn quadrics(count: usize, random: &mut Random) -> Vec<Quadric> {
    let wide = |v: Vec3<f32>| DVec3::from_array(v.to_array().map(f64::from));
    (0..count)
        .map(|i| {
            let radius = 0.3 + 0.2 * f64::from(random.signed());
            let turn = DQuat::from_axis_angle(wide(random.direction()).normalize(), 1.0);
            let scale = wide(random.vector()).abs() + 0.5;
            let at = wide(random.vector());
            Quadric {
                shape: match i % 3 {
                    0 => QuadricShape::Sphere { radius },
                    1 => QuadricShape::Disk {
                        radius,
                        height: 0.1,
                    },
                    _ => QuadricShape::Part(QuadricPart::Cylinder {
                        radius: 0.3,
                        z: [-0.3, 0.4],
                        phi_max: 5.0,
                    }),
                },
                to_group: DMat4::from_scale_rotation_translation(scale, turn, at),
            }
        })
        .collect()
}

/// Rays of all kinds, those included that can hit nothing.
fn rays(count: usize, mesh: &Mesh, random: &mut Random) -> Vec<Ray> {
    let zero = vec3(0.0, 0.0, 0.0);
    let corner = |random: &mut Random| match mesh.positions.len() {
        0 => zero,
        n => Vec3::from(mesh.positions[random.below(n)]),
    };
    (0..count)
        .map(|i| {
            let mut ray = ray(random.vector() * 1.5, random.direction());
            match random.below(12) {
                0 => ray.direction.x = 0.0,
                1 => ray.direction = vec3(0.0, -0.0, ray.direction.z),
                2 => ray.direction = vec3(0.5, -0.5, 0.5),
                3 => ray.origin = corner(random),
                4 => ray.direction = corner(random) - ray.origin,
                5 => ray.t_max = random.signed(),
                6 => ray.t_max = 2.0 * random.signed().abs(),
                7 if i % 7 == 0 => ray.t_max = f32::NAN,
                8 if i % 7 == 0 => ray.direction = zero,
                9 if i % 7 == 0 => ray.direction.y = f32::INFINITY,
                10 if i % 7 == 0 => ray.origin.z = f32::NAN,
                _ => {}
            }
            ray
        })
        .collect()
}

/// Holds batches of all lengths against single rays; returns how many hit.
fn compare(accel: &Accel, rays: &[Ray]) -> usize {
    let (mut hits, mut found) = (vec![None; 3], vec![true; 3]);
    let mut count = 0;
    let mut rest = rays;
    for length in [0, 1, 15, 16, 17, 255, 256, 257, 511, 512, 513]
        .into_iter()
        .cycle()
    {
        let batch = &rest[..rest.len().min(length)];
        rest = &rest[batch.len()..];
        accel.intersect_all(batch, &mut hits);
        accel.occluded_all(batch, &mut found);
        assert_eq!((hits.len(), found.len()), (batch.len(), batch.len()));
        for ((ray, &hit), &found) in batch.iter().zip(&hits).zip(&found) {
            assert_eq!(exact(hit), exact(accel.intersect(ray)), "{ray:?}");
            assert_eq!(found, accel.occluded(ray), "{ray:?}");
            count += usize::from(found);
        }
        if rest.is_empty() {
            break;
        }
    }
    count
}

#[test]
fn batches_are_rays_one_by_one() {
    let mut random = Random(20);
    let mut hits = 0;
    // On both sides of what is small.
    for (triangles, spheres, patches) in [
        (0, 0, 0),
        (0, 1, 0),
        (1, 0, 0),
        (0, 0, 1),
        (0, 0, 7),
        (9, 3, 2),
        (40, 0, 0),
        (12, 9, 0),
        (60, 1, 0),
        (90, 20, 20),
        (3000, 40, 300),
    ] {
        let mut mesh = Mesh::soup(triangles, &mut random);
        // Each once more, and one of no area, which keeps its place.
        if triangles == 9 {
            mesh.triangles.insert(4, [0, 1, 0]);
            mesh.triangles.extend_from_within(..);
        }
        let quadrics = quadrics(spheres, &mut random);
        let patches = patches::soup(patches, &mut mesh.positions, &mut random);
        let group = Group {
            quadrics: &quadrics,
            patches: &patches,
            ..mesh.group()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let rays = rays(20_000, &mesh, &mut random);
        hits += compare(&accel, &rays);
        assert_eq!(
            compare(&accel.clone().portable(), &rays[..4000]),
            compare(&accel, &rays[..4000])
        );
    }
    assert!(hits > 20_000, "{hits}");
}

#[test]
fn equal_distances_in_a_batch_go_to_the_smallest_index() {
    // Triangles of all shapes in one plane, and a disk in it.
    let mut random = Random(21);
    let mut mesh = Mesh::default();
    for _ in 0..40 {
        let mut corner = || vec3(random.signed(), random.signed(), 1.0);
        mesh.push([corner(), corner(), corner()]);
    }
    let disk = Quadric {
        shape: QuadricShape::Disk {
            radius: 0.9,
            height: 1.0,
        },
        to_group: DMat4::IDENTITY,
    };
    let quadrics = [disk; 2];
    let group = Group {
        quadrics: &quadrics,
        ..mesh.group()
    };
    let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
    let rays: Vec<Ray> = (0..4000)
        .map(|_| ray(vec3(random.signed(), random.signed(), 0.0), Vec3::Z))
        .collect();
    assert!(compare(&accel, &rays) > 3000);
}

#[test]
fn groups_that_are_not_placed_are_not_hit() {
    let mut random = Random(22);
    let [shown, hidden] = [5, 7].map(|count| Mesh::soup(count, &mut random));
    let groups = [hidden.group(), shown.group(), hidden.group()];
    for instances in [
        &[Instance::of(1)][..],
        &[],
        &[Instance::of(1), Instance::of(2)],
    ] {
        let accel = Accel::build(&groups, instances).unwrap();
        let hits = compare(&accel, &rays(5000, &shown, &mut random));
        assert_eq!(hits > 0, !instances.is_empty());
    }
}

/// Two triangles for each side of a box, in planes across the axes.
fn box_of(min: Vec3<f32>, max: Vec3<f32>, mesh: &mut Mesh) {
    let corner = |k: usize| {
        let pick = |bit: usize, low: f32, high: f32| if k >> bit & 1 == 0 { low } else { high };
        vec3(
            pick(0, min.x, max.x),
            pick(1, min.y, max.y),
            pick(2, min.z, max.z),
        )
    };
    for axis in 0..3 {
        let [u, v] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)];
        for side in [0, 1 << axis] {
            mesh.push([side, side | u, side | u | v].map(corner));
            mesh.push([side, side | u | v, side | v].map(corner));
        }
    }
}

/// Rays between the surfaces of a room and of what is in it, from inside and outside, end before, at and beyond walls.
#[test]
fn shadow_rays_beside_planes_across_axes_are_rays_one_by_one() {
    let mut random = Random(27);
    let (mut hits, mut misses) = (0, 0);
    for scale in [1e-3, 1.0, 1e4] {
        for far in [0.0, 1.0, 30.0] {
            let offset = random.direction() * (far * scale);
            let at = |p: Vec3<f32>| p * scale + offset;
            let mut mesh = Mesh::default();
            box_of(
                at(vec3(-1.0, 0.0, -2.0)),
                at(vec3(1.0, 1.5, 2.0)),
                &mut mesh,
            );
            box_of(
                at(vec3(-0.6, 0.0, -1.0)),
                at(vec3(0.1, 0.7, -0.5)),
                &mut mesh,
            );
            // A lamp below the ceiling, and a tilted plate.
            let lamp = [[-0.3, -0.4], [0.3, -0.4], [0.3, 0.4], [-0.3, 0.4]];
            let lamp = lamp.map(|[x, z]| at(vec3(x, 1.49, z)));
            mesh.push([lamp[0], lamp[1], lamp[2]]);
            mesh.push([lamp[0], lamp[2], lamp[3]]);
            mesh.push(
                [[0.3, 0.2, 0.4], [0.8, 0.3, 0.5], [0.4, 0.9, 0.8]].map(|p| at(Vec3::from(p))),
            );
            let accel = mesh.accel();
            // Rounding at surfaces: what keeps rays off them.
            let off = 4e-6 * (scale + offset.length());
            let mut place = || match random.below(4) {
                0 => at(random.vector() * 3.0),
                _ => {
                    let corners = mesh.corners(random.below(mesh.triangles.len()));
                    let [a, b, c] = corners.map(Vec3::from);
                    let (u, v) = (random.signed().abs(), random.signed().abs());
                    let inside = a + (b - a) * u + (c - a) * ((1.0 - u) * v);
                    let side = if random.below(2) == 0 { off } else { -off };
                    inside + (b - a).cross(c - a).normalize() * side
                }
            };
            let ends: Vec<_> = (0..12_000).map(|_| [place(), place()]).collect();
            let rays: Vec<Ray> = (ends.iter())
                .map(|&[from, to]| {
                    let mut ray = ray(from, to - from);
                    ray.t_max = [1.0 - 1e-4, 1.0, 0.5, 3.0, f32::INFINITY][random.below(5)];
                    match random.below(12) {
                        0 => ray.direction.x = 0.0,
                        1 => ray.direction = vec3(0.0, -1.0, 0.0),
                        _ => {}
                    }
                    ray
                })
                .collect();
            let found = compare(&accel, &rays);
            hits += found;
            misses += rays.len() - found;
        }
    }
    assert!(hits > 20_000 && misses > 20_000, "{hits} {misses}");
}

/// A large octahedron around small ones and around small quadrics, some squeezed up to a hundredfold.
fn room(scale: f32, offset: Vec3<f32>, random: &mut Random) -> (Mesh, Vec<Quadric>) {
    let wide = |v: Vec3<f32>| DVec3::from_array(v.to_array().map(f64::from));
    let mut mesh = Mesh::closed(1, |p| p * scale + offset);
    for _ in 0..4 {
        let (at, size) = (random.vector() * 0.3, 0.1 * random.signed().abs() + 1e-3);
        let small = Mesh::closed(1, |p| (p * size + at) * scale + offset);
        let first = u32::try_from(mesh.positions.len()).unwrap();
        mesh.positions.extend(small.positions);
        let shifted = small.triangles.iter().map(|t| t.map(|v| v + first));
        mesh.triangles.extend(shifted);
    }
    let quadrics = (0..7).map(|i| {
        let at = wide(random.vector() * (0.3 * scale) + offset);
        let turn = DQuat::from_axis_angle(wide(random.direction()).normalize(), 1.0);
        let squeezed = if i > 3 { 0.01 } else { 1.0 };
        let size = f64::from(scale) * DVec3::new(1.0, squeezed, 1.0);
        let radius = 0.02 + 0.1 * f64::from(random.signed().abs());
        Quadric {
            shape: match i % 4 {
                3 => QuadricShape::Disk {
                    radius,
                    height: 0.05,
                },
                _ => QuadricShape::Sphere { radius },
            },
            to_group: DMat4::from_scale_rotation_translation(size, turn, at),
        }
    });
    let quadrics = quadrics.collect();
    (mesh, quadrics)
}

/// A ray at the rim of what is in a room, or at a corner, off by about what rounding takes.
fn grazing(
    mesh: &Mesh,
    quadrics: &[Quadric],
    [scale, x, y, z]: [f32; 4],
    random: &mut Random,
) -> Ray {
    let narrow = |v: DVec3| Vec3::from(v.to_array().map(crate::convert::narrow));
    let wide = |v: Vec3<f32>| DVec3::from_array(v.to_array().map(f64::from));
    let centre = vec3(x, y, z);
    let mut origin = centre + random.vector() * (0.5 * scale);
    if random.below(4) == 0 {
        origin = centre + random.vector() * (1e4 * scale);
    }
    let target = if random.below(2) == 0 {
        Vec3::from(mesh.positions[random.below(mesh.positions.len())])
    } else {
        let quadric = quadrics[random.below(quadrics.len())];
        let (radius, height) = match quadric.shape {
            QuadricShape::Sphere { radius } => (radius, 0.0),
            QuadricShape::Disk { radius, height } => (radius, height),
            QuadricShape::Part(part) => panic!("{part:?} has tests of its own"),
        };
        // In its own space spheres are round: of what is seen from the origin the rim.
        let own = quadric.to_group.inverse();
        let from = own.transform_point3(wide(origin));
        let side = from.cross(wide(random.direction())).normalize_or_zero();
        let off = 1.0 + 1e-6 * f64::from(random.signed().powi(5));
        let rim = match quadric.shape {
            QuadricShape::Sphere { .. } => {
                let (d, r) = (from.length().max(radius), radius * off);
                let cos = (r / d).min(1.0);
                from / d * (r * cos) + side * (r * (1.0 - cos * cos).sqrt())
            }
            QuadricShape::Disk { .. } | QuadricShape::Part(_) => {
                let flat = DVec3::new(side.x, side.y, 0.0).normalize_or_zero();
                flat * (radius * off) + DVec3::Z * height
            }
        };
        narrow(quadric.to_group.transform_point3(rim))
    };
    let t_max = [f32::INFINITY, 1.0, 1.0 - 1e-7, 1.0 + 1e-7, 0.5][random.below(5)];
    let mut ray = ray(origin, target - origin);
    ray.t_max = t_max;
    if random.below(4) == 0 {
        ray.direction *= -1.0;
    }
    ray
}

#[test]
fn what_is_small_in_a_room_is_not_passed_by() {
    let mut random = Random(25);
    let mut hits = 0;
    for exponent in [-18, -12, -6, -3, 0, 3, 6, 12, 17] {
        for far in [0.0, 1.0, 100.0, 1e4] {
            let scale = 10.0_f32.powi(exponent);
            let offset = random.direction() * (far * scale);
            let place = [scale, offset.x, offset.y, offset.z];
            let (mesh, quadrics) = room(scale, offset, &mut random);
            let group = Group {
                quadrics: &quadrics,
                ..mesh.group()
            };
            let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
            let rays: Vec<Ray> = (0..10_000)
                .map(|_| grazing(&mesh, &quadrics, place, &mut random))
                .collect();
            hits += compare(&accel, &rays);
        }
    }
    assert!(hits > 100_000, "{hits}");
}

#[test]
fn interleaved_rays_are_rays_one_by_one() {
    let mut random = Random(23);
    let mut count = 0;
    for (triangles, spheres) in [(1, 0), (0, 1), (500, 30), (5000, 0), (60_000, 30)] {
        let mesh = Mesh::soup(triangles, &mut random);
        let quadrics = quadrics(spheres, &mut random);
        let group = Group {
            quadrics: &quadrics,
            ..mesh.group()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let scene = &accel.scene;
        let rays = rays(20_000, &mesh, &mut random);
        for batch in rays.chunks(BLOCK).chain([&rays[..2], &rays[..0]]) {
            let (mut hits, mut found) = (vec![None; batch.len()], vec![false; batch.len()]);
            let block = RayBlock::of(batch);
            let all = (&block, batch.len(), 0);
            interleaved::intersect(Portable, scene, all, &mut hits);
            interleaved::occluded(Portable, scene, all, &mut found);
            #[cfg(target_arch = "x86_64")]
            if let Some(kernel) = Avx2::detect() {
                let (mut other, mut others) = (vec![None; batch.len()], vec![false; batch.len()]);
                let block = (&block, batch.len());
                kernel.intersect_block(scene, block, &mut other);
                kernel.occluded_block(scene, block, &mut others);
                let bits = |hits: Vec<Option<Hit>>| hits.into_iter().map(exact).collect::<Vec<_>>();
                assert_eq!((bits(other), others), (bits(hits.clone()), found.clone()));
            }
            for ((ray, hit), found) in batch.iter().zip(hits).zip(found) {
                assert_eq!(exact(hit), exact(accel.intersect(ray)), "{ray:?}");
                assert_eq!(found, hit.is_some(), "{ray:?}");
                count += usize::from(found);
            }
        }
    }
    assert!(count > 10_000, "{count}");
}

#[test]
fn rays_in_a_large_tree_gain_by_interleaving() {
    let mut random = Random(24);
    let large = Mesh::soup(60_000, &mut random).accel();
    let small = Mesh::soup(1000, &mut random).accel();
    let rays: Vec<Ray> = (0..2000)
        .map(|_| ray(Vec3::ZERO, random.direction()))
        .collect();
    assert!(interleaved::gains(&large.scene));
    assert!(!interleaved::gains(&small.scene));
    assert!(compare(&large, &rays) > 1000);
    assert!(compare(&large.portable(), &rays) > 1000);
}
