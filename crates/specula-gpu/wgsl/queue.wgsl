// Wavefronts of paths, in queues: all paths are taken from one vertex to the next, and queue_advance.wgsl makes the next
// queue of those that continue. The order of a queue is not deterministic. Results are, since every path writes to its
// own slot.

import tracer::path::{PathState, path_is_requested, path_sequence, path_begin, path_step, path_end};

/// States of the paths, by slot.
@group(0) @binding(6) var<storage, read_write> queue_states: array<PathState>;
/// Depth of the current vertex, numbers of paths in the queues of even depths and of odd ones; then slots of the paths in
/// the queue of even depths, and of odd ones, NONE where a path has ended.
@group(0) @binding(7) var<storage, read_write> queue_slots: array<u32>;

/// Words before the first queue.
const QUEUE_HEAD: u32 = 3u;

/// Where an entry of the queue of the current depth is.
fn queue_entry(place: u32) -> u32 {
    return QUEUE_HEAD + (queue_slots[0] & 1u) * ((arrayLength(&queue_slots) - QUEUE_HEAD) / 2u) + place;
}

/// Whether the queue of the current depth has so many entries.
fn queue_has(place: u32) -> bool {
    return place < queue_slots[1u + (queue_slots[0] & 1u)];
}

/// Begins a path.
@compute @workgroup_size(64)
fn queue_begin(@builtin(global_invocation_id) id: vec3u) {
    let slot = id.x;
    if !queue_has(slot) {
        return;
    }
    if path_is_requested(slot) {
        queue_states[slot] = path_begin(slot, path_sequence(slot));
        queue_slots[queue_entry(slot)] = slot;
    } else {
        queue_slots[queue_entry(slot)] = NONE;
    }
}

/// Takes a path to its next vertex.
@compute @workgroup_size(64)
fn queue_bounce(@builtin(global_invocation_id) id: vec3u) {
    if !queue_has(id.x) {
        return;
    }
    let slot = queue_slots[queue_entry(id.x)];
    var state = queue_states[slot];
    if path_step(slot, &state, path_sequence(slot), queue_slots[0]) {
        queue_states[slot] = state;
    } else {
        path_end(slot, state);
        queue_slots[queue_entry(id.x)] = NONE;
    }
}
