// What Mitsuba 3's `principled` and `principledthin` are made of: Burley's material of 2012 and 2015.

/// By the names of Mitsuba 3; shares are in [0, 1].
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, PrincipledParameters.
struct PrincipledParameters {
    /// `base_color`.
    base_colour: vec3f,
    /// `roughness`; alpha is its square.
    roughness: f32,
    /// `anisotropic`.
    anisotropic: f32,
    /// `metallic`; ignored where thin.
    metallic: f32,
    /// `spec_trans`.
    spec_trans: f32,
    /// `eta`: index inside over that outside, or what `specular` says.
    eta: f32,
    /// `spec_tint`.
    spec_tint: f32,
    /// `sheen`.
    sheen: f32,
    /// `sheen_tint`.
    sheen_tint: f32,
    /// `clearcoat`; ignored where thin.
    clearcoat: f32,
    /// `clearcoat_gloss`.
    clearcoat_gloss: f32,
    /// `flatness`.
    flatness: f32,
    /// `diff_trans`, where thin: in [0, 2].
    diff_trans: f32,
    /// 1 where it is seen from the outside of its shape; where thin, both sides are alike.
    outside: u32,
}

/// Mitsuba's defaults.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, PrincipledParameters::default.
fn principled_parameters_default() -> PrincipledParameters {
    return PrincipledParameters(vec3f(0.5), 0.5, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1u);
}

/// The index of refraction that Mitsuba makes of `specular`: `2 / (1 - sqrt(0.08 s)) - 1`.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, PrincipledParameters::eta_of_specular.
fn principled_parameters_eta_of_specular(specular: f32) -> f32 {
    return 2.0 / (1.0 - sqrt(0.08 * specular)) - 1.0;
}

/// The parameters with shares outside [0, 1] clamped, and an index that bends: refraction has no density
/// where nothing is bent.
///
/// Twin: specula-bsdf/src/bsdf/principled/mod.rs, Principled::new.
fn principled_parameters_held(parameters: PrincipledParameters) -> PrincipledParameters {
    var p = parameters;
    p.base_colour = clamp(p.base_colour, vec3f(0.0), vec3f(1.0));
    p.roughness = clamp(p.roughness, 0.0, 1.0);
    p.anisotropic = clamp(p.anisotropic, 0.0, 1.0);
    p.metallic = clamp(p.metallic, 0.0, 1.0);
    p.spec_trans = clamp(p.spec_trans, 0.0, 1.0);
    let eta = clamp(p.eta, 0.1, 10.0);
    p.eta = select(eta, 1.001, abs(eta - 1.0) < 1e-3);
    p.spec_tint = clamp(p.spec_tint, 0.0, 1.0);
    p.sheen = clamp(p.sheen, 0.0, 1.0);
    p.sheen_tint = clamp(p.sheen_tint, 0.0, 1.0);
    p.clearcoat = clamp(p.clearcoat, 0.0, 1.0);
    p.clearcoat_gloss = clamp(p.clearcoat_gloss, 0.0, 1.0);
    p.flatness = clamp(p.flatness, 0.0, 1.0);
    p.diff_trans = clamp(p.diff_trans, 0.0, 2.0);
    return p;
}
