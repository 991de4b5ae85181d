// Environment lights: a constant, or a picture of the sphere of directions, which is interpolated bilinearly and
// sampled in proportion to the interpolated values.
//
// Layout of a record, in words: factor (3), maps of light space to the world and back (12 each), whether there is a
// picture; then its mapping (0: equal-area, else latitude and longitude), its two axes (cells, whole cells that fit,
// where the first begins, where in the first cell the picture begins and in the last ends), and the offsets of:
// pixels at the corners of the cells (red, green, blue, sampling weight), densities by row of cells, CDFs of the
// cells in each row, CDF of the rows.
//
// Twin of specula-render/src/light/environment.rs, environment/{axis,picture}.rs.

import package::math::warp::{warp_uniform_sphere};
import tracer::angles::{angles_sin_cos_half_turns, angles_sin_cos_turns, angles_turns};
import tracer::octahedral::{octahedral_direction, octahedral_square};
import tracer::piecewise::{PiecewiseCell, piecewise_invert};
import tracer::world::{affine_vector, number, vector, word};

/// `1 / (4 pi)`.
const ENVIRONMENT_PER_SPHERE: f32 = 0.07957747;

/// A sampled direction.
struct EnvironmentSample {
    /// Unit, world.
    wi: vec3f,
    /// Radiance from there.
    radiance: vec3f,
    /// In 1/sr; 0: there is no sample.
    pdf: f32,
}

/// A direction of light space, and the sine of its polar angle; 1 where the mapping is equal-area.
struct EnvironmentDirection {
    /// Unit.
    w: vec3f,
    /// Of the polar angle, or 1 (equal-area mapping).
    sine: f32,
}

/// The values at the corners of a cell: upper row, lower row.
struct EnvironmentCorners {
    /// Upper left.
    a: vec4f,
    /// Upper right.
    b: vec4f,
    /// Lower left.
    c: vec4f,
    /// Lower right.
    d: vec4f,
}

/// Radiance from the direction `wi` (unit, world), and the density in 1/sr with which
/// `environment_sample` samples it.
/// Twin: specula-render/src/light/environment.rs, Environment::arriving.
fn environment_arriving(at: u32, wi: vec3f) -> vec4f {
    if word(at + ENVIRONMENT_IS_PICTURE) == 0u {
        return vec4f(vector(at), ENVIRONMENT_PER_SPHERE);
    }
    let w = normalize(affine_vector(at + ENVIRONMENT_TO_LIGHT, wi));
    var uv = octahedral_square(w);
    var sine = 1.0;
    if word(at + ENVIRONMENT_MAPPING) != 0u {
        let phi = angles_turns(w.y, w.x);
        // The polar angle by its sine too: its cosine alone loses half the digits at the poles.
        sine = sqrt(w.x * w.x + w.y * w.y);
        uv = vec2f(select(phi, phi + 1.0, phi < 0.0), 2.0 * angles_turns(sine, w.z));
    }
    let across = environment_cell(at + ENVIRONMENT_ACROSS, uv.x);
    let down = environment_cell(at + ENVIRONMENT_DOWN, uv.y);
    let corners = environment_corners(at, across.cell, down.cell);
    let colour = environment_mix(corners, vec2f(across.within, down.within));
    let pdf = environment_density(at, down.cell, colour.w, sine);
    return vec4f(colour.rgb * vector(at), pdf);
}

/// Samples a direction in proportion to its radiance.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/environment.rs, Environment::sample.
fn environment_sample(at: u32, u: vec2f) -> EnvironmentSample {
    if word(at + ENVIRONMENT_IS_PICTURE) == 0u {
        return EnvironmentSample(warp_uniform_sphere(u), vector(at), ENVIRONMENT_PER_SPHERE);
    }
    let width = word(at + ENVIRONMENT_ACROSS);
    let height = word(at + ENVIRONMENT_DOWN);
    let down = piecewise_invert(word(at + ENVIRONMENT_COLUMNS), height, u.y);
    let row = word(at + ENVIRONMENT_ROWS) + down.cell * (width + 1u);
    let across = piecewise_invert(row, width, u.x);
    let corners = environment_corners(at, across.cell, down.cell);
    let left_right = environment_range(at + ENVIRONMENT_ACROSS, across.cell);
    let top_bottom = environment_range(at + ENVIRONMENT_DOWN, down.cell);
    let strengths = vec4f(corners.a.w, corners.b.w, corners.c.w, corners.d.w);
    let part = vec2f(across.within, down.within);
    let within = environment_within(strengths, left_right, top_bottom, part);
    let uv = vec2f(
        environment_place(at + ENVIRONMENT_ACROSS, across.cell, within.x),
        environment_place(at + ENVIRONMENT_DOWN, down.cell, within.y),
    );
    let colour = environment_mix(corners, within);
    let direction = environment_direction(word(at + ENVIRONMENT_MAPPING), uv);
    let pdf = environment_density(at, down.cell, colour.w, direction.sine);
    let wi = normalize(affine_vector(at + ENVIRONMENT_TO_WORLD, direction.w));
    return EnvironmentSample(wi, colour.rgb * vector(at), pdf);
}

