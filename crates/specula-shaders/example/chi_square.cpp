// Chi-square tests of the samplers of specula.hpp: do samples follow the density that is said of them?
//
//     make check
//     g++ -std=c++17 -O2 chi_square.cpp -o chi_square && ./chi_square energy_tables.bin
//     ./chi_square energy_tables.bin dielectric       those whose name has this in it
//
// For each sampler and lobe, alpha and view: a histogram of samples over the sphere beside the integral of the density
// over each cell (Pearson's test). Samples that were rejected have a cell of their own. A line for each sampler with the
// least p value of its tests; exit code 1 where one is so small that all tests of a run together have one like it once in
// 10000 runs.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "specula.hpp"

using specula::vec2f;
using specula::vec3f;

namespace {

constexpr int SAMPLES = 100000;
/// Cells along z, on each side of the surface, and around it.
constexpr int HEIGHTS = 12;
constexpr int AZIMUTHS = 24;
/// Points of a cell's quadrature along each side.
constexpr int FEWEST_POINTS = 24;
constexpr int MOST_POINTS = 96;
/// Error of the integral over the sphere, where the density has kinks.
constexpr double QUADRATURE = 2e-3;
constexpr int CELLS = 2 * HEIGHTS * AZIMUTHS;
constexpr double PI = 3.14159265358979323846;
/// Cells of fewer samples are put together.
constexpr double LEAST_EXPECTED = 5.0;
/// Share of runs without a fault that fail.
constexpr double FALSE_ALARMS = 1e-4;

/// What is tested.
struct Subject {
    const char* name;
    /// A direction for three random numbers; false: rejected, or scattered as by a mirror.
    std::function<bool(vec3f wo, vec3f u, vec3f& w)> sample;
    /// Its density in 1/sr.
    std::function<float(vec3f wo, vec3f w)> pdf;
    /// Views from below as well.
    bool from_below = false;
};

/// Uniform in [0, 1) (SplitMix64).
float uniform(uint64_t& state) {
    uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
    return static_cast<float>((z ^ (z >> 31u)) >> 40u) * 5.9604645e-8f;
}

/// The direction at an angle to the normal, and at a share of a turn around it.
vec3f direction(double theta, double turn) {
    const double x = std::sin(theta) * std::cos(2.0 * PI * turn);
    const double y = std::sin(theta) * std::sin(2.0 * PI * turn);
    return vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::cos(theta)));
}

/// The cell that a direction lies in.
int cell_of(vec3f w) {
    const double turn = std::atan2(double(w.y), double(w.x)) / (2.0 * PI);
    const int height = static_cast<int>(0.5 * (double(w.z) + 1.0) * 2 * HEIGHTS);
    const int azimuth = static_cast<int>((turn - std::floor(turn)) * AZIMUTHS);
    return std::clamp(height, 0, 2 * HEIGHTS - 1) * AZIMUTHS + std::clamp(azimuth, 0, AZIMUTHS - 1);
}

/// The integral of the density over a cell, by so many points along each side: in the angle, since lobes around the
/// normal are narrow in its cosine.
double quadrature(const Subject& subject, vec3f wo, int cell, int points) {
    const double low = std::acos(double(cell / AZIMUTHS + 1) / HEIGHTS - 1.0);
    const double high = std::acos(double(cell / AZIMUTHS) / HEIGHTS - 1.0);
    double sum = 0.0;
    for (int i = 0; i < points * points; i++) {
        const double theta = low + (high - low) * (i / points + 0.5) / points;
        const double azimuth = cell % AZIMUTHS + (i % points + 0.5) / points;
        sum += std::sin(theta) * double(subject.pdf(wo, direction(theta, azimuth / AZIMUTHS)));
    }
    return sum * (high - low) * 2.0 * PI / (double(AZIMUTHS) * points * points);
}

/// The integral of the density over a cell, with an error far below what chance does to the number of samples.
double probability(const Subject& subject, vec3f wo, int cell) {
    double value = quadrature(subject, wo, cell, FEWEST_POINTS);
    for (int points = 2 * FEWEST_POINTS; points <= MOST_POINTS; points *= 2) {
        const double before = value;
        value = quadrature(subject, wo, cell, points);
        if (std::abs(value - before) <= 0.02 * std::sqrt(value / SAMPLES) + 1e-8) {
            break;
        }
    }
    return value;
}

/// The regularised upper incomplete gamma function, `Q(a, x)`: by the series of its complement below `a + 1`, by its
/// continued fraction above.
double upper_gamma(double a, double x) {
    if (x <= 0.0) {
        return 1.0;
    }
    const double factor = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (int n = 1; n < 10000 && term > 1e-17 * sum; n++) {
            term *= x / (a + n);
            sum += term;
        }
        return 1.0 - factor * sum;
    }
    // From its end: the error after so many terms is far below what matters.
    double tail = 0.0;
    for (int n = 400; n >= 1; n--) {
        tail = n * (n - a) / (x + 2.0 * n + 1.0 - a - tail);
    }
    return factor / (x + 1.0 - a - tail);
}

