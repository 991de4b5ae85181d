//! Parts of quadrics against marched rays in double precision.

use core::f64::consts::TAU;

use glam::{DMat4, DQuat, DVec3};
use specula_scene::scene::QuadricPart;

use super::*;

fn wide(v: Vec3<f32>) -> DVec3 {
    DVec3::from_array(v.to_array().map(f64::from))
}

fn parts() -> [QuadricPart; 8] {
    let turn = QuadricPart::TURN;
    let sphere = |z, phi_max| QuadricPart::Sphere {
        radius: 0.6,
        z,
        phi_max,
    };
    let cylinder = |z, phi_max| QuadricPart::Cylinder {
        radius: 0.5,
        z,
        phi_max,
    };
    let disk = |inner, phi_max| QuadricPart::Disk {
        radius: 0.8,
        inner,
        height: 0.3,
        phi_max,
    };
    [
        sphere([-0.6, 0.1], turn),
        sphere([-0.2, 0.6], 4.0),
        sphere([-0.6, 0.6], 2.0),
        cylinder([-0.5, 0.7], turn),
        cylinder([-0.1, 0.4], 5.5),
        cylinder([0.2, 0.9], 1.0),
        disk(0.4, turn),
        disk(0.1, 3.5),
    ]
}

fn placed(random: &mut Random, count: usize) -> Vec<(QuadricPart, Quadric)> {
    (0..count)
        .map(|i| {
            let turn = DQuat::from_axis_angle(wide(random.direction()).normalize(), 1.0);
            let scale = wide(random.vector()).abs() + 0.3;
            let at = wide(random.vector());
            let part = parts()[i % parts().len()];
            let quadric = Quadric {
                shape: QuadricShape::Part(part),
                to_group: DMat4::from_scale_rotation_translation(scale, turn, at),
            };
            (part, quadric)
        })
        .collect()
}

/// Zero on the whole quadric.
fn implicit(part: &QuadricPart, p: DVec3) -> f64 {
    match *part {
        QuadricPart::Sphere { radius, .. } => p.length_squared() - f64::from(radius).powi(2),
        QuadricPart::Cylinder { radius, .. } => {
            p.truncate().length_squared() - f64::from(radius).powi(2)
        }
        QuadricPart::Disk { height, .. } => p.z - f64::from(height),
    }
}

/// How far within its bounds a point of the whole quadric is, in lengths and angles; negative outside.
fn margin(part: &QuadricPart, p: DVec3) -> f64 {
    let r = p.truncate().length();
    // By the cosine, where the tracer takes both coordinates.
    let angle = (p.x / r).clamp(-1.0, 1.0).acos();
    let phi = if p.y < 0.0 { TAU - angle } else { angle };
    let (phi_max, within) = match *part {
        QuadricPart::Sphere { radius, z, phi_max } => {
            let [low, high] = z.map(f64::from);
            let radius = f64::from(radius);
            let below = if low <= -radius { 1.0 } else { p.z - low };
            let above = if high >= radius { 1.0 } else { high - p.z };
            (phi_max, below.min(above))
        }
        QuadricPart::Cylinder { z, phi_max, .. } => {
            let [low, high] = z.map(f64::from);
            (phi_max, (p.z - low).min(high - p.z))
        }
        QuadricPart::Disk {
            radius,
            inner,
            phi_max,
            ..
        } => (phi_max, (f64::from(radius) - r).min(r - f64::from(inner))),
    };
    if phi_max >= QuadricPart::TURN {
        return within;
    }
    // Both edges: where the azimuth begins and where it ends.
    let inside = phi <= f64::from(phi_max);
    let edge = (phi - f64::from(phi_max)).abs().min(phi).min(TAU - phi);
    within.min(if inside { edge } else { -edge })
}

/// The first crossing that is on the part; `Err`: too near an edge or a silhouette to tell.
fn marched_to_part(part: &QuadricPart, o: DVec3, d: DVec3) -> Result<Option<f64>, ()> {
    let at = |t: f64| implicit(part, o + d * t);
    let margin = |t: f64| margin(part, o + d * t);
    marched(14.0 / d.length(), (at, 1e-4), (margin, 1e-5))
}

#[test]
fn hits_are_where_marched_rays_cross() {
    let mut random = Random(21);
    let (mut hits, mut misses, mut seconds) = (0, 0, 0);
    for (part, quadric) in placed(&mut random, 16) {
        let group = Group {
            quadrics: &[quadric],
            ..Group::default()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let own = quadric.to_group.inverse();
        for _ in 0..250 {
            let from = random.vector();
            let centre = quadric.to_group.w_axis.truncate().as_vec3().to_array();
            let ray = ray(from, Vec3::from(centre) + random.vector() * 0.7 - from);
            let hit = accel.intersect(&ray);
            assert_eq!(accel.occluded(&ray), hit.is_some());
            let (o, d) = (wide(ray.origin), wide(ray.direction));
            let (o, d) = (own.transform_point3(o), own.transform_vector3(d));
            let Ok(expected) = marched_to_part(&part, o, d) else {
                continue;
            };
            match (expected, hit) {
                (Some(t), Some(hit)) => {
                    hits += 1;
                    assert!(
                        (f64::from(hit.t) - t).abs() < 1e-5 * (1.0 + t),
                        "{part:?} {ray:?}"
                    );
                    // Where the first crossing of the whole quadric is cut away.
                    let start = implicit(&part, o);
                    let mut before = (1..STEPS).map(|i| t * f64::from(i) / f64::from(STEPS));
                    let crossed = before.any(|t| implicit(&part, o + d * t) * start < 0.0);
                    seconds += usize::from(crossed);
                }
                (None, None) => misses += 1,
                found => panic!("{part:?} {ray:?}: {found:?}"),
            }
        }
    }
    assert!(
        hits > 700 && misses > 700 && seconds > 100,
        "{hits} {misses} {seconds}"
    );
}
