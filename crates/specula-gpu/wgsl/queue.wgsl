// Paths in queues: all that live are taken from one vertex to the next, and those that go on make the next
// queue. Which place a path has in it depends on chance, and its result does not: that goes to its own slot.

import tracer::path::{PathState, path_is_wanted, path_sequence, path_begin, path_step, path_end};

/// The paths on their way, by their slots.
@group(0) @binding(6) var<storage, read_write> queue_states: array<PathState>;
/// Vertices before this one, paths in the queues of even vertices, and of odd ones.
@group(0) @binding(7) var<storage, read_write> queue_control: array<atomic<u32>, 3>;
/// Slots of the paths in the queues of even vertices, then of odd ones.
@group(0) @binding(8) var<storage, read_write> queue_slots: array<u32>;

/// Puts a path into the queue of a vertex.
fn queue_append(slot: u32, depth: u32) {
    let side = depth & 1u;
    let place = atomicAdd(&queue_control[1u + side], 1u);
    queue_slots[side * (arrayLength(&queue_slots) / 2u) + place] = slot;
}

/// Begins a path.
@compute @workgroup_size(64)
fn queue_begin(@builtin(global_invocation_id) id: vec3u) {
    let slot = id.x;
    if path_is_wanted(slot) {
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
