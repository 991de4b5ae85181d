// Between two vertices of a wavefront: the next queue, of the paths that continue, and how many workgroups it needs.

/// As `queue_slots` in queue.wgsl.
@group(0) @binding(0) var<storage, read_write> queue_advance_slots: array<atomic<u32>>;
/// Workgroups along the three axes.
@group(0) @binding(1) var<storage, read_write> queue_advance_workgroups: array<u32, 3>;

/// Words before the first queue, as `QUEUE_HEAD` in queue.wgsl.
const QUEUE_ADVANCE_HEAD: u32 = 3u;
/// A path that has ended.
const QUEUE_ADVANCE_ENDED: u32 = 0xffffffffu;

/// Paths of the workgroup that continue.
var<workgroup> queue_advance_count: atomic<u32>;
/// Where they begin in the next queue.
var<workgroup> queue_advance_begin: u32;

/// Appends paths that continue to the next queue. A workgroup adds to the queue's length once: single additions of all
/// threads to one word would take their turns.
@compute @workgroup_size(64)
fn queue_advance_compact(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) lane: u32) {
    let side = atomicLoad(&queue_advance_slots[0]) & 1u;
    let half = (arrayLength(&queue_advance_slots) - QUEUE_ADVANCE_HEAD) / 2u;
    var slot = QUEUE_ADVANCE_ENDED;
    if id.x < atomicLoad(&queue_advance_slots[1u + side]) {
        slot = atomicLoad(&queue_advance_slots[QUEUE_ADVANCE_HEAD + side * half + id.x]);
    }
    var place = 0u;
    if slot != QUEUE_ADVANCE_ENDED {
        place = atomicAdd(&queue_advance_count, 1u);
    }
    workgroupBarrier();
    if lane == 0u {
        queue_advance_begin = atomicAdd(&queue_advance_slots[2u - side], atomicLoad(&queue_advance_count));
    }
    workgroupBarrier();
    if slot != QUEUE_ADVANCE_ENDED {
        let next = QUEUE_ADVANCE_HEAD + (1u - side) * half + queue_advance_begin + place;
        atomicStore(&queue_advance_slots[next], slot);
    }
}

/// Advances to the next vertex; at first, to vertex 0.
@compute @workgroup_size(1)
fn queue_advance_main() {
    let depth = atomicLoad(&queue_advance_slots[0]) + 1u;
    atomicStore(&queue_advance_slots[0], depth);
    atomicStore(&queue_advance_slots[2u - (depth & 1u)], 0u);
    queue_advance_workgroups[0] = (atomicLoad(&queue_advance_slots[1u + (depth & 1u)]) + 63u) / 64u;
    queue_advance_workgroups[1] = 1u;
    queue_advance_workgroups[2] = 1u;
}
