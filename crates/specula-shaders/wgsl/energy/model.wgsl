// Which compensation, and its factors.
//
// With `L = 1 - E` the loss of a white surface (`albedo`), and `F_ms` the share of the lost light that
// a coloured one still reflects:
//
//     Turquin 2019:            f = f_ss (1 + F_ms L(wo) / E(wo))
//     Kulla and Conty 2017:    f = f_ss + F_ms L(wo) L(wi) / (pi L_avg)
//
// Both reflect all light where `F = 1`. Kulla and Conty's is reciprocal; Turquin's is not, but it keeps
// the shape and the sampler of the single-scattering lobe.

/// Turquin 2019 with `F_ms = F0`, the reflectance at normal incidence: one more bounce.
const MODEL_TURQUIN: u32 = 0u;
/// Turquin 2019 with the sum over all further bounces, `F_ms = F_avg E_avg / (1 - F_avg L_avg)`.
const MODEL_TURQUIN_SERIES: u32 = 1u;
/// A second, broad lobe. Kulla and Conty 2017, Revisiting physically based shading at Imageworks.
const MODEL_KULLA_CONTY: u32 = 2u;

/// The share of light that all bounces after the first reflect, given their average reflectance:
///
///     F_avg E_avg sum_k (F_avg L_avg)^k = F_avg E_avg / (1 - F_avg L_avg)
///
/// * `loss`: `L_avg`, in [0, 1].
///
/// Source: Kulla and Conty 2017.
///
/// Twin: specula-bsdf/src/energy/model.rs, further_bounces.
fn model_further_bounces(average: vec3f, loss: f32) -> vec3f {
    return average * (1.0 - loss) / max(vec3f(1.0) - average * loss, vec3f(1.1754944e-38));
}
