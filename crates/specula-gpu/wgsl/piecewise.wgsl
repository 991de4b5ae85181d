// A distribution over the unit square, constant in every cell of a grid, sampled by its CDFs.
//
// Its words are the CDFs of the cells in each row, `width + 1` words a row, and the CDF of the rows, `height + 1`.
//
// Twin of specula-render/src/light/piecewise.rs.

import tracer::world::{number};

/// The largest number below 1 that is a multiple of `f32`'s epsilon.
const PIECEWISE_BELOW_ONE: f32 = 0.9999999;

/// A cell along one axis, and the position of a point within it.
struct PiecewiseCell {
    /// Its index.
    cell: u32,
    /// In `[0, 1]`.
    within: f32,
}

/// Inverts a CDF: the cell among `count` in which `u` falls, and the position within it.
///
/// * `cdf`: offset of the `count + 1` values of the CDF.
///
/// Twin: specula-render/src/light/piecewise.rs, invert.
fn piecewise_invert(cdf: u32, count: u32, u: f32) -> PiecewiseCell {
    var cell = 0u;
    var size = count;
    while size > 1u {
        let part = size / 2u;
        cell += select(0u, part, number(cdf + cell + part) <= u);
        size -= part;
    }
    let begin = number(cdf + cell);
    let width = number(cdf + cell + 1u) - begin;
    if width > 0.0 {
        return PiecewiseCell(cell, clamp((u - begin) / width, 0.0, PIECEWISE_BELOW_ONE));
    }
    return PiecewiseCell(cell, 0.5);
}

/// Samples a point by a grid of `cells` x `cells`.
///
/// * `rows`, `columns`: offsets of the CDFs of the cells in each row, and of the CDF of the rows.
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/piecewise.rs, Piecewise::sample.
fn piecewise_sample(rows: u32, columns: u32, cells: u32, u: vec2f) -> vec2f {
    let down = piecewise_invert(columns, cells, u.y);
    let across = piecewise_invert(rows + down.cell * (cells + 1u), cells, u.x);
    let at = vec2f(f32(across.cell) + across.within, f32(down.cell) + down.within);
    return at / f32(cells);
}

/// Density per area of the square with which `piecewise_sample` samples a point.
///
/// Twin: specula-render/src/light/piecewise.rs, Piecewise::density.
fn piecewise_density(rows: u32, columns: u32, cells: u32, uv: vec2f) -> f32 {
    let x = min(u32(max(uv.x, 0.0) * f32(cells)), cells - 1u);
    let y = min(u32(max(uv.y, 0.0) * f32(cells)), cells - 1u);
    let row = rows + y * (cells + 1u) + x;
    let share = (number(row + 1u) - number(row)) * (number(columns + y + 1u) - number(columns + y));
    return share * f32(cells) * f32(cells);
}
