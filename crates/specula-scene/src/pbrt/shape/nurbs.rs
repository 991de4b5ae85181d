//! pbrt-v3's `nurbs`: a rational B-spline surface, diced into 30 by 30 points as it is there.
//!
//! With `N_i` the B-splines of the knots and `P_ij` the control points times their weights `w_ij`,
//!
//! ```text
//! S(u, v) = sum N_i(u) N_j(v) P_ij / sum N_i(u) N_j(v) w_ij
//! ```
//!
//! Source: Piegl and Tiller 1997, The NURBS Book, eq. 4.11; algorithms A2.1 to A2.3 for the splines and their
//! derivatives.

use std::ops::RangeInclusive;

use glam::{DVec3, DVec4};

use super::mesh_error;
use crate::error::SceneError;
use crate::grid;
use crate::num::f32_of;
use crate::pbrt::context::Entity;
use crate::scene::Mesh;

/// Points along a side.
const POINTS: u32 = 30;

/// Orders: splines of a degree below this.
const ORDERS: RangeInclusive<u32> = 2..=32;

/// Most control points along a side.
const MOST_POINTS: u32 = 1 << 14;

/// B-splines along one direction.
struct Splines<'a> {
    count: usize,
    order: usize,
    knots: &'a [f64],
    /// What is diced of them.
    range: [f64; 2],
}

/// Reads the shape.
pub(super) fn read(entity: &Entity) -> Result<Mesh, SceneError> {
    let u = Splines::read(entity, ["nu", "uorder", "uknots", "u0", "u1"])?;
    let v = Splines::read(entity, ["nv", "vorder", "vknots", "v0", "v1"])?;
    let points = control_points(entity, u.count * v.count)?;
    let mut mesh = Mesh::default();
    for j in 0..POINTS {
        for i in 0..POINTS {
            let at = [u.diced(i), v.diced(j)];
            let Some((position, normal)) = evaluate(&u, &v, &points, at) else {
                let message = "the weights of \"Pw\" cancel";
                return Err(mesh_error(entity, "Pw", message.to_owned()));
            };
            mesh.positions.push(position.to_array().map(f32_of));
            mesh.normals.push(normal.to_array().map(f32_of));
            mesh.uvs.push(at.map(f32_of));
        }
    }
    mesh.triangles = grid::triangles(&mesh.positions, [POINTS; 2]);
    Ok(mesh)
}

/// `(w x, w y, w z, w)`, with u fastest.
fn control_points(entity: &Entity, count: usize) -> Result<Vec<DVec4>, SceneError> {
    let params = &entity.params;
    let (name, points): (_, Vec<DVec4>) = match params.numbers("P", &["point3"])? {
        Some(numbers) => {
            let points = numbers.as_chunks::<3>().0.iter();
            ("P", points.map(|p| DVec3::from(*p).extend(1.0)).collect())
        }
        None => {
            let numbers = params.numbers("Pw", &["float"])?.unwrap_or(&[]);
            let points = numbers.as_chunks::<4>().0.iter();
            ("Pw", points.map(|p| DVec4::from(*p)).collect())
        }
    };
    if points.len() == count {
        return Ok(points);
    }
    let message = format!(
        "expected {count} control points in \"point3 P\" or \"float Pw\", found {}",
        points.len()
    );
    Err(mesh_error(entity, name, message))
}

impl<'a> Splines<'a> {
    fn read(entity: &'a Entity, names: [&str; 5]) -> Result<Self, SceneError> {
        let params = &entity.params;
        let [n, order, knots, from, to] = names;
        let count = params.integer_within(n, 2, 2..=MOST_POINTS)? as usize;
        let order = params.integer_within(order, 2, ORDERS)? as usize;
        let values = params.numbers(knots, &["float"])?.unwrap_or(&[]);
        let wrong = |message: String| mesh_error(entity, knots, format!("\"{knots}\": {message}"));
        if count < order {
            let message =
                format!("expected at least {order} control points, as the order is, found {count}");
            return Err(wrong(message));
        }
        if values.len() != count + order {
            let message = format!("expected {} knots, found {}", count + order, values.len());
            return Err(wrong(message));
        }
        let [first, last] = [values[order - 1], values[count]];
        if !values.is_sorted() || first >= last {
            return Err(wrong(
                "expected knots that do not fall, and that rise between".to_owned(),
            ));
        }
        let range = [params.float(from, first)?, params.float(to, last)?];
        if range[0] >= range[1] || range[0] < first || range[1] > last {
            let message = format!("expected \"{from}\" below \"{to}\", both in [{first}, {last}]");
            return Err(wrong(message));
        }
        Ok(Self {
            count,
            order,
            knots: values,
            range,
        })
    }

    fn diced(&self, i: u32) -> f64 {
        let share = f64::from(i) / f64::from(POINTS - 1);
        self.range[0] + share * (self.range[1] - self.range[0])
    }

