@group(0) @binding(1) var<storage, read> parity_arguments: array<f32>;
@group(0) @binding(2) var<storage, read_write> parity_results: array<f32>;
@group(0) @binding(3) var<storage, read> parity_rows: array<u32>;
