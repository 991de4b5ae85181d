// Graphs of texture nodes, and parameters that may be textures.
//
// Twin of specula-render/src/texture/graph.rs and mod.rs. WGSL has no recursion: nodes that wait for the values of
// their inputs are on a stack, whose size is what the scene's graphs need (TEXTURE_WAITING, at most 32). What a scene
// does not use is not compiled: the constants are those of specula-render/src/texture/flat.rs.

import tracer::texture_filter::{TextureLookup, texture_filter_at};
import tracer::texture_mapping::{texture_mapping_at, texture_mapping_axes};
import tracer::texture_noise::{texture_noise_fbm, texture_noise_turbulence, texture_noise_windy};
import tracer::texture_noise::{texture_noise_marble, texture_noise_in_dot};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::texture_raster::{texture_raster_at};
import tracer::world::{word, number, vector, affine_point};

/// A node that waits for the value of an input.
struct TextureWaiting {
    /// Offset of the node.
    at: u32,
    /// Which input is evaluated next: `TEXTURE_AMOUNT`, `TEXTURE_FIRST` or `TEXTURE_SECOND`.
    stage: u32,
    /// Share of the second input.
    amount: f32,
    /// Value of the first.
    first: vec3f,
}

/// The amount of a mix.
const TEXTURE_AMOUNT: u32 = 0u;
/// The first input.
const TEXTURE_FIRST: u32 = 1u;
/// The second, or the only one.
const TEXTURE_SECOND: u32 = 2u;

/// A colour parameter of 4 words: the index of a texture, or NONE and the value.
///
/// Twin: specula-render/src/texture/mod.rs, Textures::colour.
fn parameter_colour(at: u32, place: TextureCoordinates) -> vec3f {
    if TEXTURE_COUNT == 0u || word(at) == NONE {
        return vector(at + 1u);
    }
    return texture_colour(word(at), place);
}

/// A scalar parameter of 2 words: the index of a texture, or NONE and the value.
///
/// Twin: specula-render/src/texture/mod.rs, Textures::float.
fn parameter_float(at: u32, place: TextureCoordinates) -> f32 {
    if TEXTURE_COUNT == 0u || word(at) == NONE {
        return number(at + 1u);
    }
    return texture_float(word(at), place);
}

/// The colour of a texture; 0 where it is not finite.
///
/// Twin: specula-render/src/texture/mod.rs, Textures::colour.
fn texture_colour(id: u32, place: TextureCoordinates) -> vec3f {
    if TEXTURE_COUNT == 0u {
        return vec3f(0.0);
    }
    let value = texture_graph_value(word(TEXTURES + id), place);
    return vec3f(
        texture_graph_finite(value.x),
        texture_graph_finite(value.y),
        texture_graph_finite(value.z),
    );
}

/// The scalar value of a texture; 0 where it is not finite.
///
/// Twin: specula-render/src/texture/mod.rs, Textures::float.
fn texture_float(id: u32, place: TextureCoordinates) -> f32 {
    return texture_colour(id, place).x;
}

/// The value, or 0 where it is not finite. By the bits: compilers may assume that values are finite.
///
/// Twin: specula-render/src/texture/mod.rs, finite.
fn texture_graph_finite(v: f32) -> f32 {
    return select(v, 0.0, (bitcast<u32>(v) & 0x7f800000u) == 0x7f800000u);
}

