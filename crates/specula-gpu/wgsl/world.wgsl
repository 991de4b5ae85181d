// The scene on the device: nodes and packets of its bounding volume hierarchies, and all else as words of 32 bits.
//
// Offsets of the parts are constants made for each scene by `specula-render/src/flat` (SHAPES,
// MATERIALS, LIGHTS, ...), written in front of the composed shader; so are the codes of
// specula-render/src/codes.rs (NONE, LIGHTS_AREA, TEXTURE_MIX, ...).
//
// Twin of specula-render/src/flat/words.rs; also of small functions that many parts use.

/// 8-wide nodes of 6 vectors, as src/tree.rs says.
@group(0) @binding(1) var<storage, read> world_nodes: array<vec4u>;
/// Triangles of 3 vectors, likewise.
@group(0) @binding(2) var<storage, read> world_triangles: array<vec4u>;
/// Everything else.
@group(0) @binding(3) var<storage, read> world_words: array<u32>;

/// Larger than any distance within a scene, which is bounded by 1e15 along each axis.
const FARTHEST: f32 = 3.0e38;

/// The word at an offset.
fn word(at: u32) -> u32 {
    return world_words[at];
}

/// The float at an offset.
fn number(at: u32) -> f32 {
    return bitcast<f32>(world_words[at]);
}

/// The vector of three floats at an offset.
fn vector(at: u32) -> vec3f {
    return vec3f(number(at), number(at + 1u), number(at + 2u));
}

/// An affine map of 12 words, three columns and a translation, of a vector.
///
/// Twin: specula-render/src/convert.rs, Affine::vector.
fn affine_vector(at: u32, v: vec3f) -> vec3f {
    return vector(at) * v.x + vector(at + 3u) * v.y + vector(at + 6u) * v.z;
}

/// An affine map of 12 words of a point.
///
/// Twin: specula-render/src/convert.rs, Affine::point.
fn affine_point(at: u32, p: vec3f) -> vec3f {
    return affine_vector(at, p) + vector(at + 9u);
}

/// Sums of the absolute values of the terms that `affine_point` sums.
///
/// Twin: specula-render/src/convert.rs, Affine::magnitude.
fn affine_magnitude(at: u32, p: vec3f) -> vec3f {
    return abs(vector(at)) * abs(p.x) + abs(vector(at + 3u)) * abs(p.y)
        + abs(vector(at + 6u)) * abs(p.z) + abs(vector(at + 9u));
}

/// The error of a point from the magnitudes behind each component: the largest stands for all.
///
/// Twin: specula-render/src/offset.rs, coupled.
fn offset_coupled(magnitude: vec3f) -> vec3f {
    return vec3f(max(magnitude.x, max(magnitude.y, magnitude.z)) * RELATIVE_ERROR);
}

/// `p + d`, moved an ulp or two further, since rounding may have left it at `p`.
///
/// Twin: specula-render/src/offset.rs, away.
fn offset_away(p: vec3f, d: vec3f) -> vec3f {
    let moved = p + d;
    let further = abs(moved) * 1.1920929e-7;
    return moved + select(further, -further, d < vec3f(0.0));
}

/// The origin of a ray that leaves `p` towards `direction`: outside of the box of the point's error.
///
/// * `normal`: unit geometric normal, either side.
///
/// Twin: specula-render/src/offset.rs, SurfacePoint::ray_origin.
fn offset_leave(p: vec3f, error: vec3f, normal: vec3f, direction: vec3f) -> vec3f {
    let distance = dot(abs(normal), error);
    let side = select(distance, -distance, dot(normal, direction) < 0.0);
    return offset_away(p, normal * side);
}

/// The unit vector along `v`; `fallback` for the zero vector.
///
/// Twin: specula-render/src/geometry.rs, unit_or.
fn unit_or(v: vec3f, fallback: vec3f) -> vec3f {
    let a = abs(v);
    let largest = max(a.x, max(a.y, a.z));
    if !(largest > 0.0 && largest < FARTHEST) {
        return fallback;
    }
    return normalize(v / largest);
}
