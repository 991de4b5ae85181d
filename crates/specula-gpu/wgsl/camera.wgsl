// Cameras and filters: from a sample of a pixel to a ray and the sample's weight.
//
// Twin of specula-render/src/camera.rs and film/filter.rs.

import tracer::world::{word, number, affine_point, affine_vector};
import tracer::area::{area_disk};
import tracer::environment::{environment_direction};

/// A camera's ray, and the weight of its sample.
struct CameraRay {
    origin: vec3f,
    direction: vec3f,
    weight: f32,
    // Of the whole pixel; 0 where no texture is filtered.
    cone: vec2f,
}

/// Samples a position about the pixel's centre along one axis of the filter; position and weight.
///
/// * `at`: the axis.
///
/// Twin: specula-render/src/film/filter.rs, Axis::sample.
fn camera_filter(at: u32, u: f32) -> vec2f {
    let radius = number(at);
    if word(at + 1u) != 0u {
        return vec2f((u * 2.0 - 1.0) * radius, 1.0);
    }
    let cdf = at + 3u;
    var cell = 0u;
    var size = FILTER_CELLS;
    while size > 1u {
        let part = size / 2u;
        if number(cdf + cell + part) <= u {
            cell += part;
        }
        size -= part;
    }
    let begin = number(cdf + cell);
    let width = number(cdf + cell + 1u) - begin;
    var within = 0.5;
    if width > 0.0 {
        within = clamp((u - begin) / width, 0.0, 1.0);
    }
    let x = ((f32(cell) + within) / f32(FILTER_CELLS) * 2.0 - 1.0) * radius;
    let magnitude = number(at + 2u);
    let negative = word(cdf + FILTER_CELLS + 1u + cell) != 0u;
    return vec2f(x, select(magnitude, -magnitude, negative));
}

/// A coordinate beyond the unit interval, mirrored at the nearer end.
fn camera_folded(x: f32) -> f32 {
    return select(2.0 - x, -x, x < 0.0);
}

/// A point next to the unit square, where filters reach over its edges, as the point of the square for the
/// same direction.
///
/// Twin: specula-render/src/camera.rs, within_sphere.
fn camera_within_sphere(mapping: u32, at: vec2f) -> vec2f {
    var u = at.x;
    var v = at.y;
    let is_square = mapping == ENVIRONMENT_EQUAL_AREA;
    if is_square && (u < 0.0 || u > 1.0) {
        // Each edge of the square is folded about its middle.
        u = camera_folded(u);
        v = 1.0 - v;
    }
    if v < 0.0 || v > 1.0 {
        u = select(u + 0.5, 1.0 - u, is_square);
        v = camera_folded(v);
    }
    if !is_square {
        u -= floor(u);
    }
    return clamp(vec2f(u, v), vec2f(0.0), vec2f(1.0));
}

/// The ray of a sample.
///
/// * `u`: uniform in `[0, 1)^4`: the second and third for the filter, the first and last for the lens.
///
/// Twin: specula-render/src/camera.rs, Camera::ray.
fn camera_ray(pixel: vec2u, u: vec4f) -> CameraRay {
    let across = camera_filter(FILTER_ACROSS, u.y);
    let down = camera_filter(FILTER_DOWN, u.z);
    let raster = vec2f(pixel) + 0.5 + vec2f(across.x, down.x);
    let x = number(CAMERA + 12u) + raster.x * number(CAMERA + 14u);
    let y = number(CAMERA + 13u) + raster.y * number(CAMERA + 15u);
    var begin = vec3f(0.0);
    var towards = vec3f(x, y, 1.0);
    if CAMERA_VIEW == CAMERA_ORTHOGRAPHIC {
        begin = vec3f(x, y, 0.0);
        towards = vec3f(0.0, 0.0, 1.0);
    } else if CAMERA_VIEW >= CAMERA_SPHERICAL {
        let mapping = CAMERA_VIEW - CAMERA_SPHERICAL;
        towards = environment_direction(mapping, camera_within_sphere(mapping, vec2f(x, y))).w;
    }
    let radius = number(CAMERA + 16u);
    if radius > 0.0 {
        let focus = begin + towards * number(CAMERA + 17u);
        begin += vec3f(area_disk(u.xw) * radius, 0.0);
        towards = focus - begin;
    }
    var cone = vec2f(0.0);
    if TEXTURES_ARE_FILTERED != 0u {
        cone = camera_cone(vec2f(x, y));
    }
    return CameraRay(
        affine_point(CAMERA, begin),
        normalize(affine_vector(CAMERA, towards)),
        across.y * down.y,
        cone,
    );
}

/// The cone of a whole pixel around the ray through a point of the camera's window: a circle of the pixel's radius, whose
/// square is the area, or the solid angle, by which a step right and a step down differ.
///
/// * `at`: in the camera's space, at the distance 1; for views of the sphere, in the square of their mapping.
///
/// Twin: specula-render/src/camera/cone.rs, Camera::cone.
fn camera_cone(at: vec2f) -> vec2f {
    let a = affine_vector(CAMERA, vec3f(1.0, 0.0, 0.0));
    let b = affine_vector(CAMERA, vec3f(0.0, 1.0, 0.0));
    let pixel = abs(number(CAMERA + 14u) * number(CAMERA + 15u));
    let area = cross(a, b);
    if CAMERA_VIEW == CAMERA_ORTHOGRAPHIC {
        return vec2f(sqrt(length(area) * pixel), 0.0);
    }
    if CAMERA_VIEW == CAMERA_PERSPECTIVE {
        let c = affine_vector(CAMERA, vec3f(0.0, 0.0, 1.0));
        let size = length(affine_vector(CAMERA, vec3f(at, 1.0)));
        return vec2f(0.0, sqrt(abs(dot(area, c)) * pixel / (size * size * size)));
    }
    let pi = 3.1415927;
    let mapping = CAMERA_VIEW - CAMERA_SPHERICAL;
    if mapping == ENVIRONMENT_EQUAL_AREA {
        return vec2f(0.0, sqrt(4.0 * pi * pixel));
    }
    let v = camera_within_sphere(mapping, at).y;
    return vec2f(0.0, sqrt(2.0 * pi * pi * abs(sin(pi * v)) * pixel));
}
