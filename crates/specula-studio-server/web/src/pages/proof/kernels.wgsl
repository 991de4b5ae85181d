// What puts a BSDF of the page to the proof. One set of bindings for all kernels.

struct ProofTask {
    wo: vec4f,
    parameters: vec4f,
    seed: u32,
    // Samples of a thread.
    each: u32,
}

// Cells: rows of theta from 0 to pi, columns of phi from 0 to 2 pi, both even.
const PROOF_ROWS = 32u;
const PROOF_COLUMNS = 64u;
const PROOF_CELLS = 2048u;
// Points along a side of a cell, and of the coarser rule that it is compared with.
const PROOF_FINE = 32u;
const PROOF_COARSE = 16u;
// Of cells where both differ.
const PROOF_FINEST = 256u;
const PROOF_THREADS = 8192u;
const PROOF_PI = 3.14159265;

// Places behind the cells.
const PROOF_FAILED = 2048u;
const PROOF_DIFFERS = 2049u;
const PROOF_DIFFERENCE = 2050u;
const PROOF_NOT_UNIT = 2051u;
const PROOF_SAMPLE_INVALID = 2052u;
const PROOF_PAIRS = 2053u;
const PROOF_UNEQUAL = 2054u;
const PROOF_INEQUALITY = 2055u;
const PROOF_INVALID = 2056u;
const PROOF_FIRST_INVALID = 2057u;

@group(1) @binding(0) var<uniform> proof_task: ProofTask;
@group(1) @binding(1) var<storage, read_write> proof_counts: array<atomic<u32>>;
@group(1) @binding(2) var<storage, read_write> proof_sums: array<vec4f>;
// Cosine and sine of the cells' boundaries, theta before phi: devices' own are too rough for narrow lobes.
@group(1) @binding(3) var<storage, read> proof_turns: array<vec2f>;
// Cells that take a finer rule.
@group(1) @binding(4) var<storage, read> proof_list: array<u32>;

fn proof_hash(x: u32) -> u32 {
    let state = x * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn proof_next(state: ptr<function, u32>) -> f32 {
    *state = *state * 747796405u + 2891336453u;
    return f32(proof_hash(*state) >> 8u) * 5.9604645e-8;
}

// By bits: arithmetic may take for granted that there is neither.
fn proof_is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}

fn proof_is_value(x: f32) -> bool {
    return proof_is_finite(x) && x >= 0.0;
}

fn proof_is_colour(c: vec3f) -> bool {
    return proof_is_value(c.x) && proof_is_value(c.y) && proof_is_value(c.z);
}

// Cosine and sine of a boundary's angle and a little more, below 0.1.
fn proof_turned(boundary: u32, more: f32) -> vec2f {
    let turn = proof_turns[boundary];
    let squared = more * more;
    let c = 1.0 - squared * (0.5 - squared * (1.0 / 24.0 - squared / 720.0));
    let s = more * (1.0 - squared * (1.0 / 6.0 - squared / 120.0));
    return vec2f(turn.x * c - turn.y * s, turn.y * c + turn.x * s);
}

// Whether a vector of the plane is at a boundary's angle or beyond, by less than half a turn.
fn proof_is_beyond(boundary: u32, v: vec2f) -> bool {
    let turn = proof_turns[boundary];
    return turn.x * v.y - turn.y * v.x >= 0.0;
}

// The cell of a direction.
fn proof_cell(w: vec3f) -> u32 {
    let polar = vec2f(w.z, length(w.xy));
    let theta = atan2(polar.y, polar.x);
    var row = clamp(u32(theta * f32(PROOF_ROWS) / PROOF_PI), 1u, PROOF_ROWS - 2u);
    row = select(row - 1u, row, proof_is_beyond(row, polar));
    row = select(row, row + 1u, proof_is_beyond(row + 1u, polar));
    // The lower half of the plane is turned into the upper one.
    let is_upper = w.y > 0.0 || (w.y == 0.0 && w.x >= 0.0);
    let across = select(-w.xy, w.xy, is_upper);
    let half = PROOF_COLUMNS / 2u;
    let phi = max(atan2(across.y, across.x), 0.0);
    var column = clamp(u32(phi * f32(half) / PROOF_PI), 1u, half - 2u);
    let first = PROOF_ROWS + 1u;
    column = select(column - 1u, column, proof_is_beyond(first + column, across));
    column = select(column, column + 1u, proof_is_beyond(first + column + 1u, across));
    return row * PROOF_COLUMNS + column + select(half, 0u, is_upper);
}

