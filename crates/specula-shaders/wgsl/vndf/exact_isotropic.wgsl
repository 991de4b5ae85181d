// Exact reflections of isotropic alpha: a map from the disk in closed form.
//
// Planes across the plane of incidence cut the cone's projection along the view in chords whose lengths
// are a disk's, so that a uniform point `(X, Y)` of the disk needs a scale across and a scale and a
// shift along them. With `p = a^2`, `q = i.z (1 - a^2)`:
//
//     Delta = sqrt(q^2 + 4 p),  lambda = (q + Delta)/2,  kappa = p/lambda,  B = lambda + i.z a^2
//     y = sqrt(lambda/B) Y
//     K = (1/L) (lambda sqrt(lambda B)/Delta X + r kappa/(Delta B) R)
//     R = sqrt((1 - Y^2) kappa B + Y^2 i.z a^2 Delta)
//     m = y T1 + K T2 + sqrt(1 - y^2 - K^2) h/L
//
// with `r = |(hx, hy)|`, `L = |h|`, `T1` across the plane of incidence and `T2 = h/L x T1` (towards the
// surface's normal). Nothing in it cancels.
//
// Source: derived in docs/exact-reflection-sampling.md of Specula.

import package::math::turns::{turns_sin_cos};
import package::vndf::cap::{cap_sample_direction};
import package::vndf::half_vector::{half_vector_density, half_vector_mirrored};
import package::vndf::stretched::{stretched_lengths};

/// The reflection of `wo`, as `exact_sample_direction` of `exact` gives it where both alphas are `a`.
///
/// * `wo`: unit, any hemisphere; `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, sample_direction.
fn exact_isotropic_sample_direction(a: f32, wo: vec3f, u: vec2f) -> vec3f {
    if wo.z <= 0.0 {
        return cap_sample_direction(vec2f(a), wo, u);
    }
    return half_vector_mirrored(wo, exact_isotropic_half_vector(a, wo, u));
}

/// Density of `exact_isotropic_sample_direction` in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, reflection_pdf.
fn exact_isotropic_reflection_pdf(a: f32, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(vec2f(a), wo, wi, exact_isotropic_norm_quotient(a, wo));
}

/// `N` of `pdf = D(wm) / (4 N)`, `lambda^2 / Delta` for `z > 0`, else `sigma(wo)`, as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, norm_quotient.
fn exact_isotropic_norm_quotient(a: f32, wo: vec3f) -> vec2f {
    if wo.z <= 0.0 {
        return vec2f(stretched_lengths(vec3f(a * wo.xy, wo.z)).y, 2.0);
    }
    return exact_isotropic_norm(a, wo.z);
}

/// `(Delta, lambda, kappa)` for the alpha `a` and a view at height `z > 0`.
///
/// Twin: specula-bsdf/src/vndf/exact/isotropic.rs, roots.
fn exact_isotropic_roots(a: f32, z: f32) -> vec3f {
    let p = a * a;
    let q = z * (1.0 - p);
    let delta = sqrt(q * q + 4.0 * p);
    let big = 0.5 * (abs(q) + delta);
    let small = p / big;
    return select(vec3f(delta, small, big), vec3f(delta, big, small), q >= 0.0);
}

/// `N = lambda^2 / Delta` as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/exact/isotropic.rs, norm.
fn exact_isotropic_norm(a: f32, z: f32) -> vec2f {
    let roots = exact_isotropic_roots(a, z);
    return vec2f(roots.y * roots.y, roots.x);
}

/// A half vector back in the surface's space, of any length.
///
/// * `a`: the alpha; `wo`: `wo.z > 0`.
/// * `u`: uniform in [0, 1)^2; `u.x` is the squared radius on the disk, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/exact/isotropic.rs, half_vector.
fn exact_isotropic_half_vector(a: f32, wo: vec3f, u: vec2f) -> vec3f {
    let z = wo.z;
    let roots = exact_isotropic_roots(a, z);
    let delta = roots.x;
    let lambda = roots.y;
    let kappa = roots.z;
    let tilt = z * a * a;
    let b = lambda + tilt;
    let scale = 1.0 / (delta * b);
    let root = sqrt(lambda * b);

    // The plane of incidence, defined at the normal too.
    let plane = dot(wo.xy, wo.xy);
    let sine = sqrt(max(plane, 1e-24));
    let incidence = select(vec2f(sine, 0.0), wo.xy, plane > 1e-24);
    let r = a * sine;
    let length = sqrt(r * r + z * z);
    let inverse = 1.0 / (sine * length);
    let to_length = inverse * sine;

    let phi = turns_sin_cos(u.y);
    let disk = sqrt(min(u.x, 0.9999962)) * phi.yx;
    let y = disk.y * disk.y;
    let middle = sqrt(max((1.0 - y) * kappa * b + y * tilt * delta, 0.0));
    let on_t = root * scale * delta * disk.y;
    let on_k = to_length * scale * (lambda * root * b * disk.x + r * kappa * middle);
    let height = sqrt(max(1.0 - on_t * on_t - on_k * on_k, 0.0));

    let radial = to_length * (height * r - z * on_k);
    let up = to_length * (height * z + r * on_k);
    let axis = incidence * (inverse * length);
    return vec3f(a * (radial * axis + on_t * vec2f(-axis.y, axis.x)), up);
}