/// The direction of light space at a point of the square.
/// Twin: specula-render/src/light/environment/picture.rs, direction_and_sine.
fn environment_direction(mapping: u32, uv: vec2f) -> EnvironmentDirection {
    if mapping == ENVIRONMENT_EQUAL_AREA {
        return EnvironmentDirection(octahedral_direction(uv), 1.0);
    }
    let phi = angles_sin_cos_turns(uv.x);
    let theta = angles_sin_cos_half_turns(uv.y);
    return EnvironmentDirection(vec3f(theta.x * phi.yx, theta.y), theta.x);
}

/// Density per solid angle with which a point in a row of cells is sampled.
///
/// * `strength`: sampling weight there.
/// * `sine`: of the polar angle; 1 where equal areas are equal solid angles.
///
/// Twin: specula-render/src/light/environment/picture.rs, Picture::pdf.
fn environment_density(at: u32, row: u32, strength: f32, sine: f32) -> f32 {
    if sine > 0.0 {
        return strength * number(word(at + ENVIRONMENT_DENSITY) + row) / sine;
    }
    return 0.0;
}

/// The pixels at the corners of a cell.
/// Twin: specula-render/src/light/environment/picture.rs, Picture::corners.
fn environment_corners(at: u32, x: u32, y: u32) -> EnvironmentCorners {
    let row = word(at + ENVIRONMENT_ACROSS) + 1u;
    let upper = word(at + ENVIRONMENT_CORNERS) + 4u * (y * row + x);
    let lower = upper + 4u * row;
    return EnvironmentCorners(
        environment_pixel(upper),
        environment_pixel(upper + 4u),
        environment_pixel(lower),
        environment_pixel(lower + 4u),
    );
}

/// Red, green, blue and sampling weight of the pixel at `at`.
fn environment_pixel(at: u32) -> vec4f {
    return vec4f(vector(at), number(at + 3u));
}

/// Bilinear interpolation between the pixels at the corners of a cell.
/// Twin: specula-render/src/light/environment/picture.rs, mix.
fn environment_mix(corners: EnvironmentCorners, at: vec2f) -> vec4f {
    let upper = corners.a * (1.0 - at.x) + corners.b * at.x;
    let lower = corners.c * (1.0 - at.x) + corners.d * at.x;
    return upper * (1.0 - at.y) + lower * at.y;
}

/// Bilinear interpolation between the values at the corners of a square: upper row, lower row.
/// Twin: specula-render/src/light/environment/picture.rs, bilinear_of.
fn environment_bilinear(corners: vec4f, x: f32, y: f32) -> f32 {
    let upper = corners.x * (1.0 - x) + corners.y * x;
    let lower = corners.z * (1.0 - x) + corners.w * x;
    return upper * (1.0 - y) + lower * y;
}

/// Samples a point of a cell in proportion to the sampling weights, interpolated between its corners.
///
/// * `xs`, `ys`: the part of the cell that lies within the picture.
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/environment/picture.rs, Picture::within.
fn environment_within(strengths: vec4f, xs: vec2f, ys: vec2f, u: vec2f) -> vec2f {
    let a = environment_bilinear(strengths, xs.x, ys.x);
    let b = environment_bilinear(strengths, xs.y, ys.x);
    let c = environment_bilinear(strengths, xs.x, ys.y);
    let d = environment_bilinear(strengths, xs.y, ys.y);
    let y = environment_linear(u.y, a + b, c + d);
    let x = environment_linear(u.x, a + (c - a) * y, b + (d - b) * y);
    return vec2f(xs.x + (xs.y - xs.x) * x, ys.x + (ys.y - ys.x) * y);
}

/// Samples a point of `[0, 1]` with a density that goes linearly from `a` to `b`, up to a factor.
///
/// Source: Pharr, Jakob and Humphreys, 4th edition, eq. 2.24, in the form that does not cancel.
/// Twin: specula-render/src/light/environment/picture.rs, sample_linear.
fn environment_linear(u: f32, a: f32, b: f32) -> f32 {
    let root = sqrt(a * a * (1.0 - u) + b * b * u);
    if a + root > 0.0 {
        return min(u * (a + b) / (a + root), 1.0);
    }
    return u;
}

/// The part of a cell of the axis at `at` that lies within the picture.
/// Twin: specula-render/src/light/environment/axis.rs, Axis::range.
fn environment_range(at: u32, cell: u32) -> vec2f {
    let begin = select(0.0, number(at + 3u), cell == 0u);
    let end = select(1.0, number(at + 4u), cell + 1u == word(at));
    return vec2f(begin, end);
}

/// The coordinate, in `[0, 1]`, of a point in a cell of the axis at `at`.
/// Twin: specula-render/src/light/environment/axis.rs, Axis::place.
fn environment_place(at: u32, cell: u32, within: f32) -> f32 {
    let steps = number(at + 1u);
    let along = f32(cell) + within + number(at + 2u);
    return select(along, along - steps, along > steps) / steps;
}

/// The cell of a coordinate along the axis at `at`.
/// Twin: specula-render/src/light/environment/axis.rs, Axis::cell_of.
fn environment_cell(at: u32, coordinate: f32) -> PiecewiseCell {
    let steps = number(at + 1u);
    let from_first = coordinate * steps - number(at + 2u);
    let along = select(from_first, from_first + steps, from_first < 0.0);
    let cell = clamp(floor(along), 0.0, f32(word(at)) - 1.0);
    return PiecewiseCell(u32(cell), along - cell);
}
