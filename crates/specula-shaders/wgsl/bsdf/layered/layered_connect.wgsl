// What a vertex below a coat sends to the light.
//
// A first bounce off the base runs `wo`, `-u`, `v`, `wi`, with `u` and `v` the directions up from the
// base. Where the coat is rough there are three ways to sample it, weighed by the power heuristic (Veach
// and Guibas 1995):
//
//     A: u from wo, v from wi        B: u from wo, v from the base        C: v from wi, u from the base
//     p(u | wo) p(v | wi)            p(u | wo) p(v | u)                   p(v | wi) p(u | v)
//
// Over a narrow base the tails are rare and bright without C: a light off the mirror's direction is seen
// by a rare `u` and a common `v` as much as the other way round. Over a wide one C is left out, and later
// vertices have A and B. A smooth coat leaves A, which then is no sample: the first bounce is a closed
// form. Over a mirror B and C remain.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_IMPORTANCE, BSDF_SAMPLE_RADIANCE};
import package::bsdf::layered::layered_base::{layered_base_sample, layered_base_eval_pdf, layered_base_is_mirror};
import package::bsdf::layered::layered_coat::{LayeredCoatSample, layered_coat_passes};
import package::bsdf::layered::layered_lobe::{LayeredLobe, layered_lobe_echoes};
import package::bsdf::layered::layered_medium::{layered_medium_phase, layered_medium_transmittance, layered_medium_turned};
import package::math::rgb::{rgb_max_channel};
import package::math::stream::{StreamState};

/// A floor of divisors.
const LAYERED_CONNECT_TINY: f32 = 1.1754944e-38;

/// Both ends of the paths whose value is asked.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends.
struct LayeredConnectEnds {
    /// Towards the viewer.
    wo: vec3f,
    /// Towards the light.
    wi: vec3f,
    /// How light of `wi` comes in: for radiance, the way back from it.
    entry: LayeredCoatSample,
    /// `p(u | wo)` of how light of `wo` came in, at a first vertex that C may sample.
    first: f32,
    /// Whether this is such a vertex.
    is_first: bool,
}

/// Densities of the three ways to sample one path.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ways.
struct LayeredConnectWays {
    /// Both ends from outside.
    a: f32,
    /// From `wo`.
    b: f32,
    /// From `wi`.
    c: f32,
}

/// What light a vertex sends, and how the walk goes on.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::at_base.
struct LayeredConnectVertex {
    /// `f |cos|` of the light.
    light: vec3f,
    /// The next direction of travel.
    w: vec3f,
    /// Its weight.
    weight: vec3f,
    /// Whether the walk goes on.
    goes_on: bool,
}

/// The densities of the ways.
///
/// * `from_wo`: `p(u | wo)`; `has_third`: whether C is a way.
/// * `from_wi`: `p(v | wi)`.
/// * `on`, `back`: `p(v | u)` and `p(u | v)` at the base.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ways::new.
fn layered_connect_ways(
    lobe: LayeredLobe,
    from_wo: f32,
    has_third: bool,
    from_wi: f32,
    on: f32,
    back: f32,
) -> LayeredConnectWays {
    let first = select(1.0, from_wo, has_third);
    let mirror = layered_base_is_mirror(lobe.base);
    let onward = select(on, 1.0, mirror);
    let backward = select(back, 1.0, mirror);
    let a = select(first * from_wi, 0.0, mirror);
    return LayeredConnectWays(a, first * onward, select(0.0, from_wi * backward, has_third));
}

/// The weight of the way with the density `own`.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ways::share.
fn layered_connect_share(ways: LayeredConnectWays, own: f32) -> f32 {
    let scale = 1.0 / max(ways.a + ways.b + ways.c, LAYERED_CONNECT_TINY);
    let shares = vec3f(ways.a, ways.b, ways.c) * scale;
    let mine = own * scale;
    return mine * mine / max(dot(shares, shares), LAYERED_CONNECT_TINY);
}

/// Light by way of the base, which is met along `down`; and how the walk goes on.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::at_base.
fn layered_connect_at_base(
    ends: LayeredConnectEnds,
    lobe: LayeredLobe,
    down: vec3f,
    stream: ptr<function, StreamState>,
) -> LayeredConnectVertex {
    let u = -down;
    let is_rough = lobe.coat.rough == 1u;
    let depth = lobe.medium.thickness;
    var sum = vec3f(0.0);
    if ends.entry.exists {
        let v = -ends.entry.w;
        let value = layered_base_eval_pdf(lobe.base, u, v);
        if rgb_max_channel(value.rgb) > 0.0 {
            var share = 1.0;
            if is_rough {
                let back = layered_connect_back(ends, lobe, u, v);
                let ways = layered_connect_ways(lobe, ends.first, ends.is_first, ends.entry.pdf, value.a, back);
                share = layered_connect_share(ways, ways.a);
            }
            let left = layered_medium_transmittance(depth, v) * share;
            sum += value.rgb * (layered_connect_arriving(ends, v) * left);
        }
    }
    let next = layered_base_sample(lobe.base, u, stream);
    if next.flags != 0u && is_rough {
        let passed = layered_coat_passes(lobe.coat, ends.wi, next.wi, BSDF_SAMPLE_RADIANCE);
        let back = layered_connect_back(ends, lobe, u, next.wi);
        let ways = layered_connect_ways(lobe, ends.first, ends.is_first, passed.y, next.pdf, back);
        let left = layered_medium_transmittance(depth, next.wi) * layered_connect_share(ways, ways.b);
        sum += next.weight * (passed.x * ends.wi.z * left);
    }
    return LayeredConnectVertex(sum, next.wi, next.weight, next.flags != 0u);
}

