// Exact reflectance and refraction at a dielectric interface.

/// What becomes of light at a dielectric interface.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, Refraction.
struct DielectricRefraction {
    /// Share that is reflected, in [0, 1]; 1 beyond the critical angle.
    reflectance: f32,
    /// Share that passes, `1 - reflectance` without its cancellation at grazing angles.
    transmittance: f32,
    /// Cosine of the refracted direction; 0 beyond the critical angle.
    cos_t: f32,
}

/// Unpolarised reflectance of a dielectric interface.
///
///     cos_t = sqrt(1 - (1 - cos^2) / eta^2) = sqrt((eta - 1) (eta + 1) + cos^2) / eta
///     rs = (cos - eta cos_t) / (cos + eta cos_t),   rp = (eta cos - cos_t) / (eta cos + cos_t)
///     F = (rs^2 + rp^2) / 2
///     1 - F = 2 eta cos cos_t (1 / (cos + eta cos_t)^2 + 1 / (eta cos + cos_t)^2)
///
/// * `cosine`: between the direction and the normal on its side, in [0, 1].
/// * `eta`: index beyond the interface over the index on the direction's side, above 0.
///
/// Departure: the second form of `cos_t`, which does not cancel where `eta` is near 1 and the angle
/// grazes.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, dielectric.
fn dielectric(cosine: f32, eta: f32) -> DielectricRefraction {
    let inside = clamp(cosine, 0.0, 1.0);
    let refracted = (eta - 1.0) * (eta + 1.0) + inside * inside;
    return dielectric_refraction(inside, refracted / (eta * eta), eta);
}

/// `dielectric` where the square of the refracted cosine is known, 0 or less beyond the critical angle.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, refraction.
fn dielectric_refraction(cosine: f32, cos_t_squared: f32, eta: f32) -> DielectricRefraction {
    if cos_t_squared <= 0.0 {
        return DielectricRefraction(1.0, 0.0, 0.0);
    }
    let cos_t = sqrt(cos_t_squared);
    let inverse_s = 1.0 / max(cosine + eta * cos_t, 1.1754944e-38);
    let inverse_p = 1.0 / max(eta * cosine + cos_t, 1.1754944e-38);
    let rs = (cosine - eta * cos_t) * inverse_s;
    let rp = (eta * cosine - cos_t) * inverse_p;
    let reflectance = min(0.5 * (rs * rs + rp * rp), 1.0);
    let fluxes = inverse_s * inverse_s + inverse_p * inverse_p;
    let transmittance = min(2.0 * eta * cosine * cos_t * fluxes, 1.0);
    return DielectricRefraction(reflectance, transmittance, cos_t);
}

/// The direction `wo` refracted at a facet.
///
///     wi = (cos_o / eta - cos_t) wm - wo / eta
///
/// * `wm`: unit, on the side of `wo`; `cos_o = wo . wm`; `cos_t` of `dielectric`.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, refract.
fn dielectric_refract(wo: vec3f, wm: vec3f, cos_o: f32, cos_t: f32, eta: f32) -> vec3f {
    let inverse = 1.0 / eta;
    return wm * (inverse * cos_o - cos_t) - wo * inverse;
}

/// Hemispherical reflectance of a smooth interface for light from every side, `int F(mu) 2 mu dmu`, for
/// `eta` from 1/10 to 10.
///
/// For light from inside: `1 - (1 - Fdr(eta)) / eta^2` (reciprocity).
///
/// Source: Walsh 1926, as given by Duntley 1942; linear below 1.002 as the Rust source. Departure: all
/// but the singular term of the closed form, which cancels in f32, is a fit in
/// `t = (eta - 1) / (eta + 1)` with a relative error below 2e-6.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, dielectric_average.
fn dielectric_average(eta: f32) -> f32 {
    let outside_in = eta >= 1.0;
    let n = select(1.0 / eta, eta, outside_in);
    // The closed form is 0/0 at 1: its limit is 0.
    let safe = max(n, 1.002);
    let entering = dielectric_walsh(safe) * ((n - 1.0) / (safe - 1.0));
    let leaving = 1.0 - (1.0 - entering) / (n * n);
    return select(leaving, entering, outside_in);
}

/// The average for `n > 1`.
///
/// Twin: specula-bsdf/src/fresnel/dielectric.rs, walsh.
fn dielectric_walsh(n: f32) -> f32 {
    let t = (n - 1.0) / (n + 1.0);
    let square = n * n;
    let r = n * (square - 1.0) / (square + 1.0);
    let singular = r * r / (square + 1.0) * log(t);
    let x = 2.4444444 * t - 1.0;
    let high = ((0.00325263475 * x - 0.00189994172) * x - 0.0198743592) * x + 0.0322744025;
    let middle = ((high * x + 0.0459898683) * x - 0.184615148) * x + 0.0805662465;
    let low = ((middle * x + 0.521863671) * x - 0.690830042) * x - 0.193081013;
    return t * (low * x + 1.4221043) + singular;
}
