// Samples of the exported library, counted in cells of the unit disk: rows from y = 1 down, the rejected ones last.

struct CheckTask {
    wo: vec4f,
    alpha: vec2f,
    strategy: u32,
    seed: u32,
    // Samples of a thread, and cells along a side.
    each: u32,
    size: u32,
    unused: vec2u,
}

@group(1) @binding(0) var<uniform> check_task: CheckTask;
@group(1) @binding(1) var<storage, read_write> check_counts: array<atomic<u32>>;

fn check_hash(x: u32) -> u32 {
    let state = x * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn check_next(state: ptr<function, u32>) -> f32 {
    *state = *state * 747796405u + 2891336453u;
    return f32(check_hash(*state) >> 8u) * 5.9604645e-8;
}

@compute @workgroup_size(64)
fn check_main(@builtin(global_invocation_id) id: vec3u) {
    let size = check_task.size;
    var state = check_hash(id.x ^ check_hash(check_task.seed));
    for (var i = 0u; i < check_task.each; i += 1u) {
        let a = check_next(&state);
        let b = check_next(&state);
        let wi = reflection_sample_direction(check_task.strategy, check_task.alpha, check_task.wo.xyz, vec2f(a, b));
        var cell = size * size;
        if wi.z > 0.0 {
            let place = clamp(vec2i(floor((wi.xy * 0.5 + 0.5) * f32(size))), vec2i(0), vec2i(i32(size) - 1));
            cell = (size - 1u - u32(place.y)) * size + u32(place.x);
        }
        atomicAdd(&check_counts[cell], 1u);
    }
}