/// The value of the node whose record begins at `root`.
///
/// Twin: specula-render/src/texture/graph.rs, Textures::node.
fn texture_graph_value(root: u32, place: TextureCoordinates) -> vec3f {
    if TEXTURE_HAS_INPUTS == 0u {
        return texture_graph_leaf(root, place);
    }
    var waiting: array<TextureWaiting, TEXTURE_WAITING>;
    var count = 0u;
    var at = root;
    var value: vec3f;
    loop {
        let kind = word(at);
        if kind >= TEXTURE_SCALE {
            let node = texture_graph_begun(at, place);
            waiting[count] = node;
            count += 1u;
            at = texture_graph_next(node);
            continue;
        }
        if kind >= TEXTURE_CHECKERBOARD {
            at = word(at + select(2u, 1u, texture_graph_shows_first(at, place)));
            continue;
        }
        value = texture_graph_leaf(at, place);
        // Nodes that waited for this value alone are done; one that needs another input continues.
        at = NONE;
        while count > 0u && at == NONE {
            var node = waiting[count - 1u];
            if node.stage == TEXTURE_SECOND {
                value = texture_graph_done(node, value);
                count -= 1u;
                continue;
            }
            if node.stage == TEXTURE_FIRST {
                node.first = value;
                node.stage = TEXTURE_SECOND;
            } else {
                node.amount = texture_graph_finite(value.x);
                node.stage = TEXTURE_FIRST;
            }
            at = texture_graph_next(node);
            if node.stage == TEXTURE_FIRST && (node.amount <= 0.0 || node.amount >= 1.0) {
                // One input has all the weight.
                count -= 1u;
            } else {
                waiting[count - 1u] = node;
            }
        }
        if at == NONE {
            break;
        }
    }
    return value;
}

/// A node that waits for its inputs, of which none has been evaluated.
fn texture_graph_begun(at: u32, place: TextureCoordinates) -> TextureWaiting {
    let kind = word(at);
    if kind == TEXTURE_MIX {
        if word(at + 3u) != NONE {
            return TextureWaiting(at, TEXTURE_AMOUNT, 0.5, vec3f(0.0));
        }
        return TextureWaiting(at, TEXTURE_FIRST, number(at + 4u), vec3f(0.0));
    }
    if kind == TEXTURE_THRESHOLD {
        return TextureWaiting(at, TEXTURE_SECOND, 0.5, vec3f(0.0));
    }
    var amount = 0.5;
    if kind == TEXTURE_DIRECTION_MIX {
        amount = abs(dot(place.normal, vector(at + 3u)));
    }
    return TextureWaiting(at, TEXTURE_FIRST, amount, vec3f(0.0));
}

/// Offset of the input that a waiting node needs next.
fn texture_graph_next(node: TextureWaiting) -> u32 {
    if node.stage == TEXTURE_AMOUNT {
        return word(node.at + 3u);
    }
    let is_only = word(node.at) == TEXTURE_THRESHOLD;
    let is_alone = word(node.at) == TEXTURE_MIX && node.amount >= 1.0;
    let is_second = node.stage == TEXTURE_SECOND && !is_only;
    return word(node.at + select(1u, 2u, is_second || is_alone));
}

/// The value of a node, from that of its last input.
fn texture_graph_done(node: TextureWaiting, last: vec3f) -> vec3f {
    let kind = word(node.at);
    if kind == TEXTURE_SCALE {
        return node.first * last;
    }
    if kind == TEXTURE_SUM {
        return node.first + last;
    }
    if kind == TEXTURE_THRESHOLD {
        return texture_graph_step(last, number(node.at + 2u));
    }
    return texture_graph_mixed(node.first, last, node.amount);
}

/// Whether a node that selects one of two inputs selects the first.
fn texture_graph_shows_first(at: u32, place: TextureCoordinates) -> bool {
    let kind = word(at);
    if kind == TEXTURE_CHECKERBOARD_SOLID {
        return texture_graph_is_even(affine_point(at + 3u, place.position));
    }
    let coordinates = texture_mapping_at(at + 3u, place);
    if TEXTURE_HAS_NOISE != 0u && kind == TEXTURE_DOTS {
        return texture_noise_in_dot(coordinates);
    }
    return texture_graph_is_even(vec3f(coordinates, 0.0));
}

/// The value of a node without inputs.
fn texture_graph_leaf(at: u32, place: TextureCoordinates) -> vec3f {
    switch word(at) {
        case TEXTURE_CONSTANT: {
            return vector(at + 1u);
        }
        case TEXTURE_IMAGE: {
            return texture_graph_picture(at + 1u, place);
        }
        case TEXTURE_BILINEAR: {
            let st = texture_mapping_at(at + 13u, place);
            return texture_graph_mixed(
                texture_graph_mixed(vector(at + 1u), vector(at + 7u), st.x),
                texture_graph_mixed(vector(at + 4u), vector(at + 10u), st.x),
                st.y,
            );
        }
        case TEXTURE_NOISE: {
            if TEXTURE_HAS_NOISE != 0u {
                return texture_graph_noise(at + 1u, place);
            }
            return vec3f(0.0);
        }
        default: {
            return place.colour;
        }
    }
}

