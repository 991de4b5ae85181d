// Gradient noise, and pbrt's textures made of it.
//
// Twin of specula-render/src/texture/noise.rs. The tables (NOISE_PERMUTATION, NOISE_MARBLE) are words
// of the scene: arrays of constants that are indexed at run time are copied for every call by some
// compilers.

import tracer::angles::{angles_sin_cos_of_half};
import tracer::world::{word, vector};

/// Beyond 2^22 the fraction has no digits left.
const TEXTURE_NOISE_FARTHEST: f32 = 4194304.0;

/// Gradient noise, in about `[-1, 1]`; 0 at all points of the integer lattice.
///
/// Source: Perlin 2002, Improving Noise.
///
/// Twin: specula-render/src/texture/noise.rs, noise.
fn texture_noise(p: vec3f) -> f32 {
    let size = abs(p);
    if !(max(size.x, max(size.y, size.z)) < TEXTURE_NOISE_FARTHEST) {
        return 0.0;
    }
    let low = floor(p);
    let cell = vec3u(vec3i(low) & vec3i(255));
    let d = p - low;
    let w = d * d * d * (d * (d * 6.0 - 15.0) + 10.0);
    var planes = vec2f(0.0);
    for (var k = 0u; k < 2u; k++) {
        var rows = vec2f(0.0);
        for (var j = 0u; j < 2u; j++) {
            let left = texture_noise_corner(cell, d, vec3u(0u, j, k));
            let right = texture_noise_corner(cell, d, vec3u(1u, j, k));
            rows[j] = texture_noise_between(w.x, left, right);
        }
        planes[k] = texture_noise_between(w.y, rows.x, rows.y);
    }
    return texture_noise_between(w.z, planes.x, planes.y);
}

/// The linear function of a corner's gradient.
fn texture_noise_corner(cell: vec3u, d: vec3f, corner: vec3u) -> f32 {
    return texture_noise_gradient(texture_noise_hash(cell + corner), d - vec3f(corner));
}

/// Twin: specula-render/src/texture/noise.rs, hash.
fn texture_noise_hash(cell: vec3u) -> u32 {
    let x = word(NOISE_PERMUTATION + (cell.x & 255u));
    let y = word(NOISE_PERMUTATION + ((x + cell.y) & 255u));
    return word(NOISE_PERMUTATION + ((y + cell.z) & 255u));
}

/// The dot product with one of the 12 edges of the cube (four of them twice).
///
/// Twin: specula-render/src/texture/noise.rs, gradient.
fn texture_noise_gradient(hash: u32, p: vec3f) -> f32 {
    let h = hash & 15u;
    let u = select(p.y, p.x, h < 8u || h == 12u || h == 13u);
    let v = select(p.z, p.y, h < 4u || h == 12u || h == 13u);
    return select(-u, u, (h & 1u) == 0u) + select(-v, v, (h & 2u) == 0u);
}

/// Twin: specula-render/src/texture/noise.rs, lerp.
fn texture_noise_between(t: f32, a: f32, b: f32) -> f32 {
    return (1.0 - t) * a + t * b;
}

/// Fractional Brownian motion: `sum_i roughness^i noise(1.99^i p)`.
///
/// Twin: specula-render/src/texture/noise.rs, fbm.
fn texture_noise_fbm(p: vec3f, roughness: f32, octaves: u32) -> f32 {
    return texture_noise_sum(p, roughness, octaves, false).x;
}

/// The same of absolute values; octaves that are left out are replaced by their mean, as in pbrt.
///
/// Twin: specula-render/src/texture/noise.rs, turbulence.
fn texture_noise_turbulence(p: vec3f, roughness: f32, octaves: u32) -> f32 {
    let sum = texture_noise_sum(p, roughness, octaves, true);
    return sum.x + 0.2 * sum.y;
}

/// The sum of octaves, and the amplitude of the next.
///
/// * `absolute`: whether absolute values are summed.
///
/// Twin: specula-render/src/texture/noise.rs, sum.
fn texture_noise_sum(p: vec3f, roughness: f32, octaves: u32, absolute: bool) -> vec2f {
    var sum = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < octaves; i++) {
        let value = texture_noise(p * frequency);
        sum += amplitude * select(value, abs(value), absolute);
        frequency *= TEXTURE_NOISE_LACUNARITY;
        amplitude *= roughness;
    }
    return vec2f(sum, amplitude);
}

/// Waves whose strength is another noise: pbrt's `windy`.
///
/// Twin: specula-render/src/texture/noise.rs, windy.
fn texture_noise_windy(p: vec3f) -> f32 {
    return abs(texture_noise_fbm(p * 0.1, 0.5, 3u)) * texture_noise_fbm(p, 0.5, 6u);
}

/// A ramp of greys along y, bent by fractional Brownian motion: pbrt's `marble`.
///
/// Twin: specula-render/src/texture/noise.rs, marble.
fn texture_noise_marble(p: vec3f, variation: f32, roughness: f32, octaves: u32) -> vec3f {
    let bent = p.y + variation * texture_noise_fbm(p, roughness, octaves);
    let along = (0.5 + 0.5 * texture_noise_sine(bent)) * 6.0;
    // A Bezier segment over each four neighbours in a row.
    let first = clamp(floor(along), 0.0, 5.0);
    let t = along - first;
    let s = 1.0 - t;
    let weights = vec4f(s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t);
    var colour = vec3f(0.0);
    for (var i = 0u; i < 4u; i++) {
        colour += vector(NOISE_MARBLE + 3u * (u32(first) + i)) * weights[i];
    }
    return colour * 1.5;
}

/// The sine of an angle in radians. Whole turns are subtracted in two parts, of which the first has few digits, so
/// that its multiples are exact.
fn texture_noise_sine(angle_rad: f32) -> f32 {
    let turns = round(angle_rad * 0.15915494);
    let rest = (angle_rad - turns * 6.28125) - turns * 0.0019353072;
    return angles_sin_cos_of_half(clamp(rest * 0.15915494, -0.5, 0.5)).x;
}

/// Whether a point lies in one of pbrt's `dots`: at most one per cell of unit size, somewhere in it.
///
/// Twin: specula-render/src/texture/noise.rs, in_dot.
fn texture_noise_in_dot(at: vec2f) -> bool {
    let radius = 0.35;
    let cell = floor(at + 0.5);
    // One call in a loop, since the code of noise is long.
    var values = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let shift = select(select(vec2f(0.5), vec2f(1.5, 2.8), i == 1u), vec2f(4.5, 9.8), i == 2u);
        values[i] = texture_noise(vec3f(cell + shift, 0.5));
    }
    let from_middle = at - (cell + (0.5 - radius) * values.yz);
    return values.x > 0.0 && dot(from_middle, from_middle) < radius * radius;
}
