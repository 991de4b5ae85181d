// Materials whose alphas grow by what a normal map's filter averages away.
//
// Twin of specula-render/src/material/bind.rs, where its `PointParameters` have a `widening`.

import tracer::bound::{Bound, BOUND_SMOOTH_BELOW, bound_unit, bound_unit_roughness};
import tracer::slopes::{SlopesWidening, slopes_widened, slopes_widened_isotropic, slopes_widened_own_coat};

/// Most parameters that a scene's materials store, less one.
const WIDENED_LAST: u32 = BOUND_STORED - 1u;

/// The index of a stored parameter; of scenes whose materials store none, one that there is.
fn widened_index(i: u32) -> u32 {
    return min(i, WIDENED_LAST);
}

/// The alphas by which the frame of a material's lobes is chosen, along its axes; 0 where it is smooth or has none.
///
/// Twin: specula-render/src/material/bind.rs, alphas.
fn widened_alphas(b: Bound) -> vec2f {
    if b.kind == KIND_GLTF {
        let regularized = (b.variant & 8u) != 0u;
        let roughness = bound_unit_roughness(b.stored[widened_index(4u)], regularized);
        return widened_gltf_alphas(roughness, bound_unit(b.stored[widened_index(5u)]));
    }
    if b.kind == KIND_PRINCIPLED {
        let regularized = (b.variant & 4u) != 0u;
        let roughness = bound_unit_roughness(b.stored[widened_index(1u)], regularized);
        return widened_principled_alphas(roughness, bound_unit(b.stored[widened_index(2u)]));
    }
    if b.kind == KIND_LAYERED && b.variant != 8u && b.alpha.x == b.alpha.y {
        return b.stored[widened_index(5u)].xy;
    }
    return b.alpha;
}

/// The material with alphas that have grown.
fn widened_bound(b: Bound, w: SlopesWidening) -> Bound {
    var wide = b;
    switch b.kind {
        case KIND_GLTF: {
            let regularized = (b.variant & 8u) != 0u;
            let alphas = slopes_widened(w, widened_alphas(b));
            let base = widened_gltf_roughness(alphas);
            wide.stored[widened_index(4u)] = vec3f(base.x);
            wide.stored[widened_index(5u)] = vec3f(base.y);
            let coat = bound_unit_roughness(b.stored[widened_index(9u)], regularized);
            let alpha = slopes_widened_own_coat(w, coat * coat);
            wide.stored[widened_index(9u)] = vec3f(min(sqrt(alpha), 1.0));
            wide.variant &= ~8u;
        }
        case KIND_PRINCIPLED: {
            let regularized = (b.variant & 4u) != 0u;
            let base = widened_principled_roughness(slopes_widened(w, widened_alphas(b)));
            wide.stored[widened_index(1u)] = vec3f(base.x);
            wide.stored[widened_index(2u)] = vec3f(base.y);
            let gloss = select(bound_unit(b.stored[widened_index(9u)]), 0.0, regularized);
            let coat = slopes_widened_isotropic(w, 0.1 + (0.001 - 0.1) * gloss);
            wide.stored[widened_index(9u)] = vec3f(widened_coat_gloss(coat));
            wide.variant &= ~4u;
        }
        case KIND_LAYERED: {
            wide.alpha = widened_rough(w, b.alpha);
            var is_smooth = wide.alpha.x == 0.0;
            if b.variant != 8u {
                let base = widened_rough(w, b.stored[widened_index(5u)].xy);
                wide.stored[widened_index(5u)] = vec3f(base, 0.0);
                is_smooth = is_smooth && base.x == 0.0;
            }
            wide.specular = b.specular && is_smooth;
        }
        case KIND_CONDUCTOR, KIND_COMPENSATED_CONDUCTOR, KIND_MULTIBOUNCE_CONDUCTOR: {
            wide.alpha = widened_rough(w, b.alpha);
            wide.specular = wide.alpha.x == 0.0;
            wide.variant = (b.variant & 3u) + select(4u, 0u, wide.specular);
        }
        case KIND_DIELECTRIC, KIND_COMPENSATED_DIELECTRIC, KIND_MULTIBOUNCE_DIELECTRIC: {
            wide.alpha = widened_rough(w, b.alpha);
            // As glass_bind has it: with equal indices nothing is bent.
            wide.specular = wide.alpha.x == 0.0 || abs(b.eta - 1.0) <= 1.0e-4;
        }
        case KIND_COATED_DIFFUSE, KIND_PLASTIC: {
            wide.alpha = widened_rough(w, b.alpha);
        }
        default: {}
    }
    return wide;
}

/// The grown alphas; 0 where the surface is still smooth.
///
/// Twin: specula-render/src/slopes.rs, Widening::of_rough.
fn widened_rough(w: SlopesWidening, alphas: vec2f) -> vec2f {
    let r = slopes_widened(w, alphas);
    let is_rough = r.x >= BOUND_SMOOTH_BELOW || r.y >= BOUND_SMOOTH_BELOW;
    return select(vec2f(0.0), clamp(r, vec2f(BOUND_SMOOTH_BELOW), vec2f(10.0)), is_rough);
}

/// Alphas of glTF's base layer; the longer one is the first.
///
/// Twin: specula-render/src/material/bind.rs, gltf_alphas.
fn widened_gltf_alphas(roughness: f32, anisotropy: f32) -> vec2f {
    let alpha = roughness * roughness;
    return vec2f(alpha + (1.0 - alpha) * anisotropy * anisotropy, alpha);
}

/// The roughness and the anisotropy of glTF's base layer with these alphas, or the nearest that it has.
///
/// Twin: specula-render/src/material/bind.rs, gltf_roughness.
fn widened_gltf_roughness(alphas: vec2f) -> vec2f {
    let a = min(alphas, vec2f(1.0));
    let anisotropy = clamp((a.x - a.y) / max(1.0 - a.y, 1.0e-6), 0.0, 1.0);
    return sqrt(vec2f(a.y, anisotropy));
}

/// Alphas of the principled materials' base; the longer one is the first.
///
/// Twin: specula-render/src/material/bind.rs, principled_alphas.
fn widened_principled_alphas(roughness: f32, anisotropic: f32) -> vec2f {
    let alpha = roughness * roughness;
    let aspect = sqrt(1.0 - 0.9 * anisotropic);
    return vec2f(alpha / aspect, alpha * aspect);
}

/// The roughness and the anisotropy of the principled materials' base with these alphas.
///
/// Twin: specula-render/src/material/bind.rs, principled_roughness.
fn widened_principled_roughness(alphas: vec2f) -> vec2f {
    let squared_aspect = clamp(alphas.y / max(alphas.x, 1.0e-9), 0.1, 1.0);
    let alpha = min(alphas.x * sqrt(squared_aspect), 1.0);
    return vec2f(sqrt(alpha), (1.0 - squared_aspect) / 0.9);
}

/// The gloss of the principled materials' clear coat with an alpha, or the nearest that it has.
///
/// Twin: specula-render/src/material/bind.rs, coat_gloss.
fn widened_coat_gloss(alpha: f32) -> f32 {
    return clamp((0.1 - alpha) / (0.1 - 0.001), 0.0, 1.0);
}
