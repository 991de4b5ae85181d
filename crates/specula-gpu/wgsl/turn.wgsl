// Between two vertices of paths in queues: empties the queue that has been dealt with, and says how many
// workgroups the next one needs.

/// As `queue_control` in queue.wgsl.
@group(0) @binding(0) var<storage, read_write> turn_control: array<u32, 3>;
/// Workgroups along the three axes.
@group(0) @binding(1) var<storage, read_write> turn_workgroups: array<u32, 3>;

/// Turns to the next vertex; the first time, to the first.
@compute @workgroup_size(1)
fn turn_main() {
    let depth = turn_control[0] + 1u;
    turn_control[0] = depth;
    turn_control[2u - (depth & 1u)] = 0u;
    turn_workgroups[0] = (turn_control[1u + (depth & 1u)] + 63u) / 64u;
    turn_workgroups[1] = 1u;
    turn_workgroups[2] = 1u;
}
