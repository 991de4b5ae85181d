// Samples of bounded caps with their densities, at small alphas: alpha, view, direction, density.
#include "specula.hpp"

#include <cstdio>
#include <initializer_list>

int main() {
    for (const float alpha : {1e-4f, 1e-3f, 0.1f}) {
        for (const float cosine : {1.0f, 0.7f, 0.05f}) {
            const float sine = sqrtf(1.0f - cosine * cosine);
            const specula::vec3f wo{0.6f * sine, 0.8f * sine, cosine};
            for (int i = 0; i < 64; ++i) {
                const float column = static_cast<float>(i % 8);
                const float row = static_cast<float>(i / 8);
                const specula::vec2f u{(column + 0.5f) / 8.0f, (row + 0.5f) / 8.0f};
                const specula::vec3f wi = specula::bounded_sample_direction({alpha, alpha}, wo, u);
                const float pdf = specula::bounded_reflection_pdf({alpha, alpha}, wo, wi);
                for (const float value : {alpha, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z, pdf}) {
                    std::printf("%.17g ", static_cast<double>(value));
                }
                std::printf("\n");
            }
        }
    }
}
