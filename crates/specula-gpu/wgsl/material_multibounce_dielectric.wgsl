// Glass whose bounces are simulated.
//
// Twin of specula-render/src/material/{bind,rough}.rs.

import tracer::bound::{Bound, Parameters, bound_distribution, bound_only};
import tracer::glass::{glass_bind, glass_tints, glass_smooth};
import package::math::stream::{StreamState};
import package::multibounce::normals::{NormalsModel};
import package::multibounce::multibounce_dielectric::{MultibounceDielectric};
import package::multibounce::multibounce_dielectric::{multibounce_dielectric_eval_pdf};
import package::multibounce::multibounce_dielectric::{multibounce_dielectric_sample};
import package::bsdf::smooth_dielectric::{smooth_dielectric_sample};
import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};

/// Binds the parameters at a point: those of `glass_bind`.
fn material_multibounce_dielectric_bind(head: Bound, p: Parameters, outside: bool) -> Bound {
    return glass_bind(head, p, outside);
}

/// The lobe of a rough surface.
fn material_multibounce_dielectric_lobe(b: Bound) -> MultibounceDielectric {
    let normals = NormalsModel(b.alpha, bound_distribution(b));
    let model = bound_only(ONLY_DIELECTRIC_BOUNCES, b.energy);
    return MultibounceDielectric(normals, b.eta, 0u, model, BOUNCES_PDF, glass_tints(b));
}

/// `f |cos|`, and the density of `wi` in 1/sr.
fn material_multibounce_dielectric_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {
    if b.specular {
        return vec4f(0.0);
    }
    var random = StreamState(stream);
    let lobe = material_multibounce_dielectric_lobe(b);
    return multibounce_dielectric_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE, &random);
}

/// Samples a direction.
fn material_multibounce_dielectric_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {
    if b.specular {
        return smooth_dielectric_sample(glass_smooth(b), wo, u, BSDF_SAMPLE_RADIANCE);
    }
    var random = StreamState(stream);
    let lobe = material_multibounce_dielectric_lobe(b);
    return multibounce_dielectric_sample(lobe, wo, u, BSDF_SAMPLE_RADIANCE, &random);
}

/// Albedo, as a feature for denoisers.
fn material_multibounce_dielectric_albedo(b: Bound) -> vec3f {
    return vec3f(1.0);
}
