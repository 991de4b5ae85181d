// Warps of the unit square to densities that are bilinear on a grid and depend on the view.
//
//     p(x, y)                           bilinear within the cells
//     C(x, y) = int_0^x p(t, y) dt      along the rows
//     M(y)    = int_0^y C(1, t) dt
//
// A sample solves `M(y) = u.y`, then `C(x, y) = u.x C(1, y)`: quadratic equations within a cell. Slices are
// densities with their integrals, so that interpolated densities have the interpolated integrals.
//
// Source: Dupuy and Jakob 2018, section 5 and the data's loader.
// Twin of specula-bsdf/src/measured/warp.rs.

import package::measured::measured_grid::{MeasuredGridTable, measured_grid_between, measured_grid_cell, measured_grid_lerp};
import package::measured::measured_slices::{MeasuredSlices, measured_slices_value};

/// A floor of divisors.
const MEASURED_WARP_TINY: f32 = 1.1754944e-38;

/// Densities on the unit square, one for each slice, and the warps to them.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp.
struct MeasuredWarp {
    /// Nodes along x and y, at least 2 each.
    size: vec2u,
    /// Where the densities begin.
    density: u32,
    /// Where `C` at the nodes begins.
    along_rows: u32,
    /// Where `M` at the rows begins.
    marginal: u32,
}

/// Where in [0, 1] the integral of the density from `a` to `b` reaches `area`:
///
///     a t + (b - a) t^2 / 2 = area,   t = 2 area / (a + sqrt(a^2 + 2 (b - a) area))
///
/// Twin: specula-bsdf/src/measured/warp.rs, within_cell.
fn measured_warp_within(area: f32, a: f32, b: f32) -> f32 {
    let root = sqrt(max(a * a + 2.0 * (b - a) * area, 0.0));
    return clamp(2.0 * area / max(a + root, MEASURED_WARP_TINY), 0.0, 1.0);
}

/// Integral from 0 to `t` of the density from `a` to `b`.
///
/// Twin: specula-bsdf/src/measured/warp.rs, area.
fn measured_warp_area(t: f32, a: f32, b: f32) -> f32 {
    return t * (a + (b - a) * t * 0.5);
}

/// `M` at a row.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::sample.
fn measured_warp_below(warp: MeasuredWarp, at: MeasuredSlices, i: u32) -> f32 {
    return measured_slices_value(at, warp.marginal, warp.size.y, i);
}

/// `C(1, y)` at the rows `i` and `i + 1`.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::sample.
fn measured_warp_totals(warp: MeasuredWarp, at: MeasuredSlices, i: u32) -> vec2f {
    let nodes = warp.size.x * warp.size.y;
    let last = i * warp.size.x + warp.size.x - 1u;
    return vec2f(
        measured_slices_value(at, warp.along_rows, nodes, last),
        measured_slices_value(at, warp.along_rows, nodes, last + warp.size.x));
}

/// A value between the rows of a node and of the one above it.
///
/// * `data`: where the table begins; `place`: of the node within a slice; `t`: from one row to the next.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::invert.
fn measured_warp_across(
    warp: MeasuredWarp,
    at: MeasuredSlices,
    data: u32,
    place: u32,
    t: f32,
) -> f32 {
    let nodes = warp.size.x * warp.size.y;
    let lower = measured_slices_value(at, data, nodes, place);
    let upper = measured_slices_value(at, data, nodes, place + warp.size.x);
    return measured_grid_lerp(lower, upper, t);
}

/// The density at a point.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::pdf.
fn measured_warp_pdf(warp: MeasuredWarp, at: MeasuredSlices, p: vec2f) -> f32 {
    let cell = measured_grid_cell(warp.size, p);
    return measured_grid_between(MeasuredGridTable(warp.size, warp.density), at, cell, 1u, 0u);
}

/// From uniform random numbers to a point, with its density: `(x, y, density)`.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::sample.
fn measured_warp_sample(warp: MeasuredWarp, at: MeasuredSlices, u: vec2f) -> vec3f {
    let columns = f32(warp.size.x - 1u);
    let rows = f32(warp.size.y - 1u);
    var i = 0u;
    var end = warp.size.y - 1u;
    while end - i > 1u {
        let middle = (i + end) / 2u;
        if measured_warp_below(warp, at, middle) <= u.y {
            i = middle;
        } else {
            end = middle;
        }
    }
    let totals = measured_warp_totals(warp, at, i);
    let t = measured_warp_within((u.y - measured_warp_below(warp, at, i)) * rows, totals.x, totals.y);

    let target_area = u.x * measured_grid_lerp(totals.x, totals.y, t);
    let row = i * warp.size.x;
    var j = 0u;
    end = warp.size.x - 1u;
    while end - j > 1u {
        let middle = (j + end) / 2u;
        if measured_warp_across(warp, at, warp.along_rows, row + middle, t) <= target_area {
            j = middle;
        } else {
            end = middle;
        }
    }
    let left = measured_warp_across(warp, at, warp.density, row + j, t);
    let right = measured_warp_across(warp, at, warp.density, row + j + 1u, t);
    let rest = target_area - measured_warp_across(warp, at, warp.along_rows, row + j, t);
    let s = measured_warp_within(rest * columns, left, right);
    return vec3f((f32(j) + s) / columns, (f32(i) + t) / rows, measured_grid_lerp(left, right, s));
}

/// From a point to the random numbers that lead to it, with its density: `(u.x, u.y, density)`.
///
/// Twin: specula-bsdf/src/measured/warp.rs, Warp::invert.
fn measured_warp_invert(warp: MeasuredWarp, at: MeasuredSlices, p: vec2f) -> vec3f {
    let columns = f32(warp.size.x - 1u);
    let rows = f32(warp.size.y - 1u);
    let cell = measured_grid_cell(warp.size, p);
    let s = cell.part.x;
    let t = cell.part.y;
    let place = cell.node.y * warp.size.x + cell.node.x;
    let left = measured_warp_across(warp, at, warp.density, place, t);
    let right = measured_warp_across(warp, at, warp.density, place + 1u, t);
    let below = measured_warp_across(warp, at, warp.along_rows, place, t)
        + measured_warp_area(s, left, right) / columns;
    let totals = measured_warp_totals(warp, at, cell.node.y);
    let all_of_row = max(measured_grid_lerp(totals.x, totals.y, t), MEASURED_WARP_TINY);
    let under = measured_warp_below(warp, at, cell.node.y)
        + measured_warp_area(t, totals.x, totals.y) / rows;
    let u = clamp(vec2f(below / all_of_row, under), vec2f(0.0), vec2f(1.0));
    return vec3f(u, measured_grid_lerp(left, right, s));
}
