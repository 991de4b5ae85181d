// A material at a point: its parameters there, with textures evaluated.
//
// Each kind of material has a module of its own (`material_diffuse`, `material_conductor`, ...) with
// four functions: bind, eval, sample and albedo. The switch over the kinds that a scene has is written for
// each scene (`specula-gpu/src/program.rs`).
//
// Twin of specula-render/src/material/{mod,bind,flat}.rs.

import tracer::world::{word, number};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::texture_graph::{parameter_colour, texture_colour};

/// A material's parameters at a point. Each kind of material says what `first`, `second` and `third` are.
struct Bound {
    kind: u32,
    // Index of the material; of a mix, of the chosen one.
    material: u32,
    // Rotation of the tangent, in radians.
    rotation: f32,
    // Which of the kind's lobes, where it has several.
    variant: u32,
    // Whether the lobe consists of Dirac deltas alone.
    specular: bool,
    // Whether the lobe is black where `wi.z <= 0`.
    opaque: bool,
    // Whether tangents do not matter.
    isotropic: bool,
    // Energy model: 0 for single scattering; see specula-render/src/material/flat.rs.
    energy: u32,
    masking: u32,
    distribution: u32,
    alpha: vec2f,
    eta: f32,
    first: vec3f,
    second: vec3f,
    third: vec3f,
    // All parameters, of kinds that have many.
    stored: array<vec3f, BOUND_STORED>,
}

/// Least alpha of a rough surface.
const BOUND_SMOOTH_BELOW: f32 = 1.0e-3;
/// Most parameters that may have a texture.
const MOST_PARAMETERS: u32 = 12u;
/// Kind of a black surface.
const BOUND_BLACK: u32 = 0xffffffffu;

/// A black surface.
fn bound_black() -> Bound {
    var b: Bound;
    b.kind = BOUND_BLACK;
    b.opaque = true;
    b.isotropic = true;
    b.eta = 1.0;
    return b;
}

/// The parameters that the head of a record holds.
fn bound_head(record: u32) -> Bound {
    var b: Bound;
    b.kind = word(record + MATERIAL_KIND);
    b.rotation = number(record + MATERIAL_ROTATION);
    b.opaque = word(record + MATERIAL_OPAQUE) != 0u;
    b.isotropic = word(record + MATERIAL_ISOTROPIC) != 0u;
    b.energy = word(record + MATERIAL_ENERGY);
    b.eta = 1.0;
    return b;
}

/// A material's parameters at a point.
struct Parameters {
    // Those that may have a texture, evaluated; the first `count` of these.
    values: array<vec3f, MOST_PARAMETERS>,
    count: u32,
    // Offset of the others.
    plain: u32,
}

/// Evaluates the parameters of a record. One call in a loop, since the code of textures is long.
fn bound_parameters(record: u32, place: TextureCoordinates) -> Parameters {
    var p: Parameters;
    let count = word(record + MATERIAL_PARAMETERS);
    var at = record + MATERIAL_PARAMETERS + 1u;
    for (var i = 0u; i < min(count, MOST_PARAMETERS); i += 1u) {
        p.values[i] = parameter_colour(at, place);
        at += 4u;
    }
    p.count = count;
    p.plain = at;
    return p;
}

/// Rotation of the tangent by a texture of directions, in radians.
///
/// Twin: specula-render/src/material/mod.rs, azimuth.
fn bound_direction(record: u32, place: TextureCoordinates) -> f32 {
    let texture = word(record + MATERIAL_DIRECTION);
    if texture == NONE {
        return 0.0;
    }
    let at = 2.0 * texture_colour(texture, place).xy - vec2f(1.0);
    // The middle of 8 bits is not exactly 1/2.
    if max(abs(at.x), abs(at.y)) < 0.01 {
        return 0.0;
    }
    return atan2(at.y, at.x);
}

/// Stores all parameters.
fn bound_store(b: Bound, p: Parameters) -> Bound {
    var all = b;
    for (var i = 0u; i < BOUND_STORED; i += 1u) {
        all.stored[i] = p.values[i];
    }
    return all;
}

/// A scalar parameter, clamped to `[0, 1]`.
fn bound_unit(x: vec3f) -> f32 {
    return clamp(x.x, 0.0, 1.0);
}

/// A colour, clamped to `[0, 1]`.
fn bound_albedo(colour: vec3f) -> vec3f {
    return clamp(colour, vec3f(0.0), vec3f(1.0));
}

/// Alphas of a surface that a path meets behind a rough one: at least 0.1.
///
/// Twin: specula-render/src/material/metal.rs, regularized_alpha.
fn bound_regularized(alpha: vec2f) -> vec2f {
    return select(alpha, clamp(2.0 * alpha, vec2f(0.1), vec2f(0.3)), alpha < vec2f(0.3));
}

/// A roughness in `[0, 1]`, whose square is alpha.
///
/// Twin: specula-render/src/material/bind.rs, PointParameters::roughness.
fn bound_unit_roughness(x: vec3f, is_regularized: bool) -> f32 {
    let r = bound_unit(x);
    if is_regularized && r * r < 0.3 {
        return sqrt(bound_regularized(vec2f(r * r)).x);
    }
    return r;
}

/// Alphas from two parameters; 0 where the surface is smooth.
///
/// * `mapping`: what the parameters are, ROUGHNESS_*.
///
/// Twin: specula-render/src/material/metal.rs, alpha.
fn bound_alphas(across: f32, along: f32, mapping: u32) -> vec2f {
    var r = max(vec2f(across, along), vec2f(0.0));
    if (mapping & ROUGHNESS_MAPPING) == ROUGHNESS_SQRT {
        r = sqrt(r);
    } else if (mapping & ROUGHNESS_MAPPING) == ROUGHNESS_SQUARE {
        r = r * r;
    }
    if (mapping & ROUGHNESS_REGULARIZED) != 0u {
        r = bound_regularized(r);
    }
    let is_rough = r.x >= BOUND_SMOOTH_BELOW || r.y >= BOUND_SMOOTH_BELOW;
    return select(vec2f(0.0), clamp(r, vec2f(BOUND_SMOOTH_BELOW), vec2f(10.0)), is_rough);
}

/// A code that is stored with a material, by the constant of the only one that the scene has; NONE: it has several. What
/// shaders know beforehand leaves nothing to compile of the others.
fn bound_only(only: u32, stored: u32) -> u32 {
    if only != NONE {
        return only;
    }
    return stored;
}

/// The distribution of normals.
fn bound_distribution(b: Bound) -> u32 {
    return bound_only(ONLY_DISTRIBUTION, b.distribution);
}

/// The masking.
fn bound_masking(b: Bound) -> u32 {
    return bound_only(ONLY_MASKING, b.masking);
}

/// Alphas, distribution and masking from the first two parameters and the first three words.
fn bound_roughness(b: Bound, p: Parameters) -> Bound {
    var rough = b;
    rough.alpha = bound_alphas(p.values[0].x, p.values[1].x, word(p.plain));
    rough.distribution = word(p.plain + 1u);
    rough.masking = word(p.plain + 2u);
    return rough;
}
