// A worked example of `specula export`: samples reflections off rough metal of reflectance 1.

#include "specula.metal"

// requests: for each sample two vectors: the view (unit, local, z up) with alpha, two uniform random
// numbers in [0, 1). results: for each sample the direction of the light, and `f cos / pdf`; 0 where it
// went below the surface.
kernel void sample_reflections(device const metal::float4* requests [[buffer(1)]],
                             device metal::float4* results [[buffer(2)]],
                             constant uint& count [[buffer(3)]],
                             uint index [[thread_position_in_grid]])
{
    if (index >= count) {
        return;
    }
    metal::float3 wo = requests[2 * index].xyz;
    metal::float2 alpha = requests[2 * index].ww;
    metal::float2 u = requests[2 * index + 1].xy;

    metal::float3 wi = bounded_sample_direction(alpha, wo, u);
    float pdf = bounded_reflection_pdf(alpha, wo, wi);
    if (pdf <= 0.0f) {
        results[index] = metal::float4(wi, 0.0f);
        return;
    }
    metal::float3 wm = metal::normalize(wo + wi);
    float masking = ggx_g2_over_cos(MASKING_HEIGHT_CORRELATED, alpha, wo, wi);
    float f_cos = 0.25f * ggx_d(alpha, wm) * masking;
    results[index] = metal::float4(wi, f_cos / pdf);
}