/// C: light by way of the base, sampled from the light.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::sampled_from_light.
fn layered_connect_sampled_from_light(
    ends: LayeredConnectEnds,
    lobe: LayeredLobe,
    stream: ptr<function, StreamState>,
) -> vec3f {
    if !ends.entry.exists {
        return vec3f(0.0);
    }
    let v = -ends.entry.w;
    let sampled = layered_base_sample(lobe.base, v, stream);
    if sampled.flags == 0u {
        return vec3f(0.0);
    }
    let u = sampled.wi;
    let passed = layered_coat_passes(lobe.coat, ends.wo, u, BSDF_SAMPLE_IMPORTANCE);
    let on = layered_base_eval_pdf(lobe.base, u, v).a;
    let ways = layered_connect_ways(lobe, passed.y, true, ends.entry.pdf, on, sampled.pdf);
    let depth = lobe.medium.thickness;
    let crossed = layered_medium_transmittance(depth, u) * layered_medium_transmittance(depth, v);
    let share = layered_connect_share(ways, ways.c);
    return sampled.weight * (ends.entry.weight * ends.wi.z * passed.x * crossed * share);
}

/// Light by way of a particle, which is met along `down`, and where the walk goes on.
///
/// * `ways_out`: optical ways to the base and to the coat.
/// * `events`: how many more are allowed.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::at_particle.
fn layered_connect_at_particle(
    ends: LayeredConnectEnds,
    lobe: LayeredLobe,
    down: vec3f,
    ways_out: vec2f,
    events: u32,
    stream: ptr<function, StreamState>,
) -> LayeredConnectVertex {
    let is_rough = lobe.coat.rough == 1u;
    var sum = vec3f(0.0);
    if ends.entry.exists {
        let v = -ends.entry.w;
        let phase = layered_medium_phase(lobe.medium, dot(down, v));
        let share = layered_connect_balance(is_rough, ends.entry.pdf, phase);
        let up = phase * layered_medium_transmittance(ways_out.y, v) * share;
        var seen = vec3f(up);
        if !is_rough && layered_base_is_mirror(lobe.base) {
            // Both surfaces smooth: only here can light be met that they have mirrored.
            let turned = layered_medium_phase(lobe.medium, dot(down, vec3f(v.x, v.y, -v.z)));
            let way = ways_out.x + lobe.medium.thickness;
            let mirrored = turned * layered_medium_transmittance(way, v);
            seen = layered_lobe_echoes(lobe, v, up, mirrored, events);
        }
        sum += seen * layered_connect_arriving(ends, v);
    }
    let w = layered_medium_turned(lobe.medium, down, stream);
    if is_rough && w.z > 0.0 {
        let passed = layered_coat_passes(lobe.coat, ends.wi, w, BSDF_SAMPLE_RADIANCE);
        let phase = layered_medium_phase(lobe.medium, dot(down, w));
        let share = layered_connect_balance(is_rough, phase, passed.y);
        let left = layered_medium_transmittance(ways_out.y, w) * share;
        sum += vec3f(passed.x * ends.wi.z * left);
    }
    return LayeredConnectVertex(sum, w, vec3f(1.0), true);
}

/// The weight of the way with the density `own` beside another, where the coat is rough.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::at_particle.
fn layered_connect_balance(is_rough: bool, own: f32, other: f32) -> f32 {
    return select(1.0, own / max(own + other, LAYERED_CONNECT_TINY), is_rough);
}

/// What of `f |cos|` at a vertex reaches the light along `v`: reciprocity changes the cosines.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::arriving.
fn layered_connect_arriving(ends: LayeredConnectEnds, v: vec3f) -> f32 {
    return ends.entry.weight * ends.wi.z / max(v.z, LAYERED_CONNECT_TINY);
}

/// `p(u | v)` at the base, where it matters.
///
/// Twin: specula-bsdf/src/bsdf/layered/connect.rs, Ends::back.
fn layered_connect_back(ends: LayeredConnectEnds, lobe: LayeredLobe, u: vec3f, v: vec3f) -> f32 {
    if ends.is_first {
        return layered_base_eval_pdf(lobe.base, v, u).a;
    }
    return 0.0;
}
