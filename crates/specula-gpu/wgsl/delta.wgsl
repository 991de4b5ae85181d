// Lights without extent: parallel, point and spot.
//
// Words of one: kind, then of
// - a parallel light: irradiance, direction to it (3 each);
// - a point: position, axis, intensity (3 each), cosine of the cone and of where its edge begins (-2: a
//   whole sphere of directions), falloff.
//
// Twin of specula-render/src/light/delta.rs. Departure: pictures thrown from a point are not there.

import tracer::angles::{angles_turns};
import tracer::parallelogram::{parallelogram_ratio};
import tracer::world::{number, vector, word};

/// Kinds: the first word of each.
const DELTA_DISTANT: u32 = 0u;
const DELTA_POINT: u32 = 1u;
/// Falloffs of a spot's edge.
const DELTA_SMOOTH_COSINE: u32 = 0u;
const DELTA_LINEAR_ANGLE: u32 = 1u;
const DELTA_SQUARED_COSINE: u32 = 2u;

/// What arrives from a light without extent.
struct DeltaArrival {
    /// On a surface that faces the light; black: nothing arrives.
    irradiance: vec3f,
    /// Unit, towards the light.
    wi: vec3f,
    /// Of the light; of no use where it is parallel.
    position: vec3f,
    /// Whether it is parallel.
    distant: bool,
}

/// What arrives at `p` from the light at `at`.
/// Twin: specula-render/src/light/delta.rs, Delta::illuminate.
fn delta_illuminate(at: u32, p: vec3f) -> DeltaArrival {
    if word(at) == DELTA_DISTANT {
        return DeltaArrival(vector(at + 1u), vector(at + 4u), vec3f(0.0), true);
    }
    let position = vector(at + 1u);
    let d = position - p;
    let distance_squared = dot(d, d);
    if !(distance_squared > 0.0) {
        return DeltaArrival(vec3f(0.0), vec3f(0.0), position, false);
    }
    let wi = d * (1.0 / sqrt(distance_squared));
    let share = delta_share(
        word(at + 12u), number(at + 10u), number(at + 11u), -dot(vector(at + 4u), wi),
    );
    let irradiance = vector(at + 7u) * parallelogram_ratio(share, distance_squared);
    return DeltaArrival(irradiance, wi, position, false);
}

/// Share of a spot light's intensity at the cosine `x` from its axis: 0 up to `low`, 1 from `high` on.
/// Twin: specula-render/src/light/delta.rs, share.
fn delta_share(falloff: u32, low: f32, high: f32, x: f32) -> f32 {
    if x >= high {
        return 1.0;
    }
    if x <= low {
        return 0.0;
    }
    let t = (x - low) / (high - low);
    switch falloff {
        case DELTA_LINEAR_ANGLE: {
            let last = delta_angle(low);
            return (last - delta_angle(x)) / (last - delta_angle(high));
        }
        case DELTA_SQUARED_COSINE: {
            return t * t;
        }
        default: {
            return t * t * (3.0 - 2.0 * t);
        }
    }
}

/// The angle of a cosine, in turns.
fn delta_angle(cosine: f32) -> f32 {
    return angles_turns(sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)), cosine);
}
