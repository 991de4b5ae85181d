// Wavefronts of paths, in queues: all paths are taken from one vertex to the next. A kernel traces them, one shades what
// they hit, one casts shadow rays; queue_advance.wgsl makes the next queue of those that continue. Kernels that trace and
// do little else are faster: a kernel's registers and stacks are those of its most demanding part (Laine, Karras and
// Aila 2013). The order of a queue is not deterministic. Results are, since every path writes to its own slot.

import tracer::path::{PathState, PATH_ENDS, path_is_requested, path_sequence, path_begin, path_trace, path_shade};
import tracer::path::{path_connect, path_end};
import tracer::queue_state::{queue_state_begun, queue_state_to_trace, queue_state_traced, queue_state_to_shade};
import tracer::queue_state::{queue_state_shaded, queue_state_shadow, queue_state_to_connect, queue_state_connected};

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
        queue_state_begun(slot, path_begin(slot, path_sequence(slot)));
        queue_slots[queue_entry(slot)] = slot;
    } else {
        queue_slots[queue_entry(slot)] = NONE;
    }
}

/// The slot of a path in the queue of the current depth; NONE where there is none, or the path has ended.
fn queue_slot(place: u32) -> u32 {
    if !queue_has(place) {
        return NONE;
    }
    return queue_slots[queue_entry(place)];
}

/// Ends a path of the queue of the current depth.
fn queue_end(place: u32, slot: u32, state: PathState) {
    path_end(slot, state);
    queue_slots[queue_entry(place)] = NONE;
}

/// Traces a path to its next vertex.
@compute @workgroup_size(64)
fn queue_trace(@builtin(global_invocation_id) id: vec3u) {
    let slot = queue_slot(id.x);
    if slot == NONE {
        return;
    }
    var state = queue_state_to_trace(slot);
    path_trace(&state, path_sequence(slot), queue_slots[0]);
    queue_state_traced(slot, state);
}

/// Shades the vertex that a path has come to.
@compute @workgroup_size(64)
fn queue_shade(@builtin(global_invocation_id) id: vec3u) {
    let slot = queue_slot(id.x);
    if slot == NONE {
        return;
    }
    var state = queue_state_to_shade(slot);
    let shadow = path_shade(slot, &state, path_sequence(slot), queue_slots[0]);
    if (state.flags & PATH_ENDS) != 0u && all(shadow.contribution == vec3f(0.0)) {
        queue_end(id.x, slot, state);
        return;
    }
    queue_state_shaded(slot, state, shadow);
}

/// Casts the shadow ray of a path.
@compute @workgroup_size(64)
fn queue_connect(@builtin(global_invocation_id) id: vec3u) {
    let slot = queue_slot(id.x);
    if slot == NONE {
        return;
    }
    var state = queue_state_to_connect(slot);
    path_connect(&state, queue_state_shadow(slot), path_sequence(slot), queue_slots[0]);
    if (state.flags & PATH_ENDS) != 0u {
        queue_end(id.x, slot, state);
        return;
    }
    queue_state_connected(slot, state);
}
