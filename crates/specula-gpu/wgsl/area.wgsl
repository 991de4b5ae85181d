// Shapes that emit light: triangles, parallelograms, spheres, disks and ellipsoids, sampled from a
// point.
//
// Layout of a record, in words: kind, then of
// - a triangle or disk: corner or centre, two edges or axes, normal (3 each), area;
// - a parallelogram: see parallelogram.wgsl;
// - a sphere: centre (3), radius, whether its normals point inwards;
// - an ellipsoid: from the unit sphere to the world, back, cofactor (affine maps), the same flag.
//
// Twin of specula-render/src/light/area.rs.

import package::math::frame::{frame_from_normal, frame_to_world};
import package::math::warp::{warp_uniform_sphere};
import tracer::angles::{angles_sin_cos_of_half, angles_sin_cos_turns};
import tracer::parallelogram::{parallelogram_sample, parallelogram_pdf, parallelogram_ratio};
import tracer::world::{affine_magnitude, affine_point, affine_vector, number, offset_coupled, unit_or, vector, word};

/// `1 / (4 pi)`.
const AREA_PER_SPHERE: f32 = 0.07957747;

/// A sampled point on a light.
/// Twin: specula-render/src/light/area.rs, AreaSample.
struct AreaSample {
    /// The point.
    position: vec3f,
    /// Bound on the error of each component of it.
    error: vec3f,
    /// Towards the outside.
    normal: vec3f,
    /// From the reference point, unit.
    wi: vec3f,
    /// In 1/sr; 0: there is no sample.
    pdf: f32,
}

/// The cone in which a sphere is seen from outside.
/// Twin: specula-render/src/light/sphere.rs, Cone.
struct AreaCone {
    /// To the centre, unit.
    axis: vec3f,
    /// Distance to the centre.
    to_centre: f32,
    /// Of the half angle.
    sine_squared: f32,
    /// `1 - cos` of the half angle, without cancellation; 0 from inside or on the sphere.
    one_minus_cosine: f32,
}

/// Samples a point of the shape at `at`, as seen from `p`.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/area.rs, Area::sample.
fn area_sample(at: u32, p: vec3f, u: vec2f) -> AreaSample {
    let kind = word(at);
    if AREA_HAS_PARALLELOGRAM != 0u && kind == AREA_PARALLELOGRAM {
        let seen = parallelogram_sample(at + 1u, p, u);
        return AreaSample(seen.position, vector(at + 23u), vector(at + 10u), seen.wi, seen.pdf);
    }
    if AREA_HAS_SPHERE != 0u && kind == AREA_SPHERE {
        return area_sample_sphere(at, p, u);
    }
    if AREA_HAS_ELLIPSOID != 0u && kind == AREA_ELLIPSOID {
        let d = warp_uniform_sphere(u);
        let stretched = affine_vector(at + 25u, d);
        let growth = length(stretched);
        let normal = stretched * (area_sign(at + 37u) / growth);
        let reach = affine_magnitude(at + 1u, d);
        return area_by_area(p, affine_point(at + 1u, d), reach, normal, AREA_PER_SPHERE / growth);
    }
    if AREA_HAS_FLAT != 0u {
        return area_sample_flat(at, p, u);
    }
    var none: AreaSample;
    return none;
}

/// Samples a point of the triangle or disk at `at`, as seen from `p`.
fn area_sample_flat(at: u32, p: vec3f, u: vec2f) -> AreaSample {
    var weights = area_triangle(u);
    if word(at) == AREA_DISK {
        weights = area_disk(u);
    }
    let corner = vector(at + 1u);
    let edge = vector(at + 4u);
    let other = vector(at + 7u);
    return area_by_area(
        p,
        corner + edge * weights.x + other * weights.y,
        abs(corner) + abs(edge) + abs(other),
        vector(at + 10u),
        1.0 / number(at + 13u),
    );
}

/// Density in 1/sr with which `area_sample` samples the direction from `p` to the point `q` of the shape at
/// `at`.
///
/// * `normal`: of the shape at `q`.
///
/// Twin: specula-render/src/light/area.rs, Area::pdf.
fn area_pdf(at: u32, p: vec3f, q: vec3f, normal: vec3f) -> f32 {
    let kind = word(at);
    var per_area = 0.0;
    if AREA_HAS_PARALLELOGRAM != 0u && kind == AREA_PARALLELOGRAM {
        return parallelogram_pdf(at + 1u, p, q);
    }
    if AREA_HAS_SPHERE != 0u && kind == AREA_SPHERE {
        let radius = number(at + 4u);
        let cone = area_cone(p, vector(at + 1u), radius);
        if cone.one_minus_cosine > 0.0 {
            return 2.0 * AREA_PER_SPHERE / cone.one_minus_cosine;
        }
        per_area = AREA_PER_SPHERE / (radius * radius);
    } else if AREA_HAS_ELLIPSOID != 0u && kind == AREA_ELLIPSOID {
        let d = unit_or(affine_point(at + 13u, q), vec3f(0.0, 0.0, 1.0));
        per_area = AREA_PER_SPHERE / length(affine_vector(at + 25u, d));
    } else {
        per_area = 1.0 / number(at + 13u);
    }
    let d = q - p;
    let distance_squared = dot(d, d);
    if !(distance_squared > 0.0) {
        return 0.0;
    }
    let cosine = abs(dot(normal, d)) / sqrt(distance_squared);
    return parallelogram_ratio(per_area * distance_squared, cosine);
}

