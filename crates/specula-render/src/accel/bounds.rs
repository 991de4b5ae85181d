//! Axis-aligned boxes.

use bytemuck::Zeroable;

/// An axis-aligned box, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Zeroable)]
pub struct Bounds {
    /// Least coordinates.
    pub min: [f32; 3],
    /// Greatest coordinates.
    pub max: [f32; 3],
}

impl Bounds {
    /// The box that holds nothing, the neutral element of [`Bounds::union`].
    pub const EMPTY: Self = Self {
        min: [f32::INFINITY; 3],
        max: [f32::NEG_INFINITY; 3],
    };

    /// The least box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|a| self.min[a].min(other.min[a])),
            max: std::array::from_fn(|a| self.max[a].max(other.max[a])),
        }
    }

    /// The least box around the points.
    pub(super) fn around(points: &[[f32; 3]]) -> Self {
        points
            .iter()
            .fold(Self::EMPTY, |b, &p| b.union(&Self { min: p, max: p }))
    }

    /// The box with every side moved out by `fraction` of the sum of its extents, and by one ulp.
    pub(super) fn padded(&self, fraction: f32) -> Self {
        let pad = fraction * (0..3).map(|a| self.max[a] - self.min[a]).sum::<f32>();
        let pad = if pad.is_finite() { pad } else { 0.0 };
        Self {
            min: self.min.map(|x| (x - pad).next_down().max(f32::MIN)),
            max: self.max.map(|x| (x + pad).next_up().min(f32::MAX)),
        }
    }

    /// Half of the surface's area, in double precision, where no finite box overflows.
    pub(super) fn half_area(&self) -> f64 {
        let [x, y, z] = std::array::from_fn(|a| f64::from(self.max[a]) - f64::from(self.min[a]));
        x * y + y * z + z * x
    }

    /// Twice the centre's coordinate.
    pub(super) fn twice_centre(&self, axis: usize) -> f64 {
        f64::from(self.min[axis]) + f64::from(self.max[axis])
    }
}
