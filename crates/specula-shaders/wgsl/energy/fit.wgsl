// The lost energy of isotropic GGX as short formulas, for shaders that hold no table.
//
//     p = sqrt(mu (1 + alpha) / (mu + alpha)),   m = 1 - sqrt(1 - p),   q = alpha / (1 + alpha)
//     sqrt(1 - E)     = alpha p / (mu + alpha) sum_j sum_i c_ji (2 m - 1)^i (4 q - 1)^j,   i < 8, j < 5
//     sqrt(1 - E_avg) = q sum_i a_i q^(i / 4),                                             i < 6
//
// for height-correlated masking and alpha in [1e-4, 1]: error of E at most 8e-4. The average is that of the fit, to
// 2.5e-3 of itself. How the coefficients were found: specula-bsdf/src/energy/fit.rs.

/// `1 - E(mu)` of height-correlated isotropic GGX, in [0, 1].
///
/// * `alpha`: in [1e-4, 1]; beyond, the nearest is taken.
/// * `cosine`: in [0, 1].
///
/// Twin: specula-bsdf/src/energy/fit.rs, ggx_loss.
fn fit_ggx_loss(alpha: f32, cosine: f32) -> f32 {
    let a = clamp(alpha, 1e-4, 1.0);
    let inverse = 1.0 / (cosine + a);
    let p = sqrt(cosine * (1.0 + a) * inverse);
    // 1 - p without cancellation.
    let rest = a * inverse * (1.0 - cosine) / (1.0 + p);
    let x = 1.0 - 2.0 * sqrt(max(rest, 0.0));
    let y = 4.0 * a / (1.0 + a) - 1.0;
    let low = (((
        vec4f(-0.011399, -0.008089, -0.017931, 0.067114) * y
            + vec4f(-0.068101, -0.029062, 0.224136, 0.295469)) * y
            + vec4f(0.178277, -0.155137, -0.634633, -1.076655)) * y
            + vec4f(0.221598, -0.181627, 0.516728, 0.856384)) * y
            + vec4f(0.985916, 0.708616, 0.291430, -0.377557);
    let high = (((
        vec4f(0.269154, -0.234563, -0.221806, 0.276775) * y
            + vec4f(-0.367989, -0.434426, 0.117614, 0.047183)) * y
            + vec4f(0.127887, 1.975467, 0.439834, -1.125790)) * y
            + vec4f(-0.059090, -1.502841, -0.132891, 0.759655)) * y
            + vec4f(-0.174583, 0.131740, 0.121340, -0.133707);
    let upper = ((high.w * x + high.z) * x + high.y) * x + high.x;
    let sum = (((upper * x + low.w) * x + low.z) * x + low.y) * x + low.x;
    let root = a * inverse * p * sum;
    return min(root * root, 1.0);
}

/// `1 - E_avg` of `fit_ggx_loss`, in (0, 1]: its integral over the hemisphere by the cosine, over pi.
///
/// * `alpha`: in [1e-4, 1]; beyond, the nearest is taken.
///
/// Twin: specula-bsdf/src/energy/fit.rs, ggx_average_loss.
fn fit_ggx_average_loss(alpha: f32) -> f32 {
    let a = clamp(alpha, 1e-4, 1.0);
    let q = a / (1.0 + a);
    let z = sqrt(sqrt(q));
    let root = q * (((((-36.799182 * z + 95.985019) * z - 102.879680) * z + 60.084252) * z - 21.109732) * z + 5.453085);
    return root * root;
}
