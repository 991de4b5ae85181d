// Intersection of rays with spheres and disks.
//
// Twin of specula-render/src/accel/quadric.rs. Departure: in f32, where the CPU computes in f64.

import tracer::world::{word, number, affine_point, affine_vector};

/// The least `t > 0` at which a ray hits a quadric; not positive where it misses.
///
/// * `at`: offset of its kind (sphere, disk), radius and height.
/// * `space`: offset of the affine map from the space of the ray to that of the quadric.
///
/// Source: Haines, Guenther and Akenine-Moeller 2019 (Ray Tracing Gems 7), eqs. 5 and 10.
fn quadric_distance(at: u32, space: u32, origin: vec3f, direction: vec3f) -> f32 {
    let o = affine_point(space, origin);
    let d = affine_vector(space, direction);
    let radius = number(at + 1u);
    if word(at) == QUADRIC_DISK {
        let t = (number(at + 2u) - o.z) / d.z;
        let p = o.xy + t * d.xy;
        return select(-1.0, t, dot(p, p) <= radius * radius && d.z != 0.0);
    }
    let a = dot(d, d);
    let b = -dot(o, d);
    let closest = o + d * (b / a);
    let discriminant = radius * radius - dot(closest, closest);
    if discriminant < 0.0 {
        return -1.0;
    }
    let distance = length(o);
    let root = sqrt(a * discriminant);
    let q = b + select(root, -root, b < 0.0);
    let c = (distance - radius) * (distance + radius);
    if q == 0.0 {
        return -1.0;
    }
    let first = min(c / q, q / a);
    let second = max(c / q, q / a);
    return select(second, first, first > 0.0);
}
