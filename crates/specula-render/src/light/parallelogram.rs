//! Parallelograms that emit light: rectangles are sampled uniformly by solid angle, others by area.
//!
//! Source: Urena, Fajardo and King 2013, An Area-Preserving Parametrization for Spherical Rectangles.
//! Departures: the angles of the spherical rectangle are stored as what they exceed a right angle by, so
//! that their sum does not cancel against a full turn; eq. for `x` without quotients of sines.

use specula_bsdf::Vec3;

use super::angles::{sin_cos_of_half, turns};
use super::area::AreaSample;
use crate::convert::{abs, narrow};
use crate::geometry::unit_or;
use crate::offset::coupled;
use crate::words::Words;

/// Solid angle in sr below which rectangles too are sampled by area: rounding takes 6e-7 of it.
const LEAST_SOLID_ANGLE: f32 = 1e-3;
/// Largest cosine between the sides of a rectangle.
const RIGHT_ANGLE: f32 = 1e-5;

/// A parallelogram, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parallelogram {
    pub(super) corner: Vec3<f32>,
    pub(super) edges: [Vec3<f32>; 2],
    pub(crate) normal: Vec3<f32>,
    pub(super) area: f32,
    /// Edges of length 1, and the lengths.
    pub(super) axes: [Vec3<f32>; 2],
    pub(super) sides: [f32; 2],
    /// Solid angle from which on it is sampled by that.
    pub(super) least: f32,
    /// Bound on the error of each component of a point.
    pub(crate) error: Vec3<f32>,
}

/// A point of a parallelogram, seen from another point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ParallelogramSample {
    pub(crate) point: Vec3<f32>,
    /// Towards it, unit.
    pub(crate) wi: Vec3<f32>,
    /// In 1/sr; 0 where the point is of no use.
    pub(crate) pdf: f32,
}

/// A rectangle from a point, in the coordinates of its sides with the point as origin.
struct Spread {
    x: [f32; 2],
    y: [f32; 2],
    /// Distance to its plane.
    h: f32,
    /// Components along the normal of the planes through the point and the lower and upper side.
    b: [f32; 2],
    /// What the last two angles exceed right angles by, in turns.
    last: f32,
    /// In turns: over 2 pi.
    solid_angle: f32,
}

impl Parallelogram {
    /// * `corner` and its neighbours, in winding order about the outside.
    pub(super) fn new([corner, b, c]: [Vec3<f32>; 3]) -> Self {
        let edges = [b - corner, c - corner];
        let cross = edges[0].cast::<f64>().cross(edges[1].cast());
        let axes = edges.map(|e| unit_or(e, Vec3::ZERO));
        let right = axes[0].dot(axes[1]).abs() < RIGHT_ANGLE;
        Self {
            corner,
            edges,
            normal: unit_or(edges[0].cross(edges[1]), Vec3::Z),
            area: narrow(cross.length()),
            axes,
            sides: [0, 1].map(|k| edges[k].dot(axes[k])),
            least: if right {
                LEAST_SOLID_ANGLE
            } else {
                f32::INFINITY
            },
            error: coupled(abs(corner) + abs(edges[0]) + abs(edges[1])),
        }
    }

    /// 25 words for shaders, which have no infinity.
    pub(super) fn flatten(&self, to: &mut Words) {
        for v in [self.corner, self.edges[0], self.edges[1], self.normal] {
            to.vector(v);
        }
        to.number(self.area);
        for axis in self.axes {
            to.vector(axis);
        }
        to.floats(self.sides);
        to.number(self.least.min(f32::MAX));
        to.vector(self.error);
    }

    /// A point as seen from `p`.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline(always)]
    pub(crate) fn sample(&self, p: Vec3<f32>, u: [f32; 2]) -> ParallelogramSample {
        let spread = self.spread(p);
        let solid_angle = core::f32::consts::TAU * spread.solid_angle;
        let by_angle = solid_angle >= self.least;
        let weights = spread.sample(u, self.sides);
        let at = |k: usize| if by_angle { weights[k] } else { u[k] };
        let point = self.corner + self.edges[0] * at(0) + self.edges[1] * at(1);
        let d = point - p;
        let distance_squared = d.length_squared();
        let wi = d * (1.0 / distance_squared.sqrt());
        let per_area = distance_squared / (self.area * self.normal.dot(wi).abs());
        let pdf = if by_angle {
            1.0 / solid_angle
        } else {
            per_area
        };
        let usable = (pdf > 0.0) & (pdf < f32::INFINITY) & (wi.length_squared() > 0.5);
        ParallelogramSample {
            point,
            wi,
            pdf: if usable { pdf } else { 0.0 },
        }
    }

