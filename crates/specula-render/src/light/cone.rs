//! Bounds on the directions that lights send light to.

use specula_bsdf::Vec3;

/// A bound on the emission of a set of lights: every one's normal lies within `theta_o` of the
/// axis, and sends light up to `theta_e` away from it.
///
/// Source: Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree
/// Splitting, section 4.1. Departure: lights that emit to both sides are bounded by a double cone,
/// as in pbrt-v4. In `f64`, since the angle of nearly parallel directions loses half of the digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmissionCone {
    /// Unit.
    pub(crate) axis: Vec3<f64>,
    /// In `[0, pi]`.
    pub(crate) theta_o: f64,
    /// In `[0, pi]`.
    pub(crate) theta_e: f64,
    /// Whether the opposite cone belongs to it too.
    pub(crate) two_sided: bool,
}

impl EmissionCone {
    /// Of a light that sends light everywhere.
    pub(crate) const SPHERE: Self = Self {
        axis: Vec3::Z,
        theta_o: core::f64::consts::PI,
        theta_e: core::f64::consts::FRAC_PI_2,
        two_sided: false,
    };

    /// Of a flat light.
    ///
    /// * `normal`: unit, on the side that emits.
    pub(crate) fn flat(normal: Vec3<f32>, two_sided: bool) -> Self {
        Self {
            axis: normal.cast(),
            theta_o: 0.0,
            theta_e: core::f64::consts::FRAC_PI_2,
            two_sided,
        }
    }

    /// A cone around both, the least one where neither holds the other.
    ///
    /// ```text
    /// theta_o = (theta_a + theta_d + theta_b) / 2,   theta_d = angle(axis_a, axis_b)
    /// ```
    ///
    /// The axis is that of `a`, turned towards that of `b` by `theta_o - theta_a`; of opposite axes,
    /// all directions.
    ///
    /// Source: Conty Estevez and Kulla 2018, algorithm 1.
    pub(crate) fn union(&self, other: &Self) -> Self {
        let (a, mut b) = if self.theta_o >= other.theta_o {
            (*self, *other)
        } else {
            (*other, *self)
        };
        let theta_e = a.theta_e.max(b.theta_e);
        let two_sided = a.two_sided || b.two_sided;
        if a.two_sided && b.two_sided && a.axis.dot(b.axis) < 0.0 {
            b.axis = -b.axis;
        }
        let held = Self {
            theta_e,
            two_sided,
            ..a
        };
        let cos = a.axis.dot(b.axis).clamp(-1.0, 1.0);
        // Without the angle where the axes are the same: lights of one plane are common.
        if a.theta_o >= core::f64::consts::PI || cos >= 1.0 {
            return held;
        }
        let theta_d = cos.acos();
        if theta_d + b.theta_o <= a.theta_o {
            return held;
        }
        let theta_o = 0.5 * (a.theta_o + theta_d + b.theta_o);
        let sideways = b.axis - a.axis * cos;
        let length = sideways.length();
        if theta_o >= core::f64::consts::PI || length <= 0.0 {
            return Self {
                theta_o: core::f64::consts::PI,
                ..held
            };
        }
        let (sin, cos) = (theta_o - a.theta_o).sin_cos();
        Self {
            axis: (a.axis * cos + sideways * (sin / length)).normalize(),
            theta_o,
            ..held
        }
    }

    /// Solid angle of the emission, weighted by its cosine to the nearest normal.
    ///
    /// ```text
    /// M = 2 pi (1 - cos o) + pi/2 (2 w sin o - cos(o - 2 w) - 2 o sin o + cos o),
    /// o = theta_o,   w = min(theta_o + theta_e, pi)
    /// ```
    ///
    /// Source: Conty Estevez and Kulla 2018, eq. 1. Departure: twice that of a double cone.
    pub(crate) fn measure(&self) -> f64 {
        use core::f64::consts::{FRAC_PI_2, PI, TAU};
        let o = self.theta_o;
        let w = (o + self.theta_e).min(PI);
        let (sin, cos) = o.sin_cos();
        let rim = 2.0 * w * sin - (o - 2.0 * w).cos() - 2.0 * o * sin + cos;
        let one = TAU * (1.0 - cos) + FRAC_PI_2 * rim;
        if self.two_sided { 2.0 * one } else { one }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};
    use specula_bsdf::math::vec3;

