// Sheen by the Charlie distribution, with its scaling of what lies below: `KHR_materials_sheen`.
//
//     f = colour D(wm) / ((1 + L(wo) + L(wi)) 4 |wo.z| |wi.z|)
//     D(wm) = (2 + 1/r) sin^(1/r) / (2 pi)
//
// Source: Estevez and Kulla 2017, eqs. 2 to 4.

import package::bsdf::gltf_albedo::{GLTF_ALBEDO_LEAST_ROUGHNESS, gltf_albedo_sheen, gltf_albedo_sheen_stencil};
import package::energy::stencil::{StencilWeights};
import package::math::rgb::{rgb_max_channel};

/// `1 / (2 pi)`.
const GLTF_SHEEN_PER_TURN: f32 = 0.15915494309190;

/// Fibres that stand on a surface.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, Sheen.
struct GltfSheen {
    /// In [0, 1].
    colour: vec3f,
    /// At least 0.07.
    roughness: f32,
    /// The albedo's table at this roughness.
    stencil: StencilWeights,
}

/// The sheen of a colour and roughness.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, Sheen::new.
fn gltf_sheen_new(colour: vec3f, roughness: f32) -> GltfSheen {
    let held = max(roughness, GLTF_ALBEDO_LEAST_ROUGHNESS);
    return GltfSheen(colour, held, gltf_albedo_sheen_stencil(held));
}

/// The fit `a / (1 + b x^c) + d x + e` of the paper's table 1.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, fitted.
fn gltf_sheen_fitted(x: f32, roughness: f32) -> f32 {
    let fine = (1.0 - roughness) * (1.0 - roughness);
    let a = 21.5473 + (25.3245 - 21.5473) * fine;
    let b = 3.82987 + (3.32435 - 3.82987) * fine;
    let c = 0.19823 + (0.16801 - 0.19823) * fine;
    let d = -1.97760 + (-1.27393 + 1.97760) * fine;
    let e = -4.32054 + (-4.85967 + 4.32054) * fine;
    let power = exp(log(max(x, 1e-30)) * c);
    return a / (1.0 + b * power) + d * x + e;
}

/// Masking of the fibres.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, lambda.
fn gltf_sheen_lambda(cosine: f32, roughness: f32) -> f32 {
    if cosine < 0.5 {
        return exp(gltf_sheen_fitted(cosine, roughness));
    }
    return exp(2.0 * gltf_sheen_fitted(0.5, roughness) - gltf_sheen_fitted(1.0 - cosine, roughness));
}

/// `f |wi.z|` of white sheen, finite at grazing views.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, charlie_f_cos.
fn gltf_sheen_charlie_f_cos(roughness: f32, wo: vec3f, wi: vec3f, wm: vec3f) -> f32 {
    let inverse = 1.0 / roughness;
    let squared = min(wm.x * wm.x + wm.y * wm.y, 1.0);
    // sin^(1/r); exp and log of a floor that is 0 for every roughness here.
    let power = exp(log(max(squared, 1e-30)) * (0.5 * inverse));
    let d = (2.0 + inverse) * power * GLTF_SHEEN_PER_TURN;
    // Finite at grazing angles, the same way for both directions.
    let cos_o = max(abs(wo.z), 1e-4);
    let cos_i = max(abs(wi.z), 1e-4);
    let masking = 1.0 + gltf_sheen_lambda(cos_o, roughness) + gltf_sheen_lambda(cos_i, roughness);
    return d * abs(wi.z) / (masking * 4.0 * cos_o * cos_i);
}

/// The share of light that reaches the base from `wo` and leaves to `wi`.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, Sheen::left.
fn gltf_sheen_left(sheen: GltfSheen, wo: vec3f, wi: vec3f) -> f32 {
    let most = max(gltf_albedo_sheen(sheen.stencil, abs(wo.z)), gltf_albedo_sheen(sheen.stencil, abs(wi.z)));
    return max(1.0 - rgb_max_channel(sheen.colour) * most, 0.0);
}

/// The largest channel of the albedo from `wo`.
///
/// Twin: specula-bsdf/src/bsdf/gltf/sheen.rs, Sheen::strength.
fn gltf_sheen_strength(sheen: GltfSheen, wo: vec3f) -> f32 {
    return rgb_max_channel(sheen.colour) * gltf_albedo_sheen(sheen.stencil, abs(wo.z));
}