    /// The first of the splines that are not 0 at `x`, and their values and derivatives.
    fn at(&self, x: f64) -> (usize, Vec<[f64; 2]>) {
        let degree = self.order - 1;
        let knots = self.knots;
        // The last span that begins at or before x, and has a length.
        let inner = &knots[self.order..=self.count];
        let mut span = degree + inner.partition_point(|k| *k <= x);
        span = span.min(self.count - 1);
        while knots[span + 1] <= knots[span] {
            span -= 1;
        }
        let mut values = vec![1.0];
        let mut lower = Vec::new();
        for d in 1..=degree {
            lower.clone_from(&values);
            values = vec![0.0; d + 1];
            for (r, low) in lower.iter().enumerate() {
                let (left, right) = (knots[span + 1 + r - d], knots[span + 1 + r]);
                let share = low / (right - left);
                values[r] += (right - x) * share;
                values[r + 1] += (x - left) * share;
            }
        }
        // N'_i = p (N_{i,p-1} / (t_{i+p} - t_i) - N_{i+1,p-1} / (t_{i+p+1} - t_{i+1})).
        let rate = |r: usize| {
            let (left, right) = (knots[span + 1 + r - degree], knots[span + 1 + r]);
            degree as f64 * lower[r] / (right - left)
        };
        let slope = |r: usize| {
            let before = if r > 0 { rate(r - 1) } else { 0.0 };
            let after = if r < degree { rate(r) } else { 0.0 };
            before - after
        };
        let both = values.iter().enumerate().map(|(r, v)| [*v, slope(r)]);
        (span - degree, both.collect())
    }
}

/// A point of the surface and its unit normal; `None`: its weight is 0.
fn evaluate(
    u: &Splines<'_>,
    v: &Splines<'_>,
    points: &[DVec4],
    at: [f64; 2],
) -> Option<(DVec3, DVec3)> {
    let ((first_u, of_u), (first_v, of_v)) = (u.at(at[0]), v.at(at[1]));
    let [mut sum, mut along_u, mut along_v] = [DVec4::ZERO; 3];
    for (j, [nv, dv]) in of_v.iter().enumerate() {
        for (i, [nu, du]) in of_u.iter().enumerate() {
            let p = points[(first_v + j) * u.count + first_u + i];
            sum += p * (nu * nv);
            along_u += p * (du * nv);
            along_v += p * (nu * dv);
        }
    }
    let position = sum.truncate() / sum.w;
    let derivative = |d: DVec4| (d.truncate() - position * d.w) / sum.w;
    let (du, dv) = (derivative(along_u), derivative(along_v));
    // Where the surface has a tip: something upright.
    let normal = du.cross(dv).normalize_or(DVec3::Z);
    position.is_finite().then_some((position, normal))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a cylinder of radius 1, exactly a circle across, by the weights of a rational arc.
    #[test]
    fn rational_splines_make_circles() {
        let half = 0.5_f64.sqrt();
        let arc = [[1.0, 0.0, 1.0], [1.0, 1.0, half], [0.0, 1.0, 1.0]];
        let mut points = Vec::new();
        for z in [0.0, 2.0] {
            for [x, y, w] in arc {
                points.push(DVec4::new(x * w, y * w, z * w, w));
            }
        }
        let u = Splines {
            count: 3,
            order: 3,
            knots: &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            range: [0.0, 1.0],
        };
        let v = Splines {
            count: 2,
            order: 2,
            knots: &[0.0, 0.0, 1.0, 1.0],
            range: [0.0, 1.0],
        };
        for i in 0..=20 {
            let at = [f64::from(i) / 20.0, 0.25];
            let (p, n) = evaluate(&u, &v, &points, at).unwrap();
            let across = p.truncate();
            assert!((across.length() - 1.0).abs() < 1e-12, "{p}");
            assert!((p.z - 0.5).abs() < 1e-12);
            assert!((n.truncate() - across).length() < 1e-9, "{n} and {p}");
        }
    }

    /// Splines sum to 1, their derivatives to 0 and to the differences of values, over uneven and repeated knots.
    #[test]
    fn splines_sum_to_one_and_have_their_slopes() {
        let splines = Splines {
            count: 7,
            order: 4,
            knots: &[0.0, 0.0, 0.0, 0.0, 0.3, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0],
            range: [0.0, 1.0],
        };
        let all = |x: f64| {
            let (first, values) = splines.at(x);
            let mut all = [0.0; 7];
            for (i, [value, _]) in values.iter().enumerate() {
                all[first + i] = *value;
            }
            all
        };
        for i in 0..=40 {
            let x = f64::from(i) / 40.0;
            let (first, values) = splines.at(x);
            let sum = |k: usize| values.iter().map(|v| v[k]).sum::<f64>();
            assert!((sum(0) - 1.0).abs() < 1e-12 && sum(1).abs() < 1e-9, "{x}");
            if [0.0, 0.3, 0.5, 1.0].iter().all(|k| (x - k).abs() > 1e-3) {
                let (low, high) = (all(x - 1e-6), all(x + 1e-6));
                for (i, [_, slope]) in values.iter().enumerate() {
                    let difference = (high[first + i] - low[first + i]) / 2e-6;
                    assert!(
                        (difference - slope).abs() < 1e-6,
                        "{x}: {difference} and {slope}"
                    );
                }
            }
        }
    }
}
