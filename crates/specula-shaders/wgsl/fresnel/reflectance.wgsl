// Reflectance of an opaque microfacet by one of the models, times a tint.
//
// Departure from the Rust source: a tinted reflectance is no kind of its own; every reflectance has a
// tint, and 1 is none.

import package::fresnel::conductor::{ConductorIor, conductor_eval, conductor_under};
import package::fresnel::f82::{f82_eval, f82_hump};
import package::fresnel::schlick::{schlick_eval};

/// The same at every angle.
const REFLECTANCE_CONSTANT: u32 = 0u;
/// Exact, for a complex index of refraction.
const REFLECTANCE_CONDUCTOR: u32 = 1u;
/// Schlick's approximation.
const REFLECTANCE_SCHLICK: u32 = 2u;
/// Schlick's approximation with a chosen colour at 82 degrees.
const REFLECTANCE_F82_TINT: u32 = 3u;

/// Reflectance by one of the models.
///
///     kind         first                     second
///     constant     the colour                -
///     conductor    real part of the index    imaginary part
///     schlick      at normal incidence       -
///     f82_tint     at normal incidence       the hump
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance.
struct ReflectanceModel {
    /// One of the constants above.
    kind: u32,
    /// See the table.
    first: vec3f,
    /// See the table.
    second: vec3f,
    /// Factor on it all.
    tint: vec3f,
}

/// The same at every angle.
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance::Constant.
fn reflectance_constant(colour: vec3f) -> ReflectanceModel {
    return ReflectanceModel(REFLECTANCE_CONSTANT, colour, vec3f(0.0), vec3f(1.0));
}

/// Exact, for a complex index of refraction relative to the outer medium.
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance::Conductor.
fn reflectance_conductor(eta: vec3f, k: vec3f) -> ReflectanceModel {
    return ReflectanceModel(REFLECTANCE_CONDUCTOR, eta, k, vec3f(1.0));
}

/// Schlick's approximation of the reflectance `normal` at normal incidence.
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance::Schlick.
fn reflectance_schlick(normal: vec3f) -> ReflectanceModel {
    return ReflectanceModel(REFLECTANCE_SCHLICK, normal, vec3f(0.0), vec3f(1.0));
}

/// Schlick's approximation with the factor `tint` at 82 degrees.
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance::F82Tint.
fn reflectance_f82_tint(normal: vec3f, tint: vec3f) -> ReflectanceModel {
    return ReflectanceModel(REFLECTANCE_F82_TINT, normal, f82_hump(normal, tint), vec3f(1.0));
}

/// The same reflectance times `tint`, in [0, 1].
///
/// Twin: specula-bsdf/src/fresnel/tinted.rs, Reflectance::tinted.
fn reflectance_tinted(reflectance: ReflectanceModel, tint: vec3f) -> ReflectanceModel {
    let f = reflectance;
    return ReflectanceModel(f.kind, f.first, f.second, f.tint * tint);
}

/// The same surface under a medium of index `eta` instead of vacuum, where an index is known.
///
/// Twin: specula-bsdf/src/fresnel/tinted.rs, Reflectance::under.
fn reflectance_under(reflectance: ReflectanceModel, eta: f32) -> ReflectanceModel {
    if reflectance.kind != REFLECTANCE_CONDUCTOR {
        return reflectance;
    }
    let metal_index = conductor_under(ConductorIor(reflectance.first, reflectance.second), eta);
    return ReflectanceModel(REFLECTANCE_CONDUCTOR, metal_index.eta, metal_index.k, reflectance.tint);
}

/// Reflectance at the cosine between the direction and the facet's normal, in [0, 1].
///
/// Twin: specula-bsdf/src/fresnel/mod.rs, Reflectance::eval.
fn reflectance_eval(reflectance: ReflectanceModel, cosine: f32) -> vec3f {
    let f = reflectance;
    switch f.kind {
        case REFLECTANCE_CONSTANT: {
            return f.first * f.tint;
        }
        case REFLECTANCE_CONDUCTOR: {
            return conductor_eval(ConductorIor(f.first, f.second), cosine) * f.tint;
        }
        case REFLECTANCE_SCHLICK: {
            return schlick_eval(f.first, cosine) * f.tint;
        }
        default: {
            return f82_eval(f.first, f.second, cosine) * f.tint;
        }
    }
}
