// What every lobe samples and returns.
//
// Directions point away from the surface in the local frame (z up): `wo` towards the viewer, given;
// `wi` towards the light, sampled. A lobe is a structure with four functions:
//
//     <lobe>_eval(lobe, wo, wi, transport)      f(wo, wi) |cos theta_i| in 1/sr, without Dirac deltas
//     <lobe>_pdf(lobe, wo, wi)                  density with which a sample gives `wi`, in 1/sr
//     <lobe>_eval_pdf(lobe, wo, wi, transport)  both: (red, green, blue, density)
//     <lobe>_sample(lobe, wo, u, transport)       a direction; `u` independent and uniform in [0, 1):
//                                               `u.x` chooses among lobes, `u.y`, `u.z` the direction
//
// Departure from the Rust source: a sample that leads to no direction has no flags, where Rust returns
// `None`; event and specular are flags.

/// A sampled direction; it does not exist where `flags` is 0.
///
/// Twin: specula-bsdf/src/bsdf/mod.rs, BsdfSample.
struct BsdfSample {
    /// Towards the light, unit, local frame.
    wi: vec3f,
    /// Density in 1/sr; the probability of this direction where it is specular.
    pdf: f32,
    /// `f |cos theta_i| / pdf`, computed in the cancelled form, of the whole lobe.
    weight: vec3f,
    /// Index of refraction of the medium that `wi` runs in over that of `wo`; 1 for reflection.
    eta: f32,
    /// A sum of `BSDF_SAMPLE_VALID`, `BSDF_SAMPLE_TRANSMISSION` and `BSDF_SAMPLE_SPECULAR`.
    flags: u32,
}

/// The sample led to a direction.
const BSDF_SAMPLE_VALID: u32 = 1u;
/// `wi` lies on the other side than `wo`.
const BSDF_SAMPLE_TRANSMISSION: u32 = 2u;
/// The direction is one of a countable set: `eval` and `pdf` are 0 there.
const BSDF_SAMPLE_SPECULAR: u32 = 4u;

/// `wo` leads to the camera: radiance is scaled by `1 / eta^2` on refraction.
const BSDF_SAMPLE_RADIANCE: u32 = 0u;
/// `wo` leads to a light: importance is not scaled.
const BSDF_SAMPLE_IMPORTANCE: u32 = 1u;

/// Largest density of a sample that exists.
const BSDF_SAMPLE_LARGEST: f32 = 3.4e38;
/// A floor of divisors.
const BSDF_SAMPLE_TINY: f32 = 1.1754944e-38;

/// A sample that led to no direction.
///
/// Twin: Option::None.
fn bsdf_sample_none() -> BsdfSample {
    return BsdfSample(vec3f(0.0, 0.0, 1.0), 0.0, vec3f(0.0), 1.0, 0u);
}

/// A reflected sample; none below the horizon or where its density is not positive and finite.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, BsdfSample::reflected.
fn bsdf_sample_reflected(wi: vec3f, weight: vec3f, pdf: f32) -> BsdfSample {
    if wi.z > 0.0 && pdf > 0.0 && pdf <= BSDF_SAMPLE_LARGEST {
        return BsdfSample(wi, pdf, weight, 1.0, BSDF_SAMPLE_VALID);
    }
    return bsdf_sample_none();
}

/// A transmitted sample; none above the horizon or where its density is not positive and finite.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, BsdfSample::transmitted.
fn bsdf_sample_transmitted(wi: vec3f, weight: vec3f, pdf: f32, eta: f32) -> BsdfSample {
    if wi.z < 0.0 && pdf > 0.0 && pdf <= BSDF_SAMPLE_LARGEST {
        return BsdfSample(wi, pdf, weight, eta, BSDF_SAMPLE_VALID | BSDF_SAMPLE_TRANSMISSION);
    }
    return bsdf_sample_none();
}

/// A mirrored or refracted sample of the probability `pdf`.
///
/// * `event`: 0 or `BSDF_SAMPLE_TRANSMISSION`.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, BsdfSample::delta.
fn bsdf_sample_delta(wi: vec3f, weight: vec3f, pdf: f32, event: u32, eta: f32) -> BsdfSample {
    return BsdfSample(wi, pdf, weight, eta, BSDF_SAMPLE_VALID | BSDF_SAMPLE_SPECULAR | event);
}

/// A reflected sample of the value and density `value`; none as of `bsdf_sample_reflected`.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, BsdfSample::reflected, of `f_cos / pdf`.
fn bsdf_sample_of_reflection(wi: vec3f, value: vec4f) -> BsdfSample {
    return bsdf_sample_reflected(wi, value.rgb / max(value.a, BSDF_SAMPLE_TINY), value.a);
}

/// A transmitted sample of the value and density `value`; none as of `bsdf_sample_transmitted`.
///
/// Twin: specula-bsdf/src/bsdf/lambert.rs, BsdfSample::transmitted, of `f_cos / pdf`.
fn bsdf_sample_of_transmission(wi: vec3f, value: vec4f, eta: f32) -> BsdfSample {
    return bsdf_sample_transmitted(wi, value.rgb / max(value.a, BSDF_SAMPLE_TINY), value.a, eta);
}

/// What refraction does to what the path carries: radiance is compressed.
///
/// Twin: specula-bsdf/src/bsdf/compensated_dielectric.rs, radiance_scale.
fn bsdf_sample_radiance_scale(eta: f32, transport: u32) -> f32 {
    return select(1.0, 1.0 / (eta * eta), transport == BSDF_SAMPLE_RADIANCE);
}
