
layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer ParityArguments {
    float parity_arguments[];
};
layout(std430, binding = 2) buffer ParityResults {
    float parity_results[];
};
layout(std430, binding = 3) readonly buffer ParityRows {
    uint parity_rows;
};
// FOR EACH CASE

void run_NAME() {
    uint row = gl_GlobalInvocationID.y * 65536u + gl_GlobalInvocationID.x;
    if (row >= parity_rows) {
        return;
    }
    float x[ARGUMENTS];
    for (uint k = 0u; k < ARGUMENTS; k++) {
        x[k] = parity_arguments[row * ARGUMENTS + k];
    }
    float y[RESULTS];
    for (uint k = 0u; k < RESULTS; k++) {
        y[k] = 0.0;
    }
    parity_NAME(x, y);
    for (uint k = 0u; k < RESULTS; k++) {
        parity_results[row * RESULTS + k] = y[k];
    }
}
// END

// Calls all, so that the compiler keeps them; it goes in the end.
void main() {
    // NAMES
}
