// Shapes whose emission varies over them, by textures or by opacity.
//
// Layout of a record, in words: instance, primitive, whether the area's second and third corner are the primitive's
// third and second, cells along the sides of the table by which points are sampled (0: uniformly), the table's rows
// and columns (piecewise.wgsl), the shape (area.wgsl). Radiance and opacity are those of the surface's shape.
//
// Twin of specula-render/src/light/textured.rs.

import tracer::area::{AreaSample, area_sample, area_pdf, area_triangle};
import tracer::piecewise::{piecewise_density, piecewise_sample};
import tracer::ray::{Hit, Ray};
import tracer::surface::{Surface, surface_at, surface_place};
import tracer::texture_graph::{parameter_colour, parameter_float};
import tracer::world::{word};


/// A sampled point of a light, and its radiance.
struct TexturedSample {
    /// The point; there is no sample where its density is 0.
    area: AreaSample,
    /// Emitted there.
    radiance: vec3f,
}

/// Samples a point of the light at `at`, as seen from `p`.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/textured.rs, Textured::sample.
fn textured_sample(at: u32, p: vec3f, u: vec2f) -> TexturedSample {
    let cells = word(at + 3u);
    var uv = u;
    var density = 1.0;
    if cells > 0u {
        uv = piecewise_sample(word(at + 4u), word(at + 5u), cells, u);
        density = piecewise_density(word(at + 4u), word(at + 5u), cells, uv);
    }
    var sampled = TexturedSample(area_sample(at + TEXTURED_AREA, p, uv), vec3f(0.0));
    sampled.area.pdf *= density;
    let weights = textured_swapped(at, area_triangle(uv));
    // Of quadrics `surface_at` projects the ray's end; of triangles it takes the weights.
    let ray = Ray(sampled.area.position, vec3f(0.0), 0.0);
    let hit = Hit(0.0, weights.x, weights.y, word(at + 1u), word(at));
    sampled.radiance = textured_radiance(surface_at(ray, hit));
    if all(sampled.radiance == vec3f(0.0)) {
        sampled.area.pdf = 0.0;
    }
    return sampled;
}

/// Density in 1/sr with which `textured_sample` samples the direction from `p` to the point `position` of the
/// light at `at`.
///
/// * `normal`: of the surface there.
/// * `weights`: barycentric, of the primitive's second and third corner.
///
/// Twin: specula-render/src/light/textured.rs, Textured::pdf.
fn textured_pdf(at: u32, p: vec3f, position: vec3f, normal: vec3f, weights: vec2f) -> f32 {
    let pdf = area_pdf(at + TEXTURED_AREA, p, position, normal);
    let cells = word(at + 3u);
    if cells == 0u {
        return pdf;
    }
    let uv = textured_square(textured_swapped(at, weights));
    return pdf * piecewise_density(word(at + 4u), word(at + 5u), cells, uv);
}

/// Emitted radiance at a point of a shape, times its opacity.
///
/// Twin: specula-render/src/light/textured.rs, Varying::radiance.
fn textured_radiance(s: Surface) -> vec3f {
    let shape = SHAPES + s.shape * SHAPE_SIZE;
    let place = surface_place(s);
    let radiance = max(parameter_colour(shape + 3u, place), vec3f(0.0));
    return radiance * clamp(parameter_float(shape + 7u, place), 0.0, 1.0);
}

/// Barycentric weights of the area from those of the primitive, and back.
fn textured_swapped(at: u32, weights: vec2f) -> vec2f {
    return select(weights, weights.yx, word(at + 2u) != 0u);
}

/// The inverse of `area_triangle`.
/// Twin: specula-render/src/light/area.rs, Area::square_of.
fn textured_square(weights: vec2f) -> vec2f {
    let sum = weights.x + weights.y;
    if weights.y > weights.x {
        return vec2f(2.0 * weights.x, sum);
    }
    return vec2f(sum, 2.0 * weights.y);
}
