// The dielectric on top: what passes it, and what it reflects from either side.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_TRANSMISSION, BsdfSample, BSDF_SAMPLE_IMPORTANCE, bsdf_sample_delta, bsdf_sample_radiance_scale};
import package::bsdf::microfacets::{MicrofacetsModel, microfacets_d_along, microfacets_g_over_cos};
import package::bsdf::rough_dielectric::{RoughDielectric, rough_dielectric_sample, rough_dielectric_sample_branch, rough_dielectric_eval_branch};
import package::bsdf::smooth_dielectric::{SmoothDielectric, smooth_dielectric_sample};
import package::bsdf::tints::{TintsPair};
import package::fresnel::dielectric::{dielectric};
import package::math::stream::{StreamState, stream_next};

/// An interface. Directions under it point down when they enter and up when they leave.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat.
struct LayeredCoat {
    /// Its facets where it is rough: height-correlated GGX, sampled by caps.
    facets: MicrofacetsModel,
    /// 1 where it is rough.
    rough: u32,
    /// Index under it over the index above.
    eta: f32,
}

/// A direction that was sampled.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, CoatSample.
struct LayeredCoatSample {
    /// Of travel.
    w: vec3f,
    /// `f |cos| / pdf`.
    weight: f32,
    /// In 1/sr; of no meaning where smooth.
    pdf: f32,
    /// Whether there is one.
    exists: bool,
}

/// The coat as a rough interface.
///
/// * `two_sided`: 1 where views from below are from inside, 0 where they are backfacing normals.
///
/// Twin: specula-bsdf/src/bsdf/dielectric.rs, RoughDielectric::new and RoughDielectric::facing.
fn layered_coat_rough(coat: LayeredCoat, two_sided: u32) -> RoughDielectric {
    return RoughDielectric(coat.facets, coat.eta, two_sided, TintsPair(vec3f(1.0), vec3f(1.0)));
}

/// `f |cos|` of light that is reflected from above, in 1/sr, without Dirac deltas.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::reflection.
fn layered_coat_reflection(coat: LayeredCoat, wo: vec3f, wi: vec3f) -> f32 {
    if coat.rough == 0u {
        return 0.0;
    }
    let half_vector = wo + wi;
    let squared = dot(half_vector, half_vector);
    let quarter = 0.25 * microfacets_d_along(coat.facets, half_vector, squared);
    let fresnel = dielectric(0.5 * sqrt(squared), coat.eta).reflectance;
    return fresnel * quarter * microfacets_g_over_cos(coat.facets, wo, wi);
}

/// The mirror image of `wo` as it is bent by a smooth surface. A view from behind (a backfacing shading
/// normal) enters as its mirror image does.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::below.
fn layered_coat_below(coat: LayeredCoat, wo: vec3f) -> vec3f {
    let inverse = 1.0 / coat.eta;
    let x = -wo.x * inverse;
    let y = -wo.y * inverse;
    return vec3f(x, y, sqrt(max(1.0 - x * x - y * y, 0.0)));
}

/// A way in for light that comes along `wo` (or that leaves along it, by the other transport).
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::enter.
fn layered_coat_enter(
    coat: LayeredCoat,
    wo: vec3f,
    transport: u32,
    stream: ptr<function, StreamState>,
) -> LayeredCoatSample {
    if coat.rough == 0u {
        let b = layered_coat_below(coat, wo);
        let passed = dielectric(abs(wo.z), coat.eta).transmittance;
        let scale = bsdf_sample_radiance_scale(coat.eta, transport);
        return LayeredCoatSample(vec3f(b.x, b.y, -b.z), passed * scale, 1.0, true);
    }
    let first = stream_next(stream);
    let u = vec2f(first, stream_next(stream));
    let sampled = rough_dielectric_sample_branch(layered_coat_rough(coat, 0u), wo, u, false, transport);
    return LayeredCoatSample(sampled.wi, sampled.weight.r, sampled.pdf, sampled.flags != 0u);
}

/// Light that travels up along `w`, reflected down.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::bounce.
fn layered_coat_bounce(coat: LayeredCoat, w: vec3f, stream: ptr<function, StreamState>) -> LayeredCoatSample {
    if coat.rough == 0u {
        let reflectance = dielectric(w.z, 1.0 / coat.eta).reflectance;
        return LayeredCoatSample(vec3f(w.x, w.y, -w.z), reflectance, 1.0, true);
    }
    let first = stream_next(stream);
    let u = vec2f(first, stream_next(stream));
    let lobe = layered_coat_rough(coat, 1u);
    let sampled = rough_dielectric_sample_branch(lobe, -w, u, true, BSDF_SAMPLE_IMPORTANCE);
    return LayeredCoatSample(sampled.wi, sampled.weight.r, sampled.pdf, sampled.flags != 0u);
}

/// `f(wo, -w)` of light along `wo` that enters, or of light that travels up along `w` and leaves, by the
/// other transport; and the density with which `layered_coat_enter` samples `-w`. Zeros where smooth.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::passes.
fn layered_coat_passes(coat: LayeredCoat, wo: vec3f, w: vec3f, transport: u32) -> vec2f {
    if coat.rough == 0u || w.z <= 0.0 {
        return vec2f(0.0);
    }
    let branch = rough_dielectric_eval_branch(layered_coat_rough(coat, 0u), wo, -w, transport);
    return vec2f(branch.x / w.z, branch.y);
}

/// What becomes of light from above: a reflection or a way in, sampled by what they carry.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::scatter_above.
fn layered_coat_scatter_above(coat: LayeredCoat, wo: vec3f, u: vec3f) -> BsdfSample {
    if coat.rough == 1u {
        return rough_dielectric_sample(layered_coat_rough(coat, 0u), wo, u, BSDF_SAMPLE_IMPORTANCE);
    }
    let bent = dielectric(abs(wo.z), coat.eta);
    let b = layered_coat_below(coat, wo);
    let up = vec3f(-wo.x, -wo.y, wo.z);
    let down = vec3f(b.x, b.y, -b.z);
    if wo.z <= 0.0 {
        // A mirror that faces away is not seen.
        let passed = vec3f(bent.transmittance);
        return bsdf_sample_delta(down, passed, 1.0, BSDF_SAMPLE_TRANSMISSION, 1.0);
    }
    if u.x < bent.reflectance {
        return bsdf_sample_delta(up, vec3f(1.0), bent.reflectance, 0u, 1.0);
    }
    return bsdf_sample_delta(down, vec3f(1.0), bent.transmittance, BSDF_SAMPLE_TRANSMISSION, 1.0);
}

/// What becomes of light that travels up along `w`.
///
/// Twin: specula-bsdf/src/bsdf/layered/coat.rs, Coat::scatter_below.
fn layered_coat_scatter_below(
    coat: LayeredCoat,
    w: vec3f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    let first = stream_next(stream);
    let second = stream_next(stream);
    let u = vec3f(first, second, stream_next(stream));
    if coat.rough == 1u {
        return rough_dielectric_sample(layered_coat_rough(coat, 1u), -w, u, BSDF_SAMPLE_IMPORTANCE);
    }
    let smooth_coat = SmoothDielectric(coat.eta, 1u, TintsPair(vec3f(1.0), vec3f(1.0)));
    return smooth_dielectric_sample(smooth_coat, -w, u, BSDF_SAMPLE_IMPORTANCE);
}