    /// [`Self::sample`] with what all of its points have in common.
    #[inline(always)]
    pub(super) fn area_sample(&self, p: Vec3<f32>, u: [f32; 2]) -> AreaSample {
        let ParallelogramSample { point, wi, pdf } = self.sample(p, u);
        AreaSample {
            point,
            error: self.error,
            normal: self.normal,
            wi,
            pdf,
        }
    }

    /// Density in 1/sr with which the direction from `p` to the point `q` is sampled.
    #[inline(always)]
    pub(super) fn pdf(&self, p: Vec3<f32>, q: Vec3<f32>) -> f32 {
        let solid_angle = core::f32::consts::TAU * self.spread(p).solid_angle;
        if solid_angle >= self.least {
            return 1.0 / solid_angle;
        }
        let d = q - p;
        let distance_squared = d.length_squared();
        let cos = self.normal.dot(d).abs() / distance_squared.sqrt();
        distance_squared / (self.area * cos)
    }

    #[inline(always)]
    fn spread(&self, p: Vec3<f32>) -> Spread {
        let d = self.corner - p;
        let (x0, y0) = (d.dot(self.axes[0]), d.dot(self.axes[1]));
        let (x1, y1) = (x0 + self.sides[0], y0 + self.sides[1]);
        let h = d.dot(self.normal).abs();
        let along = |t: f32| t / (t * t + h * h).sqrt();
        let [left, right, low, high] = [-along(x0), along(x1), -along(y0), along(y1)];
        let excess = |sine: f32| {
            let rest = (1.0 - sine) * (1.0 + sine);
            turns(sine, if rest > 0.0 { rest.sqrt() } else { 0.0 })
        };
        let last = excess(high * left) + excess(left * low);
        Spread {
            x: [x0, x1],
            y: [y0, y1],
            h,
            b: [low, high],
            last,
            solid_angle: excess(low * right) + excess(right * high) + last,
        }
    }
}

impl Spread {
    /// Weights of the two edges of a point sampled uniformly by solid angle.
    #[inline(always)]
    fn sample(&self, u: [f32; 2], sides: [f32; 2]) -> [f32; 2] {
        let h = self.h;
        let (sin, cos) = sin_cos_of_half(u[0] * self.solid_angle - self.last);
        let q = cos * self.b[0] + self.b[1];
        let c = sin * h / (h * h + self.y[0] * self.y[0]).sqrt();
        let x = (h * sin).copysign(q * sin) / ((q - c) * (q + c)).sqrt();
        let x = between(x, self.x);
        let d2 = x * x + h * h;
        let ends = self.y.map(|y| y / (d2 + y * y).sqrt());
        let t = ends[0] + u[1] * (ends[1] - ends[0]);
        let y = between(t * (d2 / ((1.0 - t) * (1.0 + t))).sqrt(), self.y);
        let weight = |at: f32, side: f32| between(at / side, [0.0, 1.0]);
        [
            weight(x - self.x[0], sides[0]),
            weight(y - self.y[0], sides[1]),
        ]
    }
}

