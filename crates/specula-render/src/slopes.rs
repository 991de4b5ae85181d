//! What a normal map's filter averages away, as alphas: LEAN mapping.
//!
//! Where a footprint averages normals, their slopes `p = (x, y) / z` have the mean `B` and the covariance
//! `M - B B^T`. The slopes of a surface's own facets vary about each of these normals, so that covariances add.
//! Beckmann's slopes have the variance `alpha^2 / 2` along an axis: alphas of the sum are
//!
//! ```text
//! alpha^2 = alpha_of_the_material^2 + 2 variance_of_the_map
//! ```
//!
//! along its principal axes. GGX's slopes have no variance; its alphas grow by the same, as the two distributions have
//! nearly the same peak for an alpha.
//!
//! Sources: Olano and Baker 2010, "LEAN Mapping"; for GGX Dupuy, Heitz, Iehl, Poulin, Neyret and Ostromoukhov 2013,
//! "Linear Efficient Antialiased Displacement and Reflectance Mapping", and Tokuyoshi and Kaplanyan 2019, "Improved
//! Geometric Specular Antialiasing". Departure: the covariance is that of slopes about the mean normal, by the
//! derivative of the projection there, since lobes are in its frame.
//!
//! Twin: specula-gpu/wgsl/slopes.wgsl; of materials, specula-gpu/wgsl/widened.wgsl.

use specula_bsdf::{Alpha, Frame, Vec3};

use crate::convert::narrow;
use crate::texture::NormalMoments;

/// Share of a second moment that rounding may have left of it.
const ROUNDING: f32 = 1e-6;

/// A covariance `[[xx, xy], [xy, yy]]` of slopes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SlopeCovariance {
    pub(crate) xx: f32,
    pub(crate) xy: f32,
    pub(crate) yy: f32,
}

/// How slopes of normals vary over what a normal map averages, about their mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlopeSpread {
    covariance: SlopeCovariance,
    /// The axes of the slopes in the world, unit and perpendicular to each other.
    axes: [Vec3<f32>; 2],
}

/// How a material's alphas grow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Widening {
    /// Squares of cosine and sine of the angle by which lobes are turned from the axes of the material's alphas.
    squared_cos: f32,
    squared_sin: f32,
    /// Twice the variance along the turned axes.
    base: [f32; 2],
    /// Twice the mean variance of a clear coat that has a normal of its own.
    own_coat: f32,
}

impl SlopeCovariance {
    /// The covariance of moments; 0 where rounding is all that is left.
    fn of(moments: &NormalMoments, scale: f32) -> Self {
        let [p, q] = moments.mean;
        let [pp, pq, qq] = moments.squares;
        let squared = scale * scale;
        let xx = ((pp - p * p) - ROUNDING * pp).max(0.0) * squared;
        let yy = ((qq - q * q) - ROUNDING * qq).max(0.0) * squared;
        let most = (xx * yy).sqrt();
        let xy = ((pq - p * q) * squared).clamp(-most, most);
        Self { xx, xy, yy }
    }

    fn trace(&self) -> f32 {
        self.xx + self.yy
    }
}

impl SlopeSpread {
    /// From the moments of a normal map; `None` where nothing varies.
    ///
    /// * `scale`: factor on slopes.
    /// * `axes`: those of the slopes in the world, unit and perpendicular to each other.
    pub(crate) fn new(moments: &NormalMoments, scale: f32, axes: [Vec3<f32>; 2]) -> Option<Self> {
        let SlopeCovariance { xx, xy, yy } = SlopeCovariance::of(moments, scale);
        let [p, q] = moments.mean.map(|v| v * scale);
        // The projection's derivative at the mean is that of the axes, over the length of (p, q, 1).
        let shrunk = 1.0 / (1.0 + p * p + q * q);
        let covariance = SlopeCovariance {
            xx: xx * shrunk,
            xy: xy * shrunk,
            yy: yy * shrunk,
        };
        (covariance.trace() > 0.0).then_some(Self { covariance, axes })
    }

