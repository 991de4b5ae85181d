//! The stretched space: views, caps, and the cone of valid half vectors.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_bsdf::vndf::reflect;

use super::Surface;

impl Surface {
    /// The view in the stretched space, unit.
    pub(super) fn stretched(&self) -> Vec3<f64> {
        let stretched = self.alpha.stretch(self.wo);
        let length = stretched.length();
        vec3(
            stretched.x / length,
            stretched.y / length,
            stretched.z / length,
        )
    }

    /// `|(ax x, ay y, z)|` of the view.
    pub(super) fn length(&self) -> f64 {
        self.alpha.stretch(self.wo).length()
    }

    /// The reflection in the stretched space that belongs to a microfacet normal.
    ///
    /// The normals of the stretched space are `(x / ax, y / ay, z)`, normalised: `alpha.stretch` takes them back.
    pub(super) fn reflection_of(&self, wm: Vec3<f64>) -> Vec3<f64> {
        let m = vec3(wm.x / self.alpha.x, wm.y / self.alpha.y, wm.z);
        reflect(
            self.stretched(),
            m * (1.0 / m.length().max(f64::MIN_POSITIVE)),
        )
    }

    /// The reflection of the surface that belongs to one in the stretched space.
    ///
    /// Their half vector is along the normal. It vanishes where `o = -i`: on the rim of the cap, where the normals
    /// are at a right angle to the view, which goes straight on.
    pub(super) fn surface_reflection(&self, o: Vec3<f64>) -> Vec3<f64> {
        let half = self.stretched() + o;
        if half.length_squared() < 1e-24 {
            return -self.wo;
        }
        let wm = self.alpha.stretch(half);
        reflect(self.wo, wm * (1.0 / wm.length()))
    }

    /// `(a, s, k)` of the bounded cap `z > -k i.z`; `k` is 1 for views below the horizon, which take the whole cap.
    ///
    /// Source: Tokuyoshi and Eto 2024, eqs. 5 to 7, without eq. 7's clamp at 1, as in `vndf::bounded`.
    pub(super) fn bound(&self) -> (f64, f64, f64) {
        let a = self.alpha.x.min(self.alpha.y);
        let sine = self.wo.x.hypot(self.wo.y);
        let s = 1.0 + sine.copysign(1.0 - a);
        if self.wo.z <= 0.0 {
            return (a, s, 1.0);
        }
        let (a2, s2) = (a * a, s * s);
        let bottom = (s2 + a2 * self.wo.z * self.wo.z).max(1e-24);
        (a, s, (1.0 - a2) * s2 / bottom)
    }

    /// The cone of half vectors whose reflections are above the surface, for views above it.
    ///
    /// Source: `docs/exact-reflection-sampling.md`; `lambda` by bisection of its equation, which is monotone, between
    /// `i.z`, where it is negative, and `i.z + |(hx, hy)|`, where it is not.
    pub(super) fn cone(&self) -> Option<Cone> {
        let z = self.wo.z;
        if z <= 0.0 {
            return None;
        }
        let h = self.alpha.stretch(self.wo);
        let tilt = [self.alpha.x, self.alpha.y].map(|a| z * a * a);
        let [p, q] = [h.x * h.x, h.y * h.y];
        let (mut low, mut high) = (z, z + h.x.hypot(h.y));
        for _ in 0..80 {
            let l = 0.5 * (low + high);
            if l - z - p / (l + tilt[0]) - q / (l + tilt[1]) < 0.0 {
                low = l;
            } else {
                high = l;
            }
        }
        let lambda = 0.5 * (low + high);
        let d = tilt.map(|t| lambda + t);
        let axis = vec3(h.x / d[0], h.y / d[1], 1.0);
        Some(Cone { lambda, d, axis })
    }
}

/// Half vectors of valid reflections: `Dx x^2 + Dy y^2 < lambda` along the axis.
pub(super) struct Cone {
    /// Eigenvalue.
    pub(super) lambda: f64,
    /// `Dx`, `Dy`.
    pub(super) d: [f64; 2],
    /// `v`, not unit.
    pub(super) axis: Vec3<f64>,
}

impl Cone {
    /// `N = lambda^2 / (|v|^2 sqrt(Dx Dy))`.
    pub(super) fn norm(&self) -> f64 {
        let [x, y] = self.d;
        self.lambda * self.lambda / (self.axis.length_squared() * (x * y).sqrt())
    }

    /// A half vector of the cone's edge, unit.
    ///
    /// The foot `p` of the edge is on the ellipse; `p + t v` is on the unit sphere for the greater root of
    /// `|v|^2 t^2 + 2 t p.v + |p|^2 - 1 = 0`, which is positive since `|p| <= 1` (`Dj >= lambda`).
    pub(super) fn edge(&self, azimuth: f64) -> Vec3<f64> {
        let (sin, cos) = azimuth.sin_cos();
        let foot = vec3(
            (self.lambda / self.d[0]).sqrt() * cos,
            (self.lambda / self.d[1]).sqrt() * sin,
            0.0,
        );
        let (a, b) = (self.axis.length_squared(), foot.dot(self.axis));
        let c = (1.0 - foot.length_squared()).max(0.0);
        let t = ((b * b + a * c).sqrt() - b) / a;
        foot + self.axis * t
    }
}
