// A rough dielectric interface with all its bounces.
//
// Departure from the Rust source: the caller always passes a stream.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_SPECULAR, BSDF_SAMPLE_TRANSMISSION, BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none, bsdf_sample_radiance_scale, bsdf_sample_reflected, bsdf_sample_transmitted};
import package::bsdf::tints::{TintsPair};
import package::math::stream::{StreamState};
import package::multibounce::heitz_interface::{heitz_interface_sample, heitz_interface_eval};
import package::multibounce::mis_pdf::{mis_pdf_interface};
import package::multibounce::multibounce_interface::{MultibounceInterface, multibounce_interface_beyond, multibounce_interface_turned};
import package::multibounce::multibounce_model::{MULTIBOUNCE_MODEL_HEITZ};
import package::multibounce::normals::{NormalsModel};
import package::multibounce::stratified_bidirectional_interface::{stratified_bidirectional_interface_sample, stratified_bidirectional_interface_eval};

/// Reflection and refraction at a rough interface with every bounce between its facets, on both sides
/// of them. Values are estimates; no energy is lost.
///
/// `MULTIBOUNCE_MODEL_HEITZ` walks with heights; every other model here is
/// `MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL`, as the papers of the others treat metals only. Indices within 1e-3
/// of each other are taken as equal: light passes straight on.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric.
struct MultibounceDielectric {
    /// Distribution of its facets.
    normals: NormalsModel,
    /// Index inside (where two-sided) or beyond over that outside or on the side of `wo`, above 0.
    eta: f32,
    /// 1: `wo.z < 0` views it from inside. 0: `wo.z < 0` is a backfacing shading normal.
    two_sided: u32,
    /// One of the `MULTIBOUNCE_MODEL` constants.
    model: u32,
    /// One of the `MIS_PDF` constants.
    mis: u32,
    /// Factors on what leaves it on either side, however many bounces.
    tints: TintsPair,
}

/// Whether light passes straight on.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::is_index_matched.
fn multibounce_dielectric_is_index_matched(lobe: MultibounceDielectric) -> bool {
    return abs(lobe.eta - 1.0) < 1e-3;
}

/// Whether `wo` views the facets from inside, where z is turned.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::side.
fn multibounce_dielectric_is_turned(lobe: MultibounceDielectric, wo: vec3f) -> bool {
    return lobe.two_sided == 1u && wo.z < 0.0;
}

/// The facets from the side that a view is on.
///
/// * `is_turned`: whether that is inside.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::side.
fn multibounce_dielectric_side(lobe: MultibounceDielectric, is_turned: bool) -> MultibounceInterface {
    let outside = MultibounceInterface(lobe.normals, lobe.eta);
    if is_turned {
        return multibounce_interface_beyond(outside);
    }
    return outside;
}

/// A vector to the frame of that side, or back.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::eval_pdf_random.
fn multibounce_dielectric_upright(is_turned: bool, w: vec3f) -> vec3f {
    return select(w, multibounce_interface_turned(w), is_turned);
}

/// The density for multiple importance sampling, over the sphere, in 1/sr.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::pdf.
fn multibounce_dielectric_pdf(lobe: MultibounceDielectric, wo: vec3f, wi: vec3f) -> f32 {
    if multibounce_dielectric_is_index_matched(lobe) || wi.z == 0.0 {
        return 0.0;
    }
    let is_turned = multibounce_dielectric_is_turned(lobe, wo);
    let side = multibounce_dielectric_side(lobe, is_turned);
    let view = multibounce_dielectric_upright(is_turned, wo);
    return mis_pdf_interface(lobe.mis, side, view, multibounce_dielectric_upright(is_turned, wi));
}

/// An estimate of `f |cos|`.
///
/// * `transport`: `BSDF_SAMPLE_RADIANCE` or `BSDF_SAMPLE_IMPORTANCE`.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::eval_pdf_random.
fn multibounce_dielectric_eval(
    lobe: MultibounceDielectric,
    wo: vec3f,
    wi: vec3f,
    transport: u32,
    stream: ptr<function, StreamState>,
) -> vec3f {
    if multibounce_dielectric_is_index_matched(lobe) || wi.z == 0.0 {
        return vec3f(0.0);
    }
    let is_turned = multibounce_dielectric_is_turned(lobe, wo);
    let side = multibounce_dielectric_side(lobe, is_turned);
    let view = multibounce_dielectric_upright(is_turned, wo);
    let light = multibounce_dielectric_upright(is_turned, wi);
    var f_cos = 0.0;
    if lobe.model == MULTIBOUNCE_MODEL_HEITZ {
        f_cos = heitz_interface_eval(side, view, light, stream);
    } else {
        f_cos = stratified_bidirectional_interface_eval(side, view, light, stream);
    }
    if light.z < 0.0 {
        return lobe.tints.transmission * (f_cos * bsdf_sample_radiance_scale(side.eta, transport));
    }
    return lobe.tints.reflection * f_cos;
}

/// An estimate of `f |cos|` and the density: (red, green, blue, density).
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::eval_pdf_random.
fn multibounce_dielectric_eval_pdf(
    lobe: MultibounceDielectric,
    wo: vec3f,
    wi: vec3f,
    transport: u32,
    stream: ptr<function, StreamState>,
) -> vec4f {
    let value = multibounce_dielectric_eval(lobe, wo, wi, transport, stream);
    return vec4f(value, multibounce_dielectric_pdf(lobe, wo, wi));
}

/// A direction of the model's walk with the density of multiple importance sampling.
///
/// * `u`: samples reflection or refraction (x), and the first facet.
///
/// Twin: specula-bsdf/src/bsdf/multibounce_dielectric.rs, MultibounceDielectric::sample_random.
fn multibounce_dielectric_sample(
    lobe: MultibounceDielectric,
    wo: vec3f,
    u: vec3f,
    transport: u32,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    if multibounce_dielectric_is_index_matched(lobe) {
        let flags = BSDF_SAMPLE_VALID | BSDF_SAMPLE_TRANSMISSION | BSDF_SAMPLE_SPECULAR;
        return BsdfSample(-wo, 1.0, lobe.tints.transmission, 1.0, flags);
    }
    let is_turned = multibounce_dielectric_is_turned(lobe, wo);
    let side = multibounce_dielectric_side(lobe, is_turned);
    let view = multibounce_dielectric_upright(is_turned, wo);
    var left: BsdfSample;
    if lobe.model == MULTIBOUNCE_MODEL_HEITZ {
        left = heitz_interface_sample(side, view, u, stream);
    } else {
        left = stratified_bidirectional_interface_sample(side, view, u, stream);
    }
    if left.flags == 0u {
        return bsdf_sample_none();
    }
    let pdf = mis_pdf_interface(lobe.mis, side, view, left.wi);
    var found: BsdfSample;
    if left.wi.z > 0.0 {
        found = bsdf_sample_reflected(left.wi, lobe.tints.reflection, pdf);
    } else {
        let scale = bsdf_sample_radiance_scale(side.eta, transport);
        found = bsdf_sample_transmitted(left.wi, lobe.tints.transmission * scale, pdf, side.eta);
    }
    found.wi = multibounce_dielectric_upright(is_turned, found.wi);
    return found;
}
