//! How many directions lobes sampled in a render, and how many of them were rejected.

/// Directions sampled at surfaces, black ones apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScatterCounts {
    /// How many.
    pub sampled: u64,
    /// Those of them at which a lobe gave none, so that the path ended: a sampler's waste.
    pub rejected: u64,
}

impl ScatterCounts {
    /// Share of the samples that were rejected, in `[0, 1]`; 0 where there was none.
    pub fn rejected_share(&self) -> f64 {
        self.rejected as f64 / self.sampled.max(1) as f64
    }

    /// Of both.
    #[must_use]
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self {
            sampled: self.sampled + other.sampled,
            rejected: self.rejected + other.rejected,
        }
    }
}
