// The lights of a scene: sampling one of them and a point on it, and the density of that for emission that a ray
// hits by chance.
//
// LIGHT_PLACES has the offset of each of LIGHT_COUNT lights: its kind, then of
// - a shape: whether it emits to both sides, radiance (3), the shape (area.wgsl);
// - a shape whose emission varies: whether it emits to both sides, its record (textured.wgsl);
// - a light with extent at infinity: its index among those;
// - a light without extent: its record (delta.wgsl).
//
// LIGHT_FAR has the offset and the index of each of LIGHT_FAR_COUNT lights with extent at infinity: kind, then the
// record (environment.wgsl, sun.wgsl). LIGHT_ALIAS has LIGHT_ALIAS_COUNT bins of an alias table over
// all lights, of which only those at infinity have weights: share of the bin that is its own, the light that has
// the rest, probability of the entry. LIGHT_FAR_IRRADIANCE is the offset of their irradiance,
// LIGHT_ONLY the light that is always sampled, or NONE.
//
// What a scene lacks is not compiled: LIGHT_HAS_TEXTURED, LIGHT_HAS_PROJECTED.
//
// Twin of specula-render/src/light/{mod,select,alias}.rs.

import tracer::area::{AreaSample, area_sample, area_pdf};
import tracer::delta::{delta_illuminate};
import tracer::environment::{environment_arriving, environment_sample};
import tracer::light_tree::{LightChoice, LightRandomNumber, light_tree_sample, light_tree_probability, light_tree_total, light_tree_value, light_tree_within};
import tracer::sun::{sun_arriving, sun_density, sun_sample};
import tracer::textured::{textured_sample, textured_pdf};
import tracer::world::{number, vector, word};


/// A point to be lit.
/// Twin: specula-render/src/light/node.rs, Receiver.
struct Receiver {
    /// Where it is.
    position: vec3f,
    /// Unit; light from below it is lost. Zero where light from every side counts.
    normal: vec3f,
}

/// A sample of a light, whose visibility is not known yet.
/// Twin: specula-render/src/light/mod.rs, LightSample and Target.
struct LightSample {
    /// Unit, towards the light.
    wi: vec3f,
    /// Density in 1/sr, times the probability of the light; the probability alone where `delta`.
    pdf: f32,
    /// Radiance; of a light without extent, irradiance on a surface that faces it.
    radiance: vec3f,
    /// Whether the light is a Dirac delta, which no lobe's direction hits.
    delta: u32,
    /// Where it comes from.
    target_position: vec3f,
    /// Bound on the error of each component of `target_position`.
    target_error: vec3f,
    /// Normal of the light there.
    target_normal: vec3f,
    /// Whether it comes from infinity: there is no target then.
    from_infinity: u32,
    /// 0: there is no sample.
    valid: u32,
}

/// Samples a light and a point on it.
///
/// * `u`: uniform in `[0, 1)^4`: choice of light, two for the point on it, finer digits of the choice.
///
/// Twin: specula-render/src/light/mod.rs, Lights::sample.
fn lights_sample(receiver: Receiver, u: vec4f) -> LightSample {
    let choice = lights_choose(receiver, u.x, u.w);
    var sampled: LightSample;
    if choice.probability <= 0.0 {
        return sampled;
    }
    let at = word(LIGHT_PLACES + choice.light);
    switch word(at) {
        case LIGHTS_AREA: {
            if LIGHT_HAS_AREA != 0u {
                sampled = lights_sample_area(at + 1u, receiver.position, u.yz);
            }
        }
        case LIGHTS_FAR: {
            if LIGHT_FAR_COUNT != 0u {
                sampled = lights_sample_far(word(LIGHT_FAR + 2u * word(at + 1u)), u.yz);
            }
        }
        case LIGHTS_DELTA: {
            if LIGHT_HAS_DELTA != 0u {
                sampled = lights_sample_delta(at + 1u, receiver.position);
            }
        }
        case LIGHTS_TEXTURED: {
            if LIGHT_HAS_TEXTURED != 0u {
                sampled = lights_sample_textured(at + 1u, receiver.position, u.yz);
            }
        }
        default: {}
    }
    sampled.pdf *= choice.probability;
    return sampled;
}