/// Probability of a histogram as far from what is expected as this one, or farther.
double p_value(const std::vector<double>& expected, const std::vector<double>& found) {
    double chi2 = 0.0;
    int cells = 0;
    double rest_expected = 0.0;
    double rest_found = 0.0;
    for (size_t i = 0; i < expected.size(); i++) {
        if (expected[i] < LEAST_EXPECTED) {
            rest_expected += expected[i];
            rest_found += found[i];
            continue;
        }
        const double difference = found[i] - expected[i];
        chi2 += difference * difference / expected[i];
        cells++;
    }
    if (rest_expected >= LEAST_EXPECTED) {
        const double difference = rest_found - rest_expected;
        chi2 += difference * difference / rest_expected;
        cells++;
    } else if (rest_found > LEAST_EXPECTED + 5.0 * std::sqrt(LEAST_EXPECTED)) {
        return 0.0;
    }
    return cells < 2 ? 1.0 : upper_gamma(0.5 * (cells - 1), 0.5 * chi2);
}

/// Tests one view.
double test(const Subject& subject, vec3f wo, uint64_t seed) {
    std::vector<double> expected(CELLS + 1);
    std::vector<double> found(CELLS + 1);
    double sum = 0.0;
    for (int cell = 0; cell < CELLS; cell++) {
        const double share = probability(subject, wo, cell);
        sum += share;
        expected[size_t(cell)] = SAMPLES * share;
    }
    for (int i = 0; i < SAMPLES; i++) {
        const float a = uniform(seed);
        const float b = uniform(seed);
        vec3f w{0.0f};
        const bool is_there = subject.sample(wo, vec3f(a, b, uniform(seed)), w);
        found[is_there ? size_t(cell_of(w)) : size_t(CELLS)] += 1.0;
    }
    // Kinks leave a rest that is no rejection.
    const double rejected = SAMPLES * std::max(0.0, 1.0 - sum);
    const bool is_rest = std::abs(rejected - found[CELLS]) < QUADRATURE * SAMPLES;
    expected[CELLS] = is_rest ? found[CELLS] : rejected;
    return p_value(expected, found);
}

/// A subject of a lobe's functions.
template <class Lobe>
Subject of_lobe(
    const char* name,
    const Lobe& lobe,
    specula::BsdfSample (*sample)(const Lobe&, vec3f, vec3f, uint32_t),
    float (*pdf)(const Lobe&, vec3f, vec3f),
    bool from_below = false) {
    return {
        name,
        [=](vec3f wo, vec3f u, vec3f& w) {
            const specula::BsdfSample sampled = sample(lobe, wo, u, specula::BSDF_SAMPLE_RADIANCE);
            w = sampled.wi;
            return sampled.flags != 0u && (sampled.flags & specula::BSDF_SAMPLE_SPECULAR) == 0u;
        },
        [=](vec3f wo, vec3f w) { return pdf(lobe, wo, w); },
        from_below,
    };
}

/// Visible normals, and reflections off them.
void add_normals(std::vector<Subject>& subjects, vec2f alpha) {
    using namespace specula;
    using Sample = vec3f (*)(vec2f, vec3f, vec2f);
    using Pdf = float (*)(vec2f, vec3f, vec3f);
    const auto add = [&](const char* name, Sample sample, Pdf pdf) {
        subjects.push_back({
            name,
            [=](vec3f wo, vec3f u, vec3f& w) {
                w = sample(alpha, wo, u.yz());
                return w.z > 0.0f;
            },
            [=](vec3f wo, vec3f w) { return pdf(alpha, wo, w); },
        });
    };
    add("normals, Heitz 2018", heitz_sample_wm, heitz_pdf_wm);
    add("normals, caps", cap_sample_wm, cap_pdf_wm);
    add("normals, Beckmann", beckmann_visible_sample_wm, beckmann_visible_pdf_wm);
    add("reflections, caps", cap_sample_direction, cap_reflection_pdf);
    add("reflections, bounded caps", bounded_sample_direction, bounded_reflection_pdf);
    add("reflections, exact", exact_sample_direction, exact_reflection_pdf);
}

