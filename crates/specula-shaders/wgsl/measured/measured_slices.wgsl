// The measured views about a view, between which tables are interpolated.
//
// Twin of specula-bsdf/src/measured/warp.rs.

import package::measured::measured_table::{measured_table};

/// Ascending angles of measured views.
struct MeasuredSlicesAngles {
    /// How many.
    count: u32,
    /// Where the first one is.
    start: u32,
}

/// Four slices and their weights, which sum to 1.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Slices.
struct MeasuredSlices {
    /// Numbers of those at the azimuth before the view's.
    before: vec2u,
    /// Numbers of those at the azimuth behind it.
    behind: vec2u,
    /// What each counts.
    weights: vec4f,
}

/// The interval that `x` lies in, and the place within it in [0, 1]: a whole number and its fraction, of which the
/// fraction may be 1. Angles beyond the measured ones take the nearest.
///
/// Twin: specula-bsdf/src/measured/warp.rs, between.
fn measured_slices_between(angles: MeasuredSlicesAngles, x: f32) -> vec2f {
    if angles.count < 2u {
        return vec2f(0.0);
    }
    var low = 0u;
    var high = angles.count - 1u;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if measured_table(angles.start + middle) <= x {
            low = middle;
        } else {
            high = middle;
        }
    }
    let first = measured_table(angles.start + low);
    let t = (x - first) / (measured_table(angles.start + low + 1u) - first);
    return vec2f(f32(low), clamp(t, 0.0, 1.0));
}

/// The slices about a view; a slice for each azimuth and polar angle, the latter faster.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Slices::new.
fn measured_slices_about(
    azimuths: MeasuredSlicesAngles,
    polar: MeasuredSlicesAngles,
    phi: f32,
    theta: f32,
) -> MeasuredSlices {
    let azimuth = measured_slices_between(azimuths, phi);
    let along = measured_slices_between(polar, theta);
    let i = u32(azimuth.x);
    let j = u32(along.x);
    let first = i * polar.count;
    let second = min(i + 1u, azimuths.count - 1u) * polar.count;
    let next = min(j + 1u, polar.count - 1u);
    let r = 1.0 - azimuth.y;
    let v = 1.0 - along.y;
    return MeasuredSlices(
        vec2u(first + j, first + next),
        vec2u(second + j, second + next),
        vec4f(r * v, r * along.y, azimuth.y * v, azimuth.y * along.y));
}

/// The interpolated value.
///
/// * `data`: where the first slice begins; `size`: of a slice; `place`: within the slice.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Slices::value.
fn measured_slices_value(at: MeasuredSlices, data: u32, size: u32, place: u32) -> f32 {
    let first = data + place;
    return measured_table(first + at.before.x * size) * at.weights.x
        + measured_table(first + at.before.y * size) * at.weights.y
        + measured_table(first + at.behind.x * size) * at.weights.z
        + measured_table(first + at.behind.y * size) * at.weights.w;
}
