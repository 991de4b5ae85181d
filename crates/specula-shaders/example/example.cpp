// A worked example of `specula export`: the albedo of rough gold from three views, by sampling.
//
//     g++ -std=c++17 -O2 example.cpp -o example

#include <cstdio>

#include "specula.hpp"

/// A linear congruential generator: uniform in [0, 1).
static float uniform(uint32_t& state) {
    state = 1664525u * state + 1013904223u;
    return static_cast<float>(state >> 8u) * 5.9604645e-8f;
}

int main() {
    using namespace specula;
    const vec3f eta{0.143f, 0.375f, 1.442f};
    const vec3f k{3.983f, 2.386f, 1.603f};
    const MicrofacetsModel facets{vec2f(0.3f), DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_BOUNDED};
    const RoughConductor gold{facets, reflectance_conductor(eta, k)};

    const vec3f views[3] = {{0.0f, 0.0f, 1.0f}, {0.8f, 0.0f, 0.6f}, {0.96f, 0.0f, 0.28f}};
    const uint32_t samples = 65536u;
    uint32_t state = 1u;
    for (const vec3f wo : views) {
        vec3f sum{0.0f};
        for (uint32_t i = 0u; i < samples; i++) {
            const float first = uniform(state);
            const vec3f u{0.0f, first, uniform(state)};
            const BsdfSample sampled = rough_conductor_sample(gold, wo, u, BSDF_SAMPLE_RADIANCE);
            if (sampled.flags != 0u) {
                sum += sampled.weight;
            }
        }
        const vec3f albedo = sum / static_cast<float>(samples);
        std::printf("%.4f %.4f %.4f\n", double(albedo.x), double(albedo.y), double(albedo.z));
    }
}
