//! What fills the coat: a slab that absorbs and scatters.

use crate::math::{Real, Rgb, Stream, Vec3};

/// A homogeneous medium of unit extinction: lengths are optical.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Medium<T> {
    /// Optical thickness along the normal.
    pub thickness: T,
    /// Share of scattered light at each collision, in `[0, 1]`; black absorbs all.
    pub albedo: Rgb<T>,
    /// Mean cosine of the scattering angle (Henyey and Greenstein 1941), in `(-1, 1)`; positive
    /// scatters forwards.
    pub g: T,
}

impl<T: Real> Medium<T> {
    /// Nothing.
    pub const NONE: Self = Self {
        thickness: T::ZERO,
        albedo: Rgb {
            r: T::ZERO,
            g: T::ZERO,
            b: T::ZERO,
        },
        g: T::ZERO,
    };

    /// Values within their ranges; NaN becomes the lower end.
    pub(super) fn clamped(self) -> Self {
        Self {
            thickness: self.thickness.within(T::ZERO, T::of(1e6)),
            albedo: self.albedo.map(|a| a.within(T::ZERO, T::ONE)),
            g: self.g.within(T::of(-0.99), T::of(0.99)),
        }
    }

    pub(super) fn scatters(&self) -> bool {
        self.thickness > T::ZERO && !self.albedo.is_black()
    }

    /// `exp(-depth / |cos|)`: what is left after a way through a slab of that depth.
    #[inline(always)]
    pub(super) fn transmittance(depth: T, w: Vec3<T>) -> T {
        (-depth / w.z.abs().at_least(T::TINY)).exp()
    }

    /// Depth along the normal of the next collision, `Exp(1 / |cos|)`.
    #[inline(always)]
    pub(super) fn depth_of_collision(w: Vec3<T>, stream: &mut Stream) -> T {
        -(T::ONE - stream.next::<T>()).ln() * w.z.abs()
    }

    /// Density in 1/sr of being turned by an angle.
    ///
    /// ```text
    /// p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2))
    /// ```
    ///
    /// * `cos`: of the angle between the directions of travel.
    ///
    /// Source: Henyey and Greenstein 1941, eq. 2.
    #[inline(always)]
    pub(super) fn phase(&self, cos: T) -> T {
        let g = self.g;
        // (1 - g)^2 at least.
        let base = T::ONE + g * g - T::TWO * g * cos;
        (T::ONE - g) * (T::ONE + g) * T::of(0.25) * T::INV_PI / (base * base.sqrt())
    }

    /// A direction of travel after a collision, of density [`phase`](Self::phase).
    #[inline(always)]
    pub(super) fn turned(&self, w: Vec3<T>, stream: &mut Stream) -> Vec3<T> {
        let g = self.g;
        let xi = T::ONE - T::TWO * stream.next::<T>();
        // 1 - g xi > 0; its series near g = 0 is the isotropic xi.
        let cos = if g.abs() < T::of(1e-3) {
            xi + T::of(1.5) * g * (T::ONE - xi * xi)
        } else {
            let s = (T::ONE - g * g) / (T::ONE + g * xi);
            (T::ONE + g * g - s * s) / (T::TWO * g)
        };
        let cos = cos.within(-T::ONE, T::ONE);
        let sin = ((T::ONE - cos) * (T::ONE + cos)).safe_sqrt();
        let (sin_phi, cos_phi) = stream.next::<T>().sin_cos_turns();
        let frame = crate::math::Frame::from_normal(w);
        (frame.s * (sin * cos_phi) + frame.t * (sin * sin_phi) + w * cos).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud(g: f64) -> Medium<f64> {
        Medium {
            thickness: 1.0,
            albedo: Rgb::WHITE,
            g,
        }
    }

    #[test]
    fn the_phase_function_has_its_moments() {
        for g in [-0.9, -0.3, 0.0, 1e-4, 0.5, 0.95] {
            let n = 200_000;
            let mut sums = [0.0; 3];
            for i in 0..n {
                let cos = (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
                let p = cloud(g).phase(cos) * 4.0 * core::f64::consts::PI / f64::from(n);
                for (sum, x) in sums.iter_mut().zip([1.0, cos, cos * cos]) {
                    *sum += p * x;
                }
            }
            for (sum, x) in sums.into_iter().zip([1.0, g, (1.0 + 2.0 * g * g) / 3.0]) {
                assert!((sum - x).abs() < 1e-5, "{g}: {sums:?}");
            }
        }
    }

    #[test]
    fn turns_follow_the_phase_function() {
        let from = Vec3 {
            x: 0.6,
            y: 0.0,
            z: -0.8,
        };
        let n = 100_000;
        for g in [-0.9, 0.0, 5e-4, 0.5, 0.95] {
            let mut stream = Stream::new(11);
            let (mut first, mut second) = (0.0, 0.0);
            for _ in 0..n {
                let w = cloud(g).turned(from, &mut stream);
                assert!((w.length() - 1.0).abs() < 1e-12);
                let cos = w.dot(from);
                first += cos / f64::from(n);
                second += cos * cos / f64::from(n);
            }
            // Standard errors are below 2e-3.
            assert!((first - g).abs() < 8e-3, "{g}: {first}");
            let square = (1.0 + 2.0 * g * g) / 3.0;
            assert!((second - square).abs() < 8e-3, "{g}: {second}");
        }
    }
}
