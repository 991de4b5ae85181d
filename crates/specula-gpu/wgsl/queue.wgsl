// Wavefronts of paths, in queues: all paths are taken from one vertex to the next, and those that continue form the
// next queue. The order of a queue is not deterministic. Results are, since every path writes to its own slot.

import tracer::path::{PathState, path_is_requested, path_sequence, path_begin, path_step, path_end};

/// States of the paths, by slot.
@group(0) @binding(6) var<storage, read_write> queue_states: array<PathState>;
/// Depth of the current vertex, then the number of paths in the queue of even depths and of odd ones.
@group(0) @binding(7) var<storage, read_write> queue_control: array<atomic<u32>, 3>;
/// Slots of the paths in the queue of even depths, then of odd ones.
@group(0) @binding(8) var<storage, read_write> queue_slots: array<u32>;

/// Appends a path to the queue of a depth.
fn queue_append(slot: u32, depth: u32) {
    let side = depth & 1u;
    let place = atomicAdd(&queue_control[1u + side], 1u);
    queue_slots[side * (arrayLength(&queue_slots) / 2u) + place] = slot;
}

/// Begins a path.
@compute @workgroup_size(64)
fn queue_begin(@builtin(global_invocation_id) id: vec3u) {
    let slot = id.x;
    if path_is_requested(slot) {
        queue_states[slot] = path_begin(slot, path_sequence(slot));
        queue_append(slot, 0u);
    }
}

/// Takes a path to its next vertex.
@compute @workgroup_size(64)
fn queue_bounce(@builtin(global_invocation_id) id: vec3u) {
    let depth = atomicLoad(&queue_control[0]);
    let side = depth & 1u;
    if id.x >= atomicLoad(&queue_control[1u + side]) {
        return;
    }
    let slot = queue_slots[side * (arrayLength(&queue_slots) / 2u) + id.x];
    var state = queue_states[slot];
    if path_step(slot, &state, path_sequence(slot), depth) {
        queue_states[slot] = state;
        queue_append(slot, depth + 1u);
    } else {
        path_end(slot, state);
    }
}
