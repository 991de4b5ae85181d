// A worked example of `specula export`: samples reflections off rough metal of reflectance 1.

#include "specula.hlsl"

/// For each sample two vectors: the view (unit, local, z up) with alpha, two uniform random numbers in [0, 1).
StructuredBuffer<float4> requests : register(t1);
/// For each sample the direction of the light, and `f cos / pdf`; 0 where it went below the surface.
RWStructuredBuffer<float4> results : register(u0);

[numthreads(64, 1, 1)]
void main(uint3 invocation : SV_DispatchThreadID)
{
    uint count, stride;
    results.GetDimensions(count, stride);
    uint index = invocation.x;
    if (index >= count)
        return;
    float3 wo = requests[2 * index].xyz;
    float2 alpha = requests[2 * index].ww;
    float2 u = requests[2 * index + 1].xy;

    float3 wi = bounded_sample_direction(alpha, wo, u);
    float pdf = bounded_reflection_pdf(alpha, wo, wi);
    if (pdf <= 0.0) {
        results[index] = float4(wi, 0.0);
        return;
    }
    float3 wm = normalize(wo + wi);
    float masking = ggx_g2_over_cos(MASKING_HEIGHT_CORRELATED, alpha, wo, wi);
    float f_cos = 0.25 * ggx_d(alpha, wm) * masking;
    results[index] = float4(wi, f_cos / pdf);
}
