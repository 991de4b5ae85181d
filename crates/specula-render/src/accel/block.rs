//! Blocks of rays as structures of arrays, and their hits.

use super::brute_force::SmallHits;
use super::{Accel, Hit, Ray};
use crate::soa::{Floats, Vectors};
use specula_bsdf::Vec3;

/// Most rays of a block.
pub(crate) const BLOCK: usize = 512;

/// Rays, one after the other in columns.
#[derive(Clone, Debug)]
pub(crate) struct RayBlock {
    pub(super) origin: Vectors<BLOCK>,
    pub(super) direction: Vectors<BLOCK>,
    pub(super) t_max: Floats<BLOCK>,
}

impl RayBlock {
    pub(crate) const NONE: Self = Self {
        origin: Vectors::ZERO,
        direction: Vectors::ZERO,
        t_max: Floats::of(0.0),
    };

    /// Rays of a list, as many as fit.
    pub(super) fn of(rays: &[Ray]) -> Self {
        let mut block = Self::NONE;
        for (k, ray) in rays.iter().take(BLOCK).enumerate() {
            block.set(k, ray);
        }
        block
    }

    #[inline(always)]
    pub(crate) fn get(&self, k: usize) -> Ray {
        Ray {
            origin: self.origin.get(k),
            direction: self.direction.get(k),
            t_max: self.t_max[k],
        }
    }

    #[inline(always)]
    pub(crate) fn direction(&self, k: usize) -> Vec3<f32> {
        self.direction.get(k)
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, k: usize, ray: &Ray) {
        self.origin.set(k, ray.origin);
        self.direction.set(k, ray.direction);
        self.t_max[k] = ray.t_max;
    }
}

/// The closest hits of a block of rays.
#[derive(Clone, Debug)]
pub(crate) struct BlockHits {
    pub(super) small: SmallHits,
    /// Of scenes that are not small.
    pub(super) hits: Vec<Option<Hit>>,
}

impl BlockHits {
    pub(crate) fn new() -> Self {
        Self {
            small: SmallHits::NONE,
            hits: Vec::with_capacity(BLOCK),
        }
    }

    /// What the ray of a small scene hit, by its place; no index where it hit nothing.
    #[inline(always)]
    pub(crate) fn place(&self, k: usize) -> u32 {
        self.small.place[k % BLOCK]
    }

    /// Where the ray of a small scene hit it.
    #[inline(always)]
    pub(crate) fn t(&self, k: usize) -> f32 {
        self.small.t[k % BLOCK]
    }

    /// The hit of a ray.
    ///
    /// * `ray`: asked for in small scenes.
    #[inline(always)]
    pub(crate) fn get(&self, accel: &Accel, k: usize, ray: impl FnOnce() -> Ray) -> Option<Hit> {
        match &accel.small {
            Some(small) => small.hit(&self.small, k, &ray()),
            None => self.hits[k],
        }
    }
}
