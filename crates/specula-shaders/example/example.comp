#version 450
#extension GL_GOOGLE_include_directive : require

// A worked example of `specula export`: samples reflections off rough metal of reflectance 1.

#include "specula.glsl"

layout(local_size_x = 64) in;

/// For each sample two vectors: the view (unit, local, z up) with alpha, two uniform random numbers in [0, 1).
layout(std430, binding = 1) readonly buffer Requests {
    vec4 requests[];
};
/// For each sample the direction of the light, and `f cos / pdf`; 0 where it went below the surface.
layout(std430, binding = 2) writeonly buffer Results {
    vec4 results[];
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(results.length())) {
        return;
    }
    vec3 wo = requests[2u * index].xyz;
    vec2 alpha = requests[2u * index].ww;
    vec2 u = requests[2u * index + 1u].xy;

    vec3 wi = bounded_sample_direction(alpha, wo, u);
    float pdf = bounded_reflection_pdf(alpha, wo, wi);
    if (pdf <= 0.0) {
        results[index] = vec4(wi, 0.0);
        return;
    }
    vec3 wm = normalize(wo + wi);
    float masking = ggx_g2_over_cos(MASKING_HEIGHT_CORRELATED, alpha, wo, wi);
    float f_cos = 0.25 * ggx_d(alpha, wm) * masking;
    results[index] = vec4(wi, f_cos / pdf);
}
