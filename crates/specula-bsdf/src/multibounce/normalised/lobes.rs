//! Lobes for light that has met so many facets that little is left of its first flight.
//!
//! Each coordinate of a lobe, `x` in (-1, 1), has the slope `s = x / sqrt(1 - x^2)`, and that Student's
//! distribution with two degrees of freedom about `centre`, of scale `width`:
//!
//! ```text
//! P(x) = 1/2 + t / (2 sqrt(1 + t^2)),   t = (s - centre) / width
//! ```
//!
//! It is uniform in `x` for centre 0 and width 1, and its tails are those of GGX's slopes.

use super::maps::at;
use crate::math::{Real, Vec3, acos};

/// Distribution of a coordinate in (-1, 1).
#[derive(Clone, Copy)]
pub(super) struct Student<T> {
    pub(super) centre: T,
    pub(super) width: T,
}

impl<T: Real> Student<T> {
    /// `P(x)` and `dP / dx`.
    ///
    /// * `cos`: `sqrt(1 - x^2)`, which cancels near the ends unless it is known otherwise.
    #[inline(always)]
    fn cumulative(self, x: T, cos: T) -> (T, T) {
        let cos = cos.at_least(T::of(1e-9));
        let t = (x / cos - self.centre) / self.width;
        let secant = (T::ONE + t * t).sqrt();
        let both = secant * cos;
        let slope = T::HALF / (self.width * both * both * both);
        (T::HALF + T::HALF * t / secant, slope)
    }

    /// The `x` of `P(x) = u`.
    #[inline(always)]
    fn inverse(self, u: T) -> T {
        let sine = T::TWO * u - T::ONE;
        let cos = (T::of(4.0) * u * (T::ONE - u))
            .at_least(T::of(1e-18))
            .sqrt();
        let s = self.centre + self.width * (sine / cos);
        s / (T::ONE + s * s).sqrt()
    }
}

/// Alike in all azimuths; the squared height is distributed.
#[derive(Clone, Copy)]
pub(super) struct Round<T> {
    heights: Student<T>,
}

impl<T: Real> Round<T> {
    /// * `scale`: the geometric mean of the alphas.
    /// * `mu`: `wo.z`.
    #[inline(always)]
    pub(super) fn new(scale: T, mu: T) -> Self {
        let height = T::TWO * mu * mu - T::ONE;
        let blunt = T::of(0.172) + T::of(3.81) / scale;
        Self {
            heights: Student {
                centre: T::of(0.777) * height / (T::ONE - height * height + blunt).sqrt(),
                width: T::of(2.7) / (T::of(5.7) + scale).sqrt(),
            },
        }
    }

    /// The density of `wi`, and the point of the unit square that [`direction`](Self::direction) sends there.
    #[inline(always)]
    pub(super) fn density(self, wi: Vec3<T>) -> (T, [T; 2]) {
        let radius = (wi.x * wi.x + wi.y * wi.y).sqrt();
        let height = T::TWO * wi.z * wi.z - T::ONE;
        let (below, slope) = self.heights.cumulative(height, T::TWO * wi.z * radius);
        let cos = wi.x / radius.at_least(T::TINY);
        let angle = acos(cos.abs().at_most(T::ONE));
        let half_turns = T::INV_PI * T::select(cos < T::ZERO, T::PI - angle, angle);
        let turn = T::HALF + T::HALF * half_turns.copysign(wi.y);
        (T::TWO * slope * wi.z * T::INV_PI, [T::ONE - below, turn])
    }

    #[inline(always)]
    pub(super) fn direction(self, u: [T; 2]) -> Vec3<T> {
        let squared = T::HALF + T::HALF * self.heights.inverse(T::ONE - u[0]);
        // Half a turn less.
        let (sin, cos) = u[1].sin_cos_turns();
        at([-cos, -sin], squared.safe_sqrt())
    }
}

/// About the grain, which is the axis of less roughness: light that meets facets across it keeps its
/// component along it.
#[derive(Clone, Copy)]
pub(super) struct Cone<T> {
    along: Student<T>,
    heights: Student<T>,
    /// Towards one side of the grain.
    skew: T,
}

impl<T: Real> Cone<T> {
    /// * `[low, high]`: the alphas, the smaller one along the grain.
    /// * `[along, across]`: `wo`, along and across the grain; `mu` is `wo.z`.
    #[inline(always)]
    pub(super) fn new([low, high]: [T; 2], [along, across]: [T; 2], mu: T) -> Self {
        let radius2 = mu * mu + across * across;
        let soft = T::of(2.73) * low;
        let centre = T::of(-1.02) * along / (radius2 + soft * soft).sqrt();
        let spread = T::of(0.711) * (low / (T::ONE + T::of(0.14) * low)).sqrt();
        let height = T::ONE - T::TWO * across.abs() / radius2.at_least(T::TINY).sqrt();
        let blunt = T::of(0.28) + T::of(0.18) / high;
        let skew = T::of(-0.866) * across / (T::ONE + T::of(6.14) * high * high);
        Self {
            along: Student {
                centre,
                width: spread * (T::ONE + centre * centre).sqrt(),
            },
            heights: Student {
                centre: T::of(0.484) * height / (T::ONE - height * height + blunt).sqrt(),
                width: T::of(2.0) / (T::of(0.66) + high).sqrt(),
            },
            skew: skew.within(T::of(-0.9), T::of(0.9)),
        }
    }

    /// The density of the direction `[along, across, z]`, and the point of the unit square that
    /// [`direction`](Self::direction) sends there.
    #[inline(always)]
    pub(super) fn density(self, [along, across, z]: [T; 3]) -> (T, [T; 2]) {
        let radius = (across * across + z * z).sqrt().at_least(T::of(1e-6));
        let (u, slope) = self.along.cumulative(along, radius);
        // (c + k) / (1 + k c) moves what goes to both sides alike; `less` and `more` are 1 - c and 1 + c.
        let (k, c) = (self.skew, across / radius);
        let near = z * z / (radius * (radius + across.abs()));
        let far = T::ONE + c.abs();
        let is_left = c < T::ZERO;
        let less = T::select(is_left, far, near) * (T::ONE + k);
        let more = T::select(is_left, near, far) * (T::ONE - k);
        let inverse = T::ONE / (T::ONE - k * c);
        let moved = (T::ONE - k * k) * inverse * inverse;
        let even = T::HALF * (more - less) * inverse;
        let rest = less.at_most(more) * inverse;
        let cos = T::TWO * (even.abs() * rest).sqrt();
        let (below, height_slope) = self.heights.cumulative(T::TWO * rest - T::ONE, cos);
        let outwards = T::HALF * (T::ONE - below);
        // Half a turn is added, so that the sides meet where the square's do.
        let v = T::select(even < T::ZERO, T::ONE - outwards, outwards);
        (slope * height_slope * moved * z / radius, [u, v])
    }

    #[inline(always)]
    pub(super) fn direction(self, u: [T; 2]) -> [T; 3] {
        let along = self.along.inverse(u[0]);
        let radius = ((T::ONE - along) * (T::ONE + along)).safe_sqrt();
        let is_left = u[1] >= T::HALF;
        let outwards = T::TWO * T::select(is_left, T::ONE - u[1], u[1]);
        let even = T::HALF - T::HALF * self.heights.inverse(T::ONE - outwards);
        let even = T::select(is_left, -even, even);
        let k = self.skew;
        let c = (even + k) / (T::ONE + k * even);
        [along, radius * c, radius * (T::ONE - c * c).safe_sqrt()]
    }
}
