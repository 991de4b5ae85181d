//! Spheres and disks against double precision, and mixed with triangles.

use glam::{DMat4, DQuat, DVec3};

use super::*;

fn wide(v: Vec3<f32>) -> DVec3 {
    DVec3::from_array(v.to_array().map(f64::from))
}

/// The object-space point at `t`, in doubles.
fn point(quadric: &Quadric, ray: &Ray, t: f64) -> DVec3 {
    let p = wide(ray.origin) + wide(ray.direction) * t;
    quadric.to_group.inverse().transform_point3(p)
}

/// How far `t` is from the surface, relative to the radius; and the radius within its plane.
fn residual(quadric: &Quadric, ray: &Ray, t: f64) -> f64 {
    let p = point(quadric, ray, t);
    match quadric.shape {
        QuadricShape::Sphere { radius } => (p.length() - radius).abs() / radius,
        QuadricShape::Disk { radius, height } => (p.z - height).abs() / radius,
        QuadricShape::Part(part) => panic!("{part:?} has tests of its own"),
    }
}

/// Whether the ray meets the quadric, by the textbook in doubles; `None` near the silhouette.
fn meets(quadric: &Quadric, ray: &Ray) -> Option<bool> {
    let inverse = quadric.to_group.inverse();
    let o = inverse.transform_point3(wide(ray.origin));
    let d = inverse.transform_vector3(wide(ray.direction));
    let (inside, ahead) = match quadric.shape {
        QuadricShape::Sphere { radius } => {
            let t = -o.dot(d) / d.length_squared();
            let gap = (o + d * t).length() / radius - 1.0;
            (gap, t > 0.0 || o.length() < radius)
        }
        QuadricShape::Disk { radius, height } => {
            let t = (height - o.z) / d.z;
            let p = o + d * t;
            (p.truncate().length() / radius - 1.0, t > 0.0)
        }
        QuadricShape::Part(part) => panic!("{part:?} has tests of its own"),
    };
    (inside.abs() > 1e-6).then_some(inside < 0.0 && ahead)
}

fn shapes(random: &mut Random) -> Vec<Quadric> {
    (0..40)
        .map(|i| {
            let shape = if i % 2 == 0 {
                QuadricShape::Sphere { radius: 0.5 }
            } else {
                QuadricShape::Disk {
                    radius: 0.7,
                    height: 0.2,
                }
            };
            let turn = DQuat::from_axis_angle(wide(random.direction()).normalize(), f64::from(i));
            let scale = wide(random.vector()).abs() + 0.2;
            let at = wide(random.vector()) * 2.0;
            Quadric {
                shape,
                to_group: DMat4::from_scale_rotation_translation(scale, turn, at),
            }
        })
        .collect()
}

#[test]
fn one_by_one_against_doubles() {
    let mut random = Random(10);
    let (mut hits, mut misses) = (0, 0);
    for quadric in shapes(&mut random) {
        let group = Group {
            quadrics: &[quadric],
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        for _ in 0..2000 {
            let from = random.vector() * 3.0;
            let centre = quadric.to_group.w_axis.truncate().as_vec3().to_array();
            let ray = ray(from, Vec3::from(centre) + random.vector() - from);
            let hit = accel.intersect(&ray);
            assert_eq!(accel.occluded(&ray), hit.is_some());
            if let Some(expected) = meets(&quadric, &ray) {
                assert_eq!(hit.is_some(), expected, "{quadric:?} {ray:?}");
            }
            if let Some(hit) = hit {
                hits += 1;
                let t = f64::from(hit.t);
                assert!(residual(&quadric, &ray, t) < 3e-6, "{quadric:?} {ray:?}");
                // Nothing nearer: between the origin and the hit the ray stays on one side.
                if let QuadricShape::Sphere { radius } = quadric.shape {
                    let inside = |t| point(&quadric, &ray, t).length() < radius;
                    assert_eq!(inside(0.0), inside(0.999 * t), "{quadric:?} {ray:?}");
                }
            } else {
                misses += 1;
            }
        }
    }
    assert!(hits > 10_000 && misses > 10_000, "{hits} {misses}");
}

#[test]
fn a_small_sphere_far_away_and_a_huge_one() {
    // Where b^2 - 4 a c in single precision has no digit left.
    let sphere = |radius: f64, at: DVec3| Quadric {
        shape: QuadricShape::Sphere { radius },
        to_group: DMat4::from_translation(at),
    };
    let small = sphere(1.0, DVec3::new(0.0, 0.0, 10_000.0));
    let huge = sphere(1e6, DVec3::new(0.0, 0.0, 1e6 + 5.0));
    for (quadric, from, t) in [
        (small, Vec3::ZERO, 9999.0),
        (huge, Vec3::ZERO, 5.0),
        (huge, vec3(0.0, 0.0, 7.0), 2e6 - 2.0),
    ] {
        let group = Group {
            quadrics: &[quadric],
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let hit = accel.intersect(&ray(from, Vec3::Z)).unwrap();
        assert!((hit.t - t).abs() <= t * f32::EPSILON, "{} {t}", hit.t);
    }
}

#[test]
fn mixed_with_triangles() {
    let mut random = Random(11);
    let mesh = Mesh::soup(300, &mut random);
    let quadrics = shapes(&mut random);
    let both = Group {
        quadrics: &quadrics,
        ..mesh.group()
    };
    let accel = Accel::build(&[both], &[Instance::of(0)]).unwrap();
    let portable = accel.clone().portable();
    let apart: Vec<Accel> = quadrics
        .chunks(1)
        .map(|quadrics| {
            let group = Group {
                quadrics,
                ..Group::default()
            };
            Accel::build(&[group], &[Instance::of(0)]).unwrap()
        })
        .collect();
    let (mut on_triangles, mut on_quadrics) = (0, 0);
    for _ in 0..5000 {
        let ray = ray(random.vector() * 3.0, random.direction());
        let mut expected = mesh.brute_force(&ray);
        for (accel, primitive) in apart.iter().zip(300..) {
            if let Some(hit) = accel.intersect(&ray)
                && expected.is_none_or(|best| hit.t < best.t)
            {
                expected = Some(Hit { primitive, ..hit });
            }
        }
        let hit = accel.intersect(&ray);
        assert_eq!(exact(hit), exact(expected), "{ray:?}");
        assert_eq!(exact(portable.intersect(&ray)), exact(hit));
        match expected {
            Some(hit) if hit.primitive < 300 => on_triangles += 1,
            Some(_) => on_quadrics += 1,
            None => {}
        }
    }
    assert!(
        on_triangles > 100 && on_quadrics > 500,
        "{on_triangles} {on_quadrics}"
    );
}

#[test]
fn irregular_quadrics_are_refused() {
    for (radius, scale) in [
        (0.0, 1.0),
        (f64::NAN, 1.0),
        (1.0, 0.0),
        (1.0, f64::INFINITY),
    ] {
        let quadric = Quadric {
            shape: QuadricShape::Sphere { radius },
            to_group: DMat4::from_scale(DVec3::splat(scale)),
        };
        let group = Group {
            quadrics: &[quadric],
            ..Group::default()
        };
        let error = Accel::build(&[group], &[]).unwrap_err();
        assert_eq!(
            error,
            AccelError::SingularQuadric {
                group: 0,
                quadric: 0
            }
        );
    }
}
