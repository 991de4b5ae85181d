// Smith's masking and shadowing, the same for every distribution: functions of its projected area
// `sigma(w)` and of `|cos| Lambda(w)`, which are free of cancellation and finite at grazing angles.
//
// Directions are unit and local; the surface's normal is z.

/// `G2 = 1 / (1 + Lambda(wo) + Lambda(wi))` (Heitz 2014, eq. 99): pbrt-v4, Cycles.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Masking::HeightCorrelated.
const MASKING_HEIGHT_CORRELATED: u32 = 0u;
/// `G2 = G1(wo) G1(wi)`: Mitsuba 3, OpenPBR's reference code.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Masking::Separable.
const MASKING_SEPARABLE: u32 = 1u;

/// Smith's `G1 = 1 / (1 + Lambda)`; 0 where the direction is below the horizon.
///
/// * `cosine`: `w.z`; `lambda_cos`: `|w.z| Lambda(w)`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g1.
fn masking_g_single(cosine: f32, lambda_cos: f32) -> f32 {
    if cosine > 0.0 {
        return cosine / (cosine + lambda_cos);
    }
    return 0.0;
}

/// Height-correlated masking and shadowing; 0 unless both directions are above the horizon.
///
/// * `cosines`: `(wo.z, wi.z)`; `lambda_cos`: of both.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_correlated.
fn masking_g_correlated(cosines: vec2f, lambda_cos: vec2f) -> f32 {
    if cosines.x > 0.0 && cosines.y > 0.0 {
        let both = cosines.x * cosines.y;
        return both / (both + (cosines.y * lambda_cos.x + cosines.x * lambda_cos.y));
    }
    return 0.0;
}

/// `G2(wo, wi) / |wo.z|` as numerator and denominator: finite at grazing views, and continued through
/// the horizon for backfacing shading normals.
///
///     height-correlated:  |wi.z| / (sigma(wo) |wi.z| + |wo.z| |wi.z| Lambda(wi))
///     separable:          |wi.z| / (sigma(wo) (|wi.z| + |wi.z| Lambda(wi)))
///
/// For `wo.z < 0`, `sigma(wo)` alone knows the sign. So `G2 / |wo.z|` is continuous in `wo`, at most
/// `1 / sigma(wo)`, and the weight of a sampled visible normal is at most 1 on both sides of the
/// horizon.
///
/// * `masking`: one of the constants above; `area`: `sigma(wo)`; `cosines`: `(wo.z, wi.z)`.
/// * `lambda_cos`: `|wi.z| Lambda(wi)`.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos_quotient.
fn masking_over_cos_quotient(masking: u32, area: f32, cosines: vec2f, lambda_cos: f32) -> vec2f {
    // The summand: two directions on the horizon leave no 0/0.
    let cosine = abs(cosines.y) + 1e-30;
    let correlated = area * cosine + abs(cosines.x) * lambda_cos;
    let separable = area * (cosine + lambda_cos);
    return vec2f(cosine, select(correlated, separable, masking == MASKING_SEPARABLE));
}

/// A quotient that is 0 where its denominator is.
///
/// Twin: specula-bsdf/src/ndf/mod.rs, Ndf::g2_over_cos.
fn masking_divided(quotient: vec2f) -> f32 {
    if quotient.y > 0.0 {
        return quotient.x / quotient.y;
    }
    return 0.0;
}
