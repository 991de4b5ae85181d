// Schlick's approximation of reflectance.

/// `F = F0 + (1 - F0) (1 - cos)^5`, in [0, 1].
///
/// * `normal`: `F0`, reflectance at normal incidence, in [0, 1].
///
/// Source: Schlick 1994, eq. 15.
///
/// Twin: specula-bsdf/src/fresnel/schlick.rs, Schlick::eval.
fn schlick_eval(normal: vec3f, cosine: f32) -> vec3f {
    let m = clamp(1.0 - cosine, 0.0, 1.0);
    let square = m * m;
    return normal + (1.0 - normal) * (square * square * m);
}
