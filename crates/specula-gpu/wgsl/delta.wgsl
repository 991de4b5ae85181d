// Lights without extent: parallel, point, spot and projected-image lights.
//
// Layout of a record, in words: kind, then of
// - a parallel light: irradiance, direction to it (3 each);
// - a point or spot: position, axis, intensity (3 each), cosines of the angles where a spot ends and where it
//   starts to fade (-2: all directions), falloff;
// - a projected image: see projected.wgsl.
//
// Twin of specula-render/src/light/delta.rs.

import tracer::parallelogram::{parallelogram_ratio};
import tracer::spot::{spot_share};
import tracer::projected::{projected_intensity};
import tracer::world::{number, vector, word};

/// Light that arrives from a light without extent.
struct DeltaArrival {
    /// Irradiance on a surface that faces the light; black: nothing arrives.
    irradiance: vec3f,
    /// Unit, towards the light.
    wi: vec3f,
    /// Position of the light; meaningless where it is parallel.
    position: vec3f,
    /// Whether it is parallel.
    distant: bool,
}

/// Light that arrives at `p` from the light at `at`.
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
    if LIGHT_HAS_PROJECTED != 0u && word(at) == DELTA_PROJECTED {
        let sent = projected_intensity(at + 1u, -wi) * (1.0 / distance_squared);
        return DeltaArrival(sent, wi, position, false);
    }
    let share = spot_share(
        word(at + 12u), number(at + 10u), number(at + 11u), -dot(vector(at + 4u), wi),
    );
    let irradiance = vector(at + 7u) * parallelogram_ratio(share, distance_squared);
    return DeltaArrival(irradiance, wi, position, false);
}
