// The library's rough reflection: what is called here is taken from the exported shaders.
// parameters.xy: alpha along x and y.

fn user_eval(wo: vec3f, wi: vec3f) -> vec3f {
    if wo.z <= 0.0 || wi.z <= 0.0 {
        return vec3f(0.0);
    }
    let m = normalize(wo + wi);
    let masking = ggx_g_correlated(parameters.xy, wo, wi);
    return vec3f(ggx_d(parameters.xy, m) * masking / (4.0 * wo.z));
}

fn user_pdf(wo: vec3f, wi: vec3f) -> f32 {
    return bounded_reflection_pdf(parameters.xy, wo, wi);
}

fn user_sample(wo: vec3f, u: vec3f) -> vec4f {
    let wi = bounded_sample_direction(parameters.xy, wo, u.xy);
    return vec4f(wi, user_pdf(wo, wi));
}
