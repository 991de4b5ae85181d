
[[vk::binding(1)]] StructuredBuffer<float> parity_arguments : register(t1);
[[vk::binding(2)]] RWStructuredBuffer<float> parity_results : register(u2);
[[vk::binding(3)]] StructuredBuffer<uint> parity_rows : register(t3);
// FOR EACH CASE

[shader("compute")] [numthreads(64, 1, 1)] void run_NAME(uint3 place : SV_DispatchThreadID) {
    uint row = place.y * 65536u + place.x;
    if (row >= parity_rows[0]) {
        return;
    }
    float x[ARGUMENTS];
    for (uint k = 0u; k < ARGUMENTS; k++) {
        x[k] = parity_arguments[row * ARGUMENTS + k];
    }
    float y[RESULTS] = (float[RESULTS])0;
    parity_NAME(x, y);
    for (uint l = 0u; l < RESULTS; l++) {
        parity_results[row * RESULTS + l] = y[l];
    }
}
// END