/// -1 where the normals point inwards, else 1.
///
/// * `at`: offset of the flag.
fn area_sign(at: u32) -> f32 {
    return select(1.0, -1.0, word(at) != 0u);
}

/// The cone in which a sphere is seen from `p`.
/// Twin: specula-render/src/light/sphere.rs, Cone::new.
fn area_cone(p: vec3f, centre: vec3f, radius: f32) -> AreaCone {
    let d = centre - p;
    let distance_squared = dot(d, d);
    // A margin: next to the surface the cone is a hemisphere and rounding decides.
    if distance_squared <= radius * radius * 1.0001 {
        return AreaCone(vec3f(0.0), 0.0, 0.0, 0.0);
    }
    let sine_squared = radius * radius / distance_squared;
    let to_centre = sqrt(distance_squared);
    let one_minus_cosine = sine_squared / (1.0 + sqrt(1.0 - sine_squared));
    return AreaCone(d * (1.0 / to_centre), to_centre, sine_squared, one_minus_cosine);
}

/// Samples a point of the sphere at `at`, as seen from `p`.
///
/// Source: Pharr, Jakob and Humphreys, 4th edition, 6.2.4. Departure: `1 - cos theta` is sampled
/// instead of `cos theta`, which does not lose digits for spheres far away and needs no second branch.
/// Twin: specula-render/src/light/sphere.rs, Sphere::sample.
fn area_sample_sphere(at: u32, p: vec3f, u: vec2f) -> AreaSample {
    let centre = vector(at + 1u);
    let radius = number(at + 4u);
    let turn = area_sign(at + 5u);
    let reach = abs(centre) + vec3f(radius);
    let cone = area_cone(p, centre, radius);
    if cone.one_minus_cosine <= 0.0 {
        let n = warp_uniform_sphere(u);
        let per_area = AREA_PER_SPHERE / (radius * radius);
        return area_by_area(p, centre + n * radius, reach, n * turn, per_area);
    }
    let t = u.x * cone.one_minus_cosine;
    let sine_squared = t * (2.0 - t);
    let planar = sqrt(sine_squared) * angles_sin_cos_turns(u.y).yx;
    let frame = frame_from_normal(cone.axis);
    let wi = frame_to_world(frame, vec3f(planar, 1.0 - t));
    // Depth of the near intersection below the plane through the centre.
    let height = radius * sqrt(max(1.0 - sine_squared / cone.sine_squared, 0.0));
    let along = cone.to_centre * (1.0 - t) - height;
    let normal = unit_or(p + wi * along - centre, -wi);
    return AreaSample(
        centre + normal * radius,
        offset_coupled(reach),
        normal * turn,
        wi,
        2.0 * AREA_PER_SPHERE / cone.one_minus_cosine,
    );
}

/// The sample of a point that was sampled by area, as seen from `p`.
///
/// * `per_area`: density over the area.
///
/// Twin: specula-render/src/light/area.rs, by_area.
fn area_by_area(
    p: vec3f,
    position: vec3f,
    reach: vec3f,
    normal: vec3f,
    per_area: f32,
) -> AreaSample {
    let d = position - p;
    let distance_squared = dot(d, d);
    if !(distance_squared > 0.0) {
        return AreaSample(position, vec3f(0.0), normal, vec3f(0.0), 0.0);
    }
    let wi = d * (1.0 / sqrt(distance_squared));
    let pdf = parallelogram_ratio(per_area * distance_squared, abs(dot(normal, wi)));
    return AreaSample(position, offset_coupled(reach), normal, wi, pdf);
}

/// Barycentric weights of the second and third corner, uniform by area and continuous.
///
/// Source: Heitz 2019, A Low-Distortion Map Between Triangle and Square.
/// Twin: specula-render/src/light/triangle.rs, weights.
fn area_triangle(u: vec2f) -> vec2f {
    if u.y > u.x {
        return vec2f(0.5 * u.x, u.y - 0.5 * u.x);
    }
    return vec2f(u.x - 0.5 * u.y, 0.5 * u.y);
}

/// A point of the unit disk, area-preserving and continuous.
///
/// Source: Shirley and Chiu 1997, in the branch-lean form of Cline (Shirley 2011).
/// Twin: specula-render/src/disk.rs, concentric_disk.
fn area_disk(u: vec2f) -> vec2f {
    let at = 2.0 * u - vec2f(1.0);
    if at.x == 0.0 && at.y == 0.0 {
        return vec2f(0.0);
    }
    if at.x * at.x > at.y * at.y {
        return at.x * angles_sin_cos_of_half(0.125 * (at.y / at.x)).yx;
    }
    return at.y * angles_sin_cos_of_half(0.25 - 0.125 * (at.x / at.y)).yx;
}