/// The value of a node of noise.
///
/// * `at`: offset of the kind of noise, which its parameters follow.
fn texture_graph_noise(at: u32, place: TextureCoordinates) -> vec3f {
    let p = affine_point(at + 5u, place.position);
    let octaves = word(at + 1u);
    let roughness = number(at + 2u);
    switch word(at) {
        case TEXTURE_NOISE_FBM: {
            return vec3f(texture_noise_fbm(p, roughness, octaves));
        }
        case TEXTURE_NOISE_TURBULENCE: {
            return vec3f(texture_noise_turbulence(p, roughness, octaves));
        }
        case TEXTURE_NOISE_WINDY: {
            return vec3f(texture_noise_windy(p));
        }
        default: {
            return texture_noise_marble(p * number(at + 3u), number(at + 4u), roughness, octaves);
        }
    }
}

/// The value of an image texture: a channel, inverted, scaled.
///
/// * `at`: offset of the image within its node.
///
/// Twin: specula-render/src/texture/graph.rs, Textures::picture.
fn texture_graph_picture(at: u32, place: TextureCoordinates) -> vec3f {
    let wrap = vec2u(word(at + 4u), word(at + 5u));
    let coordinates = texture_mapping_at(at + 9u, place);
    let kind = word(at + 6u) % TEXTURE_FILTER_MEANS_ONLY;
    let means_only = word(at + 6u) >= TEXTURE_FILTER_MEANS_ONLY;
    var c: vec3f;
    if TEXTURES_ARE_FILTERED != 0u {
        let lookup = TextureLookup(word(at), word(at + 7u), wrap, kind, means_only, number(at + 8u));
        var axes = vec4f(0.0);
        if kind >= TEXTURE_FILTER_TRILINEAR {
            axes = texture_mapping_axes(at + 9u, place);
        }
        c = texture_filter_at(lookup, coordinates, axes);
    } else {
        c = texture_raster_at(word(at), coordinates, wrap, kind == TEXTURE_FILTER_NEAREST);
    }
    switch word(at + 1u) {
        case TEXTURE_CHANNEL_RGB: {}
        case TEXTURE_CHANNEL_MEAN: {
            c = vec3f((c.x + c.y + c.z) * (1.0 / 3.0));
        }
        case TEXTURE_CHANNEL_LUMINANCE: {
            c = vec3f(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
        }
        case TEXTURE_CHANNEL_RED: {
            c = c.xxx;
        }
        case TEXTURE_CHANNEL_GREEN: {
            c = c.yyy;
        }
        default: {
            c = c.zzz;
        }
    }
    if word(at + 2u) != 0u {
        c = max(1.0 - c, vec3f(0.0));
    }
    return c * number(at + 3u);
}

/// Whether the sum of the floors of the coordinates is even.
///
/// Twin: specula-render/src/texture/graph.rs, is_even; beyond 2^30 all values are even.
fn texture_graph_is_even(coordinates: vec3f) -> bool {
    let farthest = vec3f(1073741824.0);
    let cell = vec3i(clamp(floor(coordinates), -farthest, farthest));
    return ((cell.x ^ cell.y ^ cell.z) & 1) == 0;
}

/// Twin: specula-render/src/texture/graph.rs, mixed.
fn texture_graph_mixed(a: vec3f, b: vec3f, t: f32) -> vec3f {
    return a * (1.0 - t) + b * t;
}

/// Twin: specula-render/src/texture/graph.rs, step.
fn texture_graph_step(c: vec3f, cutoff: f32) -> vec3f {
    let value = vec3f(texture_graph_finite(c.x), texture_graph_finite(c.y), texture_graph_finite(c.z));
    return select(vec3f(0.0), vec3f(1.0), value >= vec3f(cutoff));
}