/// Samples a point of the emitting shape at `at`, as seen from `p`.
/// Twin: specula-render/src/light/mod.rs, Lights::sample_one.
fn lights_sample_area(at: u32, p: vec3f, u: vec2f) -> LightSample {
    return lights_from_area(area_sample(at + 4u, p, u), vector(at + 1u), word(at) != 0u);
}

/// Samples a point of the shape at `at`, whose emission varies, as seen from `p`.
/// Twin: specula-render/src/light/mod.rs, Lights::sample_one.
fn lights_sample_textured(at: u32, p: vec3f, u: vec2f) -> LightSample {
    let s = textured_sample(at + 1u, p, u);
    return lights_from_area(s.area, s.radiance, word(at) != 0u);
}

/// The light sample of a sampled point of a shape.
/// Twin: specula-render/src/light/mod.rs, from_area.
fn lights_from_area(s: AreaSample, radiance: vec3f, two_sided: bool) -> LightSample {
    var sampled: LightSample;
    sampled.wi = s.wi;
    sampled.pdf = s.pdf;
    sampled.radiance = radiance;
    sampled.target_position = s.position;
    sampled.target_error = s.error;
    sampled.target_normal = s.normal;
    let emits = two_sided || dot(s.normal, s.wi) < 0.0;
    sampled.valid = u32(s.pdf > 0.0 && emits);
    return sampled;
}

/// Samples a direction to the light with extent at infinity at `at`.
/// Twin: specula-render/src/light/mod.rs, Far::sample.
fn lights_sample_far(at: u32, u: vec2f) -> LightSample {
    var sampled: LightSample;
    sampled.from_infinity = 1u;
    if LIGHT_HAS_SUN != 0u && word(at) == LIGHTS_SUN {
        sampled.wi = sun_sample(at + 1u, u);
        sampled.radiance = vector(at + 10u);
        sampled.pdf = sun_density(at + 1u);
        sampled.valid = 1u;
        return sampled;
    }
    if LIGHT_HAS_ENVIRONMENT != 0u {
        let s = environment_sample(at + 1u, u);
        sampled.wi = s.wi;
        sampled.radiance = s.radiance;
        sampled.pdf = s.pdf;
        sampled.valid = u32(s.pdf > 0.0);
    }
    return sampled;
}

/// The light sample of the light without extent at `at`, at `p`.
/// Twin: specula-render/src/light/mod.rs, Lights::sample_one.
fn lights_sample_delta(at: u32, p: vec3f) -> LightSample {
    let arrival = delta_illuminate(at, p);
    var sampled: LightSample;
    sampled.wi = arrival.wi;
    sampled.pdf = 1.0;
    sampled.radiance = arrival.irradiance;
    sampled.delta = 1u;
    sampled.target_position = arrival.position;
    sampled.target_normal = arrival.wi;
    sampled.from_infinity = u32(arrival.distant);
    sampled.valid = u32(any(arrival.irradiance != vec3f(0.0)));
    return sampled;
}

/// Density in 1/sr, times the probability of the light, with which `lights_sample` samples the direction to
/// the point `position` of the surface of a light.
///
/// * `light`: its index; NONE of a surface that does not emit.
/// * `normal`: of the surface there.
/// * `weights`: barycentric, of its primitive's second and third corner.
///
/// Twin: specula-render/src/light/mod.rs, Lights::pdf_of_surface.
fn lights_pdf_of_surface(
    receiver: Receiver,
    light: u32,
    position: vec3f,
    normal: vec3f,
    weights: vec2f,
) -> f32 {
    if light >= LIGHT_COUNT {
        return 0.0;
    }
    let at = word(LIGHT_PLACES + light);
    var pdf = 0.0;
    if LIGHT_HAS_AREA != 0u && word(at) == LIGHTS_AREA {
        pdf = area_pdf(at + 5u, receiver.position, position, normal);
    } else if LIGHT_HAS_TEXTURED != 0u && word(at) == LIGHTS_TEXTURED {
        pdf = textured_pdf(at + 2u, receiver.position, position, normal, weights);
    }
    if pdf <= 0.0 {
        return 0.0;
    }
    return lights_probability_near(receiver, light) * pdf;
}

