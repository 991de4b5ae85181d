// What lies under a coat.

import package::bsdf::bsdf_sample::{BsdfSample, BSDF_SAMPLE_RADIANCE};
import package::bsdf::lambert::{LambertLobe, lambert_sample, lambert_eval_pdf};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::bsdf::rough_conductor::{RoughConductor, rough_conductor_sample, rough_conductor_eval_pdf};
import package::bsdf::smooth_conductor::{SmoothConductor, smooth_conductor_sample};
import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval};
import package::math::stream::{StreamState, stream_next};

/// A mirror. Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::Mirror.
const LAYERED_BASE_MIRROR: u32 = 0u;
/// A rough metal, single scattering. Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::Metal.
const LAYERED_BASE_METAL: u32 = 1u;
/// Lambert. Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::Diffuse.
const LAYERED_BASE_DIFFUSE: u32 = 2u;

/// The lower surface of a layered material.
///
/// Twin: specula-bsdf/src/bsdf/layered/base.rs, Base.
struct LayeredBase {
    /// One of the `LAYERED_BASE` constants.
    kind: u32,
    /// Of a rough metal: its facets.
    facets: MicrofacetsModel,
    /// Of a metal: what a facet reflects, under the coat.
    reflectance: ReflectanceModel,
    /// Of a diffuse one, in [0, 1].
    albedo: vec3f,
}

/// Whether it is a mirror.
///
/// Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::is_mirror.
fn layered_base_is_mirror(base: LayeredBase) -> bool {
    return base.kind == LAYERED_BASE_MIRROR;
}

/// `f |cos|` and its density: (red, green, blue, density); zeros where smooth.
///
/// Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::eval_pdf.
fn layered_base_eval_pdf(base: LayeredBase, wo: vec3f, wi: vec3f) -> vec4f {
    if base.kind == LAYERED_BASE_METAL {
        let lobe = RoughConductor(base.facets, base.reflectance);
        return rough_conductor_eval_pdf(lobe, wo, wi, BSDF_SAMPLE_RADIANCE);
    }
    if base.kind == LAYERED_BASE_DIFFUSE {
        return lambert_eval_pdf(LambertLobe(base.albedo), wo, wi, BSDF_SAMPLE_RADIANCE);
    }
    return vec4f(0.0);
}

/// A direction, its weight and its density.
///
/// Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::sample.
fn layered_base_sample(base: LayeredBase, wo: vec3f, stream: ptr<function, StreamState>) -> BsdfSample {
    if base.kind == LAYERED_BASE_MIRROR {
        let mirror = SmoothConductor(base.reflectance);
        return smooth_conductor_sample(mirror, wo, vec3f(0.0), BSDF_SAMPLE_RADIANCE);
    }
    let first = stream_next(stream);
    let u = vec3f(0.0, first, stream_next(stream));
    if base.kind == LAYERED_BASE_METAL {
        let lobe = RoughConductor(base.facets, base.reflectance);
        return rough_conductor_sample(lobe, wo, u, BSDF_SAMPLE_RADIANCE);
    }
    return lambert_sample(LambertLobe(base.albedo), wo, u, BSDF_SAMPLE_RADIANCE);
}

/// Reflectance of a facet; of the whole where diffuse.
///
/// Twin: specula-bsdf/src/bsdf/layered/base.rs, Base::reflectance.
fn layered_base_reflectance(base: LayeredBase, cosine: f32) -> vec3f {
    if base.kind == LAYERED_BASE_DIFFUSE {
        return base.albedo;
    }
    return reflectance_eval(base.reflectance, cosine);
}
