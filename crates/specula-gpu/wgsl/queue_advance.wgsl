// Between two vertices of a wavefront: empties the queue of the last one, and computes how many workgroups the next
// one needs.

/// As `queue_control` in queue.wgsl.
@group(0) @binding(0) var<storage, read_write> queue_advance_control: array<u32, 3>;
/// Workgroups along the three axes.
@group(0) @binding(1) var<storage, read_write> queue_advance_workgroups: array<u32, 3>;

/// Advances to the next vertex; at first, to vertex 0.
@compute @workgroup_size(1)
fn queue_advance_main() {
    let depth = queue_advance_control[0] + 1u;
    queue_advance_control[0] = depth;
    queue_advance_control[2u - (depth & 1u)] = 0u;
    queue_advance_workgroups[0] = (queue_advance_control[1u + (depth & 1u)] + 63u) / 64u;
    queue_advance_workgroups[1] = 1u;
    queue_advance_workgroups[2] = 1u;
}
