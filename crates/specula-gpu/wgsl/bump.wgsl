// Bump maps by heights, and normal maps: they bend shading normals.
//
// Twin of specula-render/src/bump.rs. A bump map is 4 words, as `flatten` there writes them: its kind, its rules,
// then the parameter of its heights, or a texture and a factor.

import tracer::partials::{Partials, partials_of};
import tracer::slopes::{SlopesSpread, slopes_of_normal, slopes_spread};
import tracer::surface::{Surface, surface_place};
import tracer::texture_graph::{parameter_float, texture_colour};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::world::{word, number, unit_or};
import package::math::frame::{FrameBasis, frame_from_normal_tangent};


/// A shading normal with the tangent along u.
///
/// Twin: specula-render/src/bump.rs, BumpedFrame.
struct BumpedFrame {
    normal: vec3f,
    tangent: vec3f,
    // How the slopes of what a filter averaged vary about the normal.
    spread: SlopesSpread,
}

/// A bent normal about which nothing varies.
fn bump_frame(normal: vec3f, tangent: vec3f) -> BumpedFrame {
    return BumpedFrame(normal, tangent, SlopesSpread(vec3f(0.0), vec3f(0.0), vec3f(0.0)));
}

/// How light fades towards the horizon of a bent normal, by Mitsuba's rules.
///
/// ```text
/// 2 / (1 + sqrt(1 + a tan^2(n0, wi))),   a = min(tan^2(n0, n) / 8, 1)
/// ```
///
/// with `n0` the normal before it was bent to `n`. It does not fade where `a` is 0.
///
/// Source: Conty Estevez, Lecocq and Stein 2019, "A Microfacet-Based Shadowing Function to Solve
/// the Bump Terminator Problem".
///
/// Twin: specula-render/src/bump.rs, Softness.
struct Softness {
    /// The normal before it was bent, unit.
    normal: vec3f,
    a: f32,
}

/// A bent normal, and how light fades on it.
struct Softened {
    normal: vec3f,
    softness: Softness,
}

/// Offset of a material's bump.
fn bump_of_material(material: u32) -> u32 {
    return BUMPS + BUMP_SIZE * material;
}

/// Whether a clear coat has a bump map of its own, or none while the rest of its material has one.
fn bump_coat_differs(material: u32) -> bool {
    return BUMP_COUNT != 0u && word(bump_of_material(material) + 4u) != 0u;
}

/// Offset of the bump map of such a coat.
fn bump_of_coat(material: u32) -> u32 {
    return bump_of_material(material) + 5u;
}

/// Whether there is a bump map at an offset.
fn bump_is_there(at: u32) -> bool {
    return BUMP_COUNT != 0u && word(at) != BUMP_NONE;
}

/// The bent normal, turned back where it faces away from `wo` though the unbent one does not
/// (or the other way round), and how light fades on it. By plain rules neither is done.
///
/// * `at`: the bump map.
/// * `unbent`, `bent`: unit, on the same side of the surface.
///
/// Twin: specula-render/src/bump.rs, Softness::new, with the choice around its call in
/// integrator.rs.
fn bump_softened(at: u32, unbent: vec3f, bent: vec3f, wo: vec3f) -> Softened {
    if !bump_is_there(at) || word(at + 1u) == BUMP_PLAIN {
        return Softened(bent, Softness(unbent, 0.0));
    }
    let along = dot(unbent, bent);
    var normal = bent;
    if dot(unbent, wo) * dot(bent, wo) <= 0.0 {
        normal = unbent * (2.0 * along) - bent;
    }
    var softness = Softness(unbent, 0.0);
    if word(at + 1u) == BUMP_FADES {
        softness.a = min(0.125 * bump_squared_tangent(along), 1.0);
    }
    return Softened(normal, softness);
}

/// Factor on what the surface does with light from `wi`, in `(0, 1]`.
///
/// Twin: specula-render/src/bump.rs, Softness::factor.
fn bump_softness(softness: Softness, wi: vec3f) -> f32 {
    let grown = softness.a * bump_squared_tangent(dot(softness.normal, wi));
    return 2.0 / (1.0 + sqrt(1.0 + min(grown, 1.0e12)));
}

/// `tan^2` of the angle with this cosine.
///
/// Twin: specula-render/src/bump.rs, squared_tangent.
fn bump_squared_tangent(cosine: f32) -> f32 {
    let squared = max(cosine * cosine, 1.0e-12);
    return max(1.0 - squared, 0.0) / squared;
}