    /// The covariance of slopes in a frame about the mean normal.
    pub(crate) fn within(&self, frame: &Frame<f32>) -> SlopeCovariance {
        let SlopeCovariance { xx, xy, yy } = self.covariance;
        let [a, b] = self.axes;
        let (sa, sb) = (frame.s.dot(a), frame.s.dot(b));
        let (ta, tb) = (frame.t.dot(a), frame.t.dot(b));
        SlopeCovariance {
            xx: sa * sa * xx + 2.0 * sa * sb * xy + sb * sb * yy,
            xy: sa * ta * xx + (sa * tb + sb * ta) * xy + sb * tb * yy,
            yy: ta * ta * xx + 2.0 * ta * tb * xy + tb * tb * yy,
        }
    }

    /// The sum of the variances along two axes about the mean normal.
    ///
    /// * `normal`: the mean normal, unit, on either side.
    pub(crate) fn trace_about(&self, normal: Vec3<f32>) -> f32 {
        let SlopeCovariance { xx, xy, yy } = self.covariance;
        let [a, b] = self.axes.map(|axis| normal.dot(axis));
        ((1.0 - a * a) * xx - 2.0 * a * b * xy + (1.0 - b * b) * yy).max(0.0)
    }
}

impl Widening {
    /// How alphas grow, and the angle by which the lobes' x axis turns: to the longer principal axis of both together.
    ///
    /// * `map`: covariance of the normal map's slopes, in the frame of `alphas`.
    /// * `own_coat`: sum of both variances of a clear coat with a normal of its own.
    /// * `alphas`: of the material, 0 where it is smooth.
    pub(crate) fn new(map: SlopeCovariance, own_coat: f32, alphas: [f32; 2]) -> (Self, f32) {
        let [x, y] = alphas.map(|alpha| 0.5 * alpha * alpha);
        let turn_rad = 0.5 * (2.0 * map.xy).atan2((x + map.xx) - (y + map.yy));
        let (sin, cos) = turn_rad.sin_cos();
        let (squared_cos, squared_sin) = (cos * cos, sin * sin);
        let mixed = 2.0 * sin * cos * map.xy;
        let widening = Self {
            squared_cos,
            squared_sin,
            base: [
                2.0 * (squared_cos * map.xx + mixed + squared_sin * map.yy),
                2.0 * (squared_sin * map.xx - mixed + squared_cos * map.yy).max(0.0),
            ],
            own_coat,
        };
        (widening, turn_rad)
    }

    /// The grown alphas along the turned axes. Those of a layer with other axes than the material's are the ones along
    /// these.
    ///
    /// * `alphas`: 0 where it is smooth.
    pub(crate) fn of(&self, alphas: [f32; 2]) -> [f32; 2] {
        let [x, y] = alphas.map(|alpha| alpha * alpha);
        let (cos, sin) = (self.squared_cos, self.squared_sin);
        [
            (cos * x + sin * y + self.base[0]).sqrt(),
            (sin * x + cos * y + self.base[1]).sqrt(),
        ]
    }

    /// [`Widening::of`] of a surface that may be smooth, and is still so where both alphas are below
    /// [`Alpha::SPECULAR_BELOW`].
    pub(crate) fn of_rough(&self, alpha: Option<Alpha<f32>>) -> Option<Alpha<f32>> {
        let bound = narrow(Alpha::<f32>::SPECULAR_BELOW);
        let [x, y] = self.of(alpha.map_or([0.0; 2], |a| [a.x, a.y]));
        (x >= bound || y >= bound).then(|| Alpha::clamped(x.max(bound), y.max(bound)))
    }

    /// The grown alpha of a layer that is isotropic: by the mean of both variances.
    pub(crate) fn of_isotropic(&self, alpha: f32) -> f32 {
        let [x, y] = self.base;
        (alpha * alpha + 0.5 * (x + y)).sqrt()
    }

    /// The grown alpha of a clear coat with a normal of its own.
    pub(crate) fn of_own_coat(&self, alpha: f32) -> f32 {
        (alpha * alpha + self.own_coat).sqrt()
    }
}

#[cfg(test)]
mod tests;
