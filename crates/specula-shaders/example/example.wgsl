// A worked example of `specula export`: samples reflections off rough metal of reflectance 1.
//
// Put `specula.wgsl` in front of this text: WGSL has no include.

/// For each sample two vectors: the view (unit, local, z up) with alpha, two uniform random numbers in [0, 1).
@group(0) @binding(1) var<storage, read> requests: array<vec4f>;
/// For each sample the direction of the light, and `f cos / pdf`; 0 where it went below the surface.
@group(0) @binding(2) var<storage, read_write> results: array<vec4f>;

@compute @workgroup_size(64)
fn sample_reflections(@builtin(global_invocation_id) invocation: vec3u) {
    let index = invocation.x;
    if index >= arrayLength(&results) {
        return;
    }
    let wo = requests[2u * index].xyz;
    let alpha = requests[2u * index].ww;
    let u = requests[2u * index + 1u].xy;

    let wi = bounded_sample_direction(alpha, wo, u);
    let pdf = bounded_reflection_pdf(alpha, wo, wi);
    if pdf <= 0.0 {
        results[index] = vec4f(wi, 0.0);
        return;
    }
    let wm = normalize(wo + wi);
    let masking = ggx_g2_over_cos(MASKING_HEIGHT_CORRELATED, alpha, wo, wi);
    let f_cos = 0.25 * ggx_d(alpha, wm) * masking;
    results[index] = vec4f(wi, f_cos / pdf);
}
