// Piecewise bilinear functions on the unit square: of a measurement, and for each of its views.
//
// Twin of specula-bsdf/src/measured/warp.rs.

import package::measured::measured_slices::{MeasuredSlices, measured_slices_value};
import package::measured::measured_table::{measured_table};

/// A bilinear function.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Grid.
struct MeasuredGridTable {
    /// Nodes along x and y, at least 2 each.
    size: vec2u,
    /// Where its rows of x begin.
    start: u32,
}

/// A cell of a grid, and a place within it.
struct MeasuredGridCell {
    /// Column and row of its first node.
    node: vec2u,
    /// From 0 to 1 along x and y.
    part: vec2f,
}

/// The cell of a point; beyond the square the nearest one.
///
/// Twin: specula-bsdf/src/measured/warp.rs, cell.
fn measured_grid_cell(size: vec2u, p: vec2f) -> MeasuredGridCell {
    let x = clamp(p.x, 0.0, 1.0) * f32(size.x - 1u);
    let y = clamp(p.y, 0.0, 1.0) * f32(size.y - 1u);
    let j = min(u32(x), size.x - 2u);
    let i = min(u32(y), size.y - 2u);
    return MeasuredGridCell(vec2u(j, i), vec2f(x - f32(j), y - f32(i)));
}

/// Between `a` and `b`.
///
/// Twin: specula-bsdf/src/measured/warp.rs, lerp.
fn measured_grid_lerp(a: f32, b: f32, t: f32) -> f32 {
    return a * (1.0 - t) + b * t;
}

/// The value at a point.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Grid::eval.
fn measured_grid_eval(grid: MeasuredGridTable, p: vec2f) -> f32 {
    let cell = measured_grid_cell(grid.size, p);
    let first = grid.start + cell.node.y * grid.size.x + cell.node.x;
    let second = first + grid.size.x;
    let lower = measured_grid_lerp(measured_table(first), measured_table(first + 1u), cell.part.x);
    let upper = measured_grid_lerp(measured_table(second), measured_table(second + 1u), cell.part.x);
    return measured_grid_lerp(lower, upper, cell.part.y);
}

/// The value at a point between views, of one of the channels that each slice has.
///
/// * `channels`: how many; `channel`: which.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Colours::eval; with one channel Warp::pdf.
fn measured_grid_between(
    grid: MeasuredGridTable,
    at: MeasuredSlices,
    cell: MeasuredGridCell,
    channels: u32,
    channel: u32,
) -> f32 {
    let nodes = grid.size.x * grid.size.y;
    let first = channel * nodes + cell.node.y * grid.size.x + cell.node.x;
    var rows = vec2f(0.0);
    for (var i = 0u; i < 2u; i++) {
        let place = first + i * grid.size.x;
        let left = measured_slices_value(at, grid.start, channels * nodes, place);
        let right = measured_slices_value(at, grid.start, channels * nodes, place + 1u);
        rows = vec2f(rows.y, measured_grid_lerp(left, right, cell.part.x));
    }
    return measured_grid_lerp(rows.x, rows.y, cell.part.y);
}
