// Exact reflections of anisotropic alpha: a walk along the chords of the cone's projection.
//
// Seen along its axis `v`, the cone's section is an ellipse, uniform under the cosine to the axis; the
// cosine to the view is wanted. Chords across `k = h x v` are chords in both projections. The one at `Y`
// (across) of the unit disk has the ends
//
//     K(Y, +-) = Y s1 +- c s2 + rho(+-),   c = sqrt(1 - Y^2)
//
// in the projection along the view, where `rho` lifts the ends to the sphere. `rho` makes the chord at
// `Y` longer by as much as that at `-Y` is shorter, so the disk's density of `Y` is right for the pair.
// A point `(X, Y)` of the disk therefore walks the length `(c + X) s2` from one end of its chord; if the
// chord ends before, the point lies as far from the end of the opposite chord as it had left to go. Both
// chords are covered uniformly: two values, no rejection, no root.
//
// Source: derived in docs/exact-reflection-sampling.md of Specula.

import package::alpha::{alpha_stretch};
import package::math::turns::{turns_sin_cos};
import package::vndf::exact_cone::{ExactCone};

/// A half vector back in the surface's space, of any length.
///
/// * `u`: uniform in [0, 1)^2; `u.x` is the squared radius on the disk, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/exact/chords.rs, half_vector.
fn exact_chords_half_vector(alpha: vec2f, cone: ExactCone, u: vec2f) -> vec3f {
    // k = h x v and t = k x h, free of cancellation; |t| = |k| |h| and t . v = |k|^2.
    let h = cone.h;
    let rise = dot(h.xy, cone.v);
    let k = vec3f(
        cone.v.y * (rise + cone.tilt.y),
        -cone.v.x * (rise + cone.tilt.x),
        cone.v.x * cone.v.y * (cone.tilt.x - cone.tilt.y),
    );
    let t = cross(k, h);
    let k_squared = dot(k, k);

    // Conjugate half axes of the ellipse: across and along the chords.
    let gradient = k.xy * cone.inverse_d;
    let g = dot(k.xy, gradient);
    let axis = sqrt(cone.lambda / g);
    let thin = axis * sqrt(cone.inverse_d.x * cone.inverse_d.y);
    let across = axis * gradient;
    let along = vec2f(k.y, -k.x) * thin;

    let phi = turns_sin_cos(u.y);
    let disk = sqrt(min(u.x, 0.9999962)) * vec2f(phi.y, -phi.x);
    let c = sqrt(max(1.0 - disk.y * disk.y, 0.0));

    // Ends of the chord along t, in units of |k| |h|.
    let lever = k_squared / cone.v_squared;
    let centre = disk.y * across;
    let reach = c * along;
    let slide_across = dot(t.xy, across) - dot(cone.v, across) * lever;
    let slide_along = dot(t.xy, along) - dot(cone.v, along) * lever;
    let far = exact_chords_lift(cone, centre + reach) * lever;
    let near = exact_chords_lift(cone, centre - reach) * lever;

    // The opposite chord ends at the mirror image of this one's start, lifted as that is.
    let shift = disk.y * slide_across;
    let walked = disk.x * slide_along + near;
    let sign = select(1.0, -1.0, walked - c * slide_along > far);

    // The lengths of k and t h out of the coordinates, and the rest along h.
    let inverse = 1.0 / (k_squared * cone.h_squared);
    let on_k = sign * disk.y * axis * g * cone.h_squared * inverse;
    let on_t = (sign * shift + walked) * inverse;
    let rest = 1.0 - on_k * on_k * k_squared - on_t * on_t * k_squared * cone.h_squared;
    let on_h = sqrt(max(rest, 0.0)) * sqrt(cone.h_squared) * (k_squared * inverse);
    return alpha_stretch(alpha, k * on_k + t * on_t + h * on_h);
}

/// How far the point `w` of the ellipse's plane is lifted to the sphere.
///
/// Twin: specula-bsdf/src/vndf/exact/chords.rs, half_vector, `lift`.
fn exact_chords_lift(cone: ExactCone, w: vec2f) -> f32 {
    let b = dot(cone.v, w);
    let curved = dot(cone.tilt, w * w);
    return sqrt(b * b + cone.v_squared / cone.lambda * curved);
}
