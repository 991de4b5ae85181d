// Falloff of spot lights towards their edge.
//
// Twin of specula-render/src/light/delta.rs.

import tracer::angles::{angles_turns};

/// Share of a spot light's intensity at the cosine `x` from its axis: 0 up to `low`, 1 from `high` on.
/// Twin: specula-render/src/light/delta.rs, share.
fn spot_share(falloff: u32, low: f32, high: f32, x: f32) -> f32 {
    if x >= high {
        return 1.0;
    }
    if x <= low {
        return 0.0;
    }
    let t = (x - low) / (high - low);
    switch falloff {
        case SPOT_LINEAR_ANGLE: {
            let last = spot_angle(low);
            return (last - spot_angle(x)) / (last - spot_angle(high));
        }
        case SPOT_SQUARED_COSINE: {
            return t * t;
        }
        default: {
            return t * t * (3.0 - 2.0 * t);
        }
    }
}

/// The angle of a cosine, in turns.
fn spot_angle(cosine: f32) -> f32 {
    return angles_turns(sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)), cosine);
}