// Of a cosine and an azimuth; unit.
fn proof_around(z: f32, phi: f32) -> vec3f {
    let flat = normalize(vec2f(cos(phi), sin(phi)));
    return vec3f(sqrt(max(0.0, (1.0 - z) * (1.0 + z))) * flat, z);
}

// Counts samples by cell; sums weights and their squares.
@compute @workgroup_size(64) fn proof_draw(@builtin(global_invocation_id) id: vec3u) {
    parameters = proof_task.parameters;
    let wo = proof_task.wo.xyz;
    var state = proof_hash(id.x ^ proof_hash(proof_task.seed));
    var sum = vec3f(0.0);
    var squares = vec3f(0.0);
    for (var i = 0u; i < proof_task.each; i++) {
        let u = vec3f(proof_next(&state), proof_next(&state), proof_next(&state));
        let sampled = user_sample(wo, u);
        if sampled.w == 0.0 {
            atomicAdd(&proof_counts[PROOF_FAILED], 1u);
            continue;
        }
        let wi = sampled.xyz;
        if !proof_is_value(sampled.w) || !proof_is_finite(dot(wi, wi)) {
            atomicAdd(&proof_counts[PROOF_SAMPLE_INVALID], 1u);
            continue;
        }
        if abs(length(wi) - 1.0) > 1e-3 {
            atomicAdd(&proof_counts[PROOF_NOT_UNIT], 1u);
        }
        let pdf = user_pdf(wo, wi);
        let difference = abs(pdf - sampled.w) / max(pdf, sampled.w);
        if difference > 1e-3 || !proof_is_finite(difference) {
            atomicAdd(&proof_counts[PROOF_DIFFERS], 1u);
            atomicMax(&proof_counts[PROOF_DIFFERENCE], bitcast<u32>(min(difference, 1e9)));
        }
        let weight = user_eval(wo, wi) / sampled.w;
        if proof_is_colour(weight) {
            sum += weight;
            squares += weight * weight;
        } else {
            atomicAdd(&proof_counts[PROOF_SAMPLE_INVALID], 1u);
        }
        atomicAdd(&proof_counts[proof_cell(wi)], 1u);
    }
    proof_sums[2u * id.x] = vec4f(sum, 0.0);
    proof_sums[2u * id.x + 1u] = vec4f(squares, 0.0);
}

// Integrals over rows of a cell by the midpoint rule: red, green, blue, density.
fn proof_integral(cell: u32, side: u32, first: u32, step: u32) -> vec4f {
    let wo = proof_task.wo.xyz;
    let size = vec2f(PROOF_PI / f32(PROOF_ROWS), 2.0 * PROOF_PI / f32(PROOF_COLUMNS));
    var sum = vec4f(0.0);
    for (var i = first; i < side; i += step) {
        var row = vec4f(0.0);
        let polar = proof_turned(cell / PROOF_COLUMNS, (f32(i) + 0.5) / f32(side) * size.x);
        for (var j = 0u; j < side; j++) {
            let around = proof_turned(PROOF_ROWS + 1u + cell % PROOF_COLUMNS, (f32(j) + 0.5) / f32(side) * size.y);
            let wi = vec3f(polar.y * around, polar.x);
            let value = vec4f(user_eval(wo, wi), user_pdf(wo, wi));
            if proof_is_colour(value.xyz) && proof_is_value(value.w) {
                row += value;
            } else {
                atomicAdd(&proof_counts[PROOF_INVALID], 1u);
            }
        }
        sum += row * polar.y;
    }
    return sum * (size.x * size.y / f32(side * side));
}

