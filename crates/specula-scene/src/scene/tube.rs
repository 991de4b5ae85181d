//! Meshes along curves: where their centre lines are cut, and tubes around them.
//!
//! The centre line is nowhere further from its chords than 1/20 of the width.

use std::f64::consts::PI;

use glam::DVec3;

use crate::num::f32_of;
use crate::scene::Mesh;

/// How far chords may lie from the curve, over its width.
pub(crate) const TOLERANCE: f64 = 0.05;

/// Most chords of one segment.
const MOST_STEPS: u32 = 64;

/// The control points of a cubic Bezier segment.
pub(crate) type Bezier = [DVec3; 4];

/// A point of the centre line.
pub(crate) struct Station {
    pub(crate) point: DVec3,
    pub(crate) tangent: DVec3,
    pub(crate) width: f64,
    /// Growth of half the width along the centre line.
    pub(crate) slope: f64,
    /// Along the segment it belongs to.
    pub(crate) u: f64,
    /// Number of the segment.
    pub(crate) segment: usize,
}

/// Chords of a segment: `|p - chord| <= max|p''| / (8 n^2)`, `max|p''| <= 6 max|second difference|`.
pub(crate) fn steps([a, b, c, d]: &Bezier, width: f64) -> u32 {
    let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
    let steps = (6.0 * bend / (8.0 * TOLERANCE * width.max(1e-30))).sqrt();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to small numbers"
    )]
    let steps = steps.ceil().clamp(1.0, f64::from(MOST_STEPS)) as u32;
    steps
}

/// Where a curve of some segments is cut.
///
/// * `steps`: chords of a segment.
/// * `width`: of the curve at `u` of a segment, and its derivative by `u`.
pub(crate) fn stations(
    segments: &[Bezier],
    steps: impl Fn(usize) -> u32,
    width: impl Fn(usize, f64) -> [f64; 2],
) -> Vec<Station> {
    let mut stations: Vec<Station> = Vec::new();
    let mut last = DVec3::X;
    for (segment, control) in segments.iter().enumerate() {
        let [a, b, c, d] = *control;
        let n = steps(segment);
        for i in 0..=n {
            let u = f64::from(i) / f64::from(n);
            let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
            let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
            // Where control points coincide the chord has the direction.
            let tangent = (bcd - abc)
                .try_normalize()
                .or_else(|| (d - a).try_normalize())
                .unwrap_or(last);
            last = tangent;
            let [width, growth] = width(segment, u);
            let speed = 3.0 * (bcd - abc).length();
            let is_moving = speed > 0.0;
            stations.push(Station {
                point: abc.lerp(bcd, u),
                tangent,
                width,
                slope: if is_moving { 0.5 * growth / speed } else { 0.0 },
                u,
                segment,
            });
        }
    }
    stations
}

/// Circumradius over half the mean width from all around of a regular polygon: `2 n R sin(pi / n) / pi` is its width.
pub(crate) fn circumradius(sides: u32) -> f64 {
    let n = f64::from(sides);
    PI / (n * (PI / n).sin())
}

/// A tube around the stations; its frame turns no more than it must (Wang et al. 2008 by projection).
///
/// Its `uv` are the place along the segment, and around from 0 to 1.
pub(crate) fn tube(stations: &[Station], sides: u32, mesh: &mut Mesh) {
    let n = f64::from(sides);
    let fit = circumradius(sides);
    let Some(first) = stations.first() else {
        return;
    };
    let mut across = first.tangent.any_orthonormal_vector();
    for (row, station) in stations.iter().enumerate() {
        let t = station.tangent;
        across = (across - t * t.dot(across))
            .try_normalize()
            .unwrap_or_else(|| t.any_orthonormal_vector());
        let up = t.cross(across);
        for side in 0..=sides {
            let share = f64::from(side) / n;
            let (sin, cos) = (2.0 * PI * share).sin_cos();
            let outwards = across * cos + up * sin;
            let point = station.point + outwards * (0.5 * station.width * fit);
            let normal = match station.slope == 0.0 {
                true => outwards,
                false => (outwards - t * station.slope).normalize_or(outwards),
            };
            mesh.positions.push(point.to_array().map(f32_of));
            mesh.normals.push(normal.to_array().map(f32_of));
            mesh.uvs.push([f32_of(station.u), f32_of(share)]);
        }
        join(stations, row, sides, mesh);
    }
}

/// The centre line's direction at each vertex of a tube.
pub(crate) fn tangents(stations: &[Station], sides: u32) -> Vec<[f32; 4]> {
    let each = |station: &Station| {
        let [x, y, z] = station.tangent.to_array().map(f32_of);
        std::iter::repeat_n([x, y, z, 1.0], sides as usize + 1)
    };
    stations.iter().flat_map(each).collect()
}

/// Triangles between the last row of `columns + 1` vertices and the one before, where both belong to one segment.
///
/// * `row`: that of the last station.
pub(crate) fn join(stations: &[Station], row: usize, columns: u32, mesh: &mut Mesh) {
    if row == 0 || stations[row].segment != stations[row - 1].segment {
        return;
    }
    join_rows(columns, mesh);
}

/// Triangles between the last two rows of `columns + 1` vertices.
pub(crate) fn join_rows(columns: u32, mesh: &mut Mesh) {
    let width = columns + 1;
    // Within the limit of vertices, which fits 32 bits.
    let Some(first) =
        (u32::try_from(mesh.positions.len()).ok()).and_then(|n| n.checked_sub(2 * width))
    else {
        return;
    };
    for i in 0..columns {
        let a = first + i;
        let (b, c, d) = (a + 1, a + width, a + width + 1);
        for triangle in [[a, b, d], [a, d, c]] {
            let [p, q, r] = triangle.map(|i| mesh.positions[i as usize]);
            // Where the width is 0 a side has no length.
            if p != q && q != r && r != p {
                mesh.triangles.push(triangle);
            }
        }
    }
}

/// A segment of a uniform cubic B-spline as a Bezier segment.
pub(crate) fn cubic_spline<T>([a, b, c, d]: [T; 4], mean: impl Fn(T, T, f64) -> T) -> [T; 4]
where
    T: Copy,
{
    let (bc, cb) = (mean(b, c, 1.0 / 3.0), mean(c, b, 1.0 / 3.0));
    let (ba, cd) = (mean(b, a, 1.0 / 3.0), mean(c, d, 1.0 / 3.0));
    [mean(ba, bc, 0.5), bc, cb, mean(cb, cd, 0.5)]
}