    fn cone(axis: Vec3<f64>, theta_o: f64, two_sided: bool) -> EmissionCone {
        EmissionCone {
            axis: axis.normalize(),
            theta_o,
            theta_e: FRAC_PI_2,
            two_sided,
        }
    }

    /// Angle from the nearest axis.
    fn angle(c: &EmissionCone, w: Vec3<f64>) -> f64 {
        let cos = c.axis.dot(w);
        let cos = if c.two_sided { cos.abs() } else { cos };
        cos.clamp(-1.0, 1.0).acos()
    }

    #[test]
    fn a_union_holds_both_and_touches_them() {
        let axes = [
            vec3(0.0, 0.0, 1.0),
            vec3(0.3, -0.2, 0.9),
            vec3(1.0, 0.2, -0.5),
            vec3(0.0, 1e-5, 1.0),
            vec3(0.0, 0.0, -1.0),
        ];
        let directions: Vec<Vec3<f64>> = (0..4000)
            .map(|i| {
                let z = 1.0 - (f64::from(i) + 0.5) / 2000.0;
                let (sin, cos) = (2.4 * f64::from(i)).sin_cos();
                let r = (1.0 - z * z).sqrt();
                vec3(r * cos, r * sin, z)
            })
            .collect();
        for (i, &x) in axes.iter().enumerate() {
            for (j, &y) in axes.iter().enumerate() {
                for (o, p) in [(0.0, 0.0), (0.2, 0.5), (1.0, 2.9), (0.0, PI)] {
                    for sides in 0..4 {
                        let a = cone(x, o, sides & 1 == 1);
                        let b = cone(y, p, sides & 2 == 2);
                        let u = a.union(&b);
                        assert!((u.axis.length() - 1.0).abs() < 1e-12);
                        for &w in &directions {
                            let inside = angle(&a, w) <= o || angle(&b, w) <= p;
                            assert!(
                                !inside || angle(&u, w) <= u.theta_o + 1e-9,
                                "{i} {j} {a:?} {b:?} {u:?}"
                            );
                        }
                        let opposite = (a.axis + b.axis).length() < 1e-9;
                        assert!(opposite || u.theta_o <= p.max(0.5 * (o + p + PI)) + 1e-9);
                    }
                }
            }
        }
        let u = cone(Vec3::Z, 0.1, false).union(&cone(Vec3::X, 0.3, false));
        assert!((u.theta_o - 0.5 * (0.4 + FRAC_PI_2)).abs() < 1e-12);
    }

    #[test]
    fn measures_are_the_closed_forms_of_the_paper() {
        // A single normal with a hemisphere: the projected hemisphere; a point light: the sphere.
        assert!((cone(Vec3::Z, 0.0, false).measure() - PI).abs() < 1e-12);
        assert!((cone(Vec3::Z, 0.0, true).measure() - 2.0 * PI).abs() < 1e-12);
        assert!((EmissionCone::SPHERE.measure() - 4.0 * PI).abs() < 1e-12);
        // The integral, by the midpoint rule over the angle from the axis.
        for (o, e) in [(0.3, 1.2), (1.0, FRAC_PI_2), (2.0, 0.4)] {
            let c = EmissionCone {
                theta_o: o,
                theta_e: e,
                ..EmissionCone::SPHERE
            };
            let n = 20_000;
            let end = (o + e).min(PI);
            let sum: f64 = (0..n)
                .map(|i| {
                    let t = (f64::from(i) + 0.5) / f64::from(n) * end;
                    2.0 * PI * t.sin() * (t - o).max(0.0).cos()
                })
                .sum();
            let expected = sum * end / f64::from(n);
            assert!((c.measure() - expected).abs() < 1e-6, "{o} {e}");
        }
    }
}