/// How many lights with extent at infinity there are.
fn lights_count_at_infinity() -> u32 {
    return LIGHT_FAR_COUNT;
}

/// Radiance from the direction `wi` of light `i` at infinity, and the density in 1/sr, times its
/// probability among those: `lights_sample` samples it with that density times `lights_share_from_infinity`.
/// Twin: specula-render/src/light/mod.rs, Lights::arriving_from_infinity.
fn lights_arriving_from_infinity(i: u32, wi: vec3f) -> vec4f {
    let at = word(LIGHT_FAR + 2u * i);
    let light = word(LIGHT_FAR + 2u * i + 1u);
    var arriving = vec4f(0.0);
    if LIGHT_HAS_SUN != 0u && word(at) == LIGHTS_SUN {
        arriving = sun_arriving(at + 1u, wi);
    } else if LIGHT_HAS_ENVIRONMENT != 0u {
        arriving = environment_arriving(at + 1u, wi);
    }
    var probability = 0.0;
    if light < LIGHT_ALIAS_COUNT {
        probability = number(LIGHT_ALIAS + 3u * light + 2u);
    }
    return vec4f(arriving.rgb, probability * arriving.w);
}

/// Probability with which `lights_sample` takes any light at infinity: by the estimates of irradiance, within bounds,
/// since these do not know what is occluded.
/// Twin: specula-render/src/light/select.rs, Selection::share.
fn lights_share_from_infinity(receiver: Receiver) -> f32 {
    let far = number(LIGHT_FAR_IRRADIANCE);
    if far <= 0.0 {
        return 0.0;
    }
    let near = light_tree_total(receiver.position, receiver.normal);
    if near <= 0.0 {
        return 1.0;
    }
    return clamp(far / (far + near), LIGHTS_LEAST_SHARE, 1.0 - LIGHTS_LEAST_SHARE);
}

/// Probability with which `lights_sample` takes a light within the scene.
/// Twin: specula-render/src/light/select.rs, Selection::probability_near.
fn lights_probability_near(receiver: Receiver, light: u32) -> f32 {
    let share = 1.0 - lights_share_from_infinity(receiver);
    return share * light_tree_probability(receiver.position, receiver.normal, light);
}

/// Samples a light, with its probability.
///
/// * `u`, `finer`: uniform in `[0, 1)`; the second adds digits to the first.
///
/// Twin: specula-render/src/light/select.rs, Selection::choose.
fn lights_choose(receiver: Receiver, u: f32, finer: f32) -> LightChoice {
    if LIGHT_ONLY != NONE {
        return LightChoice(LIGHT_ONLY, 1.0);
    }
    let share = lights_share_from_infinity(receiver);
    let random = LightRandomNumber(u, LIGHTS_FINER, finer);
    if light_tree_value(random) < share {
        let choice = lights_alias(light_tree_value(light_tree_within(random, 0.0, share)));
        return LightChoice(choice.light, share * choice.probability);
    }
    let rest = light_tree_within(random, share, 1.0 - share);
    let choice = light_tree_sample(receiver.position, receiver.normal, rest);
    return LightChoice(choice.light, (1.0 - share) * choice.probability);
}

/// Samples a light at infinity, with its probability among those.
///
/// * `u`: uniform in `[0, 1)`: `u n` chooses a bin, its fraction between the bin's two entries. A
///   fraction in `f32` moves the border between two lights by 2^-24 of `u` at most.
///
/// Twin: specula-render/src/light/alias.rs, AliasTable::sample.
fn lights_alias(u: f32) -> LightChoice {
    if LIGHT_ALIAS_COUNT == 0u {
        return LightChoice(0u, 0.0);
    }
    let along = u * f32(LIGHT_ALIAS_COUNT);
    let at = min(u32(along), LIGHT_ALIAS_COUNT - 1u);
    let bin = LIGHT_ALIAS + 3u * at;
    let own = along - f32(at) < number(bin);
    let chosen = select(word(bin + 1u), at, own);
    return LightChoice(chosen, number(LIGHT_ALIAS + 3u * chosen + 2u));
}
