// Directional albedos of glTF's layers, so that what lies below gets no more than they leave.
//
//     A(wo) = int D G2 / (4 |wo.z|) dwi                        what white facets reflect at once
//     q(wo) = mean of (1 - wo.wm)^5 over that light
//     H(wo) = 1/pi int (1 - wo.h)^5 cos dwi                    over half vectors of diffuse light
//     E = A (w f0 + w (1 - f0) q),    B = 1 - w f0 - w (1 - f0) H
//
// `A` is that of `albedo`. `q` and the sheen's albedo are tables, cubic in `sqrt(mu)` and in `sqrt(alpha)` or
// the sheen's roughness. They are read with a margin of their largest error, less towards normal incidence,
// so that errors cost light rather than make it. `q` of an anisotropic surface is taken at the alpha along
// the view.

import package::energy::albedo::{AlbedoLoss, albedo_directional_loss, albedo_loss};
import package::energy::energy_table::{energy_table};
import package::energy::stencil::{StencilWeights, stencil_at};
import package::ndf::distribution::{DISTRIBUTION_GGX};
import package::ndf::masking::{MASKING_HEIGHT_CORRELATED};

/// Knots along the alpha.
const GLTF_ALBEDO_ALPHAS: u32 = 16u;
/// Knots along the sheen's roughness.
const GLTF_ALBEDO_ROUGHNESSES: u32 = 12u;
/// Knots along the cosine.
const GLTF_ALBEDO_MUS: u32 = 24u;
/// Where `q` by alpha and cosine begins.
const GLTF_ALBEDO_SCHLICK_START: u32 = 923392u;
/// Where the sheen's albedo by roughness and cosine begins.
const GLTF_ALBEDO_SHEEN_START: u32 = 923776u;
/// Largest error of the tables.
const GLTF_ALBEDO_MARGIN: f32 = 4e-3;
/// Least roughness of sheen: below, its fitted masking reflects more than arrives.
const GLTF_ALBEDO_LEAST_ROUGHNESS: f32 = 0.07;

/// The albedo of a dielectric layer, as far as it concerns the diffuse base.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, LayerAlbedo.
struct GltfAlbedoLayer {
    /// Alphas of the layer's facets.
    alpha: vec2f,
    /// `1 - A`.
    loss: AlbedoLoss,
    /// `w f0` of the brightest channel.
    normal: f32,
    /// `w (1 - f0)` of the brightest channel.
    rise: f32,
}

/// The layer of these alphas.
///
/// * `normal`, `grazing`: largest reflectances at normal and at grazing incidence.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, LayerAlbedo::new.
fn gltf_albedo_layer(alpha: vec2f, normal: f32, grazing: f32) -> GltfAlbedoLayer {
    let loss = albedo_loss(DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, alpha);
    return GltfAlbedoLayer(alpha, loss, normal, grazing - normal);
}

/// The sum of a table of rows by knots of a place and of cosines.
///
/// Twin: specula-bsdf/src/energy/stencil.rs, Stencil::sum, twice.
fn gltf_albedo_sum(start: u32, place: StencilWeights, mu: f32) -> f32 {
    let m = stencil_at(sqrt(mu), GLTF_ALBEDO_MUS);
    var sum = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let first = start + (place.first + i) * GLTF_ALBEDO_MUS + m.first;
        let values = vec4f(energy_table(first), energy_table(first + 1u), energy_table(first + 2u), energy_table(first + 3u));
        sum += place.weights[i] * dot(m.weights, values);
    }
    return sum;
}

/// `q` of the cosine `mu`.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, schlick.
fn gltf_albedo_schlick(alpha: f32, mu: f32) -> f32 {
    return gltf_albedo_sum(GLTF_ALBEDO_SCHLICK_START, stencil_at(sqrt(alpha), GLTF_ALBEDO_ALPHAS), mu);
}

/// `H` of the cosine `mu`: a least-squares fit, absolute error 9e-6.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, half_vectors.
fn gltf_albedo_half_vectors(mu: f32) -> f32 {
    return (((0.008978 * mu - 0.043663) * mu + 0.086456) * mu - 0.079853) * mu + 0.028164;
}

/// Alpha along the view.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, LayerAlbedo::alpha_along.
fn gltf_albedo_alpha_along(alpha: vec2f, w: vec3f) -> f32 {
    let along = w.xy * w.xy;
    let spread = dot(alpha * alpha, along);
    let sum = along.x + along.y;
    return sqrt(select(alpha.x * alpha.y, spread / max(sum, 1e-12), sum > 1e-12));
}

/// `min(1, (1 - E) / B)`: what of the diffuse base is not too much.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, LayerAlbedo::limit.
fn gltf_albedo_limit(layer: GltfAlbedoLayer, w: vec3f) -> f32 {
    let mu = min(abs(w.z), 1.0);
    let whole = 1.0 - albedo_directional_loss(layer.loss, w);
    let q = gltf_albedo_schlick(gltf_albedo_alpha_along(layer.alpha, w), mu) + GLTF_ALBEDO_MARGIN * (1.0 - mu);
    let leaves = max(1.0 - whole * (layer.normal + layer.rise * q), 0.0);
    let wanted = 1.0 - layer.normal - layer.rise * gltf_albedo_half_vectors(mu);
    if leaves < wanted {
        return leaves / wanted;
    }
    return 1.0;
}

/// Where a roughness of sheen, at least 0.07, lies in its table.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, sheen_stencil.
fn gltf_albedo_sheen_stencil(roughness: f32) -> StencilWeights {
    let share = (roughness - GLTF_ALBEDO_LEAST_ROUGHNESS) / (1.0 - GLTF_ALBEDO_LEAST_ROUGHNESS);
    return stencil_at(sqrt(max(share, 0.0)), GLTF_ALBEDO_ROUGHNESSES);
}

/// Albedo of white sheen at the cosine `mu`, with the margin.
///
/// Twin: specula-bsdf/src/bsdf/gltf/albedo.rs, sheen.
fn gltf_albedo_sheen(roughness: StencilWeights, mu: f32) -> f32 {
    let sum = gltf_albedo_sum(GLTF_ALBEDO_SHEEN_START, roughness, mu);
    return clamp(sum + GLTF_ALBEDO_MARGIN * (1.0 - mu), 0.0, 1.0);
}