/// A value, clamped to its bounds; the upper one where it is NaN.
#[inline(always)]
fn between(v: f32, [low, high]: [f32; 2]) -> f32 {
    let v = if v < high { v } else { high };
    if v > low { v } else { low }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::vec3;

    const SIDES: [f32; 2] = [0.6, 1.5];
    /// Cells along each side.
    const CELLS: usize = 6;

    /// The same rectangle turned away from the axes, far from the origin.
    fn rectangle() -> (Parallelogram, impl Fn(Vec3<f32>) -> Vec3<f32>) {
        let frame = specula_bsdf::Frame::from_normal(vec3(0.48, -0.6, 0.64));
        let place = move |p: Vec3<f32>| frame.to_world(p) + vec3(3.0, -2.0, 1.0);
        let corners = [
            Vec3::ZERO,
            vec3(SIDES[0], 0.0, 0.0),
            vec3(0.0, SIDES[1], 0.0),
        ];
        (Parallelogram::new(corners.map(place)), place)
    }

    /// Solid angles of the cells, by the midpoint rule.
    fn solid_angles(p: Vec3<f32>) -> Vec<f64> {
        let fine = 200;
        let mut sums = vec![0.0; CELLS * CELLS];
        let [w, h] = SIDES.map(f64::from);
        let area = w * h / ((CELLS * fine) as f64).powi(2);
        for i in 0..CELLS * fine {
            for j in 0..CELLS * fine {
                let at = |k: usize| (k as f64 + 0.5) / (CELLS * fine) as f64;
                let d = vec3(w * at(i), h * at(j), 0.0) - p.cast::<f64>();
                let distance = d.length();
                sums[i / fine * CELLS + j / fine] += area * d.z.abs() / distance.powi(3);
            }
        }
        sums
    }

    /// From within its outline, from beside it, from behind, from far away and next to its plane.
    #[test]
    fn rectangles_are_sampled_uniformly_by_solid_angle() {
        let (light, place) = rectangle();
        for p in [
            vec3(0.2, 0.9, 0.3),
            vec3(0.3, 0.75, -0.05),
            vec3(-0.8, 0.1, 0.4),
            vec3(2.0, 3.0, 1.0),
            vec3(0.0, 0.0, 0.5),
            vec3(0.6, -0.4, 0.02),
            vec3(-3.0, 9.0, 12.0),
        ] {
            let expected = solid_angles(p);
            let whole: f64 = expected.iter().sum();
            let n = 600_u32;
            let mut found = vec![0.0; CELLS * CELLS];
            for k in 0..n * n {
                let u = [k / n, k % n].map(|i| (i as f32 + 0.5) / n as f32);
                let seen = light.sample(place(p), u);
                assert!(
                    (f64::from(seen.pdf) * whole - 1.0).abs() < 1e-3,
                    "{p:?}: {seen:?}"
                );
                assert_eq!(seen.pdf, light.pdf(place(p), seen.point));
                let towards = (seen.point - place(p)).normalize();
                assert!((towards - seen.wi).length() < 1e-5);
                let d = seen.point - light.corner;
                let cell = [0, 1].map(|k| {
                    let at = d.dot(light.axes[k]) / SIDES[k];
                    crate::convert::floor_index(at * CELLS as f32).min(CELLS - 1)
                });
                found[cell[0] * CELLS + cell[1]] += 1.0 / f64::from(n * n);
            }
            for (e, f) in expected.iter().zip(&found) {
                // The grid's lines and the cells' borders: a line of points, and rounding.
                assert!((e / whole - f).abs() < 3e-3, "{p:?}: {} {f}", e / whole);
            }
        }
    }

    /// `E[1 / pdf]` is the solid angle either way of sampling.
    #[test]
    fn densities_are_of_what_is_sampled() {
        let skewed = [Vec3::ZERO, vec3(1.0, 0.0, 0.0), vec3(0.4, 0.8, 0.0)];
        let square = [Vec3::ZERO, vec3(0.02, 0.0, 0.0), vec3(0.0, 0.02, 0.0)];
        for (corners, p) in [(skewed, vec3(0.3, 0.2, 0.9)), (square, vec3(0.1, 0.3, 0.7))] {
            let light = Parallelogram::new(corners);
            let n = 400_u32;
            let (mut by_samples, mut by_area) = (0.0, 0.0);
            for k in 0..n * n {
                let u = [k / n, k % n].map(|i| (i as f32 + 0.5) / n as f32);
                let seen = light.sample(p, u);
                assert!((light.pdf(p, seen.point) / seen.pdf - 1.0).abs() < 1e-5);
                by_samples += 1.0 / f64::from(seen.pdf);
                let point = corners[0] + light.edges[0] * u[0] + light.edges[1] * u[1];
                let d = (point - p).cast::<f64>();
                by_area += f64::from(light.area) * d.z.abs() / d.length().powi(3);
            }
            assert!(
                (by_samples / by_area - 1.0).abs() < 1e-4,
                "{by_samples} {by_area}"
            );
        }
    }

    /// No point of view makes a value that is not a number.
    #[test]
    fn views_of_every_kind_stay_finite() {
        let (light, place) = rectangle();
        let near = [0.0, 1e-30, 1e-6, 1e-3, 0.3, 0.6, 1.5, 1e3, 1e12];
        for k in 0..near.len().pow(3) {
            let [x, y, z] = [1, near.len(), near.len().pow(2)].map(|d| near[k / d % near.len()]);
            for sign in [1.0, -1.0] {
                let p = place(vec3(sign * x, sign * y, z));
                for u in [[0.0, 0.0], [0.3, 0.7], [0.999_999_9, 0.999_999_9]] {
                    let seen = light.sample(p, u);
                    assert!(seen.pdf >= 0.0 && seen.pdf.is_finite(), "{p:?} {seen:?}");
                    let inside = (seen.point - light.corner).length() < 1.7;
                    assert!(inside || seen.pdf == 0.0, "{p:?} {seen:?}");
                }
            }
        }
    }
}
