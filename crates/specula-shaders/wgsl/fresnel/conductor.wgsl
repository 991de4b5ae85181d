// Exact reflectance of a conductor: unpolarised, of an interface with a complex index of refraction, per
// channel.

/// A complex index of refraction per channel, relative to the outer medium.
///
/// Twin: specula-bsdf/src/fresnel/conductor.rs, Conductor.
struct ConductorIor {
    /// Real part.
    eta: vec3f,
    /// Imaginary part, at least 0.
    k: vec3f,
}

/// Reflectance at `cosine`, in [0, 1].
///
/// With `a^2 + b^2 = sqrt((eta^2 - k^2 - sin^2)^2 + 4 eta^2 k^2)` and
/// `a^2 = (a^2 + b^2 + eta^2 - k^2 - sin^2) / 2`:
///
///     Rs = (a^2 + b^2 - 2 a cos + cos^2) / (a^2 + b^2 + 2 a cos + cos^2)
///     Rp = Rs (cos^2 (a^2 + b^2) - 2 a cos sin^2 + sin^4)
///             / (cos^2 (a^2 + b^2) + 2 a cos sin^2 + sin^4)
///     F = (Rs + Rp) / 2
///
/// Source: Born and Wolf, Principles of Optics, 14.2; Fresnel's equations for a complex index.
/// Departure: two differences that cancel in f32, `eta^2 - sin^2` where `eta` is near 1 and the angle
/// grazes, and `a^2` where absorption is strong, in forms that do not.
///
/// Twin: specula-bsdf/src/fresnel/conductor.rs, Conductor::eval.
fn conductor_eval(conductor: ConductorIor, cosine: f32) -> vec3f {
    let inside = clamp(cosine, 0.0, 1.0);
    // Beyond 1000 everything reflects alike; the limit holds products in range.
    let eta = min(conductor.eta, vec3f(1e3));
    let k = min(conductor.k, vec3f(1e3));
    let eta_squared = eta * eta;
    let cos_squared = inside * inside;
    let sin_squared = 1.0 - cos_squared;
    let t = (eta - 1.0) * (eta + 1.0) - k * k + cos_squared;
    let product = 4.0 * eta_squared * k * k;
    let sum = sqrt(t * t + product);
    let s = sum + cos_squared;
    // (sum + t) (sum - t) is the product.
    let root = select(sum + t, product / max(sum - t, vec3f(1e-30)), t < vec3f(0.0));
    let twice = inside * sqrt(2.0 * root);
    let p = cos_squared * sum + sin_squared * sin_squared;
    // An index of exactly 1 reflects nothing, and at grazing angles leaves 0/0.
    let bottom = max((s + twice) * (twice * sin_squared + p), vec3f(1e-12));
    return clamp((s - twice) * p / bottom, vec3f(0.0), vec3f(1.0));
}

/// The same metal under a medium of index `eta` instead of vacuum.
///
/// Twin: specula-bsdf/src/fresnel/conductor.rs, Conductor::under.
fn conductor_under(conductor: ConductorIor, eta: f32) -> ConductorIor {
    let inverse = 1.0 / eta;
    return ConductorIor(conductor.eta * inverse, conductor.k * inverse);
}
