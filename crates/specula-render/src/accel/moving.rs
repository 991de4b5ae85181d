//! Rays with a time, in structures some of whose instances move.
//!
//! Separate from the other entries, so that still scenes neither store times nor ask for motions.

use super::kernel::Portable;
use super::traverse;
use super::{Accel, BlockHits, Hit, KernelChoice, Ray, RayBlock};

impl Accel {
    /// Whether any instance moves: only then times matter.
    pub(crate) fn moves(&self) -> bool {
        !self.scene.movements.is_empty()
    }

    /// [`Accel::intersect`] at a time, in exposures; without motion, at any.
    #[inline]
    pub(crate) fn intersect_at(&self, ray: &Ray, time: f32) -> Option<Hit> {
        if !self.moves() {
            return self.intersect(ray);
        }
        match self.kernel {
            KernelChoice::Portable => traverse::intersect_at(Portable, &self.scene, ray, time),
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.intersect_at(&self.scene, ray, time),
        }
    }

    /// [`Accel::occluded`] at a time.
    #[inline]
    pub(crate) fn occluded_at(&self, ray: &Ray, time: f32) -> bool {
        if !self.moves() {
            return self.occluded(ray);
        }
        match self.kernel {
            KernelChoice::Portable => traverse::occluded_at(Portable, &self.scene, ray, time),
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.occluded_at(&self.scene, ray, time),
        }
    }

    /// [`Accel::intersect_block`] of rays with times, which are asked for where something moves.
    ///
    /// * `time`: by the ray's index.
    pub(crate) fn intersect_block_at(
        &self,
        (rays, n): (&RayBlock, usize),
        time: impl Fn(usize) -> f32,
        hits: &mut BlockHits,
    ) {
        if !self.moves() {
            return self.intersect_block((rays, n), hits);
        }
        hits.hits.clear();
        (hits.hits).extend((0..n).map(|k| self.intersect_at(&rays.get(k), time(k))));
    }

    /// [`Accel::occluded_block`] of rays with times, as of [`Accel::intersect_block_at`].
    pub(crate) fn occluded_block_at(
        &self,
        (rays, n): (&RayBlock, usize),
        time: impl Fn(usize) -> f32,
        occluded: &mut Vec<bool>,
    ) {
        if !self.moves() {
            return self.occluded_block((rays, n), occluded);
        }
        occluded.clear();
        occluded.extend((0..n).map(|k| self.occluded_at(&rays.get(k), time(k))));
    }
}
