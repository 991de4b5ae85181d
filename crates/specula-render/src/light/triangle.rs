//! Triangles that emit light, sampled uniformly by area.

use specula_bsdf::Vec3;

use super::area::{AreaSample, by_area};
use crate::convert::{abs, narrow};
use crate::geometry::normal_of;

/// A triangle, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(super) corner: Vec3<f32>,
    pub(super) edges: [Vec3<f32>; 2],
    pub(super) normal: Vec3<f32>,
    pub(super) area: f32,
}

impl Triangle {
    /// By its corners, in winding order about the outside.
    pub(super) fn new([a, b, c]: [Vec3<f32>; 3]) -> Self {
        let edges = [b - a, c - a];
        let cross = edges[0].cast::<f64>().cross(edges[1].cast());
        Self {
            corner: a,
            edges,
            normal: normal_of(edges[0], edges[1]),
            area: narrow(0.5 * cross.length()),
        }
    }

    /// The point that `u` leads to, uniform by area.
    #[inline(always)]
    pub(super) fn point(&self, u: [f32; 2]) -> Vec3<f32> {
        let [b, c] = weights(u);
        self.corner + self.edges[0] * b + self.edges[1] * c
    }

    /// A point as seen from `p`.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline(always)]
    pub(super) fn sample(&self, p: Vec3<f32>, u: [f32; 2]) -> AreaSample {
        let reach = abs(self.corner) + abs(self.edges[0]) + abs(self.edges[1]);
        by_area(p, self.point(u), reach, self.normal, 1.0 / self.area)
    }
}

/// Barycentric weights of the second and third corner, uniform by area and continuous.
///
/// Source: Heitz 2019, A Low-Distortion Map Between Triangle and Square.
#[inline(always)]
pub(super) fn weights([u, v]: [f32; 2]) -> [f32; 2] {
    let half = 0.5 * if v > u { u } else { v };
    if v > u {
        [half, v - half]
    } else {
        [u - half, half]
    }
}
