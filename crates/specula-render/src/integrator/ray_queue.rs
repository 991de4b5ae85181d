//! Queues of rays, each with the index of its path or vertex.

use specula_bsdf::Vec3;

use super::vertex_batch::WAVEFRONT_SIZE;
use crate::accel::{Ray, RayBlock};

/// Indices of paths or vertices, each with a ray.
pub(super) struct RayQueue {
    indices: [u32; WAVEFRONT_SIZE],
    rays: RayBlock,
    len: usize,
}

impl RayQueue {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            indices: [0; WAVEFRONT_SIZE],
            rays: RayBlock::NONE,
            len: 0,
        })
    }

    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    #[inline(always)]
    pub(super) fn push(&mut self, index: u32, ray: &Ray) {
        let at = self.len % WAVEFRONT_SIZE;
        self.indices[at] = index;
        self.rays.set(at, ray);
        self.len = at + 1;
    }

    pub(super) fn len(&self) -> usize {
        self.len.min(WAVEFRONT_SIZE)
    }

    /// The index of the path or vertex.
    #[inline(always)]
    pub(super) fn index(&self, k: usize) -> usize {
        index(self.indices[k % WAVEFRONT_SIZE])
    }

    #[inline(always)]
    pub(super) fn ray(&self, k: usize) -> Ray {
        self.rays.get(k % WAVEFRONT_SIZE)
    }

    #[inline(always)]
    pub(super) fn direction(&self, k: usize) -> Vec3<f32> {
        self.rays.direction(k % WAVEFRONT_SIZE)
    }

    /// The rays, and how many there are.
    pub(super) fn rays(&self) -> (&RayBlock, usize) {
        (&self.rays, self.len())
    }
}

/// An index below the wavefront's size, which needs no check of bounds.
#[inline(always)]
pub(super) fn index(i: u32) -> usize {
    i as usize % WAVEFRONT_SIZE
}
