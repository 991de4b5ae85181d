#include "specula.hpp"

#include <cstdio>
#include <cstdlib>
#include <vector>

float second(float cosine);

/// A vector of a renderer, without a constructor.
struct Direction {
    float x, y, z;
};

int main() {
    using namespace specula;
    // Conversions from outside the range of words.
    const float zero = static_cast<float>(std::getenv("NOT_THERE") != nullptr);
    std::printf("%u %u %u %u\n", to_u32(zero - 1.5f), to_u32(zero + 1e20f), to_u32(zero + 2.9f), bits_of(zero + 1.0f));

    // Vectors of a renderer.
    const Direction up{0.0f, 0.6f, 0.8f};
    const FrameBasis frame = frame_from_normal(from_xyz(up));
    const Direction local = to<Direction>(frame_to_local(frame, from_xyz(up)));
    std::printf("%.3f %.3f %.3f\n", double(local.x), double(local.y), double(local.z));

    // Tables that are bound here and read in the other file.
    std::vector<float> tables(1u << 20);
    std::FILE* file = std::fopen("energy_tables.bin", "rb");
    tables.resize(std::fread(tables.data(), sizeof(float), tables.size(), file));
    std::fclose(file);
    specula_tables = tables.data();
    std::printf("%.6f\n", double(second(0.5f)));
}
