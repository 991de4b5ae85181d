// Runs the shader that slangc has written as C++, and prints what it writes.
#include "derive.cpp"
#include <cstdio>

int main() {
    float written[COUNT] = {};
    GlobalParams_0 globals = {};
    globals.results_0.data = written;
    globals.results_0.count = COUNT;
    ComputeVaryingInput input = {};
    input.endGroupID = {1, 1, 1};
    derive_0(&input, nullptr, &globals);
    for (float value : written) {
        std::printf("%.9g\n", value);
    }
}
