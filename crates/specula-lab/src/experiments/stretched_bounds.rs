//! Where reflections above the surface lie in the space of unit roughness, and the bounds around them.
//!
//! There reflections off visible normals are uniform on a spherical cap about z. `wo` is the papers' i,
//! a hat stands for the space of unit roughness.

use std::f64::consts::PI;

use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Vec3};

/// A view of a rough surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Alphas.
    pub(super) alpha: Alpha<f64>,
    /// Towards the viewer; `z > 0`.
    pub(super) wo: Vec3<f64>,
}

impl View {
    /// The view with the given x and y.
    pub(super) fn of_xy((ax, ay): (f64, f64), (x, y): (f64, f64)) -> Self {
        let wo = Vec3 {
            x,
            y,
            z: (1.0 - x * x - y * y).sqrt(),
        };
        let alpha = Alpha::clamped(ax, ay);
        Self { alpha, wo }
    }

    /// The view at a polar angle and an azimuth.
    pub(super) fn of_angles(alphas: (f64, f64), theta_deg: f64, phi_deg: f64) -> Self {
        let sine = theta_deg.to_radians().sin();
        let (y, x) = phi_deg.to_radians().sin_cos();
        Self::of_xy(alphas, (sine * x, sine * y))
    }

    /// `|(ax x, ay y, z)|`.
    pub(super) fn length(&self) -> f64 {
        self.alpha.stretch(self.wo).length()
    }

    /// `i^.z`.
    fn height(&self) -> f64 {
        self.wo.z / self.length()
    }

    /// Lowest `o^.z` of a sampler's cap: reflections have `o^.z` above it.
    ///
    /// A cap from `b` to 1 has the solid angle `2 pi (1 - b) = 4 pi N / |h|`.
    pub(super) fn cap_bottom(&self, sampler: Sampler) -> f64 {
        1.0 - 2.0 * Ggx::new(self.alpha).reflection_norm(sampler, self.wo) / self.length()
    }

    /// The same of the bounded cap as published, with eq. 7's clamp of alpha at 1.
    ///
    /// Source: Tokuyoshi and Eto 2024, eqs. 6 and 7.
    pub(super) fn published_bottom(&self) -> f64 {
        let a = self.alpha.x.min(self.alpha.y).min(1.0);
        let s = 1.0 + self.wo.x.hypot(self.wo.y);
        let (a2, s2) = (a * a, s * s);
        let k = (1.0 - a2) * s2 / (s2 + a2 * self.wo.z * self.wo.z);
        // Plus 0: no negative zero.
        -k * self.height() + 0.0
    }

    /// Solid angle of the exact region in the space of unit roughness, in closed form.
    pub(super) fn exact_solid_angle(&self) -> f64 {
        4.0 * PI * Ggx::new(self.alpha).reflection_norm(Sampler::Exact, self.wo) / self.length()
    }

    /// The reflection `o` in the space of unit roughness.
    pub(super) fn stretched_reflection(&self, o: Vec3<f64>) -> Vec3<f64> {
        let i = self.alpha.stretch(self.wo).normalize();
        let half = self.wo + o;
        let m = Vec3 {
            x: half.x / self.alpha.x,
            y: half.y / self.alpha.y,
            z: half.z,
        }
        .normalize();
        m * (2.0 * i.dot(m)) - i
    }

    /// `o^.z` of the reflection at a polar angle and an azimuth.
    pub(super) fn projected_height(&self, theta: f64, phi: f64) -> f64 {
        self.stretched_reflection(Vec3 {
            x: theta.sin() * phi.cos(),
            y: theta.sin() * phi.sin(),
            z: theta.cos(),
        })
        .z
    }

    /// The same at the horizon, in closed form.
    ///
    /// Source: Eto and Tokuyoshi 2023, eq. 1.
    pub(super) fn projected_bound(&self, phi: f64) -> f64 {
        let (x, y) = (self.wo.x + phi.cos(), self.wo.y + phi.sin());
        let z2 = self.wo.z * self.wo.z;
        let (ax, ay) = (self.alpha.x, self.alpha.y);
        let top = x * x + y * y + z2;
        let bottom = x * x / (ax * ax) + y * y / (ay * ay) + z2;
        (top / bottom - 1.0) * self.height()
    }
}
