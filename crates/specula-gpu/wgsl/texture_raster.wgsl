// Image textures: pixels in memory and their interpolation.
//
// Twin of specula-render/src/texture/raster.rs. Departure: coordinates are taken to be finite, since shaders compute
// no others.

import tracer::world::{word, number, vector};

/// Largest pixel index: conversions of larger values to integers differ between devices.
const TEXTURE_RASTER_FARTHEST: f32 = 1073741824.0;

/// The value at `(s, t)`, between pixels by bilinear interpolation; t = 0 is the lower edge of the picture.
///
/// * `at`: the raster: width, height, whether it is of bytes, then its pixels.
/// * `wrap`: along s and t.
///
/// Twin: specula-render/src/texture/raster.rs, Raster::at.
fn texture_raster_at(at: u32, coordinates: vec2f, wrap: vec2u, nearest: bool) -> vec3f {
    let size = vec2i(vec2u(word(at), word(at + 1u)));
    if size.x == 0 {
        return vec3f(0.0);
    }
    let place = texture_raster_position(size, coordinates, wrap);
    if nearest {
        return texture_raster_pixel(at, size, texture_raster_floor(place), wrap);
    }
    let shifted = place - 0.5;
    let first = texture_raster_floor(shifted);
    let part = shifted - floor(shifted);
    var sum = vec3f(0.0);
    for (var corner = 0; corner < 4; corner++) {
        let shift = vec2i(corner & 1, corner >> 1u);
        let weights = select(1.0 - part, part, shift == vec2i(1));
        sum += texture_raster_pixel(at, size, first + shift, wrap) * (weights.x * weights.y);
    }
    return sum;
}

/// Column and row of a point, with fractions; pixel centres are at halves.
///
/// Twin: specula-render/src/texture/raster.rs, Raster::position.
fn texture_raster_position(size: vec2i, coordinates: vec2f, wrap: vec2u) -> vec2f {
    let s = texture_raster_reduced(coordinates.x, wrap.x);
    let t = texture_raster_reduced(coordinates.y, wrap.y);
    return vec2f(s, 1.0 - t) * vec2f(size);
}

/// Column and row of the pixel that a point lies in.
///
/// Twin: specula-render/src/convert.rs, floor_i32; far outside it saturates earlier.
fn texture_raster_floor(place: vec2f) -> vec2i {
    let farthest = vec2f(TEXTURE_RASTER_FARTHEST);
    return vec2i(clamp(floor(place), -farthest, farthest));
}

/// A pixel; black outside where the picture ends there.
///
/// Twin: specula-render/src/texture/raster.rs, Raster::pixel.
fn texture_raster_pixel(at: u32, size: vec2i, pixel: vec2i, wrap: vec2u) -> vec3f {
    let x = texture_raster_wrapped(pixel.x, size.x, wrap.x);
    let y = texture_raster_wrapped(pixel.y, size.y, wrap.y);
    if x < 0 || y < 0 {
        return vec3f(0.0);
    }
    let index = u32(y) * u32(size.x) + u32(x);
    if word(at + 2u) == 0u {
        return vector(at + 3u + 3u * index);
    }
    let palette = at + 3u;
    let bytes = word(palette + 256u + index);
    return vec3f(
        number(palette + (bytes & 255u)),
        number(palette + ((bytes >> 8u) & 255u)),
        number(palette + (bytes >> 16u)),
    );
}

/// Coordinates that repeat are reduced first, so that pixel indices stay small and exact.
///
/// Twin: specula-render/src/texture/raster.rs, reduced.
fn texture_raster_reduced(s: f32, wrap: u32) -> f32 {
    if wrap == TEXTURE_RASTER_REPEAT {
        return s - floor(s);
    }
    if wrap == TEXTURE_RASTER_MIRROR {
        return s - 2.0 * floor(0.5 * s);
    }
    return s;
}

/// The index of a pixel, wrapped to `0..size`; -1 where the picture is black.
///
/// Twin: specula-render/src/texture/raster.rs, wrapped.
fn texture_raster_wrapped(x: i32, size: i32, wrap: u32) -> i32 {
    if x >= 0 && x < size {
        return x;
    }
    if wrap == TEXTURE_RASTER_CLAMP {
        return clamp(x, 0, size - 1);
    }
    if wrap == TEXTURE_RASTER_REPEAT {
        return texture_raster_remainder(x, size);
    }
    if wrap == TEXTURE_RASTER_MIRROR {
        let back = texture_raster_remainder(x, 2 * size);
        return min(back, 2 * size - 1 - back);
    }
    return -1;
}

/// The remainder in `0..size`.
fn texture_raster_remainder(x: i32, size: i32) -> i32 {
    let remainder = x % size;
    return select(remainder, remainder + size, remainder < 0);
}