/// The shading normal and the tangent along u of a surface under its bump map; those of the surface where
/// there is none.
///
/// The normal points to the outside of the surface it bends, not necessarily to the side of the
/// geometric one.
///
/// Twin: specula-render/src/bump.rs, bend.
fn bump_bend(at: u32, s: Surface) -> BumpedFrame {
    if !bump_is_there(at) {
        return bump_frame(s.ns, s.tangent);
    }
    var partials = partials_of(s);
    let n = s.ns;
    // The triangle's plane is not that of its shading normal.
    partials.along_u -= n * dot(n, partials.along_u);
    partials.along_v -= n * dot(n, partials.along_v);
    let area = cross(partials.along_u, partials.along_v);
    if !(dot(area, area) > 0.0) {
        let frame = frame_from_normal_tangent(n, s.tangent);
        partials.along_u = frame.s;
        partials.along_v = frame.t;
    }
    let place = surface_place(s);
    if word(at) == BUMP_HEIGHT {
        return bump_displaced(at + 2u, n, place, partials);
    }
    let map = bump_normal_map(at, place);
    let c = map.normal;
    let scale = number(at + 3u);
    let along_u = unit_or(partials.along_u, n);
    let across = cross(n, along_u);
    let backwards = word(at + 1u) == BUMP_PLAIN && dot(across, partials.along_v) < 0.0;
    let along_v = select(across, -across, backwards);
    let bent = along_u * (c.x * scale) + along_v * (c.y * scale) + n * c.z;
    var frame = bump_frame(unit_or(bent, n), partials.along_u);
    if NORMAL_MAPS_ARE_FILTERED != 0u && map.is_mean {
        frame.spread = slopes_spread(map.normal.xy, map.squares, scale, along_u, along_v);
    }
    return frame;
}

/// The normal of a map, not unit; where it is a mean of slopes, with their second moments (xx, xy, yy).
///
/// Twin: specula-render/src/texture/normal_map.rs, Textures::normal.
struct BumpNormalMap {
    normal: vec3f,
    is_mean: bool,
    squares: vec3f,
}

/// The normal of the map at an offset.
///
/// Twin: specula-render/src/texture/normal_map.rs, Textures::normal.
fn bump_normal_map(at: u32, place: TextureCoordinates) -> BumpNormalMap {
    // The map, its slopes with the share that is averaged, their squares. One call in a loop, since the code of
    // textures is long.
    var values = array<vec3f, 3>();
    let count = select(1u, 3u, NORMAL_MAPS_ARE_FILTERED != 0u && word(at) == BUMP_FILTERED_NORMAL);
    for (var i = 0u; i < count; i++) {
        values[i] = texture_colour(word(at + 2u) + i, place);
    }
    let normal = 2.0 * values[0] - 1.0;
    let share = min(values[1].z, 1.0);
    if NORMAL_MAPS_ARE_FILTERED == 0u || share <= 0.0 {
        return BumpNormalMap(normal, false, vec3f(0.0));
    }
    let p = slopes_of_normal(normal);
    let rest = 1.0 - share;
    let mean = values[1].xy + rest * p;
    return BumpNormalMap(vec3f(mean, 1.0), true, values[2] + rest * vec3f(p.x * p, p.y * p.y));
}

/// Steps of finite differences along u and v: half of what the footprint covers, but no less than `BUMP_STEP`, below which
/// heights in single precision have no slope.
///
/// Twin: specula-render/src/bump.rs, step.
fn bump_steps(changes: vec4f) -> vec2f {
    return max(vec2f(BUMP_STEP), 0.5 * (abs(changes.xy) + abs(changes.zw)));
}

/// Normal and tangent of the surface moved along its normal by a height:
///
/// ```text
/// dp'/du = dp/du + dh/du n + h dn/du,   n' ~ +-(dp'/du x dp'/dv)
/// ```
///
/// Source: Blinn 1978; Pharr, Jakob and Humphreys, 4th edition, 10.5.3. Departure: dp/dv is the
/// surface's own. For meshes with normals pbrt-v4 takes dp/du turned by 90 degrees in its place,
/// which doubles the heights' slope along v where a texture is twice as long that way.
///
/// * `height`: the parameter.
///
/// Twin: specula-render/src/bump.rs, displaced.
fn bump_displaced(height: u32, n: vec3f, place: TextureCoordinates, partials: Partials) -> BumpedFrame {
    // The step that rounding left: coordinates of large tiled planes have few digits.
    let wanted = bump_steps(place.footprint.changes);
    let moved = place.uv + wanted;
    let steps = moved - place.uv;
    // One call in a loop, since the code of textures is long. At the point, along u, along v.
    var heights = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        var there = place;
        if i == 1u {
            there.uv.x = moved.x;
            there.position += partials.along_u * wanted.x;
        } else if i == 2u {
            there.uv.y = moved.y;
            there.position += partials.along_v * wanted.y;
        }
        heights[i] = parameter_float(height, there);
    }
    let slopes = select(vec2f(0.0), (heights.yz - heights.x) / max(steps, vec2f(1.0e-9)),
        steps > vec2f(0.0));
    let along_u = partials.along_u + n * slopes.x + partials.normal_along_u * heights.x;
    let along_v = partials.along_v + n * slopes.y + partials.normal_along_v * heights.x;
    let normal = unit_or(cross(along_u, along_v), n);
    let side = dot(cross(partials.along_u, partials.along_v), n);
    return bump_frame(select(normal, -normal, side < 0.0), along_u);
}
