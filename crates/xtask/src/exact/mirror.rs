//! The cone of valid half vectors a second time, by bisection, and the sampler that mirrors with
//! a third number: twins that the library's are compared with.

use specula_bsdf::Alpha;
use specula_bsdf::math::{Vec3, vec3};

/// The cone of one view above the horizon: see `docs/exact-reflection-sampling.md`.
pub(super) struct Cone {
    alpha: Alpha<f64>,
    wo: Vec3<f64>,
    /// The stretched view.
    pub(super) h: Vec3<f64>,
    lambda: f64,
    d: [f64; 2],
    /// The axis.
    pub(super) v: Vec3<f64>,
}

impl Cone {
    pub(super) fn new(alpha: Alpha<f64>, wo: Vec3<f64>) -> Self {
        let h = alpha.stretch(wo);
        let offsets = [wo.z * alpha.x * alpha.x, wo.z * alpha.y * alpha.y];
        let (mut low, mut high) = (wo.z, wo.z + h.length() + 1.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let poles = h.x * h.x / (middle + offsets[0]) + h.y * h.y / (middle + offsets[1]);
            if middle - wo.z < poles {
                low = middle;
            } else {
                high = middle;
            }
        }
        let d = offsets.map(|o| low + o);
        Self {
            alpha,
            wo,
            h,
            lambda: low,
            d,
            v: vec3(h.x / d[0], h.y / d[1], 1.0),
        }
    }

    /// The unit normal of the cone above the point `(x, y)` of the unit disk.
    pub(super) fn above(&self, x: f64, y: f64) -> Vec3<f64> {
        let foot = vec3(
            (self.lambda / self.d[0]).sqrt() * x,
            (self.lambda / self.d[1]).sqrt() * y,
            0.0,
        );
        let b = self.v.dot(foot);
        let v2 = self.v.length_squared();
        let height = (b * b + v2 * (1.0 - foot.length_squared())).max(0.0).sqrt() - b;
        foot + self.v * (height / v2)
    }

    /// The reflection sampled by three random numbers: uniform as seen along the axis, then mirrored about
    /// it with the probability that makes it uniform as seen along the view.
    pub(super) fn sample(&self, u: [f64; 3]) -> Vec3<f64> {
        let r = u[0].sqrt();
        let (sine, cosine) = (std::f64::consts::TAU * u[1]).sin_cos();
        let m = self.above(r * cosine, r * sine);
        let mirrored = self.above(-r * cosine, -r * sine);
        let (own, other) = (m.dot(self.h), mirrored.dot(self.h));
        let excess = (other - own) / (other + own);
        self.reflection(if u[2] < excess { mirrored } else { m })
    }

    /// The view reflected at a normal of the space of unit roughness.
    pub(super) fn reflection(&self, m: Vec3<f64>) -> Vec3<f64> {
        let m = self.alpha.stretch(m);
        m * (2.0 * self.wo.dot(m) / m.length_squared()) - self.wo
    }
}
