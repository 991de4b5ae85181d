// Reflections off visible GGX normals by the sampler that is asked for.

import package::ndf::ggx::{ggx_projected_area_quotient};
import package::vndf::bounded::{bounded_norm_quotient, bounded_sample_direction};
import package::vndf::cap::{cap_sample_direction};
import package::vndf::exact::{exact_norm_quotient, exact_sample_direction};
import package::vndf::exact_isotropic::{exact_isotropic_norm_quotient, exact_isotropic_sample_direction};
import package::vndf::half_vector::{half_vector_density};
import package::vndf::heitz::{heitz_sample_wm};
import package::vndf::sampler::{SAMPLER_BOUNDED, SAMPLER_CAP, SAMPLER_HEITZ};

/// `wo` mirrored about `wm`, unit for unit arguments: `2 (wo . wm) wm - wo`.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, reflect.
fn reflection_mirrored(wo: vec3f, wm: vec3f) -> vec3f {
    return wm * (2.0 * dot(wo, wm)) - wo;
}

/// The reflection of `wo`, perhaps below the horizon (to be rejected).
///
/// * `strategy`: one of the samplers of `sampler`.
/// * `u`: uniform in [0, 1)^2, as the sampler's own function takes it.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, Ggx::sample_reflection.
fn reflection_sample_direction(strategy: u32, alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    switch strategy {
        case SAMPLER_HEITZ: {
            return reflection_mirrored(wo, heitz_sample_wm(alpha, wo, u));
        }
        case SAMPLER_CAP: {
            return cap_sample_direction(alpha, wo, u);
        }
        case SAMPLER_BOUNDED: {
            return bounded_sample_direction(alpha, wo, u);
        }
        default: {
            if alpha.x == alpha.y {
                return exact_isotropic_sample_direction(alpha.x, wo, u);
            }
            return exact_sample_direction(alpha, wo, u);
        }
    }
}

/// `N` of the density `D(wm) / (4 N)` above the horizon, as numerator and denominator.
///
/// * `strategy`: one of the samplers of `sampler`.
///
/// Twin: specula-bsdf/src/vndf/visible_normals.rs, Ggx::reflection_norm_quotient.
fn reflection_norm_quotient(strategy: u32, alpha: vec2f, wo: vec3f) -> vec2f {
    switch strategy {
        case SAMPLER_HEITZ, SAMPLER_CAP: {
            return ggx_projected_area_quotient(alpha, wo);
        }
        case SAMPLER_BOUNDED: {
            return bounded_norm_quotient(alpha, wo);
        }
        default: {
            if alpha.x == alpha.y {
                return exact_isotropic_norm_quotient(alpha.x, wo);
            }
            return exact_norm_quotient(alpha, wo);
        }
    }
}

/// Density of `reflection_sample_direction` in 1/sr; 0 where `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/exact/mod.rs, reflection_pdf, and those of the other samplers.
fn reflection_pdf(strategy: u32, alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(alpha, wo, wi, reflection_norm_quotient(strategy, alpha, wo));
}
