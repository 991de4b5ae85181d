// Runs the shader that slangc has written as C++, and prints what it writes.
#include "derive.cpp"
#include <cstdio>

int main() {
    float written[DERIVATIVES] = {};
    GlobalParams_0 globals = {};
    globals.results_0.data = written;
    globals.results_0.count = DERIVATIVES;
    ComputeVaryingInput input = {};
    input.endGroupID = {1, 1, 1};
    derive(&input, nullptr, &globals);
    for (float value : written) {
        std::printf("%.9g\n", value);
    }
}
