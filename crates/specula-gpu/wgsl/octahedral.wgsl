// The equal-area map between the square and the sphere.
//
// Source: Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD; orientation as in
// pbrt-v4: the centre of the square is +z, its corners are -z, u runs with x and v with y.

import tracer::angles::{angles_sin_cos_half_turns, angles_turns, angles_with_sign};

/// The direction of a point of `[0, 1]^2`.
/// Twin: specula-render/src/light/octahedral.rs, direction_of.
fn octahedral_direction(uv: vec2f) -> vec3f {
    let at = 2.0 * uv - vec2f(1.0);
    let size = abs(at);
    let signed_distance = 1.0 - (size.x + size.y);
    let r = 1.0 - abs(signed_distance);
    var quarter = 1.0;
    if r != 0.0 {
        quarter = (size.y - size.x) / r + 1.0;
    }
    let sin_cos = angles_sin_cos_half_turns(0.25 * quarter);
    let planar = r * sqrt(2.0 - r * r);
    return vec3f(
        angles_with_sign(planar * sin_cos.y, at.x),
        angles_with_sign(planar * sin_cos.x, at.y),
        angles_with_sign(1.0 - r * r, signed_distance),
    );
}

/// The point of `[0, 1]^2` of a unit direction.
/// Twin: specula-render/src/light/octahedral.rs, square_of.
fn octahedral_square(w: vec3f) -> vec2f {
    let size = abs(w);
    // sqrt(1 - z) without cancellation.
    let r = min(sqrt((size.x * size.x + size.y * size.y) / (1.0 + size.z)), 1.0);
    let v = 4.0 * angles_turns(size.y, size.x) * r;
    let above = vec2f(r - v, v);
    let folded = select(above, vec2f(1.0) - above.yx, w.z < 0.0);
    return 0.5 * (vec2f(angles_with_sign(folded.x, w.x), angles_with_sign(folded.y, w.y)) + vec2f(1.0));
}
