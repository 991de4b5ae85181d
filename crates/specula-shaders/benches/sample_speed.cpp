// Nanoseconds per sample of rough metal in C++, one line per sampler: `cap 8.1`.
//
// The lobe and the distribution of views are those of `crates/specula-bsdf/examples/sample_speed.rs`, which measures
// batches in Rust.
//
//     specula export --lang cpp -o include
//     g++ -std=c++17 -O3 -march=native -I include crates/specula-shaders/benches/sample_speed.cpp -o sample_speed
//     ./sample_speed

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "specula.hpp"

using specula::vec2f;
using specula::vec3f;

namespace {

/// Calls, of which the quickest counts.
constexpr int ROUNDS = 3;

/// A linear congruential generator: uniform in [0, 1).
float uniform(uint32_t& state) {
    state = 1664525u * state + 1013904223u;
    return static_cast<float>(state >> 8u) * 5.9604645e-8f;
}

struct Question {
    vec3f wo;
    vec3f u;
};

std::vector<Question> questions(size_t count) {
    std::vector<Question> questions(count);
    uint32_t state = 1u;
    for (Question& question : questions) {
        const float z = 0.1f + 0.9f * uniform(state);
        const float phi = 6.2831853f * uniform(state);
        const float r = std::sqrt(1.0f - z * z);
        question.wo = vec3f{r * std::cos(phi), r * std::sin(phi), z};
        const float first = uniform(state);
        const float second = uniform(state);
        question.u = vec3f{first, second, uniform(state)};
    }
    return questions;
}

/// Nanoseconds of one call of `answer`.
template <typename Answer, typename Function>
double nanoseconds(const std::vector<Question>& questions, const Function& answer) {
    std::vector<Answer> answers(questions.size());
    double least = 1e300;
    for (int round = 0; round < ROUNDS; round++) {
        const auto start = std::chrono::steady_clock::now();
        for (size_t i = 0; i < questions.size(); i++) {
            answers[i] = answer(questions[i]);
        }
        const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
        least = std::fmin(least, elapsed.count());
    }
    // All are used.
    volatile float kept = 0.0f;
    for (const Answer& one : answers) {
        kept = kept + one.wi.z;
    }
    return least / static_cast<double>(questions.size());
}

struct Direction {
    vec3f wi;
    float pdf;
};

}  // namespace

int main(int count, char** arguments) {
    const size_t samples = count > 1 ? static_cast<size_t>(std::atol(arguments[1])) : size_t{1} << 20u;
    const std::vector<Question> all = questions(samples);
    const vec2f alpha{0.3f, 0.3f};
    const specula::ReflectanceModel f0 = specula::reflectance_schlick(vec3f{0.9f, 0.6f, 0.3f});
    struct Sampler {
        const char* name;
        uint32_t id;
    };
    const Sampler samplers[] = {
        {"heitz", specula::SAMPLER_HEITZ},
        {"cap", specula::SAMPLER_CAP},
        {"bounded", specula::SAMPLER_BOUNDED},
        {"exact", specula::SAMPLER_EXACT},
    };
    for (const Sampler& sampler : samplers) {
        const specula::MicrofacetsModel facets{
            alpha, specula::DISTRIBUTION_GGX, specula::MASKING_HEIGHT_CORRELATED, sampler.id};
        const specula::RoughConductor metal{facets, f0};
        const auto lobe = [&](const Question& question) {
            return specula::rough_conductor_sample(
                metal, question.wo, question.u, specula::BSDF_SAMPLE_RADIANCE);
        };
        std::printf("%s %.3f\n", sampler.name, nanoseconds<specula::BsdfSample>(all, lobe));
    }
    // A direction and its density, without Fresnel and masking of the light.
    const auto heitz = [&](const Question& question) {
        const vec3f wm = specula::heitz_sample_wm(alpha, question.wo, question.u.yz());
        const vec3f wi = specula::reflection_mirrored(question.wo, wm);
        return Direction{wi, specula::heitz_reflection_pdf(alpha, question.wo, wi)};
    };
    const auto cap = [&](const Question& question) {
        const vec3f wi = specula::cap_sample_direction(alpha, question.wo, question.u.yz());
        return Direction{wi, specula::cap_reflection_pdf(alpha, question.wo, wi)};
    };
    const auto bounded = [&](const Question& question) {
        const vec3f wi = specula::bounded_sample_direction(alpha, question.wo, question.u.yz());
        return Direction{wi, specula::bounded_reflection_pdf(alpha, question.wo, wi)};
    };
    const auto exact = [&](const Question& question) {
        const vec3f wi = specula::exact_sample_direction(alpha, question.wo, question.u.yz());
        return Direction{wi, specula::exact_reflection_pdf(alpha, question.wo, wi)};
    };
    std::printf("heitz-direction %.3f\n", nanoseconds<Direction>(all, heitz));
    std::printf("cap-direction %.3f\n", nanoseconds<Direction>(all, cap));
    std::printf("bounded-direction %.3f\n", nanoseconds<Direction>(all, bounded));
    std::printf("exact-direction %.3f\n", nanoseconds<Direction>(all, exact));
}
