// Cosine-averaged reflectance, the `F_avg` of multiple scattering.

import package::fresnel::conductor::{ConductorIor, conductor_eval};
import package::fresnel::reflectance::{REFLECTANCE_CONSTANT, REFLECTANCE_SCHLICK, ReflectanceModel, reflectance_eval};

/// `2 int_0^1 F(mu) mu dmu` per channel.
///
///     constant   F
///     Schlick    F0 + (1 - F0) / 21
///     others     Gauss and Jacobi's five points of the weight mu
///
/// The rule's error is below 1e-3 for measured metals and F82.
///
/// Twin: specula-bsdf/src/energy/fresnel_average.rs, reflectance_average.
fn fresnel_average_of(reflectance: ReflectanceModel) -> vec3f {
    if reflectance.kind == REFLECTANCE_CONSTANT {
        return reflectance.first * reflectance.tint;
    }
    if reflectance.kind == REFLECTANCE_SCHLICK {
        let normal = reflectance.first;
        return (normal + (vec3f(1.0) - normal) * (1.0 / 21.0)) * reflectance.tint;
    }
    return reflectance_eval(reflectance, 0.098535085798826) * 0.031495829043385
        + reflectance_eval(reflectance, 0.304535726646364) * 0.147817740145233
        + reflectance_eval(reflectance, 0.562025189752614) * 0.292773974169339
        + reflectance_eval(reflectance, 0.801986582126392) * 0.334349276188739
        + reflectance_eval(reflectance, 0.960190142948531) * 0.193563180453303;
}

/// The same of an untinted conductor alone.
///
/// Twin: specula-bsdf/src/energy/fresnel_average.rs, reflectance_average, of a conductor.
fn fresnel_average_conductor(conductor: ConductorIor) -> vec3f {
    return conductor_eval(conductor, 0.098535085798826) * 0.031495829043385
        + conductor_eval(conductor, 0.304535726646364) * 0.147817740145233
        + conductor_eval(conductor, 0.562025189752614) * 0.292773974169339
        + conductor_eval(conductor, 0.801986582126392) * 0.334349276188739
        + conductor_eval(conductor, 0.960190142948531) * 0.193563180453303;
}