@compute @workgroup_size(64) fn proof_expect(@builtin(global_invocation_id) id: vec3u) {
    parameters = proof_task.parameters;
    if id.x >= PROOF_CELLS {
        return;
    }
    let at = 2u * (PROOF_THREADS + id.x);
    proof_sums[at] = proof_integral(id.x, PROOF_FINE, 0u, 1u);
    proof_sums[at + 1u] = proof_integral(id.x, PROOF_COARSE, 0u, 1u);
}

var<workgroup> proof_shared: array<vec4f, 128>;

// The same by finer rules for cells that need them, a group for each.
@compute @workgroup_size(64)
fn proof_refine(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    parameters = proof_task.parameters;
    let cell = proof_list[group.x];
    proof_shared[2u * thread] = proof_integral(cell, PROOF_FINEST, thread, 64u);
    proof_shared[2u * thread + 1u] = proof_integral(cell, PROOF_FINEST / 2u, thread, 64u);
    workgroupBarrier();
    if thread < 2u {
        var sum = vec4f(0.0);
        for (var i = 0u; i < 64u; i++) {
            sum += proof_shared[2u * i + thread];
        }
        proof_sums[2u * (PROOF_THREADS + cell) + thread] = sum;
    }
}

// f(wo, wi) against f(wi, wo), both on one side of the surface.
@compute @workgroup_size(64) fn proof_reciprocity(@builtin(global_invocation_id) id: vec3u) {
    parameters = proof_task.parameters;
    var state = proof_hash(id.x ^ proof_hash(proof_task.seed + 1u));
    for (var i = 0u; i < 8u; i++) {
        let side = select(-1.0, 1.0, proof_next(&state) < 0.75);
        let a_cos = 0.02 + 0.98 * proof_next(&state);
        let a = proof_around(a_cos, 2.0 * PROOF_PI * proof_next(&state)) * vec3f(1.0, 1.0, side);
        let b_cos = 0.02 + 0.98 * proof_next(&state);
        let b = proof_around(b_cos, 2.0 * PROOF_PI * proof_next(&state)) * vec3f(1.0, 1.0, side);
        let there = user_eval(a, b) / b_cos;
        let back = user_eval(b, a) / a_cos;
        let size = max(there, back);
        let most = max(size.x, max(size.y, size.z));
        let apart = abs(there - back);
        let difference = max(apart.x, max(apart.y, apart.z)) / max(most, 1e-20);
        if most < 1e-6 || !proof_is_finite(difference) {
            continue;
        }
        atomicAdd(&proof_counts[PROOF_PAIRS], 1u);
        atomicMax(&proof_counts[PROOF_INEQUALITY], bitcast<u32>(difference));
        if difference > 1e-2 {
            atomicAdd(&proof_counts[PROOF_UNEQUAL], 1u);
        }
    }
}

// Values at views down to the horizon: 8 cosines, 8 azimuths, 16 x 16 lights and samples.
@compute @workgroup_size(64) fn proof_scan(@builtin(global_invocation_id) id: vec3u) {
    parameters = proof_task.parameters;
    var cosines = array<f32, 8>(1.0, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, -0.3);
    let z = cosines[id.x / 2048u];
    let phi = 0.25 * PROOF_PI * f32((id.x / 256u) % 8u);
    let wo = proof_around(z, phi);
    let row = (id.x / 16u) % 16u;
    let column = id.x % 16u;
    // The first rows are lights at the horizon.
    let wi_z = select(1.0 - 2.0 * (f32(row) - 4.0) / 11.0, cosines[3u + row], row < 4u);
    let wi_phi = 0.125 * PROOF_PI * f32(column);
    let wi = proof_around(wi_z, wi_phi);
    let sampled = user_sample(wo, (vec3f(f32(row), f32(column), 8.0) + vec3f(0.0, 0.0, 0.5)) / 16.0);
    let is_valid = proof_is_value(sampled.w) && (sampled.w == 0.0 || proof_is_finite(dot(sampled.xyz, sampled.xyz)));
    if !is_valid || !proof_is_colour(user_eval(wo, wi)) || !proof_is_value(user_pdf(wo, wi)) {
        atomicAdd(&proof_counts[PROOF_INVALID], 1u);
        atomicMin(&proof_counts[PROOF_FIRST_INVALID], id.x);
    }
}
