//! How many vertices were shaded in a render, and what of them was done in batches.

/// Vertices of paths at which light was sampled and a direction, or that ended their paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VertexCounts {
    /// Those of which all was done in batches.
    pub batched: u64,
    /// Those of which all but their lobes was: these were evaluated and sampled one after the other.
    pub bound: u64,
    /// Those that were shaded singly.
    pub single: u64,
}

impl VertexCounts {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.batched + self.bound + self.single
    }

    /// Shares of `batched`, `bound` and `single`, which add up to 1; 0 where there was no vertex.
    pub fn shares(&self) -> [f64; 3] {
        let total = self.total().max(1) as f64;
        [self.batched, self.bound, self.single].map(|count| count as f64 / total)
    }

    /// Of both.
    #[must_use]
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self {
            batched: self.batched + other.batched,
            bound: self.bound + other.bound,
            single: self.single + other.single,
        }
    }
}