/// Lobes of microfacets.
void add_lobes(std::vector<Subject>& subjects, vec2f alpha) {
    using namespace specula;
    const MicrofacetsModel ggx{alpha, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_EXACT};
    const MicrofacetsModel beckmann{alpha, DISTRIBUTION_BECKMANN, MASKING_SEPARABLE, SAMPLER_CAP};
    const MicrofacetsModel caps{alpha, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_CAP};
    const ReflectanceModel gold = reflectance_conductor(vec3f(0.143f, 0.375f, 1.442f), vec3f(3.983f, 2.386f, 1.603f));
    const TintsPair white{vec3f(1.0f), vec3f(1.0f)};
    const RoughConductor metal{ggx, gold};
    subjects.push_back(of_lobe("rough conductor, GGX", metal, rough_conductor_sample, rough_conductor_pdf));
    const RoughConductor other{beckmann, gold};
    subjects.push_back(of_lobe("rough conductor, Beckmann", other, rough_conductor_sample, rough_conductor_pdf));
    const RoughDielectric glass{caps, 1.5f, 0u, white};
    subjects.push_back(of_lobe("rough dielectric", glass, rough_dielectric_sample, rough_dielectric_pdf, true));
    const CompensatedConductor compensated = compensated_new(ggx, gold, MODEL_KULLA_CONTY);
    subjects.push_back(of_lobe("conductor, Kulla-Conty", compensated, compensated_sample, compensated_pdf));
    const CompensatedDielectric full = compensated_dielectric_new(caps, 1.5f, 0u, white);
    subjects.push_back(
        of_lobe("dielectric, compensated", full, compensated_dielectric_sample, compensated_dielectric_pdf, true));
    const CoatedDiffuse coated = coated_diffuse_new(
        caps, true, 1.5f, vec3f(0.8f, 0.5f, 0.2f), 0.1f, COATED_DIFFUSE_UNLIMITED, COATED_DIFFUSE_LOSSLESS);
    subjects.push_back(of_lobe("coated diffuse", coated, coated_diffuse_sample, coated_diffuse_pdf));
}

/// Lobes without microfacets.
void add_diffuse(std::vector<Subject>& subjects) {
    using namespace specula;
    subjects.push_back(of_lobe("Lambert", LambertLobe{vec3f(0.5f)}, lambert_sample, lambert_pdf));
    subjects.push_back(of_lobe("EON", EonLobe{vec3f(0.8f), 0.7f}, eon_sample, eon_pdf));
    const DiffuseTransmission sheet{vec3f(0.5f), vec3f(0.3f)};
    subjects.push_back(of_lobe("diffuse sheet", sheet, diffuse_transmission_sample, diffuse_transmission_pdf, true));
}

std::vector<float> read_tables(const char* path) {
    std::vector<float> tables;
    FILE* file = std::fopen(path, "rb");
    if (file == nullptr) {
        return tables;
    }
    tables.resize(1u << 21u);
    tables.resize(std::fread(tables.data(), sizeof(float), tables.size(), file));
    std::fclose(file);
    return tables;
}

} // namespace

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "energy_tables.bin";
    const std::string wanted = count > 2 ? arguments[2] : "";
    const std::vector<float> tables = read_tables(path);
    if (tables.empty()) {
        std::fprintf(stderr, "cannot read the tables '%s'\n", path);
        return 2;
    }
    specula::specula_tables = tables.data();

    std::vector<Subject> subjects;
    for (const vec2f alpha : {vec2f(0.15f), vec2f(0.6f, 0.2f), vec2f(1.0f)}) {
        add_normals(subjects, alpha);
        add_lobes(subjects, alpha);
    }
    add_diffuse(subjects);
    const auto is_unwanted = [&](const Subject& s) { return std::string(s.name).find(wanted) == std::string::npos; };
    subjects.erase(std::remove_if(subjects.begin(), subjects.end(), is_unwanted), subjects.end());
    if (subjects.empty()) {
        std::fprintf(stderr, "no sampler has '%s' in its name\n", wanted.c_str());
        return 2;
    }

    // Cosines and azimuths of the views.
    const double views[4][2] = {{1.0, 0.0}, {0.75, 0.1}, {0.3, 0.4}, {-0.5, 0.7}};
    struct Result {
        const char* name;
        int tests;
        double least;
    };
    std::vector<Result> results;
    int tests = 0;
    for (const Subject& subject : subjects) {
        for (const auto& view : views) {
            if (view[0] < 0.0 && !subject.from_below) {
                continue;
            }
            tests++;
            const double p = test(subject, direction(std::acos(view[0]), view[1]), uint64_t(tests));
            const auto same = [&](const Result& result) { return result.name == subject.name; };
            const auto known = std::find_if(results.begin(), results.end(), same);
            if (known == results.end()) {
                results.push_back({subject.name, 1, p});
            } else {
                known->tests++;
                known->least = std::min(known->least, p);
            }
        }
    }
    const double level = 1.0 - std::pow(1.0 - FALSE_ALARMS, 1.0 / tests);
    bool is_fine = true;
    for (const Result& result : results) {
        const bool passes = result.least >= level;
        is_fine = is_fine && passes;
        std::printf("%-26s %2d tests, p >= %.1e  %s\n", result.name, result.tests, result.least, passes ? "ok" : "FAILED");
    }
    std::printf("%d tests, level %.1e\n", tests, level);
    return is_fine ? 0 : 1;
}
