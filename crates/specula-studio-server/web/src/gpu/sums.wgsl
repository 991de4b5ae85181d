// Sums of the samples of pixels, as `path_results` in specula-gpu/wgsl/path.wgsl lays them out: one thread a pixel.

struct SumsTask {
    // The first pixel, how many, and the samples of each.
    first: u32,
    count: u32,
    samples: u32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> sums_task: SumsTask;
@group(0) @binding(1) var<storage, read> sums_results: array<vec4f>;
// Of each pixel: values and the filter's weight; squares of values and the number of rays; samples that are not finite.
@group(0) @binding(2) var<storage, read_write> sums: array<vec4f>;

fn sums_is_finite(x: vec4f) -> bool {
    // By bits: compilers may take it for granted that floats are finite.
    let exponents = (bitcast<vec4u>(x) >> vec4u(23u)) & vec4u(0xffu);
    return all(exponents != vec4u(0xffu));
}

@compute @workgroup_size(64)
fn sums_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= sums_task.count {
        return;
    }
    var values = vec4f(0.0);
    var squares = vec4f(0.0);
    var invalid = 0.0;
    for (var s = 0u; s < sums_task.samples; s += 1u) {
        let at = 3u * (id.x * sums_task.samples + s);
        let weight = sums_results[at + 2u].w;
        let value = vec4f(sums_results[at].xyz, weight);
        squares.w += sums_results[at + 1u].w;
        if sums_is_finite(value) {
            values += value;
            squares += vec4f(value.xyz * value.xyz, 0.0);
        } else {
            // A sample without value counts as black.
            values.w += 1.0;
            invalid += 1.0;
        }
    }
    let to = 3u * (sums_task.first + id.x);
    sums[to] += values;
    sums[to + 1u] += squares;
    sums[to + 2u].x += invalid;
}
