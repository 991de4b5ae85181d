// The lost energy of isotropic GGX as a short formula: 30 coefficients, one square root.
//
//     p = sqrt(mu (1 + alpha) / (mu + alpha)),   q = alpha / (1 + alpha)
//     sqrt(1 - E) = sum_i sum_j c_ij p^i q^j  clamped to [0, 1],    i < 6, j < 5
//
// for height-correlated masking and alpha in [1e-4, 1]: error of E at most 4e-3, for shaders that hold
// no table. How the coefficients were found: specula-bsdf/src/energy/fit.rs.

/// A polynomial of the fourth degree.
///
/// * `low`: coefficients of the powers 0 to 3; `high`: of the power 4.
///
/// Twin: specula-bsdf/src/energy/fit.rs, ggx_loss, its `horner`.
fn fit_quartic(x: f32, low: vec4f, high: f32) -> f32 {
    return (((high * x + low.w) * x + low.z) * x + low.y) * x + low.x;
}

/// `1 - E(mu)` of height-correlated isotropic GGX, in [0, 1].
///
/// * `alpha`: in [1e-4, 1]; beyond, the nearest is taken.
/// * `cosine`: in [0, 1].
///
/// Twin: specula-bsdf/src/energy/fit.rs, ggx_loss.
fn fit_ggx_loss(alpha: f32, cosine: f32) -> f32 {
    let clamped = clamp(alpha, 1e-4, 1.0);
    let p = sqrt(cosine * (1.0 + clamped) / (cosine + clamped));
    let q = clamped / (1.0 + clamped);
    let constant_term = fit_quartic(q, vec4f(-0.2459010, -0.6555546, 11.8294695, -28.3126735), 18.5292090);
    let first = fit_quartic(q, vec4f(3.6134939, 6.4391663, -130.3911434, 324.0524915), -207.8692579);
    let second = fit_quartic(q, vec4f(-14.1432019, -22.8474365, 567.8079675, -1389.7207195), 879.6867027);
    let third = fit_quartic(q, vec4f(28.2991405, 32.9688362, -1118.3510965, 2829.5659502), -1854.9242410);
    let fourth = fit_quartic(q, vec4f(-24.6646901, -22.1537521, 1018.5775100, -2706.7878696), 1876.1291816);
    let fifth = fit_quartic(q, vec4f(7.0897394, 7.8885147, -349.8078658, 976.8527419), -720.4939025);
    let root = ((((fifth * p + fourth) * p + third) * p + second) * p + first) * p + constant_term;
    let held = clamp(root, 0.0, 1.0);
    return held * held;
}
